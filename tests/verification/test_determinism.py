"""Equal seed, config and software give equal content, whatever else differs.

Each run is a process of its own, and is held against one with one thread. The same holds for
canals as long as it is one machine: sparse solves round as its processor does.
"""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from reference.digests import content_digest

from vasc.timeline import Timeline

ROOT = Path(__file__).resolve().parents[2]
PRESETS = {
    "poplar-leaf": "growth.final_length=500",
    "arabidopsis-first-leaf": "stop.steps=180",
    "stem-golden-1-2": "placement.primordia=12",
    "mitchison-two-sinks-left": "transport.gain=2e3",
}
"""Two leaves, a stem and a tissue, with one value of each changed, mostly for a smaller run."""
TISSUE = "mitchison-two-sinks-left"
SMALL = "stem-golden-1-2"
"""The preset of the fast tests."""
SWEEP = """title = "Two runs that differ by seed"
base = "{base}"
replicates = 2
measures = ["summary.nodes"]

[axes]
"{key}" = [{value}]
"""
ONE_THREAD = {
    "PYTHONHASHSEED": "0",
    "OMP_NUM_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
    "NUMBA_NUM_THREADS": "1",
}
CELLS = {
    "again": {},
    "hash-seed-1": {"PYTHONHASHSEED": "1"},
    "hash-seed-2": {"PYTHONHASHSEED": "2"},
    "openmp-2": {"OMP_NUM_THREADS": "2"},
    "openblas-2": {"OPENBLAS_NUM_THREADS": "2"},
    "numba-2": {"NUMBA_NUM_THREADS": "2"},
    "all-2": dict.fromkeys(ONE_THREAD, "2"),
    "without-assertions": {"PYTHONOPTIMIZE": "1"},
}
"""What differs in the environment of a run."""
OTHER_PROCESSORS = {
    "no-avx512": {"NPY_DISABLE_CPU_FEATURES": "X86_V4 AVX512_ICL AVX512_SPR"},
    "blas-of-haswell": {"OPENBLAS_CORETYPE": "Haswell"},
}
"""Libraries as on another processor; a tissue may differ there, as its solver's sums do."""
ANYWHERE = [preset for preset in PRESETS if preset != TISSUE]
PAIRS = [(preset, cell) for preset in PRESETS for cell in CELLS] + [
    (preset, cell) for preset in ANYWHERE for cell in OTHER_PROCESSORS
]


def vasc(*arguments, cells=(), cwd=None):
    """Run the command line in a process of its own."""
    known = {"PATH": os.environ["PATH"], "HOME": os.environ.get("HOME", ""), **ONE_THREAD}
    environment = {**known, "PYTHONPATH": str(ROOT), **dict(cells)}
    command = [sys.executable, "-m", "vasc", *map(str, arguments)]
    subprocess.run(command, env=environment, cwd=cwd, check=True, capture_output=True)


def run(preset, folder, cells=(), *options):
    """Grow a preset; give its timeline."""
    output = folder / f"{preset}.h5"
    changes = ("--set", PRESETS[preset], *(options or ("--no-figure", "-q")))
    vasc("run", preset, "-o", output, *changes, cells=cells)
    return output


def digest(path):
    """Give what is recorded, but for the wording of the config."""
    return content_digest(path, without=("provenance", "config/toml"))


@pytest.fixture(scope="module")
def expected(tmp_path_factory):
    """Give a function from a preset to the digest of its first run, and its number of steps."""
    found = {}

    def of(preset):
        if preset not in found:
            path = run(preset, tmp_path_factory.mktemp("first"))
            with Timeline(path) as timeline:
                found[preset] = digest(path), timeline.last_step
        return found[preset]

    return of


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """Build the wheel, and install it into a folder of its own."""
    folder = tmp_path_factory.mktemp("installed")
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "--quiet"]
    options = ["--no-deps", "--no-build-isolation", "--wheel-dir", folder]
    subprocess.run([*pip, "wheel", ROOT, *options], check=True, capture_output=True)
    (wheel,) = folder.glob("*.whl")
    site = folder / "site"
    command = [*pip, "install", "--no-deps", "--no-index", "--target", site, wheel]
    subprocess.run(command, check=True, capture_output=True)
    return site


@pytest.mark.parametrize("cell", ["all-2"])
def test_a_stem_is_the_same_with_other_threads_and_hashes(cell, expected, tmp_path):
    assert digest(run(SMALL, tmp_path, CELLS[cell])) == expected(SMALL)[0]


def test_another_seed_gives_another_leaf(tmp_path):
    digests = set()
    for seed in (1, 2):
        path = tmp_path / f"{seed}.h5"
        changes = ["--set", "growth.final_length=200", "--seed", seed, "--no-figure", "-q"]
        vasc("run", "poplar-leaf", "-o", path, *changes)
        digests.add(content_digest(path, without=("provenance", "config")))
    assert len(digests) == 2


@pytest.mark.slow
@pytest.mark.parametrize(("preset", "cell"), PAIRS)
def test_a_run_is_the_same_in_another_environment(preset, cell, expected, tmp_path):
    cells = (CELLS | OTHER_PROCESSORS)[cell]
    assert digest(run(preset, tmp_path, cells)) == expected(preset)[0]


@pytest.mark.slow
@pytest.mark.parametrize("kernel", ["Haswell", "Nehalem"])
def test_canals_of_another_processor_differ_in_the_last_digits_alone(kernel, tmp_path):
    (tmp_path / "other").mkdir()
    paths = run(TISSUE, tmp_path), run(TISSUE, tmp_path / "other", {"OPENBLAS_CORETYPE": kernel})
    with Timeline(paths[0]) as first, Timeline(paths[1]) as second:
        assert first.last_step == second.last_step
        assert first.events.counts() == second.events.counts()
        for step in range(first.n_frames):
            fields, others = first.fields(step), second.fields(step)
            assert np.array_equal(fields.roles, others.roles)
            # far below any threshold of a strand, and what the page promises
            assert fields.concentration == pytest.approx(others.concentration, rel=1e-9)
            assert fields.carriers == pytest.approx(others.carriers, rel=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("preset", PRESETS)
def test_a_run_is_the_same_when_it_is_watched(preset, expected, tmp_path):
    path = run(preset, tmp_path, (), "--figure", tmp_path / "figure.png")
    assert digest(path) == expected(preset)[0]


@pytest.mark.slow
@pytest.mark.parametrize("preset", PRESETS)
def test_a_run_is_the_same_when_it_is_resumed_in_the_middle(preset, expected, tmp_path):
    content, n_steps = expected(preset)
    path = run(preset, tmp_path, (), "--steps", n_steps // 2, "--no-figure", "-q")
    vasc("resume", path, "--steps", n_steps // 4, "-q")
    with Timeline(path) as timeline:
        assert timeline.last_step == n_steps // 2 + n_steps // 4
    vasc("resume", path, "-q", cells={"PYTHONHASHSEED": "3"})
    assert digest(path) == content


@pytest.mark.slow
@pytest.mark.parametrize("workers", [1, 2])
@pytest.mark.parametrize("preset", PRESETS)
def test_a_run_is_the_same_in_a_sweep(preset, workers, expected, tmp_path):
    key, _, value = PRESETS[preset].partition("=")
    (tmp_path / "sweep.toml").write_text(SWEEP.format(base=preset, key=key, value=value))
    vasc("sweep", tmp_path / "sweep.toml", "-o", tmp_path / "out", "--workers", workers, "-q")
    first, second = sorted((tmp_path / "out").rglob("*.h5"))
    assert digest(first) != digest(second)
    for path in (first, second):
        with Timeline(path) as timeline:
            seed = timeline.seed
        again = run(preset, tmp_path, (), "--seed", seed, "--force", "--no-figure", "-q")
        assert digest(path) == digest(again)


@pytest.mark.slow
@pytest.mark.parametrize("preset", PRESETS)
def test_a_run_is_the_same_from_an_installed_wheel(preset, installed, expected, tmp_path):
    where = {"PYTHONPATH": str(installed)}
    command = [sys.executable, "-c", "import vasc; print(vasc.__file__)"]
    shown = subprocess.run(
        command, env=os.environ | where, cwd=tmp_path, check=True, capture_output=True, text=True
    )
    assert Path(shown.stdout.strip()).is_relative_to(installed)
    output = tmp_path / "installed.h5"
    arguments = ["run", preset, "-o", output, "--set", PRESETS[preset], "--no-figure", "-q"]
    vasc(*arguments, cells=where, cwd=tmp_path)
    assert digest(output) == expected(preset)[0]
