import importlib.metadata
from datetime import datetime

import jsonschema
import pytest
from timeline.synthetic import CONFIG, SEED, record, resume

import vasc
from vasc.timeline import Timeline, provenance


@pytest.fixture(scope="module")
def sessions(tmp_path_factory):
    path = tmp_path_factory.mktemp("provenance") / "run.h5"
    record(path, 30, stop_after=10)
    resume(path, 30)
    with Timeline(path) as timeline:
        return timeline.provenance


def test_sessions_obey_the_schema(sessions):
    schema = provenance.schema()
    jsonschema.Draft202012Validator.check_schema(schema)
    for session in sessions:
        jsonschema.validate(session, schema)


def test_the_schema_refuses_a_session_without_software(sessions):
    broken = {name: value for name, value in sessions[0].items() if name != "software"}
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate(broken, provenance.schema())


def test_one_session_a_run_and_a_resume(sessions):
    assert [s["session"] for s in sessions] == [0, 1]
    assert [s["kind"] for s in sessions] == ["run", "resume"]
    assert [s["outcome"] for s in sessions] == ["stopped", "complete"]
    assert [s["last_step"] for s in sessions] == [10, 30]
    assert sessions[0]["parameters"] == CONFIG
    assert all(s["seed"] == SEED for s in sessions)


def test_versions_and_times_are_those_of_now(sessions):
    software = sessions[0]["software"]
    assert software["vasc"] == vasc.__version__
    for name in ("numpy", "h5py", "numba"):
        assert software[name] == importlib.metadata.version(name)
    for session in sessions:
        started, ended = (datetime.fromisoformat(session[k]) for k in ("started", "ended"))
        assert started <= ended
        assert 0.0 < session["wall_seconds"]["record"] <= session["wall_seconds"]["total"]


def test_a_torn_record_is_left_out():
    whole = '{"session": 0, "kind": "run"}'
    assert provenance.sessions([whole, '{"session": 0, "en', "", "[1]", "{}"]) == [
        {"session": 0, "kind": "run"}
    ]
