"""How large a run will be is said before it starts, and what no machine holds is refused."""

import pytest
from config.wrong_configs import config

from vasc import experiment as experiments
from vasc.cli import main
from vasc.config import expected, load_text
from vasc.config.expected import (
    ExpectedSize,
    expected_size,
    memory_of_machine,
    refuse_full_disk,
    refuse_what_no_machine_holds,
)
from vasc.errors import ConfigError, OutputError, RunError
from vasc.limits import FREE_BYTES, MEMORY_SHARE
from vasc.timeline import Timeline

DARTS = "density = 0.02\nbirth_distance_sources = 4.0\nbirth_distance_veins = 4.0"
CONFIGS = {
    "marginal": config(placement=f'kind = "darts"\n{DARTS}'),
    "isogonic": config(
        placement=f'kind = "darts"\n{DARTS}',
        growth='kind = "isogonic"\nfinal_length = 100.0\nlength_per_step = 1.0',
    ),
    "given": config(placement='kind = "given"\npoints = [[0.0, 5.0], [2.0, 9.0], [-2.0, 12.0]]'),
    "deformed": config(
        domain='shape = "dome"\nlength = 10.0',
        growth='kind = "local_to_global"\nheights = [0.0, 1.0]\ng_x = [1.0, 1.0]\n'
        "g_y = [1.0, 1.0]\nend = 2.0",
        placement='kind = "empty_circles"\nbirth_distance = 4.0',
        refinement='kind = "corner_cutting"\nthreshold = 3.0',
    ),
}


@pytest.mark.parametrize("name", CONFIGS)
def test_a_run_is_no_larger_than_expected_and_no_less_than_a_thirtieth(name, tmp_path):
    experiment = load_text(CONFIGS[name])
    size = expected_size(experiment.parameters, experiment.model().growth)
    summary = experiments.run(experiment, tmp_path / "run.h5")
    for most, found in (
        (size.nodes, summary.nodes),
        (size.sources, summary.sources_placed),
        (size.file, (tmp_path / "run.h5").stat().st_size),
    ):
        assert most / 30 <= found <= most


SIZE = ExpectedSize(sources=1000, nodes=5000, memory=8_000_000_000, file=3_000_000_000)


@pytest.mark.parametrize(("more", "is_taken"), [(-1, True), (0, True), (1, False)])
def test_the_limits_of_a_machine_are_exact(more, is_taken, tmp_path, monkeypatch):
    memory, free = round((SIZE.memory - more) / MEMORY_SHARE), SIZE.file - more
    for memory_of_it, free_of_it, error, said in (
        (memory, 10**12, ConfigError, "^leaf: .* 8 GB of memory, .* has 10 GB"),
        (None, free, OutputError, "take 3 GB, and the disk has 3 GB free"),
    ):
        monkeypatch.setattr(expected, "memory_of_machine", lambda found=memory_of_it: found)
        monkeypatch.setattr(expected, "free_bytes", lambda output, found=free_of_it: found)
        if is_taken:
            refuse_what_no_machine_holds(SIZE, tmp_path / "run.h5", "leaf")
        else:
            with pytest.raises(error, match=said):
                refuse_what_no_machine_holds(SIZE, tmp_path / "run.h5", "leaf")


@pytest.mark.parametrize(("more", "is_taken"), [(-1, True), (0, True), (1, False)])
def test_a_run_begins_with_some_room_on_the_disk(more, is_taken, tmp_path, monkeypatch):
    monkeypatch.setattr(expected, "free_bytes", lambda output: FREE_BYTES - more)
    if is_taken:
        refuse_full_disk(tmp_path / "run.h5")
    else:
        with pytest.raises(OutputError, match=r"its disk has 64\.0 MB free, .*--large"):
            refuse_full_disk(tmp_path / "run.h5")


def test_a_machine_says_how_much_memory_it_has():
    assert memory_of_machine() > 10**8


def test_a_run_that_memory_cannot_hold_is_refused_by_name(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("vasc.config.expected.memory_of_machine", lambda: 10**8)
    (tmp_path / "leaf.toml").write_text(config())
    run = ["run", str(tmp_path / "leaf.toml"), "-o", str(tmp_path / "leaf.h5"), "-q", "--no-figure"]
    assert main(run) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith(str(tmp_path / "leaf.toml: the run may have up to"))
    assert "of which the machine has 0.1 GB; at most 80% are allowed" in line
    assert not (tmp_path / "leaf.h5").exists()
    assert main([*run, "--large", "--steps", "1"]) == 0


@pytest.mark.parametrize("name", ["RUN_NODES", "RUN_SOURCES", "RUN_STEPS"])
@pytest.mark.parametrize(("more", "is_taken"), [(1, True), (0, True), (-1, False)])
def test_a_run_ends_where_it_has_more_than_it_may(name, more, is_taken, tmp_path, monkeypatch):
    experiment = load_text(config(stop="steps = 20"))
    states = list(experiments.simulate(experiment.model(), streams_of(experiment)))
    # the last step is not gone on from
    held = {"RUN_NODES": "nodes", "RUN_SOURCES": "sources"}
    most = 20 if name == "RUN_STEPS" else states[-2].n_rows(held[name])
    monkeypatch.setattr(f"vasc.simulation.{name}", most + more)
    if is_taken:
        assert experiments.run(experiment, tmp_path / "run.h5").steps == 20
        return
    with pytest.raises(RunError, match=r"the run .* are kept"):
        experiments.run(experiment, tmp_path / "run.h5")
    with Timeline(tmp_path / "run.h5") as timeline:
        assert timeline.n_frames > 1
        assert "failed: RunError: the run " in timeline.provenance[-1]["outcome"]


def streams_of(experiment):
    """Give the streams of an experiment as a run makes them."""
    return experiments.Streams(experiment.parameters.seed, experiment.parameters.stream_names)
