"""Short canalization runs with several rounds of sources, for tests in this and child processes."""

from collections.abc import Callable
from pathlib import Path

from vasc import experiment
from vasc.config import load_text
from vasc.config.loading import Experiment
from vasc.experiment import never
from vasc.state import State
from vasc.streams import Streams

KINDS = ("facilitated", "polar", "pool")

CONFIG = """
kind = "canalization"
seed = 4
background = {background}
[domain]
kind = "rectangular"
columns = 15
rows = 11
[veins]
lines = [[[2, 10]], [[12, 10], [14, 10]]]
[placement]
points = [[5, 2], [9, 3], [1, 3], [13, 4]]
rounds = [1, 2, 2, 3]
[settling]
noise = 0.1
[transport]
kind = "{kind}"
"""


class Watch:
    """An observer that tells somebody the step."""

    def __init__(self, watch: Callable[[int], object]) -> None:
        self.watch = watch

    def observe(self, state: State, streams: Streams) -> None:
        self.watch(state.step)


def config(kind: str, background: float = 0.1) -> Experiment:
    return load_text(CONFIG.format(kind=kind, background=background), name="canals")


def record(
    path: Path,
    kind: str,
    *,
    watch: Callable[[int], object] = lambda step: None,
    steps: int | None = None,
    should_stop: Callable[[], bool] = never,
) -> experiment.Summary:
    """Record a run, or its first steps."""
    observers = [Watch(watch)]
    return experiment.run(
        config(kind), path, steps=steps, observers=observers, should_stop=should_stop
    )


def resume(
    path: Path,
    kind: str,
    *,
    watch: Callable[[int], object] = lambda step: None,
    should_stop: Callable[[], bool] = never,
) -> experiment.Summary:
    """Finish a run."""
    return experiment.resume(path, observers=[Watch(watch)], should_stop=should_stop)
