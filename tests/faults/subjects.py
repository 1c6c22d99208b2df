"""Real runs, small enough to be made a thousand times."""

import mmap
import struct
from collections.abc import Callable
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from unittest.mock import patch

from timeline.canals import CONFIG as CANALS
from timeline.synthetic import contents

from vasc import experiment
from vasc.config import load_text
from vasc.timeline import Recorder, Timeline, writer
from vasc.timeline.redo import log, pager

LEAF = """
kind = "closed"
seed = 3
[domain]
shape = "deltoid"
length = 100.0
[growth]
kind = "isogonic"
final_length = 260.0
length_per_step = 4.0
[placement]
kind = "darts"
density = 400e-6
birth_distance_sources = 20.0
birth_distance_veins = 20.0
[arrival]
kill_distance = 1.0
[record]
durability = "batch"
"""


class Acknowledged:
    """The frames that a recorder has committed, shared with the process that kills it."""

    def __init__(self) -> None:
        self._shared = mmap.mmap(-1, 8)

    def set(self, n_frames: int) -> None:
        struct.pack_into("q", self._shared, 0, n_frames)

    def get(self) -> int:
        return struct.unpack_from("q", self._shared, 0)[0]


@dataclass
class Subject:
    """A run: its config, and what an undisturbed one holds."""

    name: str
    toml: str
    whole: dict[str, bytes] = field(default_factory=dict, repr=False)
    n_frames: int = 0
    folder: Path = Path()

    def with_(self, durability: str) -> "Subject":
        """Give the same run with another durability."""
        toml = self.toml.replace('durability = "batch"', f'durability = "{durability}"')
        return Subject(f"{self.name}, {durability}", toml, self.whole, self.n_frames)

    def record(
        self,
        path: Path,
        acknowledged: Callable[[int], None] = lambda n_frames: None,
        steps: int | None = None,
    ) -> None:
        """Run it, and tell after every step what is committed."""
        with telling(acknowledged):
            experiment.run(load_text(self.toml, name="run"), path, large=True, steps=steps)

    def resume(
        self, path: Path, acknowledged: Callable[[int], None] = lambda n_frames: None
    ) -> None:
        """Finish it; begin again if there is no file yet."""
        if not path.exists():
            self.record(path, acknowledged)
            return
        with telling(acknowledged):
            experiment.resume(path)

    def measure(self, folder: Path) -> None:
        """Make the undisturbed run."""
        path = folder / f"{self.name}.h5"
        self.record(path)
        self.whole = contents(path)
        with Timeline(path) as timeline:
            self.n_frames = timeline.n_frames
            assert timeline.is_complete

    def check(self, path: Path, at_least: int) -> int:
        """Make sure that a file reads, holds so many frames, and the right ones."""
        if not path.exists():
            assert at_least == 0, f"{at_least} frames are gone with the file"
            return 0
        with Timeline(path) as timeline:
            n_frames = timeline.n_frames
        assert n_frames >= at_least, f"{n_frames} frames of {at_least}"
        if n_frames:
            self.compare(contents(path))
        return n_frames

    def compare(self, found: dict[str, bytes], *, is_whole: bool = False) -> None:
        """Make sure that what was found is the beginning of the undisturbed run."""
        assert found.keys() == self.whole.keys()
        for name, rows in found.items():
            assert self.whole[name].startswith(rows), name
            assert not is_whole or len(rows) == len(self.whole[name]), name

    def finish(self, path: Path) -> None:
        """Go on to the end, and make sure it is that of the undisturbed run."""
        self.resume(path)
        self.compare(contents(path), is_whole=True)
        assert not path.with_name(path.name + "-wal").exists()


@contextmanager
def telling(acknowledged: Callable[[int], None]):
    """Tell how many frames are committed whenever that changes."""
    real = Recorder._commit

    def commit(self):
        real(self)
        acknowledged(self.n_frames)

    with patch.object(Recorder, "_commit", commit):
        yield


@contextmanager
def small_batches(frames: int = 4, commits: int = 4):
    """Let few frames be a commit, few commits be applied together, and logs stay short."""
    with (
        patch.object(writer, "BATCH_FRAMES", frames),
        patch.object(pager, "BATCH_COMMITS", commits),
        patch.object(log, "KEPT_BYTES", 400_000),
    ):
        yield


def subjects() -> list[Subject]:
    """Give a leaf, and canals in a tissue, whose columns are compressed."""
    canals = CANALS.format(kind="polar", background=0.1) + '[record]\ndurability = "batch"\n'
    return [Subject("leaf", LEAF), Subject("canals", canals)]
