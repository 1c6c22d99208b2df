"""Whatever a config says, it is taken or refused in lines; nothing else ever happens."""

import shutil
import tomllib
from pathlib import Path

import pytest
import tomli_w
from hostile.ending import assert_clear, bounded, ending, refused
from hostile.spoiling import spoilt_bytes, spoilt_tables
from hostile.tiers import every_tier, hold

from vasc.config import load, load_text
from vasc.config.schema import parameters_from, to_toml
from vasc.errors import ConfigError
from vasc.limits import CONFIG_BYTES, CONFIG_DEPTH, RUN_STEPS

ROOT = Path(__file__).resolve().parents[2]
BUNDLED = [path.read_bytes() for path in sorted((ROOT / "configs").glob("*.toml"))]
TABLES = [tomllib.loads(text.decode()) for text in BUNDLED]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Give a folder with the files that bundled configs refer to."""
    made = tmp_path_factory.mktemp("configs")
    shutil.copytree(ROOT / "configs" / "outlines", made / "outlines")
    return made


def refused_or_taken(folder, content):
    """Run a config whose output has no folder: it is refused, but late if it is sound."""
    path = folder / "leaf.toml"
    path.write_bytes(content)
    lines = refused("run", path, "-o", folder / "nowhere" / "leaf.h5")
    assert all(line.startswith(str(folder)) for line in lines)
    return lines


@every_tier
def test_any_values_are_refused_or_taken(n_cases, folder):
    def check(tables):
        refused_or_taken(folder, tomli_w.dumps(tables).encode())

    hold(check, spoilt_tables(TABLES), n_cases)


@every_tier
def test_any_bytes_are_refused_or_taken(n_cases, folder):
    hold(lambda content: refused_or_taken(folder, content), spoilt_bytes(BUNDLED), n_cases)


@every_tier
def test_what_is_taken_comes_back_from_toml(n_cases):
    def check(tables):
        try:
            parameters = parameters_from(tables)
        except ConfigError as error:
            assert_clear(error.problems)
        else:
            assert parameters_from(tomllib.loads(to_toml(parameters))) == parameters

    hold(check, spoilt_tables(TABLES), n_cases)


SOUND = tomli_w.dumps(
    {
        "kind": "closed",
        "domain": {"shape": "ovate", "length": 20.0},
        "growth": {"kind": "none"},
        "placement": {"kind": "given", "points": [[0.0, 5.0]]},
        "arrival": {"kill_distance": 1.0},
    }
)

HOSTILE = {
    "brackets": ("x = " + "[" * 100_000 + "]" * 100_000, "nested too deeply"),
    "open brackets": ("x = " + "[" * 100_000, "nested too deeply"),
    "inline tables": ("x = " + "{a=" * 100_000, "nested too deeply"),
    "dotted keys": ("a." * 50_000 + "a = 1", "nested too deeply"),
    "digits": ("seed = " + "9" * 5000, "too long"),
    "a large exponent": ("seed = 1e999\n" + SOUND, "seed"),
    "not a number": ("seed = nan\n" + SOUND, "must be a finite number"),
    "hexadecimal digits": ("seed = 0x" + "f" * 5000 + "\n" + SOUND, "at most 64 bits"),
    "NUL in a name": ('title = "a\0b"\n' + SOUND, "line 1"),
    "an escaped NUL": ('reference = 3\ntitle = "\\u0000"\n' + SOUND, "reference"),
    "escapes in a key": ('"\\u001b[2J" = 1\n' + SOUND, "unknown key"),
    "UTF-16": (SOUND.encode("utf-16"), "UTF-16"),
    "a mark within": (SOUND.replace("\n", "\n\ufeff", 1), "line 2"),
    "a file of nothing that ends": (SOUND.replace('shape = "ovate"', 'file = "/dev/zero"'), "file"),
    "a folder as a file": (SOUND.replace('shape = "ovate"', 'file = ".."'), "not a file"),
    "too many bytes": ("#" * (CONFIG_BYTES + 1), f"{CONFIG_BYTES:,} bytes"),
    "too many steps": (SOUND + f"[stop]\nsteps = {RUN_STEPS + 1}\n", "stop.steps = 1000001"),
}


@pytest.mark.parametrize("name", HOSTILE)
def test_a_hostile_config_is_refused(name, folder):
    content, said = HOSTILE[name]
    lines = refused_or_taken(folder, content if isinstance(content, bytes) else content.encode())
    assert any(said in line for line in lines), lines


def test_a_byte_order_mark_is_no_part_of_the_config(folder):
    lines = refused_or_taken(folder, b"\xef\xbb\xbf" + SOUND.encode())
    assert "does not exist" in lines[0]


@pytest.mark.parametrize(("more", "is_taken"), [(-1, True), (0, True), (1, False)])
def test_limits_of_a_config_are_exact(more, is_taken, folder):
    room = CONFIG_BYTES + more - len(SOUND)
    # the tables that hold the values are a level, too
    nested = "[" * (CONFIG_DEPTH - 2 + more) + "]" * (CONFIG_DEPTH - 2 + more)
    for text in (
        SOUND + "#" * room,
        SOUND + f"[stop]\nsteps = {RUN_STEPS + more}\n",
    ):
        lines = refused_or_taken(folder, text.encode())
        assert ("nowhere" in lines[0]) is is_taken
    (line,) = refused_or_taken(folder, (SOUND + f"[printed]\nvalues = {nested}\n").encode())
    assert ("nested too deeply" in line) is not is_taken


def test_a_name_of_a_config_steers_no_terminal(folder):
    (line,) = refused("run", folder / "a\x1b[2J.toml")
    assert "\\x1b[2J" in line


def test_a_title_steers_no_terminal(folder):
    (folder / "title.toml").write_text('title = "\\u001b[2Jmine"\n' + SOUND)
    with bounded():
        assert load(folder / "title.toml").parameters.title == "\x1b[2Jmine"
    run = folder / "title.h5"
    assert ending("run", folder / "title.toml", "-o", run, "--no-figure", "--steps", 1)[0] == 0
    code, lines, said = ending("show", run)
    assert (code, lines) == (0, [])
    assert "\\x1b[2Jmine" in said
    assert "\x1b" not in said


def test_what_is_set_outside_is_as_bounded_as_the_file():
    with pytest.raises(ConfigError, match="nested too deeply"):
        load_text(SOUND, overrides=[(("printed", "values", *"abcdefghijklmnop" * 3), 1)])
