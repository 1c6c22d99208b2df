"""The checks of leaves, written for people."""

from collections.abc import Sequence

import typer

WORDS = {True: "pass", False: "FAIL", None: "open"}
"""What a verdict is called in the table; open is what a leaf has no number for."""


def print_leaves(suite: dict) -> None:
    """Write the suite of leaves for people: what was asked, what came, and what fails."""
    from vasc.cli.printing import print_table

    rows = [
        (
            check["check"],
            check["what"],
            check["leaf"],
            WORDS[check["pass"]],
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
    typer.echo()
    for line in counted(suite["checks"], suite["curves"]["real"]):
        typer.echo(line)
    missed = [check for check in suite["checks"] if not check["pass"]]
    if missed:
        typer.echo("\nnot passed")
        reasons = [(one["name"], _against(one), one["source"]) for one in missed]
        print_table(("what", "why", "source of the range"), reasons)
    for name in suite["control_failures"]:
        typer.echo(f"the real leaf fails {name}: that check is wrong, not the leaf")


def counted(checks: Sequence[dict], controls: Sequence[str]) -> list[str]:
    """Count the checks of each leaf, the controls last."""
    leaves = dict.fromkeys(check["leaf"] for check in checks)
    lines = []
    for leaf in sorted(leaves, key=lambda name: name in controls):
        verdicts = [check["pass"] for check in checks if check["leaf"] == leaf]
        control = ", the control" if leaf in controls else ""
        line = f"{leaf}{control}: {verdicts.count(True)} of {len(verdicts)} checks pass"
        if n_failed := verdicts.count(False):
            line += f", {n_failed} {'fails' if n_failed == 1 else 'fail'}"
        if n_open := verdicts.count(None):
            line += f", {n_open} cannot be decided"
        lines.append(line)
    return lines


def _against(check: dict) -> str:
    """Say how a value misses its range."""
    if check["value"] is None:
        return "open: the leaf has no such number"
    if check["value"] < check["low"]:
        return f"{check['value']:.4g} is below {check['low']:.4g}"
    return f"{check['value']:.4g} is above {check['high']:.4g}"


def _asked(low: float, high: float | None) -> str:
    """Write a range; None is no upper limit."""
    return f"{low:.4g} or more" if high is None else f"{low:.4g} to {high:.4g}"
