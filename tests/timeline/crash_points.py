"""Every file that a run killed at a write call may leave, rebuilt from one traced run.

``strace`` notes each call that changes the file; the file after the first n calls is the
one that a process killed after call n leaves behind.
"""

import os
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[2]

RUN = """
import sys
from pathlib import Path
from timeline import canals, synthetic
from vasc.timeline import writer

writer.BATCH_FRAMES = {batch}
{call}
"""

SYNTHETIC = "synthetic.{verb}(Path(sys.argv[1]), {last_step}, kind=synthetic.{kind})"
"""What is run but for real models."""

CALL = re.compile(r"^\d+ +(pwrite64|ftruncate|link|rename)\((?:\d+<([^>]*)>, )?(.*)\) += (\d+)$")
WRITE = re.compile(r'^"((?:\\x..)*)", (\d+), (\d+)$')


class Change(NamedTuple):
    """One call: bytes written at an offset, or a new length where there are none."""

    offset: int
    content: bytes | None


def trace(
    path: Path, verb: str, kind: str, *, batch: int, last_step: int
) -> tuple[list[Change], int]:
    """Trace a run that computes nothing, to its end: see :func:`trace_call`."""
    return trace_call(
        path, SYNTHETIC.format(verb=verb, last_step=last_step, kind=kind), batch=batch
    )


def trace_call(path: Path, call: str, *, batch: int) -> tuple[list[Change], int]:
    """Run to the end; give what changed the file, and the calls made before it had its name."""
    log = path.with_suffix(".trace")
    code = RUN.format(batch=batch, call=call)
    calls = "trace=pwrite64,ftruncate,link,rename"
    watch = ["strace", "-f", "-y", "-xx", "-s", "20000000", "-o", str(log), "-e", calls]
    paths = os.pathsep.join([str(ROOT), str(ROOT / "tests"), os.environ.get("PYTHONPATH", "")])
    subprocess.run(
        [*watch, sys.executable, "-c", code, str(path.resolve())],
        env={**os.environ, "PYTHONPATH": paths},
        check=True,
    )
    return _changes(log, path.name)


def _changes(log: Path, name: str) -> tuple[list[Change], int]:
    """Read the trace of a run that wrote a file, at first under a hidden name."""
    changes: list[Change] = []
    n_hidden = 0
    with log.open() as lines:
        for line in lines:
            call = CALL.match(line)
            if call is None:
                continue
            verb, raw, rest, done = call.groups()
            if verb in ("link", "rename"):
                n_hidden = len(changes)
            elif name in _text(raw).decode():
                changes.append(_change(verb, rest, int(done)))
    return changes, n_hidden


def _change(verb: str, rest: str, done: int) -> Change:
    """Read what one call changed."""
    if verb == "ftruncate":
        return Change(int(rest), None)
    raw, asked, offset = WRITE.match(rest).groups()
    content = _text(raw)
    assert len(content) == int(asked) == done
    return Change(int(offset), content)


def _text(raw: str) -> bytes:
    """Give the bytes that strace wrote as hexadecimal numbers, or as they are."""
    return bytes.fromhex(raw.replace("\\x", "")) if raw.startswith("\\x") else raw.encode()


def states(changes: list[Change], before: bytes = b"") -> Iterator[bytes]:
    """Give the file as it was at first and after every change."""
    file = bytearray(before)
    yield bytes(file)
    for offset, content in changes:
        end = offset if content is None else offset + len(content)
        if end > len(file):
            file.extend(bytes(end - len(file)))
        if content is None:
            del file[offset:]
        else:
            file[offset:end] = content
        yield bytes(file)
