"""``vasc sweep``: an experiment many times, with values varied."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from vasc.cli.options import AsJson, Quiet

if TYPE_CHECKING:
    from vasc.sweeps import Outcome, Sweep
    from vasc.sweeps.pilot import Estimate

EXAMPLES = (
    "vasc sweep kill-distance-by-darts --plan",
    "vasc sweep kill-distance-by-darts -o grid --workers 4",
    "vasc sweep my-sweep.toml -o grid --scheduler tcp://10.0.0.1:8786",
)


def sweep(
    source: Annotated[
        str,
        typer.Argument(metavar="SWEEP", help="A TOML file, or a name that `vasc configs` lists."),
    ],
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", metavar="DIR", help="The folder; by default SWEEP's name."),
    ] = None,
    workers: Annotated[
        int | None,
        typer.Option("--workers", min=1, help="Processes here; by default one a processor."),
    ] = None,
    scheduler: Annotated[
        str | None,
        typer.Option("--scheduler", metavar="ADDRESS", help="Run on this Dask cluster instead."),
    ] = None,
    plan: Annotated[
        bool,
        typer.Option("--plan", help="Make the largest run alone, elsewhere; tell time and size."),
    ] = False,
    retry: Annotated[
        bool, typer.Option("--retry", help="Make the runs that failed once more, too.")
    ] = False,
    quiet: Quiet = False,
    as_json: AsJson = False,
) -> None:
    """Run an experiment many times, with values varied, and make a table and a figure of it.

    DIR gets a timeline a run, results.csv and figure.png. The same command does what is
    missing. Exit code 3 if a run failed; the others are made all the same.
    """
    from vasc.sweeps import load_sweep

    if workers is not None and scheduler is not None:
        raise typer.BadParameter("--workers and --scheduler exclude each other")
    loaded = load_sweep(source)
    output = Path(loaded.name) if output is None else output
    if plan:
        _tell_plan(loaded, output, workers, retry=retry, as_json=as_json)
        return
    outcome = _made(loaded, output, workers, scheduler, retry=retry, quiet=quiet or as_json)
    if as_json:
        from vasc.cli.printing import print_json

        print_json(_json_outcome(outcome))
    else:
        _print_outcome(outcome, quiet=quiet)
    if outcome.progress.failed:
        raise typer.Exit(3)


def _made(
    loaded: "Sweep",
    output: Path,
    workers: int | None,
    scheduler: str | None,
    *,
    retry: bool,
    quiet: bool,
) -> "Outcome":
    """Make the runs that are missing; an interrupt ends the program with a sentence."""
    from vasc.cli.failures import complain
    from vasc.cli.interrupts import Interrupts
    from vasc.cli.sweep_progress import SweepProgress
    from vasc.sweeps import LocalWorkers, run_sweep
    from vasc.sweeps.local import n_processors
    from vasc.sweeps.workforce import Workforce

    def workforce() -> Workforce:
        if scheduler is None:
            return LocalWorkers(workers or n_processors())
        from vasc.sweeps.cluster import ClusterWorkers

        return ClusterWorkers(scheduler)

    with Interrupts() as interrupts, SweepProgress(quiet=quiet) as progress:
        outcome = run_sweep(
            loaded,
            output,
            workforce,
            retry=retry,
            watcher=progress,
            should_stop=interrupts.should_stop,
        )
    if outcome.progress.is_interrupted:
        found = outcome.progress
        ended = found.total - found.left
        complain(
            f"interrupted: {output} holds the results of {ended} of {found.total} runs;"
            " the same command goes on"
        )
        raise typer.Exit(interrupts.exit_code)
    return outcome


def _tell_plan(
    loaded: "Sweep", output: Path, workers: int | None, *, retry: bool, as_json: bool
) -> None:
    """Tell what would be run, how long it takes and how large it becomes."""
    from vasc.cli.printing import print_json
    from vasc.sweeps import SweepFolder
    from vasc.sweeps.execute import begun
    from vasc.sweeps.local import n_processors
    from vasc.sweeps.pilot import estimate

    folder = SweepFolder(output)
    folder.check(loaded.description())
    progress, missing = begun(loaded, folder, retry=retry)
    found = estimate(loaded, missing, min(workers or n_processors(), max(len(missing), 1)))
    if as_json:
        runs = [run.as_json() for run in loaded.runs]
        print_json(
            {"runs": runs, "done": progress.done, "missing": missing}
            | {"estimate": found.as_json()}
        )
    else:
        _print_plan(loaded, progress.total - progress.left, found)


def _print_plan(loaded: "Sweep", n_there: int, found: "Estimate") -> None:
    """Write the plan for people."""
    from vasc.cli.printing import file_size, print_pairs, printable, shown
    from vasc.cli.sweep_progress import duration
    from vasc.sweeps.plan import axis_values

    parameters = loaded.parameters
    typer.echo(f"{loaded.name}: {printable(parameters.title) or 'untitled'}")
    varied = {key: _listed(values) for key, values in axis_values(parameters).items()}
    varied |= {
        key: f"at random from {shown(span.low)} to {shown(span.high)}, {span.scale}"
        for key, span in parameters.random.items()
    }
    if parameters.random:
        varied["draws"] = str(parameters.draws)
    there = f", of which {n_there:,} have a result" if n_there else ""
    print_pairs(
        {"base": f"{parameters.base} ({loaded.kind})"}
        | varied
        | {
            "replicates": parameters.replicates,
            "runs": f"{len(loaded.runs):,}{there}",
            "measures": ", ".join(parameters.measures),
        }
    )
    if found.error:
        typer.echo(f"\nrun {found.number} fails: {found.error}")
        return
    typer.echo()
    print_pairs(
        {
            f"run {found.number:,}, expected to be largest": f"{duration(found.run_seconds)},"
            f" {file_size(found.run_bytes)}",
            "all that is missing": f"about {duration(found.seconds)} with {found.n_workers}"
            f" worker{'s' if found.n_workers > 1 else ''}, {file_size(found.bytes)},"
            f" if all are like run {found.number:,}",
        }
    )


def _listed(values: list[Any]) -> str:
    """Write the values of an axis, in the middle of a long one dots."""
    from vasc.cli.printing import shown

    texts = [shown(value) for value in values]
    if len(texts) > 12:
        texts = [*texts[:6], "...", *texts[-3:]]
    return f"{len(values)} values: {', '.join(texts)}"


def _json_outcome(outcome: "Outcome") -> dict[str, Any]:
    """Give what came of a sweep as JSON values."""
    progress = outcome.progress
    return {
        "runs": progress.total,
        "made": progress.made,
        "done": progress.done,
        "failed": [{"run": run, "error": text} for run, text in sorted(progress.failed.items())],
        "files": [str(path) for path in outcome.files],
    }


def _print_outcome(outcome: "Outcome", *, quiet: bool) -> None:
    """Write what came of a sweep for people; errors even when quiet."""
    from vasc.cli.failures import complain

    progress = outcome.progress
    for number, error in sorted(progress.failed.items()):
        complain(f"run {number}: {error}")
    if quiet:
        return
    there = progress.total - progress.made
    before = f", {there:,} of them before" if there else ""
    typer.echo(
        f"{progress.total:,} runs: {progress.done:,} done, {len(progress.failed):,} failed{before}"
    )
    if outcome.no_figure:
        typer.echo(f"no figure: {outcome.no_figure}")
    typer.echo(f"written: {', '.join(str(path) for path in outcome.files)}")
