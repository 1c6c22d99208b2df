"""What the configs of models on a tissue have in common."""

from abc import abstractmethod
from pathlib import Path
from typing import Annotated

import numpy as np
from pydantic import Field, model_validator

from vasc.arrays import Ids
from vasc.domain import Tissue
from vasc.domain.tissue_parameters import TissueParameters
from vasc.errors import ConfigError
from vasc.models.base import (
    Model,
    PrintedParameters,
    RecordParameters,
    StopParameters,
    UnitParameters,
)
from vasc.parameters import Parameters, quantity

Line = Annotated[list[tuple[float, float]], Field(min_length=1)]


class VeinParameters(Parameters):
    """Veins that are there at first: cells along lines, and those of the margin."""

    lines: list[Line] = quantity(
        "Lines of points [x, y]; one point is a vein of one cell.", unit="D", default=[]
    )
    margin: bool = quantity("Whether the cells of the margin are a vein.", default=False)

    @model_validator(mode="after")
    def _check(self) -> "VeinParameters":
        """Require a vein."""
        if not self.lines and not self.margin:
            raise ValueError("give 'lines' or margin = true; without a vein auxin has no way out")
        return self

    def cells(self, tissue: Tissue) -> list[Ids]:
        """Give the cells of every vein, along its line."""
        return [tissue.cells_along(np.array(line)) for line in self.lines]


class TissueExperiment(Parameters):
    """What all models on a tissue have in common."""

    title: str = quantity("One sentence on the experiment.", default="")
    reference: str = quantity("The figure or paper it follows.", default="")
    seed: int = quantity("Seed of all randomness.", default=1, ge=0, lt=2**63)
    domain: TissueParameters = quantity("The tissue.")
    stop: StopParameters = quantity("When the run ends.", default=StopParameters())
    record: RecordParameters = quantity("What is recorded.", default=RecordParameters())
    units: UnitParameters | None = quantity("Real units.", default=None)
    printed: PrintedParameters | None = quantity("Values as printed.", default=None)

    @property
    def stream_names(self) -> tuple[str, ...]:
        """Names of the processes that draw random numbers."""
        return ("placement", "noise")

    @abstractmethod
    def model(self, folder: Path = Path()) -> Model:
        """Give the model; files are looked for in ``folder``."""


class CellSourceParameters(Parameters):
    """Sources in given places, all at once or in rounds."""

    kind: str = "given"
    points: list[tuple[float, float]] = quantity(
        "Places of the sources, pairs [x, y]: the nearest cell of each.", unit="D", default=[]
    )
    rounds: list[int] | None = quantity(
        "Round in which each appears, from 1 on: when the canals of the round before have"
        " settled. By default all in the first.",
        default=None,
    )

    @model_validator(mode="after")
    def _check(self) -> "CellSourceParameters":
        """Require one round a point."""
        if self.rounds is not None and len(self.rounds) != len(self.points):
            raise ValueError("'rounds' needs one number for each of 'points'")
        return self


def in_rounds(tissue: Tissue, given: CellSourceParameters) -> tuple[Ids, Ids]:
    """Give the cells of given sources and their rounds, in the order of these."""
    cells = tissue.nearest_cells(given.points)
    rounds = np.array(given.rounds or [1] * len(cells), dtype=np.int32)
    if len(np.unique(cells)) < len(cells):
        raise ConfigError("placement.points: two sources lie in one cell")
    order = np.argsort(rounds, kind="stable")
    return cells[order], rounds[order]
