"""The outline of a blade as a polygon of shapely."""

from typing import TYPE_CHECKING

from vasc.errors import VascError
from vasc.export.specimen import Specimen

if TYPE_CHECKING:
    from shapely import Geometry


def outline_of(specimen: Specimen) -> "Geometry":
    """Give the outline as a polygon, or as several.

    Raises
    ------
    VascError
        If there is none, as of a stem.
    """
    import shapely

    if not specimen.rings:
        raise VascError("a stem has no outline")
    # even-odd rule: what lies within an even number of rings is outside
    outline = shapely.Polygon()
    for ring in specimen.rings:
        outline = (
            outline.symmetric_difference(shapely.Polygon(ring))
            if outline
            else (shapely.Polygon(ring))
        )
    return outline
