"""The [domain] table of a tissue: which cells there are."""

from abc import abstractmethod
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, model_validator

from vasc.domain.blade import Blade
from vasc.domain.parameters import BladeParameters
from vasc.domain.tilings import hexagonal, hexagonal_in, rectangular, rectangular_in
from vasc.domain.tissue import Tissue
from vasc.domain.voronoi import LLOYD, voronoi, voronoi_in
from vasc.errors import OutlineError
from vasc.limits import TISSUE_CELLS
from vasc.parameters import Parameters, quantity
from vasc.streams import Streams

MOST_BOX = 100.0
"""Times its own area that the box around a blade of cells may have."""

STREAM = "tissue"
"""The random numbers that a tissue is drawn from, which its seed alone decides."""


class CellsParameters(Parameters):
    """A box of columns and rows of cells, or the cells in a blade."""

    columns: int | None = quantity(
        "Cells side by side; at most 250000, also of columns times rows.",
        default=None,
        ge=1,
        le=TISSUE_CELLS,
    )
    rows: int | None = quantity(
        "Cells one above the other; at most 250000, as columns.",
        default=None,
        ge=1,
        le=TISSUE_CELLS,
    )
    blade: BladeParameters | None = quantity(
        "An outline instead of columns and rows; D is the width of a cell.", default=None
    )

    @model_validator(mode="after")
    def _check(self) -> "CellsParameters":
        """Require exactly one of the two ways, and a number of cells that can be."""
        given = [key for key in ("columns", "rows", "blade") if getattr(self, key) is not None]
        if given not in (["columns", "rows"], ["blade"]):
            said = " and ".join(f"'{key}'" for key in given) or "neither"
            raise ValueError(f"{said} given; give either 'columns' and 'rows' or 'blade'")
        n_cells = (self.columns or 1) * (self.rows or 1)
        if self.blade is None and not 2 <= n_cells <= TISSUE_CELLS:
            raise ValueError(
                f"columns = {self.columns} and rows = {self.rows} make {n_cells:,} cells; a tissue"
                f" has between 2 and {TISSUE_CELLS:,}"
            )
        return self

    @abstractmethod
    def tissue(self, seed: int, folder: Path = Path()) -> Tissue:
        """Give the tissue.

        Parameters
        ----------
        seed : int
            Seed of the run, for random cells.
        folder : Path
            Where a file with the outline is looked for.

        Raises
        ------
        OutlineError
            If the outline cannot be used, or cells in it make no tissue, or several; the
            message names key and place.
        """

    def outline(self, folder: Path = Path()) -> Blade | None:
        """Give the blade that cells are in; None for a box.

        Raises
        ------
        OutlineError
            If it cannot be used, or holds too many cells; the message names key and place.
        """
        if self.blade is None:
            return None
        try:
            blade = self.blade.blade(folder)
        except OutlineError as error:
            raise OutlineError(_located(str(error))) from error
        # cells are about 1 in area
        if blade.area > TISSUE_CELLS:
            raise OutlineError(
                f"domain.blade.length = {self.blade.length:g}: the tissue would have"
                f" {blade.area:.3g} cells, more than memory and disk can hold; at most"
                f" {TISSUE_CELLS:,} are allowed"
            )
        low_x, low_y, high_x, high_y = blade.bounds
        box = (high_x - low_x) * (high_y - low_y)
        if box > MOST_BOX * blade.area:
            raise OutlineError(
                f"domain.blade: fills one part in {box / blade.area:.3g} of the box around it, in"
                f" all of which cells are laid; it must fill one in {MOST_BOX:g} at least"
            )
        return blade

    def _made(
        self, box: Callable[[int, int], Tissue], inside: Callable[[Blade], Tissue], folder: Path
    ) -> Tissue:
        """Make a tissue in one of the two ways."""
        blade = self.outline(folder)
        if blade is None:
            assert self.columns is not None, "checked"
            assert self.rows is not None, "checked"
            return box(self.columns, self.rows)
        try:
            return inside(blade)
        except OutlineError as error:
            raise OutlineError(_located(str(error))) from error


class RectangularCells(CellsParameters):
    """Square cells of side 1; in a blade those whose centres lie in it."""

    kind: Literal["rectangular"] = "rectangular"

    def tissue(self, seed: int, folder: Path = Path()) -> Tissue:
        """Give the tissue."""
        return self._made(rectangular, rectangular_in, folder)


class HexagonalCells(CellsParameters):
    """Hexagonal cells with centres 1 apart; in a blade those whose centres lie in it."""

    kind: Literal["hexagonal"] = "hexagonal"

    def tissue(self, seed: int, folder: Path = Path()) -> Tissue:
        """Give the tissue."""
        return self._made(hexagonal, hexagonal_in, folder)


class VoronoiCells(CellsParameters):
    """Random cells of mean area 1; a blade cuts those at its margin."""

    kind: Literal["voronoi"] = "voronoi"
    lloyd: int = quantity(
        "How many times random points move to the centroids of their cells; at most 100.",
        default=LLOYD,
        ge=0,
        le=100,
    )

    def tissue(self, seed: int, folder: Path = Path()) -> Tissue:
        """Give the tissue, the same for the same seed."""
        rng = Streams(seed, [STREAM])[STREAM]
        return self._made(
            lambda columns, rows: voronoi(columns, rows, rng, lloyd=self.lloyd),
            lambda blade: voronoi_in(blade, rng, lloyd=self.lloyd),
            folder,
        )


def with_kind(kind: str) -> BeforeValidator:
    """Let a table that comes in several kinds be of one kind when it does not say of which."""

    def named(table: Any) -> Any:
        """Give the table with its kind."""
        if isinstance(table, dict) and "kind" not in table:
            return {"kind": kind, **table}
        return table

    return BeforeValidator(named)


TissueParameters = Annotated[
    RectangularCells | HexagonalCells | VoronoiCells,
    Field(discriminator="kind"),
    with_kind("rectangular"),
]
"""A tissue of one of three kinds of cells."""


def _located(message: str) -> str:
    """Begin a message about an outline with the key that it is about."""
    if message.startswith("outline"):
        return f"domain.blade{message.removeprefix('outline')}"
    return f"domain.blade.{message.removeprefix('domain.')}"
