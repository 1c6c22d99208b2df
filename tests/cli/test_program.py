"""The program as a process: exit codes, what it loads, and how it fails."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

import vasc
from vasc.cli import configs, main
from vasc.cli.program import VERBS
from vasc.errors import RunError, TimelineError
from vasc.events import EventKind, StopReason

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = [sys.executable, "-m", "vasc"]
NAMES = [verb.__name__.rpartition(".")[2] for verb in VERBS]


def started(*arguments, **options):
    """Run the program as a process."""
    return subprocess.run(
        [*PROGRAM, *arguments],
        env=os.environ | {"PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=False,
        **options,
    )


def test_there_is_a_verb_for_everything():
    assert set(NAMES) == {
        *("configs", "run", "resume", "show", "events", "lineage", "stats", "compare"),
        *("render", "animate", "export", "verify", "schema", "sweep", "validate"),
    }


@pytest.mark.parametrize("verb", NAMES)
def test_the_help_of_a_verb_shows_an_example_that_is_one(verb, capsys):
    assert main([verb, "--help"]) == 0
    text = capsys.readouterr().out
    _, _, shown = text.partition("  Example")
    lines = [line.strip() for line in shown.splitlines()[1:] if line.strip()]
    assert lines
    for line in lines:
        assert line.startswith(f"vasc {verb}")
        options = [word for word in line.split() if word.startswith("-")]
        assert [option for option in options if f"{option} " not in text] == []


def test_the_program_alone_shows_its_verbs(capsys):
    assert main([]) == 0
    text = capsys.readouterr().out
    assert [verb for verb in NAMES if f"\n  {verb} " not in text] == []
    assert "Example:\n  vasc run poplar-leaf" in text


def test_a_group_alone_shows_its_verbs(capsys):
    assert main(["check"]) == 0
    said = capsys.readouterr()
    assert said.err == ""
    assert "\n  sequence " in said.out
    assert "\n  vasc check strand canals.h5\n" in said.out


def test_the_help_of_events_tells_what_each_kind_is_about(capsys):
    assert main(["events", "--help"]) == 0
    text = capsys.readouterr().out.partition("by kind")[2].partition("Arguments:")[0]
    words = set(text.replace(",", " ").split())
    assert {kind.name.lower() for kind in EventKind} <= words
    for reason in StopReason:
        assert f"{reason.value} {reason.name.lower()}" in text


def test_the_version_is_the_package_s(capsys):
    assert main(["--version"]) == 0
    assert capsys.readouterr().out == f"vasc {vasc.__version__}\n"


@pytest.mark.parametrize(
    ("arguments", "part"),
    [
        (["rum"], "No such command 'rum'"),
        (["run"], "CONFIG"),
        (["run", "a", "b"], "b"),
        (["run", "a", "--sed", "1"], "--sed"),
        (["show"], "RUN.h5"),
        (["lineage", "a.h5", "--node", "x"], "--node"),
        (["stats", "a.h5", "--step", "-2"], "--step"),
        (["render", "a.h5"], "-o"),
    ],
)
def test_a_wrong_command_line_is_told_in_one_line(arguments, part, capsys):
    assert main(arguments) == 2
    said = capsys.readouterr()
    (line,) = said.err.splitlines()
    assert part in line
    assert "--help` shows an example" in line
    assert said.out == ""


@pytest.mark.parametrize("verb", ["render", "animate"])
def test_the_help_names_every_colour(verb, capsys):
    from vasc.render import COLOR_CHOICES

    main([verb, "--help"])
    assert f"One of {', '.join(COLOR_CHOICES)}." in " ".join(capsys.readouterr().out.split())


def test_a_misspelt_verb_is_told_with_the_nearest(capsys):
    main(["rum"])
    assert "'run'" in capsys.readouterr().err


@pytest.mark.parametrize("arguments", [["--help"], ["configs"], ["schema"], ["schema", "open"]])
def test_light_verbs_load_nothing_heavy(arguments):
    assert heavy_modules(arguments) == []


def heavy_modules(arguments, folder=ROOT):
    """Give the heavy packages that a verb loads."""
    program = (
        "import sys; from vasc.cli import main; code = main(sys.argv[1:]);"
        "heavy = {'scipy', 'numba', 'matplotlib', 'shapely', 'pandas', 'networkx', 'PIL'};"
        "print('loaded', *sorted(heavy & {name.partition('.')[0] for name in sys.modules}));"
        "sys.exit(code)"
    )
    ended = subprocess.run(
        [sys.executable, "-c", program, *arguments],
        cwd=folder,
        env=os.environ | {"PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=True,
    )
    return ended.stdout.splitlines()[-1].split()[1:]


def test_bad_input_ends_with_2_and_without_a_traceback(tmp_path):
    ended = started("run", "none.toml", cwd=tmp_path)
    assert ended.returncode == 2
    assert ended.stdout == ""
    assert ended.stderr.count("\n") == 1
    assert "none.toml" in ended.stderr


def fail_with(error, monkeypatch):
    """Let listing the configs fail."""

    def fail():
        raise error

    monkeypatch.setattr("vasc.config.bundled.bundled_configs", fail)


@pytest.mark.parametrize(
    ("error", "code", "part"),
    [
        (ZeroDivisionError("two\nlines"), 3, "unexpected ZeroDivisionError: two lines"),
        (KeyError("a"), 3, "unexpected KeyError: 'a'"),
        (RecursionError(), 3, "unexpected RecursionError: no message"),
        (MemoryError(), 3, "not enough memory"),
        (OSError(28, "No space left on device", "a.h5"), 3, "a.h5: No space left on device"),
        (RunError("it broke"), 3, "it broke"),
        (TimelineError("a.h5: is\ndamaged"), 2, "a.h5: is damaged"),
        (KeyboardInterrupt(), 130, "interrupted"),
    ],
    ids=lambda value: type(value).__name__ if isinstance(value, BaseException) else None,
)
def test_no_error_leaves_as_a_traceback(error, code, part, monkeypatch, capsys):
    fail_with(error, monkeypatch)
    assert main(["configs"]) == code
    said = capsys.readouterr().err
    assert said.strip().count("\n") == 0
    assert part in said
    assert "Traceback" not in said


@pytest.mark.parametrize("arguments", [["--debug", "configs"], ["configs", "--debug"]])
def test_debug_shows_where_an_error_came_from(arguments, monkeypatch, capsys):
    fail_with(ZeroDivisionError("why"), monkeypatch)
    assert main(arguments) == 3
    said = capsys.readouterr().err
    assert "Traceback" in said
    assert "in fail" in said
    assert "unexpected ZeroDivisionError: why" in said


def test_a_warning_is_one_line(monkeypatch, capsys):
    def warn():
        import warnings

        warnings.warn("mind\nthis", UserWarning, stacklevel=1)
        return []

    monkeypatch.setattr("vasc.config.bundled.bundled_configs", warn)
    with pytest.MonkeyPatch.context() as context:
        context.setattr("warnings.filters", [])
        assert main(["configs"]) == 0
    assert capsys.readouterr().err == "warning: mind this\n"


def test_a_reader_that_has_seen_enough_is_no_error():
    program = subprocess.Popen(
        [*PROGRAM, "schema"],
        env=os.environ | {"PYTHONPATH": str(ROOT)},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    program.stdout.close()
    assert program.stderr.read() == ""
    program.stderr.close()
    assert program.wait() == 0


def test_an_output_of_few_characters_shows_what_it_can(tmp_path):
    environment = os.environ | {"PYTHONPATH": str(ROOT), "PYTHONIOENCODING": "ascii"}
    ended = subprocess.run(
        [*PROGRAM, "run", "blätter"],
        cwd=tmp_path,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert ended.returncode == 2
    assert "bl\\xe4tter" in ended.stderr


def test_configs_are_listed_a_line_each(capsys):
    assert main(["configs"]) == 0
    text, _, sweeps = capsys.readouterr().out.partition("\nsweeps, for `vasc sweep`\n")
    from vasc.config import bundled_configs
    from vasc.config.bundled import bundled_sweeps

    assert [line.split()[0] for line in sweeps.splitlines()] == [
        one.name for one in bundled_sweeps()
    ]
    lines, known = text.splitlines(), bundled_configs()
    assert [line.split()[0] for line in lines] == [one.name for one in known]
    for line, one in zip(lines, known, strict=True):
        assert line.endswith(one.title)


def test_a_copied_config_is_the_bundled_one(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["configs", "--copy", "poplar-leaf"]) == 0
    assert "poplar-leaf.toml" in capsys.readouterr().out
    copied = (tmp_path / "poplar-leaf.toml").read_bytes()
    assert copied == (ROOT / "configs" / "poplar-leaf.toml").read_bytes()
    assert main(["configs", "--copy", "poplar-leaf"]) == 2
    assert "exists" in capsys.readouterr().err
    assert configs.EXAMPLES


def test_a_copy_into_a_folder_that_takes_none_is_refused(tmp_path, monkeypatch, capsys):
    def refuse(*arguments, **options):
        raise PermissionError(13, "Permission denied")

    # whoever may write everywhere, as in containers, is not stopped by the folder itself
    monkeypatch.setattr("vasc.config.bundled.write_whole", refuse)
    assert main(["configs", "--copy", "poplar-leaf", "--to", str(tmp_path)]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line == (
        f"{tmp_path / 'poplar-leaf.toml'}: cannot be written: Permission denied;"
        " --to names another folder"
    )
