"""Runs of very many steps: memory stays flat, and the log small."""

from functools import partial
from pathlib import Path

from faults import children
from faults.tiers import Report, tiered
from timeline.synthetic import NAMES, SEED, SyntheticRun, create

from vasc.streams import Streams
from vasc.timeline import Timeline, validate
from vasc.timeline.redo import log_of
from vasc.timeline.redo.pager import MOST_LOG_BYTES

N_LOOKS = 20
GROWTH = 32 << 20
"""Bytes that memory may grow by in the second half of a run."""


@tiered(steps=(2_000, 100_000, 1_000_000))
def test_a_long_run_keeps_its_memory_and_its_log(steps, tmp_path, report: Report):
    path = tmp_path / "run.h5"
    ending = children.run(partial(looked_at, path, steps), patience=3000.0)
    memory, logs = ending.answer
    assert len(memory) == N_LOOKS
    growth = max(memory[N_LOOKS // 2 :]) - memory[N_LOOKS // 2 - 1]
    is_small = growth < GROWTH and 0 < max(logs) <= MOST_LOG_BYTES
    with Timeline(path) as timeline:
        assert timeline.n_frames == steps + 1
    assert validate(path) == []
    report.add(
        f"{steps:,} steps",
        tried=1,
        lost=1 - is_small,
        note=f"memory grew by {growth / 1e6:.1f} MB at last; log {max(logs) / 1e6:.1f} MB",
    )
    assert is_small, (memory, logs)


def looked_at(path: Path, steps: int) -> tuple[list[int], list[int]]:
    """Record a run in which nothing grows; give bytes of memory and of the log, now and then."""
    streams, memory, logs = Streams(SEED, NAMES), [], []
    run = SyntheticRun(steps, nodes=0, perceived=0, sources=0)
    with create(path) as recorder:
        for state in run.states(streams):
            recorder.observe(state, streams)
            if state.step and state.step % (steps // N_LOOKS) == 0:
                memory.append(resident())
                logs.append(log_of(path).stat().st_size)
    return memory, logs


def resident() -> int:
    """Give the bytes of memory that this process holds."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * 4096
