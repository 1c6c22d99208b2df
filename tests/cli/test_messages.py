"""What the most usual faults are told, word by word, so that no message changes unseen.

``tests/data/messages.txt`` is a transcript: a command, what it says, and its exit code. Words
of other packages, which change with their versions, are not in it.
"""

import shlex
import shutil
from pathlib import Path

import h5py
import pytest

from vasc.cli import main
from vasc.timeline.redo import log_of

TRANSCRIPT = Path(__file__).parents[1] / "data" / "messages.txt"
COMMANDS = [
    line.removeprefix("$ ")
    for line in TRANSCRIPT.read_text(encoding="utf-8").splitlines()
    if line.startswith("$ ")
]


def prepare(folder, recorded):
    """Fill a folder with a run, its config, and files that are wrong in one way each."""
    for name in ("leaf.h5", "leaf.toml"):
        shutil.copy(recorded / name, folder / name)
    shutil.copy(folder / "leaf.h5", folder / "damaged.h5")
    with h5py.File(folder / "damaged.h5", "r+") as file:
        file["nodes/birth"][3] += 1
    (folder / "cut.h5").write_bytes((folder / "leaf.h5").read_bytes()[:3000])
    (folder / "notes.txt").write_text("notes\n")
    (folder / "notes.csv").write_text("notes\n")
    (folder / "folder").mkdir()
    (folder / "foreign.h5").write_bytes((folder / "leaf.h5").read_bytes())
    log_of(folder / "foreign.h5").write_text("my own notes\n")
    (folder / "sweep.toml").write_text('base = "leaf.toml"\nmeasures = ["summary.nodes"]\n')
    text = (folder / "leaf.toml").read_text()
    (folder / "key.toml").write_text(text.replace("density", "densty"))
    (folder / "value.toml").write_text(text.replace("length = 20.0", "length = -20.0"))
    (folder / "kind.toml").write_text(text.replace('"closed"', '"close"'))
    (folder / "outline.toml").write_text(text.replace('shape = "ovate"', 'file = "blade.csv"'))


def transcript(commands, capsys):
    """Run commands in the working folder; give what was said, as the file has it."""
    told = []
    for command in commands:
        code = main(shlex.split(command.removeprefix("vasc ")))
        said = capsys.readouterr()
        text = (said.out + said.err).replace(str(Path.cwd()), "FOLDER")
        told.append(f"$ {command}\n{text}exit {code}\n")
    return "\n".join(told)


def test_no_message_has_changed(recorded, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    prepare(tmp_path, recorded)
    before = {path: path.read_bytes() for path in tmp_path.iterdir() if path.is_file()}
    assert transcript(COMMANDS, capsys) == TRANSCRIPT.read_text(encoding="utf-8")
    assert {path: path.read_bytes() for path in tmp_path.iterdir() if path.is_file()} == before
    assert len(COMMANDS) >= 60


@pytest.mark.parametrize("command", COMMANDS)
def test_messages_are_short_and_of_codes_that_are_known(command):
    block = (
        TRANSCRIPT.read_text(encoding="utf-8").partition(f"$ {command}\n")[2].partition("\n\n")[0]
    )
    *lines, ended = block.splitlines()
    assert ended in ("exit 1", "exit 2", "exit 3")
    assert all(0 < len(line) < 400 for line in lines)
    assert "unexpected" not in block
    assert "Traceback" not in block
