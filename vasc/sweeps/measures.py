"""What can be measured of a run of a sweep, by name; read from its timeline alone."""

from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from vasc.config.messages import nearest
from vasc.errors import VascError

if TYPE_CHECKING:
    from vasc.timeline import Timeline

SUMMARY = (
    *("steps", "time", "nodes", "segments", "sources_placed", "sources_left"),
    *("joins", "loops", "stop_reason", "complete"),
)
STATISTICS = (
    *("step", "time", "length_unit", "blade_length", "blade_area", "nodes", "segments"),
    *("components", "cycles", "vein_length", "vein_density", "areoles", "flat_areoles"),
    *(
        "areole_area_mean",
        "areole_area_cv",
        "areole_circularity_median",
        "areole_elongation_median",
    ),
    *("areole_corners_mean", "areole_corners_variance", "enclosed_area", "enclosed_vein_density"),
    *("free_ends", "enclosed_density_x_sqrt_areole"),
    *("free_ends_per_areole", *(f"junction_degree.{degree}" for degree in range(3, 9))),
    *("sections", "section_length_mean", "section_length_cv", "free_end_length_share"),
    *("mst_ratio", "box_dimension", "density_x_sqrt_areole", "distance_to_vein_mean"),
    *("distance_to_vein_median", "distance_to_vein_p95", "density_x_distance"),
    *("bohn_junctions", "bohn_residual_median", "bohn_residual_shuffled"),
    *("bohn_angle_error_median", "murray_junctions", "murray_exponent_median", "loop_asymmetry"),
    *("loop_asymmetry_shuffled", "loop_asymmetry_weighted", "loop_asymmetry_weighted_shuffled"),
    *("loop_order", "strahler_order", "horton_bifurcation_ratio"),
    *(f"strahler_streams.{order}" for order in range(1, 8)),
    *(f"orders.{n}.{key}" for n in range(1, 8) for key in ("length", "segments", "width_mean")),
)
LINEAGE = ("source_life_mean", "source_life_median", "sources_unreached", "nodes_per_source")
CONNECTIVITY = (
    *("divergence", "rise", "radius", "per_level", "ratio", "primordia", "links", "pair"),
    *(
        "fraction",
        "local_fraction",
        "least_fraction",
        "predicted",
        "predicted_on_surface",
        "exceptions",
    ),
    *("sympodia", "pass"),
)
STRAND = (
    *("source", "step", "sinks", "reached", "nearest", "nearest_by_cells", "is_nearest"),
    *("is_nearest_by_cells", "formed", "loop", "vortex", "strands", "landings", "flux_share"),
    *("width", "length", "tortuosity", "detour", "excess", "pass"),
)
EVENTS = (
    *("tip_source", "midvein", "pair_1", "upper_pair", "pair_2", "pair_3", "lower_halves"),
    *("loop_1", "loop_2", "loop_3", "minor_in_loop_1", "minor_in_loop_2", "minor_in_loop_3"),
    *("mesophyll_event", "first_free_end", "growth_ended"),
)
CRITERIA = (*(f"C{number}" for number in range(1, 21)), "C10w")
SEQUENCE = (
    *("pass", "failures", "undecided", "order_ok", "loops", "symmetry"),
    *(f"features.{letter}" for letter in "abcd"),
    *(f"criteria.{criterion}" for criterion in CRITERIA),
    *(f"step_of.{event}" for event in EVENTS),
)
CATALOGUE: dict[str, tuple[str, ...]] = {
    "summary": SUMMARY,
    "stats": STATISTICS,
    "lineage": LINEAGE,
    "check.connectivity": CONNECTIVITY,
    "check.sequence": SEQUENCE,
    "check.strand": STRAND,
}
"""Names by group; a measure is called ``group.name``."""

MEASURES = tuple(f"{group}.{name}" for group, names in CATALOGUE.items() for name in names)
"""All names."""


def name_problem(name: str) -> str:
    """Say what is wrong with the name of a measure; empty if nothing is."""
    if name in MEASURES:
        return ""
    group = next((known for known in CATALOGUE if name.startswith(f"{known}.")), None)
    if group is None:
        known = ", ".join(f"{known}.KEY" for known in CATALOGUE)
        return f"must be one of {known}{nearest(name, MEASURES)}"
    close = nearest(name, [one for one in MEASURES if one.startswith(f"{group}.")])
    return f"{group} has no such key" + (close or f"; keys: {', '.join(CATALOGUE[group])}")


def measure(timeline: "Timeline", names: Iterable[str]) -> tuple[dict[str, Any], list[str]]:
    """Take measures of a run.

    Parameters
    ----------
    timeline : Timeline
        An open timeline.
    names : iterable of str
        Members of ``MEASURES``.

    Returns
    -------
    tuple
        Numbers, texts, flags and lists of these by name, None for what a run does not have;
        and a line for every group that cannot be measured.
    """
    found: dict[str, Mapping[str, Any]] = {}
    problems: list[str] = []
    values: dict[str, Any] = {}
    for name in names:
        group = next(one for one in CATALOGUE if name.startswith(f"{one}."))
        if group not in found:
            try:
                found[group] = _GROUPS[group](timeline)
            except VascError as error:
                found[group] = {}
                problems.append(f"{group}: {_without_path(error, timeline)}")
        values[name] = _plain(found[group].get(name[len(group) + 1 :]))
    return values, problems


def _summary(timeline: "Timeline") -> dict[str, Any]:
    """Sum up a run."""
    counts = timeline.events.counts()
    placed = timeline.n_rows("sources")
    network = timeline.frame().network
    return {
        "steps": timeline.last_step,
        "time": float(timeline.frames["time"][-1]),
        "nodes": network.n_vein_nodes,
        "segments": network.n_segments,
        "sources_placed": placed,
        "sources_left": placed - counts.get("source_removed", 0),
        "joins": counts.get("vein_joined", 0),
        "loops": counts.get("loop_closed", 0),
        "stop_reason": timeline.stop_reason,
        "complete": timeline.is_complete,
    }


def _statistics(timeline: "Timeline") -> dict[str, Any]:
    """Measure the veins of the last step."""
    from vasc.analysis import run_widths, statistics
    from vasc.analysis.run_widths import widths_of
    from vasc.analysis.statistics import flattened

    widths = None
    if timeline.dimensions == 2:
        widths = run_widths(timeline.frame, timeline.last_step, widths_of(timeline.config))
    return dict(flattened(statistics(timeline.frame(), timeline.units, widths=widths)))


def _lineage(timeline: "Timeline") -> dict[str, Any]:
    """Measure the lives of sources, in steps, and what they caused."""
    lineage = timeline.lineage
    births, removed = lineage.fates["birth"], lineage.fates["removed"]
    lives = (removed - births)[removed >= 0]
    n_caused = int(np.count_nonzero(lineage.causes >= 0))
    return {
        "source_life_mean": float(lives.mean()) if len(lives) else None,
        "source_life_median": lineage.median_life().age,
        "sources_unreached": len(births) - len(lives),
        "nodes_per_source": n_caused / len(births) if len(births) else None,
    }


def _connectivity(timeline: "Timeline") -> dict[str, Any]:
    """Hold the veins of a stem against what its phyllotaxis predicts."""
    from vasc.validation.stem_phyllotaxis import check_connectivity, reading

    return check_connectivity(reading.read_stem(timeline)).as_json()


def _sequence(timeline: "Timeline") -> dict[str, Any]:
    """Hold a leaf against the observed sequence."""
    from vasc.validation.arabidopsis import check_sequence

    found = check_sequence(timeline).as_json()
    return (
        found
        | {f"features.{name}": passed for name, passed in found["features"].items()}
        | {f"criteria.{row['id']}": row["passed"] for row in found["criteria"]}
        | {f"step_of.{event['name']}": event["step"] for event in found["events"]}
    )


def _strand(timeline: "Timeline") -> dict[str, Any]:
    """Read to which vein the canal of the source leads."""
    from vasc.validation.strands import check_strand

    return check_strand(timeline).as_json()


_GROUPS: dict[str, Callable[["Timeline"], Mapping[str, Any]]] = {
    "summary": _summary,
    "stats": _statistics,
    "lineage": _lineage,
    "check.connectivity": _connectivity,
    "check.sequence": _sequence,
    "check.strand": _strand,
}


def _plain(value: Any) -> Any:
    """Give a value that JSON holds: no nan, and a list of other things as its length."""
    if isinstance(value, float):
        return value if np.isfinite(value) else None
    if isinstance(value, list | tuple):
        is_flat = all(isinstance(item, int | float | str) for item in value)
        return list(value) if is_flat else len(value)
    return value


def _without_path(error: VascError, timeline: "Timeline") -> str:
    """Give a message without the place of the run: the table has its number."""
    return " ".join(str(error).replace(f"{timeline.path}: ", "").split())
