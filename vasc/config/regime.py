"""The dimensionless numbers of a config that decide which pattern to expect.

They are ratios of what a config holds, so that no run is needed to know them.
"""

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from vasc.models.leaf import LeafVenation

PLAIN_LEAF = "in an ovate leaf of closed veins"
"""What the patterns below are of: lobes, rows of seeds and open veins bring their own."""

MARGINAL_CLASSES = (
    (1.0, f"tips keep up with the margin; {PLAIN_LEAF}: pinnate, with secondaries to the margin"),
    (
        4.0,
        f"tips follow the margin; {PLAIN_LEAF}: a smooth midvein, arched secondaries and"
        " ladder-like tertiaries",
    ),
    (
        6.0,
        f"the margin begins to outrun the veins; {PLAIN_LEAF}: between a midvein with"
        " secondaries and a fan",
    ),
    (math.inf, f"the margin outruns the veins; {PLAIN_LEAF}: a fan, as without growth"),
)
"""Pattern of a marginally growing leaf by v, each up to the number before it."""

ISOGONIC_CLASSES = (
    (0.1, f"growth outruns the veins; {PLAIN_LEAF}: a fan"),
    (
        0.3,
        f"growth is about to outrun the veins; {PLAIN_LEAF}: between a midvein with"
        " secondaries and a fan",
    ),
    (
        1.5,
        f"veins follow growth; {PLAIN_LEAF}: a midvein, secondaries and a fine reticulation",
    ),
    (
        math.inf,
        f"veins cross the blade many times while it grows; {PLAIN_LEAF}: no hierarchy of"
        " large veins",
    ),
)
"""Pattern of an isogonically growing leaf by T, each up to the number before it."""

GAIN_PER_CELL = 8.0
"""Gain below which no canal forms by facilitated diffusion, for each cell of its way."""

WIDTH = 0.7
"""Cells across a canal, over the root of gain over saturation (facilitated diffusion)."""

MARGINAL_RANGE = (0.1, 6.0)
ISOGONIC_RANGE = (0.1, 5.0)
DART_RANGE = (0.002, 2.0)
"""Outside of these, a config deserves a second look."""


@dataclass(frozen=True)
class Regime:
    """What the numbers of a config let expect.

    Parameters
    ----------
    numbers : dict of str to float
        ``margin_speed`` (v, margin speed over vein speed), or ``crossing`` (T, the
        fraction of the initial blade a vein can cross during growth), and
        ``darts_per_spacing`` (rho b^2, darts per squared birth distance and step). In a
        tissue ``gain`` (A), ``saturation`` or ``pool``, and ``background`` (q).
    sentences : list of str
        One a number: what it is and what it lets expect.
    warnings : list of str
        One for each number out of the useful range.
    """

    numbers: dict[str, float] = field(default_factory=dict)
    sentences: list[str] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)


def regime(parameters: "LeafVenation") -> Regime:
    """Give the numbers that decide the pattern of a leaf, or of canals in a tissue.

    Parameters
    ----------
    parameters : LeafVenation
        A checked config.

    Returns
    -------
    Regime
        Numbers, what they mean, and warnings; empty for growths and placements
        that are not known here.

    References
    ----------
    A. Runions (2008). Modeling biological patterns using the space colonization
    algorithm. MSc thesis, University of Calgary, sections 4.2.4 and 4.3.2.
    """
    found = Regime()
    growth: Any = getattr(parameters, "growth", None)
    if growth is None:
        transport: Any = getattr(parameters, "transport", None)
        if hasattr(transport, "gain"):
            _canalization(transport, getattr(parameters, "background", 0.0), found)
            _sources(getattr(parameters, "placement", None), found)
        return found
    if growth.kind == "marginal":
        _marginal(growth.length_per_step / parameters.extension.segment_length, found)
    elif growth.kind == "isogonic":
        _isogonic(crossing(parameters), found)
    elif growth.kind == "none":
        found.sentences.append("no growth: veins run from their seeds toward all sources at once")
    placement: Any = getattr(parameters, "placement", None)
    if placement is not None and placement.kind == "darts":
        _darts(placement.density * placement.birth_distance_sources**2, found)
    return found


def crossing(parameters: "LeafVenation") -> float:
    """Give T = (D / dL) ln(L_f / L_i) of an isogonically growing leaf."""
    growth: Any = parameters.growth
    assert parameters.domain is not None, "isogonic growth has a domain"
    ratio = growth.final_length / parameters.domain.length
    return parameters.extension.segment_length / growth.length_per_step * math.log(ratio)


def _marginal(speed: float, found: Regime) -> None:
    """Judge the speed of the margin against that of the veins."""
    found.numbers["margin_speed"] = speed
    found.sentences.append(
        f"v = {speed:.3g} (margin speed over vein speed): {_class_of(speed, MARGINAL_CLASSES)}"
    )
    low, high = MARGINAL_RANGE
    if speed >= high:
        found.warnings.append(
            f"v = {speed:.3g} is not below {high:g}: expect a fan;"
            " lower growth.length_per_step for a hierarchy of veins"
        )
    elif speed < low:
        found.warnings.append(
            f"v = {speed:.3g} is below {low:g}: veins wait for the margin in most steps;"
            " a larger growth.length_per_step gives the same leaf sooner"
        )


def _isogonic(fraction: float, found: Regime) -> None:
    """Judge the distance a vein covers during growth."""
    found.numbers["crossing"] = fraction
    found.sentences.append(
        f"T = {fraction:.3g} (fraction of the initial blade a vein can cross during growth):"
        f" {_class_of(fraction, ISOGONIC_CLASSES)}"
    )
    low, high = ISOGONIC_RANGE
    if fraction < low:
        found.warnings.append(
            f"T = {fraction:.3g} is below {low:g}: expect a fan;"
            " lower growth.length_per_step for a hierarchy of veins"
        )
    elif fraction > high:
        found.warnings.append(
            f"T = {fraction:.3g} is above {high:g}: veins wait for growth in most steps;"
            " raise growth.length_per_step"
        )


def _darts(number: float, found: Regime) -> None:
    """Judge how soon darts fill the room there is."""
    low, high = DART_RANGE
    sparse, dense = 0.02, 0.5
    if number < sparse:
        expected = "sources come late and irregularly"
    elif number < dense:
        expected = "sources follow growth, fairly evenly spaced"
    else:
        expected = "all room is filled at once, evenly"
    found.numbers["darts_per_spacing"] = number
    found.sentences.append(
        f"rho b^2 = {number:.3g} (darts per squared birth distance and step): {expected}"
    )
    if number < low:
        found.warnings.append(
            f"rho b^2 = {number:.3g} is below {low:g}: few sources appear before growth ends;"
            " raise placement.density or placement.birth_distance_sources"
        )
    elif number > high:
        found.warnings.append(
            f"rho b^2 = {number:.3g} is above {high:g}: nearly all darts are thrown in vain;"
            " lower placement.density"
        )


def _canalization(transport: Any, background: float, found: Regime) -> None:
    """Judge feedback against saturation: whether canals form, and how wide."""
    gain, most = float(transport.gain), float(getattr(transport, "most", math.nan))
    found.numbers["gain"] = gain
    if transport.kind == "facilitated":
        reach = gain / GAIN_PER_CELL
        expected = f"canals form over ways of about {reach:.3g} cells and less"
    else:
        expected = "carriers gather where auxin leaves a cell"
    found.sentences.append(f"A = {gain:g} (gain of the feedback): {expected}")
    if transport.kind == "pool":
        found.numbers["pool"] = transport.pool
        found.sentences.append(f"P_tot = {transport.pool:g} (carriers of a cell): walls compete")
    elif math.isinf(most):
        found.sentences.append("no saturation: nothing limits what a wall carries")
        found.warnings.append(
            "transport.saturation = 'none': flux in closed loops may grow without bound;"
            " the run then ends there"
        )
    else:
        files = max(1.0, WIDTH * math.sqrt(gain / most))
        found.numbers["saturation"] = most
        found.sentences.append(
            f"A / saturation = {gain / most:.3g}, saturation = {most:g}: a canal is about"
            f" {files:.2g} cell{'s' if files >= 1.05 else ''} wide"
        )
    found.numbers["background"] = background
    found.sentences.append(
        f"q = {background:g} (what ground cells make together, over what a source makes)"
    )


def _sources(placement: Any, found: Regime) -> None:
    """Warn where no source is to come: nothing flows but what ground cells make."""
    if getattr(placement, "points", None) == []:
        found.warnings.append(
            "placement.points is empty: no source appears, no canal forms, and the run ends when"
            " the tissue is at rest, at once without background; give points"
        )


def _class_of(number: float, classes: tuple[tuple[float, str], ...]) -> str:
    """Give the first class that reaches up to a number."""
    return next(text for limit, text in classes if number < limit)
