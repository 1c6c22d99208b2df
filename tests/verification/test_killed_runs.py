"""A real run killed at any moment: the file opens, resumes, and ends in the same bytes."""

import subprocess
import sys
import time

import h5py
import numpy as np
import pytest

from vasc.timeline import Timeline, validate
from vasc.timeline.redo import log_of

CONFIG = """
kind = "closed"
seed = 3
[domain]
shape = "deltoid"
length = 115.0
[growth]
kind = "isogonic"
final_length = 1500.0
length_per_step = 6.0
[placement]
kind = "darts"
density = 200e-6
birth_distance_sources = 20.0
birth_distance_veins = 20.0
[arrival]
kill_distance = 1.0
"""

CANALS = """
kind = "canalization"
background = 0.1
[domain]
kind = "rectangular"
columns = 31
rows = 17
[veins]
lines = [[[5, 16]], [[25, 16]]]
[placement]
points = [[12, 4], [18, 6], [3, 3], [28, 8]]
rounds = [1, 2, 2, 3]
[settling]
noise = 0.1
[transport]
kind = "{kind}"
"""

CONFIGS = {"leaf": CONFIG} | {
    kind: CANALS.format(kind=kind) for kind in ("facilitated", "polar", "pool")
}

N_KILLS = 50
VASC = [sys.executable, "-m", "vasc"]


def contents(path):
    """All columns of the tables and frames of a file."""
    columns = {}

    def visit(name, item):
        if isinstance(item, h5py.Dataset) and not name.startswith("provenance"):
            columns[name] = item[()]

    with h5py.File(path, "r") as file:
        file.visititems(visit)
    return columns


@pytest.mark.slow
@pytest.mark.parametrize("toml", CONFIGS.values(), ids=CONFIGS)
def test_fifty_kills(tmp_path, toml):
    config = tmp_path / "run.toml"
    config.write_text(toml)
    whole = tmp_path / "whole.h5"
    started = time.monotonic()
    quiet = ["--quiet", "--no-figure"]
    subprocess.run([*VASC, "run", config, "-o", whole, *quiet], check=True)
    seconds = time.monotonic() - started
    expected = contents(whole)
    rng = np.random.default_rng(0)
    n_cut = 0
    while n_cut < N_KILLS:
        trial = n_cut
        path = tmp_path / f"{trial}.h5"
        process = subprocess.Popen([*VASC, "run", config, "-o", path, *quiet])
        time.sleep(float(rng.uniform(0.3 * seconds, seconds)))
        process.kill()
        process.wait()
        if not path.exists():
            continue
        with Timeline(path) as timeline:
            is_whole = timeline.is_complete
        if is_whole:
            # it may have been killed before its log was removed
            path.unlink()
            log_of(path).unlink(missing_ok=True)
            continue
        n_cut += 1
        assert validate(path) == [], trial
        subprocess.run([*VASC, "resume", path, "--quiet"], check=True)
        found = contents(path)
        assert found.keys() == expected.keys()
        for name, column in expected.items():
            np.testing.assert_array_equal(found[name], column, f"{name} in trial {trial}")
        path.unlink()
