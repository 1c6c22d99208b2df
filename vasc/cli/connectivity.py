"""What ``vasc check connectivity`` tells people."""

from collections.abc import Iterable, Mapping
from itertools import groupby
from math import degrees, inf
from pathlib import Path
from typing import Any

import typer

from vasc.cli.printing import print_pairs, print_table, shown
from vasc.validation.stem_phyllotaxis import ConnectivityReport, Prediction, n_sympodia
from vasc.validation.stem_phyllotaxis.lattice import as_pair
from vasc.validation.stem_phyllotaxis.report import NEARBY


def print_connectivity(report: ConnectivityReport, path: Path, output: Path | None) -> None:
    """Write the report on connectivity for people."""
    tie, tied = None if report.local else report.tie, report.prediction.tied
    print_pairs(_stem_lines(report) | _connection_lines(report))
    if report.exceptions:
        typer.echo("\nexceptions" if tie is None else "\nprimordia without all of these")
        rows = [
            (one.primordium, _pair(one.steps), _pair(one.missing), _pair(one.extra))
            for one in report.exceptions
        ]
        print_table(("primordium", "connected to", "missing", "extra"), rows)
    if tie is not None:
        typer.echo(f"\ntie: {tie.explanation}")
    if output is not None:
        typer.echo(f"written: {output}")
    if tie is None:
        what = (
            "the predicted pair, and" if report.local is None else "what their own R/H predicts, at"
        )
        asked = f"{what} a share of {report.least_fraction:g}"
        typer.echo(f"{path}: {'pass' if report.passed else 'FAIL'}; asked: {asked}")
    elif report.passed:
        typer.echo(f"{path}: tied, {_pair(tied)} undecided; what is no tie is as predicted")
    else:
        asked = "all that is no tie, some of what is tied, and the rule of the tie"
        typer.echo(f"{path}: FAIL; asked: {asked}")


def _stem_lines(report: ConnectivityReport) -> dict[str, Any]:
    """Give what is said of the stem itself, by name."""
    graph, interval, ratio = report.graph, report.interval, report.graph.lattice.ratio
    low = f"{interval.low:.4g}" if interval.low > 0.0 else f"{ratio / NEARBY:.4g} or less"
    high = f"{interval.high:.4g}" if interval.high < inf else f"{ratio * NEARBY:.4g} or more"
    lines = {
        "divergence, in degrees": degrees(graph.divergence),
        "R, H, in D": f"{shown(graph.radius)}, {shown(graph.rise)}",
        "R/H": f"{ratio:.4g}; the prediction holds from {low} to {high}",
    }
    if graph.radius_range is not None:
        least, largest = graph.radius_range
        lines["R along the stem"] = (
            f"{shown(least)} to {shown(largest)}, R/H {least / graph.rise:.4g} to"
            f" {largest / graph.rise:.4g}; what follows is of the middle primordium, but for"
            " connected and predicted"
        )
    judged = report.connectivity.judged
    n_primordia = len(graph.primordia)
    lines["primordia"] = f"{n_primordia}; judged: {judged.start} to {judged.stop - 1}"
    return lines


def _connection_lines(report: ConnectivityReport) -> dict[str, Any]:
    """Give what is said of the connections, by name."""
    parastichies, tie = report.parastichies, report.tie
    per_level = report.graph.per_level
    n_systems = n_sympodia(report.steps, per_level)
    lines = {
        "connected": told(report.steps, report.prediction),
        "predicted": told(report.prediction.steps, report.prediction),
        "predicted on the surface": told(report.surface.steps, report.surface),
        "contact parastichies": f"{_pair(parastichies.numbers)},"
        f" {'opposed' if parastichies.is_opposed else 'not opposed'}",
        "separate sympodia": n_systems,
    }
    if report.local is not None:
        judged = report.connectivity.judged
        return lines | {
            "connected": _along({m: report.connectivity.steps[m] for m in judged}),
            "predicted": _along({m: report.local[m] for m in judged}),
            "as their own R/H predicts": f"{report.local_fraction:.3f} of those judged",
        }
    if tie is None:
        return lines | {"exactly the pair": f"{report.fraction:.3f} of those judged"}
    firm = tuple(step for step in report.steps if step not in tie.steps)
    return lines | {
        "separate sympodia": f"{n_sympodia(firm, per_level)}; {n_systems} with tied links",
        "all but tied links": f"{tie.allowed:.3f} of those judged",
        "a tied link": f"{tie.kept:.3f} of those judged",
    }


def told(steps: tuple[int, ...], prediction: Prediction) -> str:
    """Write steps as the papers do; those that a tie leaves undecided apart."""
    tied = tuple(step for step in steps if step in prediction.tied)
    firm = tuple(step for step in steps if step not in tied)
    if not tied:
        return _pair(as_pair(steps))
    return f"{_pair(firm)}; undecided, by a tie: {_pair(tied)}"


def _pair(steps: Iterable[int]) -> str:
    """Write steps as the papers do; a dash for none."""
    text = ", ".join(str(step) for step in steps)
    return f"({text})" if text else "-"


def _along(steps: Mapping[int, tuple[int, ...]]) -> str:
    """Write the steps of primordia from below, those of neighbors together."""
    told = []
    for each, group in groupby(steps, key=lambda number: steps[number]):
        numbers = list(group)
        ends = dict.fromkeys((numbers[0], numbers[-1]))
        told.append(f"{_pair(each)} from {' to '.join(map(str, ends))}")
    return "; ".join(told)
