"""Whatever a sweep file says, it is planned or refused in lines."""

import json
import tomllib
from pathlib import Path

import pytest
import tomli_w
from hostile.ending import bounded, refused
from hostile.spoiling import VALUES, spoilt_bytes, spoilt_tables
from hostile.tiers import every_tier, hold
from hypothesis import strategies as st
from pydantic import ValidationError

from vasc.errors import ConfigError
from vasc.limits import SWEEP_RUNS
from vasc.sweeps import load_sweep
from vasc.sweeps.parameters import SweepParameters

ROOT = Path(__file__).resolve().parents[2]
BUNDLED = [path.read_bytes() for path in sorted((ROOT / "configs" / "sweeps").glob("*.toml"))]
SPANS = {
    "base": "poplar-leaf",
    "measures": ["summary.nodes"],
    "axes": {"arrival.kill_distance": {"from": 1.0, "to": 9.0, "num": 3, "scale": "log"}},
    "random": {"placement.density": {"from": 0.001, "to": 0.01, "whole": False}},
}
TABLES = [*(tomllib.loads(text.decode()) for text in BUNDLED), SPANS]


def planned_or_refused(folder, content):
    """Read a sweep; what is wrong is told by lines and exit code 2 of the program, too."""
    path = folder / "sweep.toml"
    path.write_bytes(content)
    try:
        with bounded():
            sweep = load_sweep(path)
    except ConfigError:
        lines = refused("sweep", path, "-o", folder / "out")
        assert all(line.startswith(str(folder)) for line in lines)
        assert not (folder / "out").exists()
    else:
        assert 1 <= len(sweep.runs) <= SWEEP_RUNS
        json.dumps(sweep.description(), allow_nan=False)


@pytest.mark.parametrize("base", ["9" * 300, "a/" * 3000 + "b"])
def test_a_base_that_is_too_long_for_a_name_is_told_in_a_line(base, tmp_path):
    planned_or_refused(tmp_path, tomli_w.dumps(SPANS | {"base": base}).encode())


@every_tier
def test_any_values_are_planned_or_refused(n_cases, tmp_path):
    def check(tables):
        planned_or_refused(tmp_path, tomli_w.dumps(tables).encode())

    hold(check, spoilt_tables(TABLES), n_cases // 2)


@every_tier
def test_any_bytes_are_planned_or_refused(n_cases, tmp_path):
    hold(lambda content: planned_or_refused(tmp_path, content), spoilt_bytes(BUNDLED), n_cases // 2)


@every_tier
def test_any_ends_of_a_range_are_planned_or_refused(n_cases, tmp_path):
    numbers = [value for value in VALUES if type(value) in (int, float)]
    span = st.fixed_dictionaries(
        {"from": st.sampled_from(numbers), "to": st.sampled_from(numbers)},
        optional={
            "num": st.sampled_from(numbers),
            "scale": st.sampled_from(["log", "linear"]),
            "whole": st.booleans(),
        },
    )

    def check(case):
        table, one = case
        tables = SPANS | {table: {"stop.steps": one}}
        planned_or_refused(tmp_path, tomli_w.dumps(tables).encode())

    hold(check, st.tuples(st.sampled_from(["axes", "random"]), span), n_cases // 2)


@pytest.mark.parametrize(("more", "is_planned"), [(-1, True), (0, True), (1, False)])
def test_the_limit_of_runs_is_exact(more, is_planned):
    tables = {"base": "poplar-leaf", "measures": ["summary.nodes"]}
    tables["replicates"] = SWEEP_RUNS + more
    if is_planned:
        assert SweepParameters.model_validate(tables).replicates == SWEEP_RUNS + more
    else:
        with pytest.raises(ValidationError, match="make 100,001 runs; at most 100,000"):
            SweepParameters.model_validate(tables)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("x = " + "[" * 100_000, "nested too deeply"),
        ("seed = 0x" + "f" * 5000, "at most 64 bits"),
        ("seed = 1e999", "must be a finite number"),
        ('base = "/dev/zero"\nmeasures = ["summary.nodes"]', "larger than 1,000,000 bytes"),
        ('base = "a\\u0000b"\nmeasures = ["summary.nodes"]', "base"),
    ],
)
def test_a_hostile_sweep_is_refused(text, said, tmp_path):
    (tmp_path / "sweep.toml").write_text(text)
    assert any(said in line for line in refused("sweep", tmp_path / "sweep.toml"))
