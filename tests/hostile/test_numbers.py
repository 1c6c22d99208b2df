"""A run whose numbers go wrong ends with the cause, keeps what is sound, and says so."""

import numpy as np
import pytest
from cli.conftest import LEAF
from config.wrong_configs import tissue_config

from vasc import experiment as experiments
from vasc.config import load_text
from vasc.errors import RunError
from vasc.events import StopReason
from vasc.models.canalization import Canalization
from vasc.models.colonization import Colonization
from vasc.timeline import Timeline, validate

SPOILT = 6
"""The step that goes wrong."""


def spoil_places(table, value):
    """Give an ``advance`` after which the newest place of a table is none."""
    advance = Colonization.advance

    def spoiling(self, state, streams):
        made = advance(self, state, streams)
        if made.step >= SPOILT and made.n_rows(table) > state.n_rows(table):
            made.tables[table].arrays["position"][made.n_rows(table) - 1, 1] = value
        return made

    return spoiling


@pytest.mark.parametrize("table", ["nodes", "sources"])
@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_a_place_that_is_no_number_ends_a_leaf(table, value, tmp_path, monkeypatch):
    monkeypatch.setattr(Colonization, "advance", spoil_places(table, value))
    assert_ends(
        load_text(LEAF), tmp_path / "run.h5", f"the place of {table[:-1]} \\d+ is no number"
    )


@pytest.mark.parametrize("name", ["concentration", "flux", "carriers"])
def test_a_field_that_is_no_number_ends_a_tissue(name, tmp_path, monkeypatch):
    advance = Canalization.advance

    def spoiling(self, state, streams):
        made = advance(self, state, streams)
        if made.step == SPOILT:
            getattr(made.fields, name)[3] = np.nan
        return made

    monkeypatch.setattr(Canalization, "advance", spoiling)
    of = "cell" if name == "concentration" else "wall"
    said = f"the {name} of {of} 3 is no finite number"
    assert_ends(load_text(tissue_config()), tmp_path / "run.h5", said)


def assert_ends(experiment, path, said):
    """Run to the step that goes wrong; all before is kept, and the record tells the cause."""
    with pytest.raises(RunError, match=f"step \\d+: {said}; all steps up to \\d+ are kept"):
        experiments.run(experiment, path)
    assert validate(path) == []
    with Timeline(path) as timeline:
        assert timeline.last_step >= SPOILT - 1
        assert np.isfinite(timeline.table("nodes", "position")).all()
        assert timeline.stop_reason is None
        outcome = timeline.provenance[-1]["outcome"]
    assert outcome.startswith(f"failed: RunError: step {timeline.last_step + 1}: the ")


@pytest.mark.parametrize(
    ("changes", "reason"),
    [
        # the source is out of reach of all that is perceived
        ({"perception": "influence_radius = 2.0"}, StopReason.NOTHING_PULLED),
        ({}, StopReason.NO_SOURCES),
    ],
)
def test_a_source_that_is_never_reached_ends_the_run_by_name(changes, reason, tmp_path):
    tables = {
        "domain": 'shape = "ovate"\nlength = 20.0',
        "growth": 'kind = "none"',
        "placement": 'kind = "given"\npoints = [[0.0, 15.0]]',
        "arrival": "kill_distance = 1.0",
    }
    text = 'kind = "open"\n' + "".join(
        f"[{name}]\n{body}\n" for name, body in (tables | changes).items()
    )
    summary = experiments.run(load_text(text), tmp_path / "run.h5")
    assert summary.stop_reason == reason.name.lower()
    with Timeline(tmp_path / "run.h5") as timeline:
        assert timeline.stop_reason == reason.name.lower()
