"""``vasc validate``: the suites that hold models against the literature."""

from typing import Annotated

import typer

from vasc.cli.options import AsJson

EXAMPLES = ("vasc validate growth", "vasc validate --json")

SUITES = ("growth",)


def validate(
    suite: Annotated[
        str | None,
        typer.Argument(metavar="[SUITE]", help=f"One of {', '.join(SUITES)}; all if left out."),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Run the validation suites, about a minute each; exit code 1 if a check fails.

    growth: which growth of the first leaf of Arabidopsis makes which sequence of veins.
    """
    from vasc.cli.printing import print_json
    from vasc.errors import ConfigError
    from vasc.validation.growth_variants import validate_growth

    if suite is not None and suite not in SUITES:
        raise ConfigError(f"suite = {suite!r}: must be one of {', '.join(SUITES)}")
    suites = [validate_growth(lambda name: typer.echo(f"running: {name}", err=True))]
    passed = all(check["pass"] for one in suites for check in one["checks"])
    if as_json:
        print_json({"suites": suites, "pass": passed})
    else:
        for one in suites:
            _print(one)
    if not passed:
        raise typer.Exit(1)


def _print(suite: dict) -> None:
    """Write a suite for people."""
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
