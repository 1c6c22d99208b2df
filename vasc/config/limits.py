"""Sizes that no run can hold in memory, or that leave no room for a vein, refused before any work.

Every limit is on a number that follows from several keys, so that no key has a
bound of its own that a different config would not need.
"""

from typing import TYPE_CHECKING, Any

from vasc.config.values import assignment
from vasc.limits import RUN_STEPS

if TYPE_CHECKING:
    from vasc.domain import Blade, BladeParameters
    from vasc.models.leaf import LeafVenation

Key = tuple[str | int, ...]

LONGEST = 1e6
"""Segment lengths that a blade may be long or wide."""

LARGEST_FRAME = 1e4
"""Segment lengths that a key-framed blade may be across: its margin has a point for each."""

SHORTEST = 1e-6
"""Segment lengths that a blade begins with at least: areas of far smaller ones vanish."""

NARROWEST = 0.1
"""Segment lengths that a blade is wide in the end at least: no dart would ever hit less."""

LEAST, GREATEST = 1e-12, 1e12
"""Of any length: squares of it are still far from the ends of the numbers of a computer."""

LENGTHS = (
    ("extension", "segment_length"),
    ("growth", "length_per_step"),
    ("placement", "birth_distance_sources"),
    ("placement", "birth_distance_veins"),
    ("placement", "birth_distance"),
    ("refinement", "threshold"),
    ("arrival", "kill_distance"),
    ("arrival", "join_distance"),
    ("perception", "influence_radius"),
    ("refinement", "longest"),
)
"""Keys that hold a length, but for those of the blade."""

FEWEST_DARTS = 1e-9
"""Darts a step that make a run possible: fewer would never be thrown."""

MOST_DARTS = 5e7
"""Darts that may be thrown at once; each takes about 170 bytes."""

MOST_CELLS = 1e9
"""Cells that the search for room may need; each takes about ten bytes."""

SHORTEST_PIECE = 0.01
"""Segment lengths that stretched segments may be cut down to: all vein nodes are kept."""

SHORTEST_CUT = 0.1
"""Segment lengths that two stretched segments have together when their corner is cut."""

CELLS_PER_DISTANCE = 4.0
"""Cells along the distance that sources keep from veins, as in :mod:`vasc.kernels.darts`."""


def size_problems(parameters: "LeafVenation") -> list[str]:
    """Describe lengths that cannot be, from the parameters alone.

    Parameters
    ----------
    parameters : LeafVenation
        The parameters of a config.

    Returns
    -------
    list of str
        One line a problem: key, value and what is allowed; empty if all can be.
    """
    if problems := _absurd_lengths(parameters):
        return problems
    domain, segment = parameters.domain, parameters.extension.segment_length
    if domain is None:
        found = [_too_short_pieces(parameters, segment), *_too_large_frames(parameters)]
        return [problem for problem in found if problem]
    first, key, last = domain.length, *_final_length(parameters)
    problems = [
        _too_long(key, last, last / segment),
        _too_short_pieces(parameters, segment),
        _too_late(parameters),
    ]
    if first / segment < SHORTEST:
        problems.append(
            f"{assignment(('domain', 'length'), first)}: the blade would begin with"
            f" {first / segment:.3g} segment lengths; it must have at least {SHORTEST:g}"
        )
    is_end_known = _is_end_known(parameters)
    if is_end_known:
        problems.append(_too_small(key, last, "long", last / segment, 1.0))
    if (ratio := domain.width) is not None and not any(problems):
        width = ratio * last / segment
        problems.append(_too_long(("domain", "width"), ratio, width))
        if is_end_known:
            problems.append(_too_small(("domain", "width"), ratio, "wide", width, NARROWEST))
    return [problem for problem in problems if problem]


def blade_problems(parameters: "LeafVenation", blade: "Blade") -> list[str]:
    """Describe what a blade of this outline is too large or too small for.

    Parameters
    ----------
    parameters : LeafVenation
        Parameters in which :func:`size_problems` finds nothing.
    blade : Blade
        Their blade at step 0.

    Returns
    -------
    list of str
        One line a problem; empty if all can be.
    """
    key, last = _final_length(parameters)
    factor = last / blade.length
    low_x, low_y, high_x, high_y = (factor * bound for bound in blade.bounds)
    width, height = high_x - low_x, high_y - low_y
    segment = parameters.extension.segment_length
    if _domain_of(parameters).width is None:
        found = _too_long(key, last, max(width, height) / segment)
        if not found and _is_end_known(parameters):
            found = _too_small(key, last, "wide", width / segment, NARROWEST)
        if found:
            return [found]
    if parameters.placement.kind != "darts":
        return []
    # darts of each step fall on cells over a box that holds the attachment, too
    box = (max(high_x, 0.0) - min(low_x, 0.0)) * (max(high_y, 0.0) - min(low_y, 0.0))
    problems = [
        _wrong_number_of_darts(parameters, blade.area * factor**2, width * height),
        _too_many_cells(parameters, box),
    ]
    return [problem for problem in problems if problem]


def _too_large_frames(parameters: "LeafVenation") -> list[str]:
    """Describe key-frames that are too large for a margin of points a segment apart."""
    growth: Any = parameters.growth
    segment = parameters.extension.segment_length
    for number, frame in enumerate(growth.frames):
        largest = max(abs(value) for row in frame.rows for value in row)
        if largest > LARGEST_FRAME * segment:
            return [
                f"{assignment(('growth', 'frames', number, 'rows'), largest)}: the blade would be"
                f" {largest / segment:.3g} segment lengths across; at most {LARGEST_FRAME:g} are"
                " allowed"
            ]
    return []


def _domain_of(parameters: "LeafVenation") -> "BladeParameters":
    """Give the blade at step 0 of growths that are not key-framed."""
    assert parameters.domain is not None, "checked"
    return parameters.domain


def _final_length(parameters: "LeafVenation") -> tuple[Key, float]:
    """Give the length of the blade when growth ends, and the key that says it."""
    growth: Any = parameters.growth
    final = getattr(growth, "final_length", None)
    if final is None:
        return ("domain", "length"), _domain_of(parameters).length
    return ("growth", "final_length"), float(final)


def _is_end_known(parameters: "LeafVenation") -> bool:
    """Tell whether the size at the end is known: an installed growth may keep it to itself."""
    growth: Any = parameters.growth
    return growth.kind == "none" or getattr(growth, "final_length", None) is not None


def _too_long(key: Key, value: float, n_segments: float) -> str:
    """Describe a blade that is too large for any grid; empty if it is not."""
    if n_segments <= LONGEST:
        return ""
    return (
        f"{assignment(key, value)}: the blade would be {n_segments:.3g} segment lengths across,"
        f" more than memory can hold; at most {LONGEST:g} are allowed"
    )


def _too_small(key: Key, value: float, across: str, n_segments: float, least: float) -> str:
    """Describe a blade that has no room for a vein when growth ends; empty if it has."""
    if n_segments >= least:
        return ""
    return (
        f"{assignment(key, value)}: the blade would be {n_segments:.3g} segment lengths {across}"
        f" in the end, which leaves no room for a vein; it must be at least {least:g}"
    )


def _too_short_pieces(parameters: "LeafVenation", segment: float) -> str:
    """Describe a refinement into pieces that are far too many; empty if they are not."""
    refinement: Any = parameters.refinement
    if refinement.kind == "corner_cutting" and refinement.threshold < SHORTEST_CUT * segment:
        return (
            f"{assignment(('refinement', 'threshold'), refinement.threshold)}: corners would be cut"
            f" into pieces that memory cannot hold; it must be at least {SHORTEST_CUT * segment:g}"
        )
    if refinement.kind != "subdivision":
        return ""
    placement: Any = parameters.placement
    key, longest = ("refinement", "longest"), refinement.longest
    if longest is None and placement.kind == "darts":
        key, longest = ("placement", "birth_distance_veins"), placement.birth_distance_veins
    if longest is None or longest >= SHORTEST_PIECE * segment:
        return ""
    return (
        f"{assignment(key, longest)}: refinement would cut each segment into"
        f" {segment / longest:.3g} pieces or more, which memory cannot hold; it must be at least"
        f" {SHORTEST_PIECE * segment:g}"
    )


def _too_late(parameters: "LeafVenation") -> str:
    """Describe the first source that is given for a step no run can record; empty if none is."""
    births = getattr(parameters.placement, "births", None) or []
    for row, step in enumerate(births):
        if step > RUN_STEPS:
            return (
                f"{assignment(('placement', 'births', row), step)}: must be a step of at most"
                f" {RUN_STEPS:,}"
            )
    return ""


def _absurd_lengths(parameters: "LeafVenation") -> list[str]:
    """Describe the lengths that are so large or small that no computer can compare them."""
    found = []
    for key in LENGTHS:
        value = getattr(getattr(parameters, key[0], None), key[1], None)
        if value is not None and not LEAST <= value <= GREATEST:
            found.append(
                f"{assignment(key, value)}: no length can be compared with it;"
                f" it must be between {LEAST:g} and {GREATEST:g}"
            )
    return found


def _wrong_number_of_darts(parameters: "LeafVenation", area: float, box: float) -> str:
    """Describe a density of darts that cannot be thrown at once; empty if it can.

    The areas are those of the largest blade and of the box around it.
    """
    placement: Any = parameters.placement
    n_darts = placement.density * area
    if placement.reading == "largest_blade":
        # the darts of all steps are thrown before the first one
        growth: Any = parameters.growth
        n_steps = (growth.final_length - _domain_of(parameters).length) / growth.length_per_step
        n_darts = placement.density * box * max(n_steps, 1.0)
    is_enough = n_darts >= FEWEST_DARTS or not _is_end_known(parameters)
    if is_enough and n_darts <= MOST_DARTS:
        return ""
    key, last = _final_length(parameters)
    line = (
        f"{assignment(('placement', 'density'), placement.density)}: with"
        f" {assignment(key, last)} about {n_darts:.3g} darts would be thrown at once"
    )
    if n_darts < FEWEST_DARTS:
        return f"{line}, so that no source ever appears; it must be at least {FEWEST_DARTS:g}"
    return f"{line}, more than memory can hold; at most {MOST_DARTS:g} are allowed"


def _too_many_cells(parameters: "LeafVenation", box: float) -> str:
    """Describe a blade that is too large for the distance kept from veins; empty if it is not."""
    placement: Any = parameters.placement
    if placement.reading == "largest_blade":
        return ""
    distance = max(placement.birth_distance_veins, parameters.arrival.kill_distance)
    n_cells = box * (CELLS_PER_DISTANCE / distance) ** 2
    if n_cells <= MOST_CELLS:
        return ""
    key, last = _final_length(parameters)
    return (
        f"{assignment(key, last)}: with placement.birth_distance_veins and"
        f" arrival.kill_distance of at most {distance:g} the blade would take {n_cells:.3g}"
        f" cells, more than memory can hold; at most {MOST_CELLS:g} are allowed"
    )
