"""The checks of leaves, written for people."""

import typer


def print_leaves(suite: dict) -> None:
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
        (
            one["name"],
            None if one["value"] is None else f"{one['value']:.4g}",
            one["seen"],
            one["source"],
        )
        for one in suite["reported"]
    ]
    print_table(("what", "value", "in the literature", "source"), told)
    failed = [check for check in suite["checks"] if not check["pass"]]
    n_checks = len(suite["checks"])
    typer.echo(f"\n{n_checks - len(failed)} of {n_checks} checks pass{'; not' if failed else ''}")
    if failed:
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
