"""Files that a config refers to travel with the run."""

import pytest

from vasc.config import experiment_from_record, load_text
from vasc.config.attachments import missing_files, packed, referenced_files, unpacked
from vasc.errors import ConfigError, TimelineError
from vasc.limits import FILE_BYTES

CONFIG = """kind = "closed"
[domain]
file = "a/points.csv"
length = 20.0
[placement]
kind = "given"
file = "b/points.csv"
[arrival]
kill_distance = 1.0
"""
OUTLINE = b"x,y\n-5,0\n5,0\n0,20\n"
SOURCES = b"x,y\n0,5\n"


@pytest.fixture
def folder(tmp_path):
    """Give a folder with two files of one name."""
    for name, content in (("a", OUTLINE), ("b", SOURCES)):
        (tmp_path / name).mkdir()
        (tmp_path / name / "points.csv").write_bytes(content)
    return tmp_path


def test_files_are_found_in_every_table():
    tables = {"domain": {"file": "a"}, "x": {"y": {"file": "b"}, "file": 3}, "title": "file"}
    assert referenced_files(tables) == {("domain", "file"): "a", ("x", "y", "file"): "b"}


def test_files_are_found_in_lists_of_tables():
    tables = {"growth": {"outlines": [{"t": 0.0, "file": "a"}, {"file": "b"}], "g": [1.0, 2.0]}}
    found = referenced_files(tables)
    assert found == {
        ("growth", "outlines", 0, "file"): "a",
        ("growth", "outlines", 1, "file"): "b",
    }


def test_packed_files_of_lists_are_renamed(tmp_path):
    (tmp_path / "a.csv").write_bytes(OUTLINE)
    tables = {"growth": {"outlines": [{"file": "a.csv"}], "points": [[0.0, 1.0]]}}
    with unpacked(tables, packed(tables, tmp_path)) as (renamed, folder):
        (outline,) = renamed["growth"]["outlines"]
        assert (folder / outline["file"]).read_bytes() == OUTLINE
        assert renamed["growth"]["points"] == [[0.0, 1.0]]


def test_a_recorded_run_has_its_files_when_the_folder_is_gone(folder):
    experiment = load_text(CONFIG, folder=folder)
    record = experiment.record
    (folder / "a" / "points.csv").unlink()
    (folder / "b" / "points.csv").unlink()
    with experiment_from_record(record, name="run.h5") as again:
        given = again.parameters
        assert (again.folder / given.domain.file).read_bytes() == OUTLINE
        assert (again.folder / given.placement.file).read_bytes() == SOURCES
        assert given.domain.file.endswith(".csv")
        unpacked_to = again.folder
    assert not unpacked_to.exists()


def test_a_record_without_files_is_the_config_alone():
    text = CONFIG.replace('file = "a/points.csv"', 'shape = "fan"')
    text = text.replace('file = "b/points.csv"', "points = [[0.0, 5.0]]")
    experiment = load_text(text)
    assert experiment.record == experiment.tables
    with experiment_from_record(experiment.record, name="run.h5") as again:
        assert again.parameters == experiment.parameters


def test_a_recorded_name_leads_nowhere_else(tmp_path):
    tables = {"domain": {"file": "../../outside.csv"}}
    with unpacked(tables, {"../../outside.csv": "eA=="}) as (renamed, folder):
        path = folder / renamed["domain"]["file"]
        assert path.parent == folder
        assert path.read_bytes() == b"x"


@pytest.mark.parametrize("content", ["no base64!", 3, None])
def test_damaged_files_are_told(content):
    with pytest.raises(TimelineError, match="damaged"), unpacked({}, {"a.csv": content}):
        raise AssertionError("unpacked what is damaged")


@pytest.mark.parametrize("files", ["x", ["x"], 3])
def test_damaged_records_are_told(files):
    with (
        pytest.raises(TimelineError, match=r"run\.h5.*damaged"),
        experiment_from_record({"kind": "closed", "files": files}, name="run.h5"),
    ):
        raise AssertionError("read what is damaged")


def test_a_record_of_another_version_is_told_as_a_config_is():
    with (
        pytest.raises(ConfigError, match=r'run\.h5: config: kind = "crown"'),
        experiment_from_record({"kind": "crown"}, name="run.h5"),
    ):
        raise AssertionError("read what is unknown")


@pytest.mark.parametrize(
    ("record", "key"),
    [
        ({"kind": "unheard-open"}, 'kind = "unheard-open"'),
        ({"kind": "open", "growth": {"kind": "spiral"}}, 'growth.kind = "spiral"'),
    ],
)
def test_a_record_of_a_package_that_is_not_installed_asks_for_it(record, key):
    with (
        pytest.raises(ConfigError, match="install the package that offers it") as refused,
        experiment_from_record(record, name="run.h5"),
    ):
        raise AssertionError("read what is unknown")
    assert f"run.h5: config: {key}: is not known here" in str(refused.value)
    assert len(refused.value.problems) == 1


def test_a_large_file_is_refused(folder):
    with (folder / "a" / "points.csv").open("wb") as file:
        file.truncate(FILE_BYTES + 1)
    (line,) = missing_files({"domain": {"file": "a/points.csv"}}, folder)
    assert line == 'domain.file = "a/points.csv": is larger than 20,000,000 bytes'


def test_a_file_that_goes_away_in_between_is_told(folder):
    with pytest.raises(ConfigError, match=r"none\.csv.*cannot be read"):
        packed({"domain": {"file": "none.csv"}}, folder)
