"""``vasc show``: what a recorded run is."""

from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from vasc.cli.options import AsJson, RunFile

if TYPE_CHECKING:
    from vasc.timeline import Timeline


EXAMPLES = (
    "vasc show poplar-leaf.h5",
    "vasc show poplar-leaf.h5 --check",
)


def show(
    path: RunFile,
    check: Annotated[
        bool, typer.Option("--check", help="Hold the file against its specification.")
    ] = False,
    as_json: AsJson = False,
) -> None:
    """Show what a run is, how it was made, its sizes and events."""
    refuse_folders(path)
    if check:
        _check(path, as_json=as_json)
        return
    from vasc.cli.printing import print_json
    from vasc.timeline import Timeline

    with Timeline(path) as timeline:
        if as_json:
            print_json(described(timeline))
        else:
            _print(timeline, path)
    _warn(path)


def described(timeline: "Timeline") -> dict[str, Any]:
    """Give what ``show --json`` promises to scripts."""
    from vasc.config.changes import changes_of
    from vasc.config.loading import FILES_KEY
    from vasc.timeline.layout import FORMAT

    counts = timeline.events.counts()
    refined = counts.get("segment_refined", 0)
    placed = timeline.n_rows("sources")
    sessions = [session.get("wall_seconds", {}) for session in timeline.provenance]
    frames = timeline.frames
    config = {key: value for key, value in timeline.config.items() if key != FILES_KEY}
    return {
        "format": FORMAT,
        "version": timeline.version,
        "model": timeline.model,
        "growth": timeline.growth,
        "seed": timeline.seed,
        "steps": timeline.last_step,
        "time": float(frames["time"][-1]) if timeline.n_frames else None,
        "complete": timeline.is_complete,
        "stop_reason": timeline.stop_reason,
        "nodes": timeline.n_rows("nodes") - counts.get("node_retired", 0),
        "segments": timeline.n_rows("segments") - refined,
        "sources_placed": placed,
        "sources_active": placed - counts.get("source_removed", 0),
        **_size_of_tissue(timeline),
        "events": counts,
        "wall_seconds": sum(float(seconds.get("total", 0.0)) for seconds in sessions),
        "config": config,
        "changed": changes_of(timeline.config_toml),
        "evidence": _evidence(config),
    }


def _size_of_tissue(timeline: "Timeline") -> dict[str, Any]:
    """Give cells, walls and auxin with its units; nothing in a run without cells."""
    from vasc.analysis.tissue_units import time_unit, unit_of

    if timeline.tissue is None:
        return {}
    auxin = timeline.fields(-1).concentration if timeline.n_frames else None
    return {
        "cells": timeline.tissue.n_cells,
        "walls": timeline.tissue.n_walls,
        "auxin": None if auxin is None else [float(auxin.min()), float(auxin.max())],
        "auxin_unit": unit_of(timeline.config, "concentration"),
        "time_unit": time_unit(timeline.config),
    }


def in_words_of_the_model(found: dict[str, Any]) -> dict[str, Any]:
    """Give what people are shown of a run: units, and nothing that its model does not have."""
    if "cells" not in found:
        return found
    lacking = {
        "up-the-gradient": {"growth", "nodes", "segments", "sources_placed", "sources_active"},
        "constant-production": {"growth", "sources_placed", "sources_active"},
    }.get(found["model"], {"growth"})
    found = {key: value for key, value in found.items() if key not in lacking}
    time, auxin = found.pop("time_unit"), found.pop("auxin_unit")
    if found["time"] is not None:
        found["time"] = f"{found['time']:.6g} {time}"
    if (span := found.pop("auxin")) is not None:
        found["auxin"] = f"{span[0]:.4g} to {span[1]:.4g} {auxin}".strip()
    return found


def _print(timeline: "Timeline", path: Path) -> None:
    """Write the same for people."""
    from vasc.cli.printing import file_size, print_pairs, printable
    from vasc.cli.summary import reason_of
    from vasc.config.changes import title_with_changes

    found = in_words_of_the_model(described(timeline))
    config, events = found.pop("config"), found.pop("events")
    reason = found.pop("stop_reason")
    del found["changed"]
    title = title_with_changes(str(config.get("title") or "untitled"), timeline.config_toml)
    typer.echo(f"{path}: {printable(title)}")
    if config.get("reference"):
        typer.echo(f"after {printable(str(config['reference']))}")
    for sentence in found.pop("evidence"):
        typer.echo(f"equations: {sentence}")
    outcome = str(timeline.provenance[-1].get("outcome", "")) if timeline.provenance else ""
    if reason:
        ended = reason_of(timeline.model, reason)
    elif outcome.startswith("failed"):
        ended = f"with an error, see sessions; `vasc resume {path}` would meet it again"
    else:
        ended = f"not yet; `vasc resume {path}` goes on"
    typer.echo()
    print_pairs(found | {"ended": ended, "size": file_size(path.stat().st_size)})
    typer.echo("\nevents")
    print_pairs(events, indent="  ")
    typer.echo("\nsessions")
    for session in timeline.provenance:
        software = session.get("software", {})
        typer.echo(
            printable(
                f"  {session.get('kind', 'run')} {session.get('started', '')}"
                f" with vasc {software.get('vasc', '?')}: {session.get('outcome', 'killed')}"
            )
        )
    typer.echo("\nconfig")
    for line in timeline.config_toml.splitlines():
        typer.echo(f"  {printable(line)}")


def _evidence(config: dict[str, Any]) -> list[str]:
    """Say where the equations of a recorded run are from; nothing if its config is of no use."""
    from vasc.config.schema import parameters_from
    from vasc.errors import ConfigError
    from vasc.parameters import evidence

    try:
        return evidence(parameters_from(config))
    except ConfigError:
        return []


def _check(path: Path, *, as_json: bool) -> None:
    """Validate the file; findings end the program with 1."""
    from vasc.cli.printing import print_json
    from vasc.timeline import validate

    refuse_strangers(path)
    findings = validate(path)
    if as_json:
        print_json({"findings": findings, "pass": not findings})
    elif findings:
        for finding in findings:
            typer.echo(f"{path}: {finding}")
    else:
        typer.echo(f"{path}: keeps to its specification")
    if findings:
        raise typer.Exit(1)
    _warn(path)


def _warn(path: Path) -> None:
    """Warn of a log that cannot be used, or is missing."""
    from vasc.cli.failures import complain
    from vasc.timeline.left_behind import concerns

    for concern in concerns(path):
        complain(f"warning: {concern}")


def refuse_folders(path: Path) -> None:
    """Refuse a folder in the place of a run.

    Raises
    ------
    TimelineError
        If it is one.
    """
    from vasc.errors import TimelineError

    if path.is_dir():
        raise TimelineError(f"{path}: is a folder; a recorded run is a file")


def refuse_strangers(path: Path) -> None:
    """Refuse a file that never was a timeline: bad input, no finding about a run.

    A damaged timeline is none of these: it still begins as HDF5, and has its
    format or its frames.

    Raises
    ------
    TimelineError
        If there is no such file, or it is something else.
    """
    from vasc.errors import TimelineError
    from vasc.timeline import guard
    from vasc.timeline.layout import COMMITTED, FORMAT

    try:
        with path.open("rb") as opened:
            is_hdf5 = opened.read(len(guard.SIGNATURE)) == guard.SIGNATURE
    except FileNotFoundError as error:
        raise TimelineError(f"{path}: no such file") from error
    except OSError as error:
        raise TimelineError(f"{path}: cannot be opened: {error.strerror or error}") from error
    if not is_hdf5:
        raise TimelineError(f"{path}: is not an HDF5 file, so it is no timeline")
    is_known = True
    # what cannot even be asked is damaged
    with suppress(TimelineError, *guard.TRANSIENT), guard.open_for_reading(path) as file:
        is_known = guard.attribute(file, "format") == FORMAT or COMMITTED in file
    if not is_known:
        raise TimelineError(f"{path}: is an HDF5 file, but not a timeline (format {FORMAT!r})")
