"""Where sources appear in a tissue, and in which round: the [placement] table."""

from abc import abstractmethod
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import Field, model_validator

from vasc.arrays import Ids, Points, Steps, as_points
from vasc.domain import Tissue
from vasc.domain.normalization import Pair
from vasc.domain.tissue_parameters import with_kind
from vasc.errors import ConfigError
from vasc.models.injection import DartInjection, GivenInjection, Injection
from vasc.parameters import Parameters, quantity
from vasc.placement.given import read_sources


class CellSources(Parameters):
    """Where sources appear, all at once or in rounds."""

    @abstractmethod
    def injection(
        self, tissue: Tissue, veins: list[Ids], background: float, folder: Path = Path()
    ) -> Injection:
        """Give what lets sources appear.

        Parameters
        ----------
        tissue : Tissue
            The cells.
        veins : list of ndarray of int32
            Cells of the first veins.
        background : float
            What all ground cells together make, over what one source makes.
        folder : Path
            Where a file with sources is looked for.

        Raises
        ------
        ConfigError
            If a source lies outside the tissue, in a vein or in the cell of another.
        """


class CellSourceParameters(CellSources):
    """Sources in given places, all at once or in rounds."""

    kind: Literal["given"] = "given"
    points: list[Pair] | None = quantity(
        "Places of the sources, pairs [x, y]: the nearest cell of each.", unit="D", default=None
    )
    rounds: list[int] | None = quantity(
        "Round in which each appears, from 1 on: when the canals of the round before have"
        " settled. By default all in the first.",
        default=None,
    )
    file: str | None = quantity(
        "CSV file with columns x, y and, if wanted, birth, the round, instead of points.",
        default=None,
    )

    @model_validator(mode="after")
    def _check(self) -> "CellSourceParameters":
        """Require one of the two ways, one round a point, and no round without a source."""
        if (self.points is None) == (self.file is None):
            raise ValueError("give either 'points' or 'file'")
        if self.rounds is not None:
            if len(self.rounds) != len(self.points or []):
                raise ValueError("'rounds' needs one number for each of 'points'")
            if problem := _gap(np.array(self.rounds, dtype=np.int64)):
                raise ValueError(f"'rounds' {problem}")
        return self

    def injection(
        self, tissue: Tissue, veins: list[Ids], background: float, folder: Path = Path()
    ) -> GivenInjection:
        """Give what lets sources appear in given cells."""
        cells, rounds = in_rounds(tissue, self, veins, folder)
        return GivenInjection(veins, background, cells, rounds)

    def places(self, folder: Path = Path()) -> tuple[Points, Steps]:
        """Give the places of the sources, and their rounds.

        Raises
        ------
        ConfigError
            If the file cannot be read or leaves out a round.
        """
        if self.file is None:
            points = as_points(np.reshape(self.points or [], (-1, 2)), "placement.points")
            return points, np.array(self.rounds or [1] * len(points), dtype=np.int32)
        points, rounds = read_sources(folder / self.file)
        if problem := _gap(rounds):
            raise ConfigError(f'placement.file = "{self.file}": its births {problem}')
        return points, rounds


class CellDartParameters(CellSources):
    """Sources by dart throwing, one a round, ever closer to the veins there are by then."""

    kind: Literal["darts"] = "darts"
    count: int = quantity("Sources in all, one a round; at most 100000.", ge=1, le=100_000)
    first_distance: float = quantity(
        "No source of the first round appears nearer than that to a vein.", unit="D", gt=0.0
    )
    last_distance: float = quantity(
        "The same for the last round; it shrinks by as much from round to round.",
        unit="D",
        gt=0.0,
    )

    @model_validator(mode="after")
    def _check(self) -> "CellDartParameters":
        """Require a distance that does not grow."""
        if self.last_distance > self.first_distance:
            raise ValueError(
                f"'last_distance' is {self.last_distance:g}; it must be at most"
                f" 'first_distance', {self.first_distance:g}"
            )
        return self

    def injection(
        self, tissue: Tissue, veins: list[Ids], background: float, folder: Path = Path()
    ) -> DartInjection:
        """Give what throws darts."""
        return DartInjection(veins, background, self.count, self.first_distance, self.last_distance)


AnyCellSources = Annotated[
    CellSourceParameters | CellDartParameters, Field(discriminator="kind"), with_kind("given")
]


def in_rounds(
    tissue: Tissue,
    given: CellSourceParameters,
    veins: list[Ids] | tuple[()] = (),
    folder: Path = Path(),
) -> tuple[Ids, Ids]:
    """Give the cells of given sources and their rounds, in the order of these.

    Raises
    ------
    ConfigError
        If a source lies outside the tissue, in a vein or in the cell of another.
    """
    points, rounds = given.places(folder)
    cells = tissue.nearest_cells(points)
    _check_cells(given, tissue, points, cells, veins)
    order = np.argsort(rounds, kind="stable")
    return cells[order], rounds[order]


def _check_cells(
    given: CellSourceParameters,
    tissue: Tissue,
    points: Points,
    cells: Ids,
    veins: list[Ids] | tuple[()],
) -> None:
    """Refuse sources that are in no cell of their own."""

    def named(row: int) -> str:
        """Name a source as the config has it."""
        x, y = points[row].tolist()
        key = f"placement.points[{row}] = " if given.file is None else "placement.file: source "
        return f"{key}[{x:g}, {y:g}]"

    for row in np.flatnonzero(tissue.are_outside(points)).tolist():
        low_x, low_y, high_x, high_y = tissue.blade.bounds
        raise ConfigError(
            f"{named(row)}: lies outside the tissue; sources must lie inside, between"
            f" ({low_x:g}, {low_y:g}) and ({high_x:g}, {high_y:g})"
        )
    vein_cells = np.concatenate([*veins, np.zeros(0, dtype=np.int32)])
    for row in np.flatnonzero(np.isin(cells, vein_cells)).tolist():
        raise ConfigError(f"{named(row)}: lies in a cell of a vein; sources need ground cells")
    _, first, of = np.unique(cells, return_index=True, return_inverse=True)
    for row in np.flatnonzero(first[of] != np.arange(len(cells))).tolist():
        x, y = points[first[of[row]]].tolist()
        raise ConfigError(
            f"{named(row)}: two sources lie in one cell, the other is at [{x:g}, {y:g}];"
            " each needs a cell of its own"
        )


def _gap(rounds: Steps | np.ndarray) -> str:
    """Describe rounds that do not start at 1 or leave one out; empty if they do not."""
    found = np.unique(rounds)
    wrong = np.flatnonzero(found != np.arange(1, len(found) + 1))
    if len(wrong) == 0:
        return ""
    expected = int(wrong[0]) + 1
    return f"hold {found[wrong[0]]} but not {expected}; they start at 1 and leave none out"
