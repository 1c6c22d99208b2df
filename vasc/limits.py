"""How much vasc takes in: every limit on the size of what others give it, in one place.

Limits on numbers in a config that follow from what a run can hold are beside the
parameters and in :mod:`vasc.config.limits`. docs/limits.md lists all of them for users.
"""

CONFIG_BYTES = 1_000_000
"""Bytes of a config or sweep file."""

CONFIG_DEPTH = 32
"""Levels of tables and lists in a config."""

FILE_BYTES = 20_000_000
"""Bytes of a file that a config refers to: it travels with every timeline."""

FILE_DEPTH = 64
"""Levels of elements or brackets in an outline."""

OUTLINE_POINTS = 200_000
"""Points of all rings of an outline together."""

OUTLINE_RINGS = 1000
"""Rings of an outline."""

IMAGE_PIXELS = 64_000_000
"""Pixels of a mask or scan, by its header."""

NETWORK_BYTES = 500_000_000
"""Bytes of a file of a real network, and of what a compressed one holds."""

NETWORK_DEPTH = 32
"""Levels of elements or brackets in a file of a real network."""

NETWORK_ROWS = 5_000_000
"""Nodes, or edges, of a real network."""

NAME_LENGTH = 200
"""Characters of a name: of a node, a landmark, the title of an experiment."""

TISSUE_CELLS = 250_000
"""Cells of a tissue: each takes about 5 kB of memory, and up to 60 bytes a step on the disk."""

RUN_STEPS = 1_000_000
"""Steps of a run, of which every one is recorded."""

RUN_NODES = 5_000_000
"""Nodes of a run."""

RUN_SOURCES = 5_000_000
"""Sources of a run."""

SWEEP_RUNS = 100_000
"""Runs that a sweep may have: each is a file, and a folder holds no more with ease."""

MEMORY_SHARE = 0.8
"""Share of the memory of the machine that a run may be expected to take."""

FREE_BYTES = 64_000_000
"""Bytes that a disk must have free for a run to begin."""
