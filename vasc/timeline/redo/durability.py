"""When what is committed is brought to the disk, so that it outlives a loss of power."""

from enum import StrEnum

BATCH_COMMITS = 16
"""Commits that are brought to the disk together at most."""
BATCH_SECONDS = 1.0
"""Age of the oldest of them at which they are."""


class Durability(StrEnum):
    """What a run may lose; a killed process never loses what was committed.

    ``PROCESS``: nothing is brought to the disk on purpose. ``BATCH``: a loss of power takes
    at most the last second, or 16 commits. ``STRICT``: every step is committed by itself, and
    is on the disk before the next begins.
    """

    PROCESS = "process"
    BATCH = "batch"
    STRICT = "strict"
