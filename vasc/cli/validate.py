"""``vasc validate``: the suites that hold models against the literature."""

from typing import Annotated

import typer

from vasc.cli.options import AsJson

EXAMPLES = ("vasc validate growth", "vasc validate stem", "vasc validate --json")

SUITES = ("growth", "stem")


def validate(
    suite: Annotated[
        str | None,
        typer.Argument(metavar="[SUITE]", help=f"One of {', '.join(SUITES)}; all if left out."),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Run the validation suites, about a minute each; exit code 1 if a check fails.

    growth: which growth of the first leaf of Arabidopsis makes which sequence of veins.
    stem: what the veins of the stems of the thesis connect.
    """
    from vasc.cli.printing import print_json
    from vasc.errors import ConfigError
    from vasc.validation.growth_variants import validate_growth
    from vasc.validation.stem_suite import validate_stem

    if suite is not None and suite not in SUITES:
        raise ConfigError(f"suite = {suite!r}: must be one of {', '.join(SUITES)}")
    chosen = {"growth": validate_growth, "stem": validate_stem}
    suites = [
        validate(lambda name: typer.echo(f"running: {name}", err=True))
        for name, validate in chosen.items()
        if suite in (None, name)
    ]
    passed = all(check["pass"] for one in suites for check in one["checks"])
    if as_json:
        print_json({"suites": suites, "pass": passed})
    else:
        for one in suites:
            (_print_growth if one["name"] == "growth" else _print_stem)(one)
    if not passed:
        raise typer.Exit(1)


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
