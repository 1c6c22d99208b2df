"""What a run says before its first step."""

import sys

import typer

from vasc.cli.failures import complain
from vasc.cli.printing import file_size
from vasc.cli.progress import ProgressLine
from vasc.config import Experiment
from vasc.config.expected import ExpectedSize
from vasc.config.regime import regime
from vasc.state import State
from vasc.streams import Streams
from vasc.timeline.tissues import n_bytes_a_step


class Announcement:
    """An observer that writes what is run, and what pattern to expect of it, once.

    It waits for the initial state: until the model and the file stand, a run may
    still be refused.

    Parameters
    ----------
    experiment : Experiment
        What is run.
    progress : ProgressLine
        What makes room on the terminal.
    is_made : bool
        Nothing is to be written any more.
    """

    def __init__(
        self, experiment: Experiment, progress: ProgressLine, *, is_made: bool = False
    ) -> None:
        self.experiment = experiment
        self.progress = progress
        self.is_made = is_made
        self.size: ExpectedSize | None = None

    def expect(self, size: ExpectedSize) -> None:
        """Take note of how large the run may become."""
        self.size = size

    def observe(self, state: State, streams: Streams) -> None:
        """Write it if it is not yet written."""
        if self.is_made:
            return
        self.is_made = True
        self.progress.clear()
        parameters = self.experiment.parameters
        expected = regime(parameters)
        what = _description(self.experiment)
        typer.echo(f"{self.experiment.name}: {what}, seed {parameters.seed}")
        for sentence in [*self._size(), *_tissue_sentences(state), *expected.sentences]:
            typer.echo(f"  {sentence}")
        # before the warnings, which go another way
        sys.stdout.flush()
        for warning in expected.warnings:
            complain(f"warning: {warning}")

    def _size(self) -> list[str]:
        """Say how large the run may become, if that is much."""
        if self.size is None or not self.size.is_large:
            return []
        memory, file = file_size(self.size.memory), file_size(self.size.file)
        return [f"may have {self.size.rows}, and take {memory} of memory and a file of {file}"]


def _description(experiment: Experiment) -> str:
    """Give the kind of an experiment in words."""
    growth = getattr(experiment.parameters, "growth", None)
    if growth is not None:
        how = "no" if growth.kind == "none" else growth.kind.replace("_", "-")
        return f"{experiment.kind} venation, {how} growth"
    if experiment.kind == "stem":
        return "stem vasculature"
    transport = getattr(experiment.parameters, "transport", None)
    return experiment.kind + ("" if transport is None else f", {transport.kind} transport")


def _tissue_sentences(state: State) -> list[str]:
    """Say how large a tissue is, and how large its record will be; nothing without cells."""
    if state.tissue is None:
        return []
    n_bytes = n_bytes_a_step(state.tissue.n_cells, state.tissue.n_walls)
    return [
        f"{state.tissue.n_cells:,} cells, {state.tissue.n_walls:,} walls",
        f"each step takes up to {file_size(n_bytes)} of the file,"
        f" 100 steps up to {file_size(100 * n_bytes)}, mostly two thirds of that",
    ]
