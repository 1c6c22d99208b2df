"""From the parameters of a sweep to its runs: numbered, with a seed and their own values each."""

import itertools
import json
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import Any

from vasc.config.overrides import Override, parse_override
from vasc.streams import Streams, spawned_seed
from vasc.sweeps.parameters import Range, SweepParameters


@dataclass(frozen=True)
class PlannedRun:
    """One run of a sweep.

    Parameters
    ----------
    number : int
        From 1 on, in the order of the table.
    values : dict
        From every dotted key that is varied to its value in this run.
    draw : int
        Which random choice, from 1 on.
    replicate : int
        Which of the runs that differ by seed alone, from 1 on.
    seed : int
        The seed of the run.
    """

    number: int
    values: dict[str, Any]
    draw: int
    replicate: int
    seed: int

    @property
    def overrides(self) -> list[Override]:
        """What it changes in the base."""
        return [*as_overrides(self.values), (("seed",), self.seed)]

    def as_json(self) -> dict[str, Any]:
        """Give the run as JSON values."""
        return asdict(self)


def as_overrides(values: dict[str, Any]) -> list[Override]:
    """Give values by dotted key as changes of a config.

    Raises
    ------
    ConfigError
        If a key is none.

    Examples
    --------
    >>> as_overrides({"arrival.kill_distance": 2.0})
    [(('arrival', 'kill_distance'), 2.0)]
    """
    return [(parse_override(f"{key}=0")[0], value) for key, value in values.items()]


def axis_values(parameters: SweepParameters) -> dict[str, list[Any]]:
    """Give the values of every axis."""
    return {
        key: axis.values() if isinstance(axis, Range) else list(axis)
        for key, axis in parameters.axes.items()
    }


def drawn_values(parameters: SweepParameters) -> list[dict[str, Any]]:
    """Give the random choices, each a value for every key in ``[random]``.

    A key has a stream of its own, so that another key changes no value of it.
    """
    spans = parameters.random
    streams = Streams(parameters.seed, spans)
    shares = {key: streams[key].random(parameters.draws).tolist() for key in spans}
    return [
        {key: span.at(shares[key][draw]) for key, span in spans.items()}
        for draw in range(parameters.draws)
    ]


def choices(parameters: SweepParameters) -> Iterator[tuple[int, dict[str, Any]]]:
    """Give all combinations of values with the number of their draw, the first axis slowest."""
    axes, drawn = axis_values(parameters), drawn_values(parameters)
    for combination in itertools.product(*axes.values()):
        for draw, values in enumerate(drawn, start=1):
            yield draw, dict(zip(axes, combination, strict=True)) | values


def plan(parameters: SweepParameters) -> list[PlannedRun]:
    """Give all runs of a sweep in their order.

    Parameters
    ----------
    parameters : SweepParameters
        What the sweep file says.

    Returns
    -------
    list of PlannedRun
        Replicates of one choice stand together; their seeds differ, as all seeds do.
    """
    runs: list[PlannedRun] = []
    for draw, values in choices(parameters):
        for replicate in range(1, parameters.replicates + 1):
            number = len(runs) + 1
            seed = spawned_seed(parameters.seed, number)
            runs.append(PlannedRun(number, values, draw, replicate, seed))
    return runs


def is_number(value: Any) -> bool:
    """Tell whether a value has a place on an axis of numbers; a flag has none."""
    return isinstance(value, int | float) and not isinstance(value, bool)


def value_text(value: Any) -> str:
    """Write a value of an axis, as figures name it.

    Examples
    --------
    >>> value_text(0.1 + 0.2), value_text("marginal"), value_text([1, 2])
    ('0.3', 'marginal', '[1, 2]')
    """
    if is_number(value):
        return f"{value:.6g}"
    return value if isinstance(value, str) else json.dumps(value)
