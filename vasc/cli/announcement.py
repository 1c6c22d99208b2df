"""What a run says before its first step."""

import sys

import typer

from vasc.cli.failures import complain
from vasc.cli.progress import ProgressLine
from vasc.config import Experiment
from vasc.config.regime import regime
from vasc.state import State
from vasc.streams import Streams


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
    """

    def __init__(self, experiment: Experiment, progress: ProgressLine) -> None:
        self.experiment = experiment
        self.progress = progress
        self.is_made = False

    def observe(self, state: State, streams: Streams) -> None:
        """Write it if it is not yet written."""
        if self.is_made:
            return
        self.is_made = True
        self.progress.clear()
        parameters = self.experiment.parameters
        expected = regime(parameters)
        growth = getattr(parameters, "growth", None)
        what = "vasculature" if growth is None else f"venation, {growth.kind} growth"
        typer.echo(f"{self.experiment.name}: {self.experiment.kind} {what}, seed {parameters.seed}")
        for sentence in expected.sentences:
            typer.echo(f"  {sentence}")
        # before the warnings, which go another way
        sys.stdout.flush()
        for warning in expected.warnings:
            complain(f"warning: {warning}")
