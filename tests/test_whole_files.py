"""Files that are there as a whole or not at all."""

from pathlib import Path

import pytest
from matplotlib.figure import Figure

from vasc.errors import OutputError
from vasc.render import save
from vasc.whole_files import write_whole


@pytest.fixture
def full_disk(monkeypatch):
    """Let the disk be full."""

    def fail(*arguments):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.fsync", fail)


@pytest.mark.parametrize("content", ["lines\nof text, é\n", b"\x00\r\n\xff"])
def test_a_file_holds_what_was_written(tmp_path, content):
    path = tmp_path / "a.txt"
    path.write_text("something older and longer than what follows")
    write_whole(path, content)
    assert path.read_bytes() == (content.encode() if isinstance(content, str) else content)
    assert [one.name for one in tmp_path.iterdir()] == ["a.txt"]


def test_a_file_that_cannot_be_written_is_as_it_was(tmp_path, full_disk):
    path = tmp_path / "a.json"
    path.write_text("old")
    with pytest.raises(OSError, match="No space"):
        write_whole(path, "new")
    assert path.read_text() == "old"
    assert [one.name for one in tmp_path.iterdir()] == ["a.json"]


@pytest.mark.parametrize("there", [True, False])
def test_a_picture_that_cannot_be_written_leaves_no_half(tmp_path, full_disk, there):
    path = tmp_path / "a.png"
    if there:
        path.write_text("old")
    with pytest.raises(OutputError, match=r"a\.png: cannot be written: No space left on device"):
        save(Figure(), path)
    assert [Path(one).read_text() for one in tmp_path.iterdir()] == ["old"] * there
