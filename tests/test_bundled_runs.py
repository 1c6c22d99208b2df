"""The bundled experiments: each builds its model, and its whole run ends as it should."""

import numpy as np
import pytest

from vasc.analysis.topology import count_components, count_cycles, free_ends
from vasc.config import load, parse_override
from vasc.config.bundled import bundled_configs
from vasc.config.expected import expected_size
from vasc.events import EventKind
from vasc.experiment import run, verify
from vasc.network import Origin
from vasc.simulation import simulate
from vasc.streams import Streams
from vasc.timeline import Timeline
from vasc.timeline.validation import validate
from vasc.validation.stem_phyllotaxis import check_connectivity
from vasc.validation.stem_phyllotaxis.reading import read_stem
from vasc.validation.stem_references import STEM_PATTERNS

NAMES = [config.name for config in bundled_configs()]
STEMS = [name for name in NAMES if load(name).kind == "stem"]
CANALS = [name for name in NAMES if load(name).kind == "canalization"]
LEAVES = [name for name in NAMES if load(name).kind in ("open", "closed", "areole")]
OTHERS = [name for name in NAMES if name not in STEMS + LEAVES]
"""Tissues of cells, and a leaf without any growth of veins."""
FLAX = "stem-lucas-7-11"
"""The largest stem."""
FREE = {f"param-kill-distance-{letter}" for letter in "abc"}
"""Closed models whose kill distance is so long that no two veins come near a source."""

WITHOUT_LOOPS = {*FREE, "forked-like"}
"""In the latter veins end blindly from the first one on."""
ROUNDING = 1e-6
"""Veins that end on the margin may lie outside by less, in D."""


@pytest.mark.parametrize("name", NAMES)
def test_the_model_builds(name):
    experiment = load(name)
    parameters = experiment.parameters
    if name in LEAVES:
        assert parameters.arrival.kill_distance >= parameters.extension.segment_length
    state = parameters.model(experiment.folder).initial_state(
        Streams(parameters.seed, parameters.stream_names)
    )
    assert state.step == 0


def test_names_are_those_of_the_table():
    rows = {
        *(f"param-kill-distance-{letter}" for letter in "abcde"),
        *(f"param-darts-{letter}" for letter in "fgh"),
        *("slow-marginal", "ginkgo-leaf", "alchemilla-leaf", "sweetgum-leaf"),
        *("toothed-lobed-leaf", "emergent-tertiary", "orchid-leaf", "reticulate-leaf"),
        *("nankin-cherry-leaf", "grass-leaf", "poplar-leaf", "trillium-petal"),
    }
    assert rows <= set(NAMES)
    assert all(load(name).parameters.printed is not None for name in rows)


def test_every_stem_of_the_thesis_is_there():
    found = {}
    for name in STEMS:
        tables = load(name).tables
        placement, radius = tables["placement"], tables["domain"].get("radius")
        key = (placement["divergence"], radius, placement["rise"], placement["plastochron"])
        found[key] = placement["primordia"]
    for row in STEM_PATTERNS:
        enough = 3 * max(row.pair) + 26
        assert found[row.divergence, row.radius, row.rise, row.plastochron] == enough


def test_a_stem_that_widens_has_three_pairs_one_above_the_other(tmp_path):
    run(load("stem-golden-widening"), tmp_path / "run.h5")
    with Timeline(tmp_path / "run.h5") as timeline:
        report = check_connectivity(read_stem(timeline))
    steps = [report.connectivity.steps[m] for m in report.connectivity.judged]
    assert steps[-13:] == [(5, 8)] * 13
    assert steps[9:21] == [(3, 5)] * 12
    assert steps[:9].count((2, 3)) == 8
    assert len(report.exceptions) == 2
    assert report.passed


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=pytest.mark.slow if name == FLAX else ()) for name in STEMS]
)
def test_the_whole_stem_ends_as_it_should(name, tmp_path):
    path = tmp_path / "run.h5"
    experiment = load(name)
    n_primordia = experiment.tables["placement"]["primordia"]
    summary = run(experiment, path)
    assert summary.stop_reason == "no_sources"
    assert validate(path) == []
    with Timeline(path) as timeline:
        network = timeline.frame().network
        report = check_connectivity(read_stem(timeline))
    primordia = np.flatnonzero(network.origins == Origin.PRIMORDIUM)
    assert len(primordia) == n_primordia
    assert np.isin(primordia, network.segments).all()
    assert count_components(network) == 1
    assert len(np.unique(network.positions, axis=0)) == network.n_nodes
    assert report.passed


@pytest.mark.parametrize("name", CANALS)
def test_canals_of_all_sources_become_veins(name, tmp_path):
    path = tmp_path / "run.h5"
    summary = run(load(name), path)
    assert summary.stop_reason == "at_rest"
    assert summary.sources_left == 0
    assert validate(path) == []
    with Timeline(path) as timeline:
        network = timeline.frame().network
    n_cycles = count_cycles(network)
    assert n_cycles == (1 if name == "areole-canals" else 0)
    assert count_components(network) == (2 if name.startswith("mitchison") else 1)


@pytest.mark.parametrize("kind", [["rectangular"], ["hexagonal", "rows=19"], ["voronoi"]])
@pytest.mark.parametrize("side", ["left", "right", "polar", "pool"])
def test_of_two_veins_the_nearer_one_is_reached_on_any_cells(side, kind):
    overrides = [parse_override(f"domain.kind={kind[0]}")]
    overrides += [parse_override(f"domain.{one}") for one in kind[1:]]
    parameters = load(f"mitchison-two-sinks-{side}", overrides).parameters
    streams = Streams(parameters.seed, parameters.stream_names)
    *_, state = simulate(parameters.model(), streams)
    kinds = state.rows("events", "kind")
    assert EventKind.CANALS_UNSETTLED not in kinds
    assert EventKind.CANALS_SETTLED in kinds
    if side in ("polar", "pool"):
        assert parameters.transport.kind == side
    # the first new node extends the vein that the canal leads to
    assert state.rows("nodes", "parent")[2] == (1 if side == "right" else 0)


def assert_as_large_as_expected(experiment, summary, path):
    """What is said of a run before its start is too much, and not far too much."""
    growth = experiment.parameters.grown(experiment.folder)
    expected = expected_size(experiment.parameters, growth)
    assert 0.05 * expected.nodes < summary.nodes < expected.nodes
    assert 0.05 * expected.sources < summary.sources_placed < expected.sources
    assert 0.05 * expected.file < path.stat().st_size < expected.file


@pytest.mark.slow
@pytest.mark.parametrize("name", LEAVES)
def test_the_whole_run_ends_as_it_should(name, tmp_path):
    path = tmp_path / "run.h5"
    experiment = load(name)
    summary = run(experiment, path)
    assert summary.stop_reason == "no_sources"
    assert summary.sources_left == 0
    assert validate(path) == []
    assert_as_large_as_expected(experiment, summary, path)
    with Timeline(path) as timeline:
        frame = timeline.frame()
        network, blade = frame.network, frame.blade
        n_live = frame.sources.n_sources
    positions = network.positions
    assert n_live == 0
    assert len(np.unique(positions, axis=0)) == len(positions)
    ends = positions[free_ends(network)]
    assert (blade.contains(ends) | (blade.margin_distance(ends) < ROUNDING)).all()
    n_seeds = int((network.origins == Origin.SEED).sum())
    n_components, n_cycles = count_components(network), count_cycles(network)
    if experiment.kind == "open":
        assert (n_components, n_cycles) == (n_seeds, 0)
    else:
        assert n_components <= n_seeds
        assert n_cycles == 0 if name in WITHOUT_LOOPS else n_cycles > 0


@pytest.mark.slow
@pytest.mark.parametrize("name", OTHERS)
def test_the_whole_run_of_another_model_ends_and_repeats(name, tmp_path):
    path = tmp_path / "run.h5"
    experiment = load(name)
    summary = run(experiment, path)
    assert summary.stop_reason == ("no_sources" if experiment.kind == "gottlieb" else "at_rest")
    assert summary.sources_left == 0
    # straight veins go around a bay of the outline, not across it
    assert summary.nodes_outside == 0
    assert validate(path) == []
    assert verify(path) == []
