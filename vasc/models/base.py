"""What a model is, and the tables that the configs of all models may have."""

from abc import ABC, abstractmethod
from typing import Literal, TypeVar

from vasc import kernels
from vasc.limits import RUN_STEPS
from vasc.parameters import Parameters, quantity
from vasc.state import State, Tables
from vasc.streams import Streams

B = TypeVar("B")


class Model(ABC):
    """A model makes states: an initial one, and from each the next."""

    @abstractmethod
    def initial_state(self, streams: Streams) -> State:
        """Give the state before the first step."""

    @abstractmethod
    def advance(self, state: State, streams: Streams) -> State:
        """Give the state one step later."""

    @abstractmethod
    def restore(self, tables: Tables, step: int, streams: Streams) -> State:
        """Give the state that a record describes, ready to go on to the same bytes."""

    def is_finished(self, state: State) -> bool:
        """Tell whether nothing is left to do."""
        return state.is_finished


def newest(state: State, kind: type[B]) -> B:
    """Give the buffers of a state, which must be the newest of its run.

    Parameters
    ----------
    state : State
        The state to go on from.
    kind : type
        What the model keeps its buffers in.

    Raises
    ------
    ValueError
        If the state has a successor already, or is of another model.
    """
    buffers = state.index
    if not isinstance(buffers, kind):
        raise ValueError(f"the state of step {state.step} is of another model")
    if state.tables.counts() != state.counts:
        raise ValueError(f"the state of step {state.step} has been advanced already")
    return buffers


class StopParameters(Parameters):
    """When a run ends at the latest."""

    steps: int | None = quantity(
        "Last step; by default a run ends when growth, placement and extension do.",
        unit="steps",
        default=None,
        ge=1,
        le=RUN_STEPS,
    )


class RecordParameters(Parameters):
    """What the timeline holds besides what it always does."""

    perceived: Literal["veins", "nodes", "none"] = quantity(
        "When the set of nodes that a source attracts is recorded: when a vein enters or leaves"
        " it ('veins'), also when a vein in it merely extends ('nodes', most of a large file),"
        " or never ('none').",
        default="veins",
    )
    durability: Literal["process", "batch", "strict"] = quantity(
        "What a loss of power may take, a killed process never loses what is recorded: the last"
        " second at most ('batch'), nothing, with every step brought to the disk by itself"
        " ('strict'), or what the system has not written yet ('process').",
        default="batch",
    )

    @property
    def least_change(self) -> int:
        """The least change that is recorded, see :mod:`vasc.kernels.perceived`."""
        return {
            "nodes": kernels.perceived.SAME_VEINS,
            "veins": kernels.perceived.OTHER_VEINS,
            "none": kernels.perceived.NEVER,
        }[self.perceived]


LEAST_UNIT, MOST_UNIT = 1e-12, 1e12
"""Range of a length or time of the model in real units: areas stay far from the ends of floats."""


class UnitParameters(Parameters):
    """Real units, if the config's D and step stand for some."""

    length: str = quantity("Unit of length, for example 'um'.", default="um", min_length=1)
    segment: float = quantity("One D in that unit.", default=1.0, ge=LEAST_UNIT, le=MOST_UNIT)
    time: str = quantity("Unit of time, for example 'h'.", default="step", min_length=1)
    step: float = quantity("One step in that unit.", default=1.0, ge=LEAST_UNIT, le=MOST_UNIT)


class PrintedParameters(Parameters):
    """What a paper prints, beside the reading of it that is run."""

    table: str | None = quantity("Where the values are printed.", default=None)
    values: dict[str, str] = quantity("The values as printed.", default={})
    reading: str | None = quantity("How they were read, and why.", default=None)
