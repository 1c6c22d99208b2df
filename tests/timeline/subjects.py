"""Runs that the crash and live-reading tests start, kill and resume in child processes."""

import mmap
import os
import struct
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[2]

SYNTHETIC = """
import mmap, signal, struct, sys
from pathlib import Path
from timeline import synthetic
from vasc.timeline import writer

path, watched, verb = Path(sys.argv[1]), sys.argv[2], sys.argv[3]
writer.BATCH_FRAMES = {batch}
# Python drops a KeyboardInterrupt that comes up inside a weak reference's callback, as
# h5py has many: the signal is noted, as the program does, and raised between two steps.
signals = []
signal.signal(signal.SIGINT, lambda number, frame: signals.append(number))
with open(watched, "r+b") as file:
    shared = mmap.mmap(file.fileno(), 8)
    def watch(step):
        struct.pack_into("q", shared, 0, step)
        if signals:
            raise KeyboardInterrupt
    getattr(synthetic, verb)(path, {last_step}, watch=watch, kind=synthetic.{kind})
"""


CANALS = """
import mmap, signal, struct, sys
from pathlib import Path
from timeline import canals
from vasc.timeline import writer

path, watched, verb = Path(sys.argv[1]), sys.argv[2], sys.argv[3]
writer.BATCH_FRAMES = {batch}
signals = []
signal.signal(signal.SIGINT, lambda number, frame: signals.append(number))
with open(watched, "r+b") as file:
    shared = mmap.mmap(file.fileno(), 8)
    def watch(step):
        struct.pack_into("q", shared, 0, step)
    getattr(canals, verb)(path, "{kind}", watch=watch, should_stop=lambda: bool(signals))
"""


@dataclass(frozen=True)
class Subject:
    """A run in a child process.

    ``code`` gets the timeline's path, the path of an 8-byte file that tells the last step
    observed, and the verb ``record`` or ``resume``. ``batch`` is the most frames that a
    kill may lose, ``seconds`` about how long the run takes.
    """

    name: str
    code: str
    batch: int
    seconds: float

    def start(self, path: Path, verb: str) -> subprocess.Popen:
        """Start the run, or its continuation."""
        self.watched(path).write_bytes(struct.pack("q", -1))
        paths = [str(ROOT), str(ROOT / "tests"), os.environ.get("PYTHONPATH", "")]
        return subprocess.Popen(
            [sys.executable, "-c", self.code, str(path), str(self.watched(path)), verb],
            env={**os.environ, "PYTHONPATH": os.pathsep.join(paths)},
            stderr=subprocess.PIPE,
        )

    def finish(self, path: Path, verb: str) -> None:
        """Run to the end."""
        child = self.start(path, verb)
        _, errors = child.communicate()
        assert child.returncode == 0, errors.decode()

    def watched(self, path: Path) -> Path:
        """Give the file that tells the last step observed."""
        return path.with_suffix(".step")

    def last_observed(self, path: Path) -> int:
        """Give the last step that a child has observed, -1 if none."""
        with self.watched(path).open("r+b") as file, mmap.mmap(file.fileno(), 8) as shared:
            return struct.unpack_from("q", shared, 0)[0]


SUBJECTS = [
    Subject(
        "batches",
        SYNTHETIC.format(batch=64, last_step=2500, kind="SyntheticRun"),
        batch=64,
        seconds=0.6,
    ),
    Subject(
        "every-step",
        SYNTHETIC.format(batch=1, last_step=600, kind="SyntheticRun"),
        batch=1,
        seconds=0.6,
    ),
    Subject(
        "explicit",
        SYNTHETIC.format(batch=16, last_step=400, kind="ExplicitRun"),
        batch=16,
        seconds=0.6,
    ),
    Subject(
        "tissue",
        SYNTHETIC.format(batch=16, last_step=1600, kind="TissueRun"),
        batch=16,
        seconds=0.6,
    ),
    Subject(
        "stem",
        SYNTHETIC.format(batch=16, last_step=2400, kind="StemRun"),
        batch=16,
        seconds=0.6,
    ),
    Subject(
        "canals",
        CANALS.format(batch=16, kind="polar"),
        batch=16,
        seconds=0.6,
    ),
]
"""Runs that compute nothing, and one of a real model."""
