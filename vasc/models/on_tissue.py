"""What the configs of models on a tissue have in common."""

from abc import abstractmethod
from pathlib import Path
from typing import Annotated

import numpy as np
from pydantic import Field, model_validator

from vasc.arrays import Ids
from vasc.domain import Tissue
from vasc.domain.normalization import Pair
from vasc.domain.tissue import sampled
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

Line = Annotated[list[Pair], Field(min_length=1)]


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
        """Give the cells of every vein, along its line; a margin comes back to its first cell.

        Raises
        ------
        ConfigError
            If a line leaves the tissue, or a part of the tissue has no vein.
        """
        for row, line in enumerate(self.lines):
            corners = np.array(line, dtype=np.float64)
            # points along a line to somewhere very far would be more than memory holds
            is_far = np.abs(corners).max() > 10.0 * np.abs(tissue.blade.bounds).max() + 100.0
            points = corners if is_far else sampled(corners)
            for x, y in points[tissue.are_outside(points)].tolist():
                low_x, low_y, high_x, high_y = tissue.blade.bounds
                raise ConfigError(
                    f"veins.lines[{row}]: lies outside the tissue at ({x:g}, {y:g}); veins must"
                    f" lie inside, between ({low_x:g}, {low_y:g}) and ({high_x:g}, {high_y:g})"
                )
        lines = [tissue.cells_along(np.array(line)) for line in self.lines]
        found = lines + (tissue.margins if self.margin else [])
        far = np.flatnonzero(np.isinf(tissue.hops(np.concatenate(found))))
        if len(far):
            x, y = tissue.positions[far[0]].tolist()
            raise ConfigError(
                f"veins: no way leads from the cell at ({x:g}, {y:g}) to a vein; each part of a"
                " tissue needs one"
            )
        return found


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
