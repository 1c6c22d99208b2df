"""Leaves of the user, recorded runs and real networks, held against the checks of leaves."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from vasc.analysis.run_widths import widths_of
from vasc.arrays import Floats
from vasc.errors import VascError
from vasc.networks_in import is_network_file, read_network
from vasc.timeline import Timeline
from vasc.validation.vein_statistics.branchings import branching_exponents
from vasc.validation.vein_statistics.checks import (
    LeafCheck,
    check_growing,
    check_leaf,
    check_open,
)
from vasc.validation.vein_statistics.densities import Densities, blade_areas, densities_of
from vasc.validation.vein_statistics.samples import (
    LeafSample,
    dalbergia,
    sample_of_run,
)
from vasc.validation.vein_statistics.suite import LeafReport, Progress

OPEN = "open"
"""The kind of runs whose venation is a tree."""
GIVEN = "given"
"""Networks of the user: real, but no control of the checks."""


def validate_leaves(paths: Sequence[Path], progress: Progress = lambda name: None) -> LeafReport:
    """Hold leaves of the user against the checks, beside the real leaf that comes with vasc.

    A run is judged at its last step: by checks 6 to 13, and by check 15 if its blade has
    doubled its area; one of open venation by checks 11 and 14. A real network is judged by
    checks 6 to 13, without those of widths where it has none. Check 17 is of the measuring,
    and is left out.

    Parameters
    ----------
    paths : sequence of Path
        Timelines of leaves, and files of networks.
    progress : callable
        Told what is begun.

    Returns
    -------
    LeafReport
        Of open runs, ``exponents`` are less the exponent asked for.

    Raises
    ------
    VascError
        If a file is none of these, is given twice, or has no areole where checks need some.
    """
    checks: list[LeafCheck] = []
    samples: list[LeafSample] = []
    densities: dict[str, Densities] = {}
    off: list[Floats] = []
    for name, path in _named(paths).items():
        progress(f"{name}: measuring")
        if is_network_file(path):
            samples.append(_with_areoles(LeafSample(name, GIVEN, read_network(path)), path))
            continue
        kind = _kind_of(path)
        sample = sample_of_run(name, kind, path)
        if kind == OPEN:
            exponents, asked = _exponents(sample, path)
            checks += check_open(sample, exponents, asked)
            off.append(exponents - asked)
            continue
        samples.append(_with_areoles(sample, path))
        with Timeline(path) as timeline:
            areas = blade_areas(timeline)
            if areas[-1] >= 2.0 * areas[0]:
                densities[name] = densities_of(timeline, widths_of(timeline.config))
                checks += check_growing(name, densities[name])
    samples.append(dalbergia())
    for sample in samples:
        checks += check_leaf(sample)
    return LeafReport(checks, samples, np.concatenate([np.empty(0), *off]), densities)


def _named(paths: Sequence[Path]) -> dict[str, Path]:
    """Give a short name to each file, and refuse a file that is given twice."""
    found: dict[str, Path] = {}
    stems = [path.name.partition(".")[0] for path in paths]
    for path, stem in zip(paths, stems, strict=True):
        name = stem if stems.count(stem) == 1 else str(path)
        if name in found:
            raise VascError(f"{path}: is given twice")
        found[name] = path
    return found


def _kind_of(path: Path) -> str:
    """Give the kind of a recorded leaf, and refuse what has no blade with free veins."""
    with Timeline(path) as timeline:
        if timeline.dimensions != 2:
            raise VascError(f"{path}: is a stem; the checks of leaves are of veins in a plane")
        if timeline.tissue is not None:
            raise VascError(f"{path}: is a run on a tissue; its veins are walls of cells")
        if not timeline.n_frames:
            raise VascError(f"{path}: holds no step yet")
        return str(timeline.config["kind"])


def _exponents(sample: LeafSample, path: Path) -> tuple[Floats, float]:
    """Give the exponent at each branching of a tree, and the one that its config asks for."""
    with Timeline(path) as timeline:
        asked = widths_of(timeline.config)
    return branching_exponents(sample.leaf.network, asked), asked.exponent


def _with_areoles(sample: LeafSample, path: Path) -> LeafSample:
    """Give a leaf back that has areoles to be judged."""
    if not sample.measured.areoles.n_areoles:
        raise VascError(
            f"{path}: its veins enclose no areole, and checks 6 to 13 are of areoles;"
            " only runs of open venation are judged without"
        )
    return sample
