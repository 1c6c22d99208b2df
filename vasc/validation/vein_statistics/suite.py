"""Bundled leaves, simulated and held against what is known of real ones."""

from collections.abc import Callable
from copy import deepcopy
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from vasc.analysis.run_widths import widths_of
from vasc.arrays import Floats
from vasc.config import Experiment, load, load_text
from vasc.experiment import run
from vasc.timeline import Timeline
from vasc.validation.vein_statistics.branchings import branching_exponents
from vasc.validation.vein_statistics.checks import (
    LeafCheck,
    as_table,
    check_growing,
    check_leaf,
    check_numbers,
    check_open,
    reported,
)
from vasc.validation.vein_statistics.densities import Densities, densities_of
from vasc.validation.vein_statistics.distributions import curves, distributions
from vasc.validation.vein_statistics.samples import (
    LeafSample,
    dalbergia,
    sample_of_run,
)

CLOSED, AREOLE, MATURE, OPEN = (
    "reticulate-leaf",
    "arabidopsis-first-leaf",
    "mature-areoles",
    "sweetgum-leaf",
)
"""Bundled experiments: closed venation on a blade that grows isogonically; areole venation with
the mesophyll event, and a larger leaf without it; open venation."""

Progress = Callable[[str], None]


@dataclass(frozen=True)
class LeafReport:
    """The leaves, and what came of the checks.

    Parameters
    ----------
    checks : list of LeafCheck
        All of them.
    samples : list of LeafSample
        The leaves with areoles; the real one is the last.
    exponents : ndarray of shape (b,), float64
        Murray's exponent at each branching of the open leaf.
    densities : dict of str to Densities
        Of the growing leaves.
    """

    checks: list[LeafCheck]
    samples: list[LeafSample]
    exponents: Floats
    densities: dict[str, Densities]

    def as_suite(self) -> dict[str, Any]:
        """Give the suite as ``vasc validate --json`` writes it.

        Returns
        -------
        dict
            ``name``, ``checks``, each with its ``name``, ``value``, ``low``, ``high``,
            ``source``, ``basis`` of the range and ``pass``; ``reported``, numbers that decide
            nothing; ``control_failures``, checks that the real leaf fails: in these the
            check is wrong, not the leaf; and ``distributions``, ``curves`` and ``exponents``,
            which pictures are drawn from.
        """
        real = {sample.name for sample in self.samples if sample.kind == "real"}
        checks = as_table(self.checks)
        return {
            "name": "leaf",
            "checks": checks,
            "reported": [row for sample in self.samples for row in reported(sample)],
            "control_failures": [
                check["name"] for check in checks if check["leaf"] in real and not check["pass"]
            ],
            "distributions": distributions(self.samples),
            "curves": curves(self.samples, self.densities),
            "exponents": self.exponents.tolist(),
        }


def validate_leaf(progress: Progress = lambda name: None) -> LeafReport:
    """Run the bundled leaves and hold them, and a real one, against the checks.

    Parameters
    ----------
    progress : callable
        Told what is begun.

    Returns
    -------
    LeafReport
    """
    checks: list[LeafCheck] = []
    samples: list[LeafSample] = []
    densities: dict[str, Densities] = {}
    with TemporaryDirectory() as folder:
        for name, kind in ((CLOSED, "closed"), (AREOLE, "areole"), (MATURE, "areole")):
            progress(f"{name}: growing")
            path = recorded(load(name), Path(folder))
            progress(f"{name}: measuring")
            samples.append(sample_of_run(name, kind, path))
            if name != AREOLE:
                densities[name] = growing(path)
                checks += check_growing(name, densities[name])
            path.unlink()
        progress(f"{OPEN}: growing")
        path = recorded(load(OPEN), Path(folder))
        open_leaf = sample_of_run(OPEN, "open", path)
        with Timeline(path) as timeline:
            asked = widths_of(timeline.config)
    exponents = branching_exponents(open_leaf.leaf.network, asked)
    checks += check_open(open_leaf, exponents, asked.exponent)
    progress("Dalbergia, a real leaf: measuring")
    samples.append(dalbergia())
    for sample in samples:
        checks += check_leaf(sample)
    checks += check_numbers(samples[-1])
    return LeafReport(checks, samples, exponents, densities)


def leaf_suite(progress: Progress = lambda name: None) -> dict[str, Any]:
    """Run the bundled leaves, and give the suite as ``vasc validate --json`` writes it."""
    return validate_leaf(progress).as_suite()


def recorded(experiment: Experiment, folder: Path) -> Path:
    """Run an experiment into a folder, and give the timeline."""
    path = folder / "run.h5"
    path.unlink(missing_ok=True)
    run(experiment, path)
    return path


def growing(path: Path) -> Densities:
    """Measure the densities of a recorded leaf while it grows."""
    with Timeline(path) as timeline:
        return densities_of(timeline, widths_of(timeline.config))


def changed(name: str, change: dict[str, dict[str, Any]]) -> Experiment:
    """Give a bundled experiment with keys of its tables changed."""
    import tomli_w

    tables = deepcopy(load(name).tables)
    for table, values in change.items():
        # of another kind, nothing of the old table has a meaning
        tables[table] = values if "kind" in values else tables.get(table, {}) | values
    return load_text(tomli_w.dumps(tables))
