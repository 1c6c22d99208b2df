"""What ``vasc validate canalization`` tells people."""

import typer

from vasc.cli.printing import print_table


def print_canalization(suite: dict) -> None:
    """Write the suite of canals for people: what was asked, and the answer."""
    rows = [
        (
            check["name"],
            "pass" if check["pass"] else "FAIL",
            f"{check['value']:.4g}",
            f"{check['low']:.4g} to {check['high']:.4g}",
        )
        for check in suite["checks"]
    ]
    print_table(("canals", "verdict", "found", "asked"), rows)
    _print_answers(suite)


def _print_answers(suite: dict) -> None:
    """Write how often canals reach what the rules of geometry predict."""
    typer.echo(
        "\nDoes a canal reach the vein that the geometric rule predicts?"
        f" Rates of {suite['n']} scenarios:"
    )
    answers = [
        (
            f"{row['tissue']} {row['scenario']}",
            row["protocol"],
            f"{row['hit_rate']:.2f} ({row['hit_low']:.2f}-{row['hit_high']:.2f})",
            f"{row['reference_low']:.2f}-{row['reference_high']:.2f}",
            f"{row['p']:.2g}",
            f"{row['hit_clears']}/{row['hit_clear_n']}",
            f"{row['hit_by_cells_rate']:.2f}",
            f"{row['as_closed_rate']:.2f} ({row['as_closed_low']:.2f}-{row['as_closed_high']:.2f})",
            f"{row['as_closed_severals']}/{row['as_closed_several_n']}",
            "-" if row["miss_q_min"] is None else f"{row['miss_q_min']:.2f}",
        )
        for row in suite["tables"]["hit_rates"]
    ]
    header = (
        "open rule",
        "reference",
        "p",
        "d/d2 < 0.8",
        "over cells",
        "closed rule",
        "several",
        "least d/d2 missed",
    )
    print_table(("tissue, veins", "transport", *header), answers)
    missed = [row for row in suite["tables"]["figure"] if not row["is_hit"]]
    for row in missed:
        typer.echo(
            f"not where two veins are given: {row['tissue']}, {row['protocol']}, {row['case']}"
            f" (d/d2 = {row['q']:.2f})"
        )
    _explain()


def _explain() -> None:
    """Say what the columns are."""
    from vasc.validation.canalization.hit_rates import EXACT

    typer.echo(
        "open rule: the nearest vein; closed rule: the veins of all relative neighbors,"
        " which may be\nseveral; d/d2: distance of the nearest vein over that of the second;"
        " in brackets: 95 % (Wilson);\nreference: the same of a measurement by another program, p"
        " that both have one true rate (Fisher).\nFor the nearest by Euclid to be the nearest over"
        f" cells for sure, d/d2 is below {EXACT['rectangular']:.3f} on squares and"
        f" {EXACT['hexagonal']:.3f} on hexagons"
    )
