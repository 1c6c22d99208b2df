"""Worker processes of this machine; one that is killed loses its own run alone."""

import json
import os
import queue
import signal
import subprocess
import sys
import tempfile
import threading
from collections.abc import Sequence
from contextlib import suppress

from vasc.sweeps.folder import SweepFolder
from vasc.sweeps.work import Result, result_of
from vasc.sweeps.workforce import REPEATS, Workforce

SECONDS_TO_STOP = 60.0
"""Time in which a worker that is told to stop ends its step; one that does not is killed."""

ONE_THREAD = dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "NUMBA_NUM_THREADS"), "1")
"""Environment of a worker: there is one a processor, and each has work enough."""


START = """
import json, sys
sys.path[:] = json.loads(sys.argv[1])
from vasc.sweeps.worker import main
main(int(sys.argv[2]), sys.argv[3])
"""
"""How a worker begins: with the packages, vasc among them, that its parent has."""


def n_processors() -> int:
    """Give the number of processors that this process may use."""
    try:
        return len(os.sched_getaffinity(0))
    except AttributeError:
        return os.cpu_count() or 1  # a system that keeps no such account


class LocalWorkers(Workforce):
    """Worker processes of this machine, each with a thread that hands it runs.

    Parameters
    ----------
    n_workers : int
        How many.
    """

    def __init__(self, n_workers: int) -> None:
        super().__init__()
        self.n_workers = n_workers
        self._waiting: queue.SimpleQueue[int] = queue.SimpleQueue()
        self._processes: dict[threading.Thread, WorkerProcess] = {}
        self._threads: list[threading.Thread] = []
        self._busy: set[threading.Thread] = set()
        self._is_stopping = threading.Event()

    def start(self, folder: SweepFolder, numbers: Sequence[int]) -> None:
        """Start the workers, no more than there are runs."""
        for number in numbers:
            self._waiting.put(number)
        for _ in range(min(self.n_workers, len(numbers))):
            thread = threading.Thread(target=self._serve, args=(folder,), daemon=True)
            self._threads.append(thread)
            thread.start()

    def stop(self) -> None:
        """Ask all workers to stop, kill those that do not."""
        self._is_stopping.set()
        for process in list(self._processes.values()):
            process.ask_to_stop()
        for thread in self._threads:
            thread.join(SECONDS_TO_STOP)
        self.close()

    def close(self) -> None:
        """Kill the workers that are still there."""
        self._is_stopping.set()
        for process in list(self._processes.values()):
            process.kill()

    @property
    def n_running(self) -> int:
        """Runs that are being made now."""
        return len(self._busy)

    @property
    def process_ids(self) -> list[int]:
        """The ids of the worker processes."""
        return [process.id for process in list(self._processes.values())]

    def _serve(self, folder: SweepFolder) -> None:
        """Hand runs to one worker, and start another when it is lost, until none is left."""
        me = threading.current_thread()
        with suppress(queue.Empty):
            while not self._is_stopping.is_set():
                number = self._waiting.get_nowait()
                self._busy.add(me)
                result = self._made(me, folder, number)
                self._busy.discard(me)
                if result is not None:
                    self.results.put(result)
        if me in self._processes:
            self._processes.pop(me).end()

    def _made(self, me: threading.Thread, folder: SweepFolder, number: int) -> Result | None:
        """Let a run be made, once more if a worker is lost; None if all are to stop."""
        reason = ""
        for _ in range(1 + REPEATS):
            try:
                process = self._processes.get(me) or WorkerProcess(folder)
            except OSError as error:
                reason = f"no worker can be started: {error.strerror or error}"
                continue
            self._processes[me] = process
            if self._is_stopping.is_set():
                process.ask_to_stop()
            result = process.make(number)
            if result is not None:
                return result
            reason = self._processes.pop(me).end()
            if self._is_stopping.is_set():
                return None
        result = result_of(number, {}, [f"{1 + REPEATS} workers were lost; the last {reason}"])
        with suppress(OSError):
            folder.write_result(result)
        return result


class WorkerProcess:
    """One worker process, and the pipes to it.

    Parameters
    ----------
    folder : SweepFolder
        The sweep.

    Raises
    ------
    OSError
        If the system starts no more.
    """

    def __init__(self, folder: SweepFolder) -> None:
        path = str(folder.path.resolve())
        self._said = tempfile.TemporaryFile()  # noqa: SIM115
        self._process = subprocess.Popen(
            [sys.executable, "-c", START, json.dumps(sys.path), str(os.getpid()), path],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self._said,
            encoding="utf-8",
            env=ONE_THREAD | os.environ,
            # Ctrl-C on the terminal is not for workers
            start_new_session=True,
            pass_fds=folder.inherited if sys.platform != "win32" else (),
        )

    @property
    def id(self) -> int:
        """The id of the process."""
        return self._process.pid

    def make(self, number: int) -> Result | None:
        """Let a run be made; None if the worker is lost meanwhile."""
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        try:
            self._process.stdin.write(f"{number}\n")
            self._process.stdin.flush()
            line = self._process.stdout.readline()
            return json.loads(line) if line.endswith("\n") else None
        except (OSError, ValueError):
            return None

    def ask_to_stop(self) -> None:
        """Ask for the run to end after its step."""
        self._process.terminate()

    def kill(self) -> None:
        """Kill the process."""
        self._process.kill()

    def end(self) -> str:
        """Let the process end, and say how it did."""
        for pipe in (self._process.stdin, self._process.stdout):
            with suppress(OSError):
                if pipe is not None:
                    pipe.close()
        try:
            code = self._process.wait(SECONDS_TO_STOP)
        except subprocess.TimeoutExpired:
            self._process.kill()
            code = self._process.wait()
        self._said.seek(0)
        said = self._said.read().decode("utf-8", "replace").split("\n")
        self._said.close()
        if code < 0:
            return f"was ended by {signal.Signals(-code).name}"
        last = next((line.strip() for line in reversed(said) if line.strip()), "")
        return f"ended with exit code {code}" + (f": {last}" if last else "")
