"""Sweeps: one experiment many times, with values varied, as files, a table and a figure."""

from vasc.sweeps.execute import Outcome, Progress, run_sweep
from vasc.sweeps.folder import SweepFolder
from vasc.sweeps.local import LocalWorkers
from vasc.sweeps.measures import MEASURES
from vasc.sweeps.reading import Sweep, load_sweep
from vasc.sweeps.table import write_table

__all__ = [
    "MEASURES",
    "LocalWorkers",
    "Outcome",
    "Progress",
    "Sweep",
    "SweepFolder",
    "load_sweep",
    "run_sweep",
    "write_table",
]
