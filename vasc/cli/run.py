"""``vasc run``: grow a leaf and record it."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from vasc.cli.options import AsJson, Force, MoreSteps, Quiet

if TYPE_CHECKING:
    from vasc.config import Experiment

EXAMPLES = (
    "vasc run poplar-leaf",
    "vasc run my-leaf.toml -o my.h5 --seed 2 --set growth.final_length=2000",
)


def run(
    config: Annotated[
        str,
        typer.Argument(metavar="CONFIG", help="A TOML file, or a name that `vasc configs` lists."),
    ],
    output: Annotated[
        Path | None,
        typer.Option(
            "--output", "-o", metavar="RUN.h5", help="The timeline; by default CONFIG.h5."
        ),
    ] = None,
    seed: Annotated[
        int | None, typer.Option("--seed", help="Instead of the config's seed.")
    ] = None,
    changes: Annotated[
        list[str] | None,
        typer.Option(
            "--set", metavar="KEY=VALUE", help="Instead of a value of the config; repeat."
        ),
    ] = None,
    steps: MoreSteps = None,
    figure: Annotated[
        Path | None,
        typer.Option("--figure", metavar="FILE", help="png, svg or pdf; by default beside RUN.h5."),
    ] = None,
    no_figure: Annotated[bool, typer.Option("--no-figure", help="Draw no picture.")] = False,
    force: Force = False,
    large: Annotated[
        bool,
        typer.Option("--large", help="Run even what memory or disk are not expected to hold."),
    ] = False,
    quiet: Quiet = False,
    as_json: AsJson = False,
) -> None:
    """Run an experiment: record every step, and draw the last one."""
    from vasc.cli.announcement import Announcement
    from vasc.cli.interrupts import Interrupts
    from vasc.cli.outputs import check_folder, check_outputs
    from vasc.cli.progress import ProgressLine
    from vasc.cli.start import load_numba
    from vasc.cli.summary import end_if_interrupted, print_summary
    from vasc.timeline.storage import check_output

    if figure is not None and no_figure:
        raise typer.BadParameter("--figure and --no-figure exclude each other")
    experiment = changed(config, changes or (), seed)
    output = Path(f"{experiment.name}.h5") if output is None else output
    check_folder(output)
    check_output(output, force=force)
    figure = None if no_figure else figure or output.with_suffix(".png")
    check_outputs(config, output, figure, force=force)

    from vasc import experiment as experiments

    with Interrupts() as interrupts, ProgressLine(quiet=quiet) as progress:
        load_numba()
        announcement = Announcement(experiment, progress, is_made=quiet or as_json)
        summary = experiments.run(
            experiment,
            output,
            force=force,
            large=large,
            steps=steps,
            observers=[announcement, progress],
            should_stop=interrupts.should_stop,
            on_size=announcement.expect,
        )
    end_if_interrupted(summary, interrupts)
    files = [output, *_drawn(output, figure, unroll=experiment.kind == "stem")]
    if as_json or not quiet:
        print_summary(summary, files, as_json=as_json)


def _drawn(output: Path, figure: Path | None, *, unroll: bool) -> list[Path]:
    """Draw the last step, if asked for; give the picture."""
    if figure is None:
        return []
    from vasc.render import render

    return [render(output, figure, unroll=unroll)]


def changed(config: str, changes: Sequence[str], seed: int | None) -> "Experiment":
    """Read a config with some values, and maybe the seed, replaced.

    Raises
    ------
    ConfigError
        If the config or a change is wrong.
    """
    from vasc.config import load, parse_override

    overrides = [parse_override(change) for change in changes]
    return load(config, [*overrides, *([] if seed is None else [(("seed",), seed)])])
