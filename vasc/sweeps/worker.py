"""A worker process: takes numbers of runs from its input, gives results to its output.

It is started by :mod:`vasc.sweeps.local`, ends when its input ends, and stops its run
when its parent is gone.
"""

import json
import os
import signal
import sys
from types import FrameType

from vasc.sweeps.work import STOPPED, perform


def main(parent: int, folder: str) -> None:
    """Perform the runs whose numbers come in, a line each, until no more come."""
    wishes: list[int] = []

    def note(number: int, frame: FrameType | None) -> None:
        wishes.append(number)

    def should_stop() -> bool:
        # a parent that was killed says nothing more, and its number is no longer ours
        return bool(wishes) or os.getppid() != parent

    signal.signal(signal.SIGTERM, note)
    # Ctrl-C is for the parent, which then tells its workers
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    # whatever a model prints must not mix with results
    results = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)
    while line := sys.stdin.readline():
        number = int(line)
        result = (
            {"number": number, "status": STOPPED}
            if should_stop()
            else perform(folder, number, should_stop)
        )
        try:
            results.write(json.dumps(result) + "\n")
            results.flush()
        except BrokenPipeError:
            os._exit(0)  # nobody is there to read it; the file of the result is
