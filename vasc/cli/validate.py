"""``vasc validate``: the suites that hold models against the literature."""

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Annotated, Any

import typer

from vasc.cli.options import AsJson, Force
from vasc.cli.outputs import check_file, check_not_needed, check_picture
from vasc.errors import writing
from vasc.whole_files import write_whole

EXAMPLES = (
    "vasc validate growth",
    "vasc validate transitions -o transitions.png",
    "vasc validate canalization --n 200 -o canals.json",
    "vasc validate leaf -o leaves.png",
    "vasc validate leaf mine.h5 leaf_edges.csv",
    "vasc validate --json",
)

SUITES = ("growth", "stem", "transitions", "canalization", "leaf")


def validate(
    suite: Annotated[
        str | None,
        typer.Argument(metavar="[SUITE]", help=f"One of {', '.join(SUITES)}; all if left out."),
    ] = None,
    files: Annotated[
        list[Path] | None,
        typer.Argument(
            metavar="[FILE]...",
            help="With leaf: your recorded runs or real networks instead of the bundled runs.",
        ),
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option(
            "--output",
            "-o",
            metavar="FILE",
            help="Draw the transitions or the leaves: png, svg, pdf, leaves into a folder also; or"
            " write what canalization found: json.",
        ),
    ] = None,
    n: Annotated[
        int | None,
        typer.Option(
            "--n",
            min=5,
            max=10_000,
            help="Scenarios a rate of canalization: 20 by default; from 200 on of all protocols.",
        ),
    ] = None,
    force: Force = False,
    as_json: AsJson = False,
) -> None:
    """Run the validation suites, a minute or two each; exit code 1 if a check fails.

    growth: which growth of the first leaf of Arabidopsis makes which sequence of veins.
    stem: what the veins of the stems of the thesis connect.
    transitions: what stems connect over the ratio of radius to rise, against the predicted
    thresholds.
    canalization: whether canals reach the vein nodes that the open and the closed rule of
    geometry predict, by which model, and where not.
    leaf: statistics of the veins of simulated leaves, or of those of FILE..., against those of
    real ones. A folder as --output gets a picture for each check.
    """
    from vasc.cli.canals import print_canalization
    from vasc.cli.leaves import print_leaves
    from vasc.cli.printing import print_json
    from vasc.errors import ConfigError

    if suite is not None and suite not in SUITES:
        raise ConfigError(f"suite = {suite!r}: must be one of {', '.join(SUITES)}")
    if files and suite != "leaf":
        raise ConfigError(f"{files[0]}: only the suite leaf judges files: vasc validate leaf FILE")
    if n is not None and suite not in (None, "canalization"):
        raise ConfigError(f"--n {n}: only the suite canalization draws scenarios")
    if output is not None:
        _check_output(output, suite, force=force)
        _spare(files or [], output)
    suites = [run() for name, run in _suites(n, files or []).items() if suite in (None, name)]
    if output is not None:
        _write(output, suites)
    # None is what a leaf has no number for
    passed = all(check["pass"] is not False for one in suites for check in one["checks"])
    if as_json:
        print_json({"suites": suites, "pass": passed})
    else:
        printed = PRINTED | {"canalization": print_canalization, "leaf": print_leaves}
        for one in suites:
            printed[one["name"]](one)
    if not passed:
        raise typer.Exit(1)


def _check_output(output: Path, suite: str | None, *, force: bool) -> None:
    """Refuse a file that the suites make nothing for, or that exists."""
    from vasc.errors import ConfigError

    if suite == "canalization":
        if output.suffix != ".json":
            raise ConfigError(f"--output {output}: tables of canalization are written as .json")
        check_file(output, force=force)
        return
    if suite not in (None, "transitions", "leaf"):
        raise ConfigError(
            f"--output {output}: the suites transitions and leaf are drawn, the tables of"
            " canalization written"
        )
    if suite == "leaf" and output.is_dir():
        from vasc.render.leaf_checks import check_pictures

        for picture in check_pictures(output):
            check_file(picture, force=force)
        return
    # a minute of simulations, and then no picture, is what this saves
    check_picture(output, force=force, also=(".json",) if suite is None else ())


def _spare(files: list[Path], output: Path) -> None:
    """Refuse to draw over what is judged, or a file that the config of a run refers to."""
    from vasc.errors import OutputError
    from vasc.networks_in import is_network_file

    for file in files:
        if file.exists() and output.exists() and output.samefile(file):
            raise OutputError(f"{output}: is one of the leaves, and is never replaced")
        if not is_network_file(file):
            check_not_needed(file, output)


def _write(output: Path, suites: list[dict[str, Any]]) -> None:
    """Write the tables of canalization, or draw the transitions or the leaves."""
    found = {one["name"]: one for one in suites}
    if output.suffix == ".json":
        import json

        text = json.dumps(found["canalization"], indent=2, allow_nan=False) + "\n"
        with writing(output):
            write_whole(output, text)
        return
    from vasc.render import draw_transitions, save, save_leaf_checks

    if "transitions" not in found:
        save_leaf_checks(found["leaf"], output)
        return
    save(
        draw_transitions(found["transitions"]["stems"], found["transitions"]["thresholds"]), output
    )


def _suites(n: int | None, files: list[Path]) -> dict[str, Callable[[], dict[str, Any]]]:
    """Give the suites, each ready to run."""
    from vasc.validation.canalization.suite import DEFAULT, validate_canalization
    from vasc.validation.growth_variants import validate_growth
    from vasc.validation.stem_suite import validate_stem
    from vasc.validation.stem_transitions import validate_transitions
    from vasc.validation.vein_statistics import leaf_suite, validate_leaves

    def progress(name: str) -> None:
        typer.echo(f"running: {name}", err=True)

    def own_leaves(progress: Callable[[str], None]) -> dict[str, Any]:
        return validate_leaves(files, progress).as_suite()

    canals = partial(validate_canalization, n=DEFAULT if n is None else n)
    found: tuple[Callable[..., dict[str, Any]], ...] = (
        validate_growth,
        validate_stem,
        validate_transitions,
        canals,
        own_leaves if files else leaf_suite,
    )
    return {name: partial(run, progress) for name, run in zip(SUITES, found, strict=True)}


def _print_stem(suite: dict) -> None:
    """Write the suite of stems for people."""
    from vasc.cli.printing import print_table

    rows = [
        (
            check["name"],
            _stem_verdict(check),
            ",".join(map(str, check["pair"])),
            f"{check['value']:.2f}",
            f"{check['low']:.2f}" if check["tie"] is None else "by the rule of the tie",
        )
        for check in suite["checks"]
    ]
    print_table(("stem", "verdict", "found", "share", "asked"), rows)
    for check in suite["checks"]:
        if check["tie"] is not None:
            typer.echo(f"{check['name']}: {check['tie']}")


def _stem_verdict(check: dict) -> str:
    """Say how a stem turned out; a tie leaves some of its links undecided, and is no pass."""
    if not check["pass"]:
        return "FAIL"
    return "pass" if check["tie"] is None else "tied"


def _print_growth(suite: dict) -> None:
    """Write the suite of growth for people."""
    from vasc.cli.printing import print_table

    typer.echo(f"{suite['name']}: criteria of the sequence that fail")
    rows = [
        (
            check["name"],
            "pass" if check["pass"] else "FAIL",
            " ".join(check["fails"]) or "none",
            " ".join(check["expected_fails"]) or "none",
        )
        for check in suite["checks"]
    ]
    print_table(("growth", "verdict", "fails", "expected to fail"), rows)


PRINTED: dict[str, Callable[[dict], None]] = {
    "growth": _print_growth,
    "stem": _print_stem,
    "transitions": _print_stem,
}
"""How the suites without transport are written for people."""
