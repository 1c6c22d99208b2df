"""What a run says when it has ended."""

from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from vasc.cli.failures import complain
from vasc.cli.interrupts import Interrupts
from vasc.cli.printing import file_size, print_json, print_pairs

if TYPE_CHECKING:
    from vasc.analysis.summaries import Summary, TissueSummary

REASONS = {
    "no_sources": "growth and placement are over, no source is left",
    "nothing_pulled": "growth and placement are over, the sources left pull no vein",
    "livelock": "livelock: veins grow without coming nearer to any source",
    "step_limit": "the last step of the config was reached",
    "at_rest": "no source is to come, and the tissue is at rest",
}
AT_REST = {
    "up-the-gradient": "the tissue is at rest: auxin hardly changes any more",
    "constant-production": "no wall of a vein is steep enough for another vein cell",
}
"""What rest is in models without sources."""


def print_summary(summary: "Summary", files: list[Path], *, as_json: bool) -> None:
    """Write what came of a run, and the files it left."""
    if as_json:
        print_json(json_summary(summary, files))
        return
    print_pairs(
        {
            "steps": summary.steps,
            **(_leaf(summary) if summary.tissue is None else _tissue(summary, summary.tissue)),
            "wall time": f"{summary.wall_seconds:.2f} s",
            "ended": reason_text(summary),
            "written": ", ".join(f"{file} ({file_size(file.stat().st_size)})" for file in files),
        }
    )


def warn_of_veins_outside(summary: "Summary") -> None:
    """Warn of veins that left the blade, where the config can keep them in."""
    from vasc.timeline import Timeline

    if not summary.nodes_outside:
        return
    with Timeline(summary.output) as timeline:
        extension = timeline.config.get("extension")
    if isinstance(extension, dict) and extension.get("kind") == "free":
        complain(
            f"warning: {summary.output}: {summary.nodes_outside:,} nodes lie outside the blade, as"
            ' where veins run across a sinus; extension.kind = "confined" keeps veins in'
        )


def _leaf(summary: "Summary") -> dict[str, Any]:
    """Give the veins of a leaf or stem, and what became of sources: primordia stay."""
    veins = {"nodes": summary.nodes, "segments": summary.segments}
    if summary.nodes_outside is None:
        return veins | {"primordia": summary.sources_placed, "joins": _joins(summary)}
    return veins | {
        "sources": f"{summary.sources_placed:,} placed, {summary.sources_left:,} left",
        "joins": _joins(summary),
        "stalls resolved": summary.stalls_resolved,
        "nodes outside the blade": summary.nodes_outside,
    }


def _joins(summary: "Summary") -> str:
    """Say how many veins joined."""
    return f"{summary.joins:,}, of which {summary.loops:,} closed a loop"


def _tissue(summary: "Summary", tissue: "TissueSummary") -> dict[str, Any]:
    """Give what came of cells, in the words of their model."""
    # in the unit of the model: turnover times of a wall, seconds, or steps
    found: dict[str, Any] = {"time": f"{summary.time:.6g} {tissue.time_unit}"}
    found["cells"] = f"{tissue.cells:,}, with {tissue.walls:,} walls between them"
    span = f"{tissue.concentration_least:.4g} to {tissue.concentration_most:.4g}"
    found["auxin"] = f"{span} {tissue.concentration_unit}".strip()
    if tissue.model == "up-the-gradient":
        return found
    found |= {"vein cells": summary.nodes, "segments": summary.segments}
    if tissue.model == "constant-production":
        return found | {"joins": _joins(summary)}
    return found | {
        "sources": f"{summary.sources_placed:,} placed, {tissue.connected:,} connected to a vein",
        "rounds unsettled": tissue.unsettled,
        "vortices": tissue.vortices,
    }


def json_summary(summary: "Summary", files: list[Path]) -> dict[str, Any]:
    """Give a summary as JSON values."""
    values = asdict(summary)
    del values["output"], values["is_interrupted"]
    # leaves and stems have none of it
    values |= values.pop("tissue") or {}
    return values | {"complete": summary.stop_reason is not None, "files": list(map(str, files))}


def reason_text(summary: "Summary") -> str:
    """Say why a run ended."""
    if summary.stop_reason is None:
        return f"not finished; `vasc resume {summary.output}` goes on"
    if summary.nodes_outside is None and summary.stop_reason == "no_sources":
        return "all primordia have appeared and are connected"
    if summary.tissue is None:
        return REASONS.get(summary.stop_reason, summary.stop_reason)
    if summary.tissue.unsettled and summary.stop_reason == "at_rest":
        return "no source is to come, and the tissue is at rest or had its time to settle"
    return reason_of(summary.tissue.model, summary.stop_reason)


def reason_of(model: str, reason: str) -> str:
    """Say why a run of a model ended, in its own words."""
    if reason == "at_rest" and model in AT_REST:
        return AT_REST[model]
    return REASONS.get(reason, reason)


def end_if_interrupted(summary: "Summary", interrupts: Interrupts) -> None:
    """End the program if the run was stopped from outside.

    Raises
    ------
    typer.Exit
        With 128 and the number of the signal.
    """
    if summary.is_interrupted:
        complain(
            f"interrupted: {summary.output} holds all steps up to {summary.steps};"
            f" `vasc resume {summary.output}` goes on"
        )
        raise typer.Exit(interrupts.exit_code)
