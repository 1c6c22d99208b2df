"""What a timeline shows of itself in a notebook."""

from pathlib import Path
from typing import Protocol

from vasc.notebook import card
from vasc.timeline.frame import Frame


class Recorded(Protocol):
    """What the card of a timeline needs of it."""

    path: Path

    @property
    def model(self) -> str:
        """Name of the model."""

    @property
    def growth(self) -> str:
        """Name of the growth."""

    @property
    def seed(self) -> int:
        """Seed of the run."""

    @property
    def last_step(self) -> int:
        """The last recorded step."""

    @property
    def is_complete(self) -> bool:
        """Whether the run ended by itself."""

    def n_rows(self, table: str) -> int:
        """Give the number of rows of a table."""

    def frame(self, step: int = -1) -> Frame:
        """Give a recorded step."""


def timeline_card(timeline: Recorded) -> str:
    """Give the last step and a few facts of a timeline, as HTML; never fails.

    Parameters
    ----------
    timeline : Timeline
        Open, closed, or still being written.

    Returns
    -------
    str
    """
    facts = {
        "model": lambda: timeline.model,
        "growth": lambda: timeline.growth,
        "seed": lambda: str(timeline.seed),
        "last step": lambda: timeline.last_step,
        "complete": lambda: "yes" if timeline.is_complete else "no",
        "nodes": lambda: timeline.frame().n_vein_nodes,
        "sources": lambda: timeline.n_rows("sources"),
        "events": lambda: timeline.n_rows("events"),
    }
    return card(f"Timeline {timeline.path.name}", facts, lambda: timeline.frame().picture())
