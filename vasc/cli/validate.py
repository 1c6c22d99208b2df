"""``vasc validate``: the suites that hold models against the literature."""

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Annotated, Any

import typer

from vasc.cli.options import AsJson, Force
from vasc.cli.run import check_picture

EXAMPLES = (
    "vasc validate growth",
    "vasc validate transitions -o transitions.png",
    "vasc validate --json",
)

SUITES = ("growth", "stem", "transitions")


def validate(
    suite: Annotated[
        str | None,
        typer.Argument(metavar="[SUITE]", help=f"One of {', '.join(SUITES)}; all if left out."),
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option(
            "--output", "-o", metavar="PICTURE", help="Draw the transitions: png, svg or pdf."
        ),
    ] = None,
    force: Force = False,
    as_json: AsJson = False,
) -> None:
    """Run the validation suites, about a minute each; exit code 1 if a check fails.

    growth: which growth of the first leaf of Arabidopsis makes which sequence of veins.
    stem: what the veins of the stems of the thesis connect.
    transitions: what stems connect over the ratio of radius to rise, against the predicted
    thresholds.
    """
    from vasc.cli.printing import print_json
    from vasc.errors import ConfigError

    if suite is not None and suite not in SUITES:
        raise ConfigError(f"suite = {suite!r}: must be one of {', '.join(SUITES)}")
    if output is not None:
        if suite not in (None, "transitions"):
            raise ConfigError(f"--output {output}: only the suite transitions is drawn")
        check_picture(output, force=force)
    suites = [run() for name, run in _suites().items() if suite in (None, name)]
    if output is not None:
        from vasc.render import draw_transitions, save

        save(draw_transitions(suites[-1]["stems"], suites[-1]["thresholds"]), output)
    passed = all(check["pass"] for one in suites for check in one["checks"])
    if as_json:
        print_json({"suites": suites, "pass": passed})
    else:
        for one in suites:
            (_print_growth if one["name"] == "growth" else _print_stem)(one)
    if not passed:
        raise typer.Exit(1)


def _suites() -> dict[str, Callable[[], dict[str, Any]]]:
    """Give the suites, each ready to run."""
    from vasc.validation.growth_variants import validate_growth
    from vasc.validation.stem_suite import validate_stem
    from vasc.validation.stem_transitions import validate_transitions

    def progress(name: str) -> None:
        typer.echo(f"running: {name}", err=True)

    found = (validate_growth, validate_stem, validate_transitions)
    return {name: partial(run, progress) for name, run in zip(SUITES, found, strict=True)}


def _print_stem(suite: dict) -> None:
    """Write the suite of stems for people."""
    from vasc.cli.printing import print_table

    rows = [
        (
            check["name"],
            "pass" if check["pass"] else "FAIL",
            ",".join(map(str, check["pair"])),
            f"{check['value']:.2f}",
            f"{check['low']:.2f}" if check["tie"] is None else "tied",
        )
        for check in suite["checks"]
    ]
    print_table(("stem", "verdict", "found", "share", "asked"), rows)
    for check in suite["checks"]:
        if check["tie"] is not None:
            typer.echo(f"{check['name']}: {check['tie']}")


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
