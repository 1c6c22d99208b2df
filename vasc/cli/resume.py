"""``vasc resume``: go on with a run."""

import typer

from vasc.cli.options import AsJson, MoreSteps, Quiet, RunFile

EXAMPLES = ("vasc resume poplar-leaf.h5 --steps 500",)


def resume(
    path: RunFile, steps: MoreSteps = None, quiet: Quiet = False, as_json: AsJson = False
) -> None:
    """Go on with a run from its last recorded step, to the same bytes."""
    from vasc import experiment
    from vasc.cli.interrupts import Interrupts
    from vasc.cli.progress import ProgressLine
    from vasc.cli.start import load_numba
    from vasc.cli.summary import end_if_interrupted, print_summary
    from vasc.timeline import Timeline
    from vasc.timeline.redo import settle

    with Timeline(path) as timeline:
        was_complete, last_step = timeline.is_complete, timeline.last_step
    if was_complete and not (quiet or as_json):
        settle(path)
        typer.echo(f"{path} is complete: its {last_step:,} steps are all there are")
        return
    with Interrupts() as interrupts, ProgressLine(quiet=quiet) as progress:
        load_numba()
        summary = experiment.resume(
            path, steps=steps, observers=[progress], should_stop=interrupts.should_stop
        )
    end_if_interrupted(summary, interrupts)
    if as_json or not quiet:
        print_summary(summary, [path], as_json=as_json)
