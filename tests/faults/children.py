"""Work in a forked process, which may be killed, crash or hang: modules are loaded already."""

import contextlib
import json
import os
import resource
import signal
import sys
import tempfile
import time
from collections.abc import Callable
from typing import Any, NamedTuple

MEMORY = 3 << 30
"""Bytes of address space that a child gets at most, where it is limited."""


class Ending(NamedTuple):
    """How a child ended: its answer, or the signal that ended it; what it said."""

    answer: Any
    signal: int
    said: str

    @property
    def is_killed(self) -> bool:
        return self.signal == signal.SIGKILL


def run(
    call: Callable[[], Any],
    *,
    kill_after: float | None = None,
    send: int = signal.SIGKILL,
    file_bytes: int | None = None,
    memory: int | None = None,
    patience: float = 120.0,
) -> Ending:
    """Fork, call, and give the JSON value that came of it; end the child by a signal if asked."""
    sys.stdout.flush()
    sys.stderr.flush()
    with tempfile.TemporaryFile("w+") as answers, tempfile.TemporaryFile("w+") as said:
        child = os.fork()
        if not child:
            _work(call, answers.fileno(), said.fileno(), file_bytes, memory)
        if kill_after is not None:
            time.sleep(kill_after)
            with contextlib.suppress(ProcessLookupError):
                os.kill(child, send)
        status = _wait(child, patience)
        answers.seek(0)
        said.seek(0)
        raw, text = answers.read(), said.read()
    number = os.WTERMSIG(status) if os.WIFSIGNALED(status) else 0
    return Ending(json.loads(raw) if raw and not number else None, number, text)


def _work(
    call: Callable[[], Any], answers: int, said: int, file_bytes: int | None, memory: int | None
) -> None:
    """Do the work of a child; never comes back."""
    try:
        os.dup2(said, 1)
        os.dup2(said, 2)
        sys.stdout, sys.stderr = os.fdopen(1, "w", closefd=False), os.fdopen(2, "w", closefd=False)
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        if memory is not None:
            resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
        if file_bytes is not None:
            resource.setrlimit(resource.RLIMIT_FSIZE, (file_bytes, file_bytes))
        try:
            found = call()
        except BaseException as error:
            found = {"error": type(error).__name__, "text": str(error)}
        sys.stdout.flush()
        sys.stderr.flush()
        # the limit on the size of files is that of the work, not of the answer
        with os.fdopen(answers, "w") as file:
            json.dump(found, file)
    finally:
        os._exit(0)


def _wait(child: int, patience: float) -> int:
    """Wait for a child to end; kill one that hangs."""
    until = time.monotonic() + patience
    while True:
        done, status = os.waitpid(child, os.WNOHANG)
        if done:
            return status
        if time.monotonic() > until:
            os.kill(child, signal.SIGKILL)
            os.waitpid(child, 0)
            raise AssertionError(f"a child did not end within {patience} s")
        time.sleep(0.001)
