"""What a run says when it has ended."""

from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from vasc.cli.failures import complain
from vasc.cli.interrupts import Interrupts
from vasc.cli.printing import file_size, print_json, print_pairs

if TYPE_CHECKING:
    from vasc.experiment import Summary

REASONS = {
    "no_sources": "growth and placement are over, no source is left",
    "nothing_pulled": "growth and placement are over, the sources left pull no vein",
    "livelock": "livelock: veins grow without coming nearer to any source",
    "step_limit": "the last step of the config was reached",
    "at_rest": "no source is to come, and the tissue is at rest",
}


def print_summary(summary: "Summary", files: list[Path], *, as_json: bool) -> None:
    """Write what came of a run, and the files it left."""
    if as_json:
        print_json(json_summary(summary, files))
        return
    print_pairs(
        {
            "steps": summary.steps,
            **_cells(summary),
            "nodes": summary.nodes,
            "segments": summary.segments,
            **_sources(summary),
            "wall time": f"{summary.wall_seconds:.2f} s",
            "ended": reason_text(summary),
            "written": ", ".join(f"{file} ({file_size(file.stat().st_size)})" for file in files),
        }
    )


def _cells(summary: "Summary") -> dict[str, Any]:
    """Give the time and the size of a tissue; nothing in a run without cells."""
    if summary.tissue is None:
        return {}
    cells = f"{summary.tissue.cells:,}, with {summary.tissue.walls:,} walls between them"
    # in the unit of the model: turnover times of a wall, seconds, or steps
    return {"time": f"{summary.time:.6g}", "cells": cells}


def _sources(summary: "Summary") -> dict[str, Any]:
    """Give what became of sources: those of a leaf are drained, primordia stay."""
    if summary.tissue is not None:
        connected = f"{summary.tissue.connected:,} connected to a vein"
        return {
            "sources": f"{summary.sources_placed:,} placed, {connected}",
            "rounds unsettled": summary.tissue.unsettled,
            "vortices": summary.tissue.vortices,
        }
    joins = f"{summary.joins:,}, of which {summary.loops:,} closed a loop"
    if summary.nodes_outside is None:
        return {"primordia": summary.sources_placed, "joins": joins}
    return {
        "sources": f"{summary.sources_placed:,} placed, {summary.sources_left:,} left",
        "joins": joins,
        "stalls resolved": summary.stalls_resolved,
        "nodes outside the blade": summary.nodes_outside,
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
    if summary.tissue is not None and summary.tissue.unsettled and summary.stop_reason == "at_rest":
        return "no source is to come, and the tissue is at rest or had its time to settle"
    return REASONS.get(summary.stop_reason, summary.stop_reason)


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
