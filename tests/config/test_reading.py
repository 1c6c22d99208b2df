"""Files that are no configs, and places of mistakes."""

import pytest

from vasc.config import load
from vasc.config.reading import parse, read_text
from vasc.errors import ConfigError
from vasc.limits import CONFIG_BYTES


def refused(path):
    """Give the one line with which a file is refused."""
    with pytest.raises(ConfigError) as caught:
        read_text(path)
    (line,) = caught.value.problems
    return line


def test_a_byte_order_mark_is_no_part_of_the_text(tmp_path):
    path = tmp_path / "a.toml"
    path.write_bytes(b'\xef\xbb\xbfkind = "closed"\n')
    assert parse(read_text(path), "a") == {"kind": "closed"}


def test_line_ends_of_windows_are_read(tmp_path):
    path = tmp_path / "a.toml"
    path.write_bytes(b'kind = "closed"\r\nseed = 2\r\n')
    assert parse(read_text(path), "a") == {"kind": "closed", "seed": 2}


@pytest.mark.parametrize(
    ("content", "parts"),
    [
        ("kind = 'é'".encode("latin-1"), ["line 1, column 9", "0xe9", "UTF-8"]),
        (b"a = 1\nb = '\xff'\n", ["line 2, column 6", "0xff", "UTF-8"]),
        ('kind = "closed"'.encode("utf-16"), ["UTF-16", "UTF-8"]),
        (b"\x89HDF\r\n\x1a\n" + b"\0" * 100, ["is a timeline", "vasc resume"]),
        (b"#" * (CONFIG_BYTES + 1), ["larger than 1,000,000 bytes"]),
    ],
    ids=["latin-1", "broken", "utf-16", "timeline", "large"],
)
def test_a_file_that_is_no_text_is_refused(tmp_path, content, parts):
    path = tmp_path / "a.toml"
    path.write_bytes(content)
    line = refused(path)
    assert line.startswith(f"{path}: ")
    assert [part for part in parts if part not in line] == []


def test_a_config_of_the_largest_size_is_read(tmp_path):
    path = tmp_path / "a.toml"
    path.write_bytes(b"#" * CONFIG_BYTES)
    assert len(read_text(path)) == CONFIG_BYTES


def test_a_folder_is_refused(tmp_path):
    assert "is a folder" in refused(tmp_path)


def test_a_file_that_is_not_there_is_refused(tmp_path):
    with pytest.raises(ConfigError, match="no such file and no bundled experiment"):
        load(tmp_path / "none.toml")


@pytest.mark.parametrize("name", ["a\0b", "x" * 5000])
def test_an_impossible_name_is_refused(name):
    with pytest.raises(ConfigError) as caught:
        load(name)
    (line,) = caught.value.problems
    assert line.isprintable()


@pytest.mark.parametrize(
    ("text", "place"),
    [
        ("a = 1\nb = = 2\n", "line 2, column 5"),
        ("a = 1\n\n[b\n", "line 3, column 3"),
        ("a = [1,\n2,", "line 2, column 3"),
        ('a = """x\ny', "line 2, column 2"),
        ("a = ", "line 1, column 5"),
    ],
)
def test_a_mistake_in_toml_has_a_line_and_a_column(text, place):
    with pytest.raises(ConfigError) as caught:
        parse(text, "leaf")
    (line,) = caught.value.problems
    assert line.startswith(f"leaf: {place}: not TOML: ")
    assert "(at " not in line
