"""``vasc verify``: run it again and compare every bit."""

from typing import TYPE_CHECKING

import typer

from vasc.cli.options import AsJson, Quiet, RunFile

if TYPE_CHECKING:
    from vasc.timeline.comparison import Difference


EXAMPLES = ("vasc verify poplar-leaf.h5",)


def verify(path: RunFile, quiet: Quiet = False, as_json: AsJson = False) -> None:
    """Run a recorded run again from its own config and compare all tables bit for bit."""
    from vasc import experiment
    from vasc.cli.printing import print_json
    from vasc.cli.progress import ProgressLine
    from vasc.cli.start import load_numba

    with ProgressLine(quiet=quiet) as progress:
        load_numba()
        differences = experiment.verify(path, observers=[progress])
    if as_json:
        found = [difference._asdict() for difference in differences]
        print_json({"differences": found, "pass": not differences})
    elif not differences and not quiet:
        typer.echo(f"{path}: the second run gave the same, bit for bit")
    else:
        for index, difference in enumerate(differences):
            typer.echo(
                f"{path}: {'first difference' if index == 0 else 'also'}: {said(difference)}"
            )
    if differences:
        raise typer.Exit(1)


def said(difference: "Difference") -> str:
    """Say in one line where two runs differ."""
    step, table, column, row, recorded, repeated = difference
    where = f"{table}/{column} row {row}" if table else column
    return f"step {step}, {where}: recorded {recorded}, now {repeated}"
