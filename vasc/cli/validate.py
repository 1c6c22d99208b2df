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
    "vasc validate leaf -o leaves.png",
    "vasc validate --json",
)

SUITES = ("growth", "stem", "transitions", "leaf")
DRAWN = ("transitions", "leaf")


def validate(
    suite: Annotated[
        str | None,
        typer.Argument(metavar="[SUITE]", help=f"One of {', '.join(SUITES)}; all if left out."),
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option(
            "--output",
            "-o",
            metavar="PICTURE",
            help="Draw the transitions, or the leaves: png, svg or pdf; leaves into a folder also.",
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
    leaf: statistics of the veins of simulated leaves, against those of real ones. A folder as
    --output gets a picture for each check.
    """
    from vasc.cli.printing import print_json
    from vasc.errors import ConfigError

    if suite is not None and suite not in SUITES:
        raise ConfigError(f"suite = {suite!r}: must be one of {', '.join(SUITES)}")
    if output is not None:
        if suite not in DRAWN:
            raise ConfigError(
                f"--output {output}: one of the suites {' and '.join(DRAWN)} is drawn at a time"
            )
        if suite != "leaf" or not output.is_dir():
            check_picture(output, force=force)
    suites = [run() for name, run in _suites().items() if suite in (None, name)]
    if output is not None:
        _draw(suites[0], output)
    passed = all(check["pass"] for one in suites for check in one["checks"])
    if as_json:
        print_json({"suites": suites, "pass": passed})
    else:
        for one in suites:
            PRINTERS.get(one["name"], _print_stem)(one)
    if not passed:
        raise typer.Exit(1)


def _suites() -> dict[str, Callable[[], dict[str, Any]]]:
    """Give the suites, each ready to run."""
    from vasc.validation.growth_variants import validate_growth
    from vasc.validation.stem_suite import validate_stem
    from vasc.validation.stem_transitions import validate_transitions
    from vasc.validation.vein_statistics import leaf_suite

    def progress(name: str) -> None:
        typer.echo(f"running: {name}", err=True)

    found = (validate_growth, validate_stem, validate_transitions, leaf_suite)
    return {name: partial(run, progress) for name, run in zip(SUITES, found, strict=True)}


def _draw(suite: dict, output: Path) -> None:
    """Draw the transitions or the leaves."""
    from vasc.render import draw_transitions, save, save_leaf_checks

    if suite["name"] == "leaf":
        save_leaf_checks(suite, output)
    else:
        save(draw_transitions(suite["stems"], suite["thresholds"]), output)


def _print_leaf(suite: dict) -> None:
    """Write the suite of leaves for people: what was asked, what came, and what fails."""
    from vasc.cli.printing import print_table

    rows = [
        (
            check["check"],
            check["what"],
            check["leaf"],
            "pass" if check["pass"] else "FAIL",
            "-" if check["value"] is None else f"{check['value']:.4g}",
            _asked(check["low"], check["high"]),
        )
        for check in suite["checks"]
    ]
    print_table(("check", "what", "leaf", "verdict", "value", "asked"), rows)
    typer.echo("\nreported, deciding nothing")
    told = [
        (one["name"], f"{one['value']:.4g}", one["seen"], one["source"])
        for one in suite["reported"]
    ]
    print_table(("what", "value", "in the literature", "source"), told)
    failed = [check for check in suite["checks"] if not check["pass"]]
    n_checks = len(suite["checks"])
    typer.echo(f"\n{n_checks - len(failed)} of {n_checks} checks pass; not")
    reasons = [(one["name"], _against(one), one["source"]) for one in failed]
    print_table(("what", "why", "source of the range"), reasons)
    for name in suite["control_failures"]:
        typer.echo(f"the real leaf fails {name}: that check is wrong, not the leaf")


def _against(check: dict) -> str:
    """Say how a value misses its range."""
    if check["value"] is None:
        return "the leaf has no such number"
    if check["value"] < check["low"]:
        return f"{check['value']:.4g} is below {check['low']:.4g}"
    return f"{check['value']:.4g} is above {check['high']:.4g}"


def _asked(low: float, high: float | None) -> str:
    """Write a range; None is no upper limit."""
    return f"{low:.4g} or more" if high is None else f"{low:.4g} to {high:.4g}"


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


PRINTERS: dict[str, Callable[[dict], None]] = {"growth": _print_growth, "leaf": _print_leaf}
"""What writes a suite for people, where it is not a suite of stems."""
