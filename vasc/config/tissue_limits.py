"""Tissues of more cells than a run can hold, refused before any work."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

from vasc.config.values import assignment

if TYPE_CHECKING:
    from vasc.models.on_tissue import TissueExperiment

MOST_CELLS = 250_000
"""Cells of a tissue: each takes about 5 kB of memory, and up to 60 bytes a step on the disk."""


def tissue_problems(parameters: "TissueExperiment", folder: Path) -> list[str]:
    """Describe a tissue of more cells than a run can hold.

    Parameters
    ----------
    parameters : TissueExperiment
        The parameters of a config.
    folder : Path
        What files are relative to.

    Returns
    -------
    list of str
        One line a problem: key, value and what is allowed; empty if all can be.
    """
    domain: Any = parameters.domain
    columns, rows = (getattr(domain, name, None) for name in ("columns", "rows"))
    if columns is not None and rows is not None:
        key: tuple[str, ...] = ("domain", "columns")
        value, n_cells = columns, float(columns) * rows
        also = f" with {assignment(('domain', 'rows'), rows)}"
    else:
        # cells are about 1 in area
        blade = domain.blade
        key = ("domain", "blade", "length")
        value, n_cells = blade.length, blade.blade(folder).area
        also = ""
    if n_cells <= MOST_CELLS:
        return []
    return [
        f"{assignment(key, value)}:{also} the tissue would have {n_cells:.3g} cells, more than"
        f" memory and disk can hold; at most {MOST_CELLS:,} are allowed"
    ]
