"""The [domain] table of a tissue: which cells there are."""

from pathlib import Path
from typing import Literal

from vasc.domain.tilings import rectangular
from vasc.domain.tissue import Tissue
from vasc.parameters import Parameters, quantity


class TissueParameters(Parameters):
    """A tissue of square cells."""

    kind: Literal["rectangular"] = "rectangular"
    columns: int = quantity("Cells side by side.", ge=1, le=2000)
    rows: int = quantity("Cells one above the other.", ge=1, le=2000)

    def tissue(self, seed: int, folder: Path = Path()) -> Tissue:
        """Give the tissue."""
        return rectangular(self.columns, self.rows)
