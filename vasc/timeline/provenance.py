"""Provenance: which software, on what machine, when and for how long; JSON under a schema."""

import importlib.metadata
import json
import platform
import secrets
from collections.abc import Iterable, Mapping
from datetime import UTC, datetime
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any, cast

import h5py
import numpy as np

import vasc

SOFTWARE = ("numpy", "numba", "llvmlite", "scipy", "shapely", "h5py", "matplotlib", "pydantic")
"""Packages whose versions are noted, without importing them."""


def begin_session(
    session: int, *, kind: str, seed: int, parameters: Mapping[str, Any] | None = None
) -> dict[str, Any]:
    """Describe a session that begins now.

    Parameters
    ----------
    session : int
        Its number in the file, from 0.
    kind : str
        ``"run"`` or ``"resume"``.
    seed : int
        The recorded seed.
    parameters : mapping, optional
        The resolved config; a resume has that of the run.

    Returns
    -------
    dict
        A session as the schema describes it, without its end.
    """
    record: dict[str, Any] = {
        "session": session,
        "kind": kind,
        "identifier": secrets.token_hex(16),
        "started": _now(),
        "software": software(),
        "platform": machine(),
        "seed": seed,
    }
    if parameters is not None:
        record["parameters"] = dict(parameters)
    return record


def end_session(
    session: int,
    *,
    outcome: str,
    last_step: int,
    wall_seconds: Mapping[str, float],
    checksums: Mapping[str, str],
) -> dict[str, Any]:
    """Describe how a session ended; merged into its beginning by :func:`sessions`."""
    return {
        "session": session,
        "ended": _now(),
        "outcome": outcome,
        "last_step": last_step,
        "wall_seconds": {name: round(seconds, 6) for name, seconds in wall_seconds.items()},
        "checksums": dict(checksums),
    }


def sessions(records: Iterable[str]) -> list[dict[str, Any]]:
    """Merge the recorded texts into one dict a session.

    A text that is no record (the last one of a killed run may be torn) is left
    out; the session of a killed run has no ``ended``.
    """
    merged: dict[int, dict[str, Any]] = {}
    for text in records:
        try:
            record = json.loads(text)
        except (ValueError, RecursionError):
            continue
        if isinstance(record, dict) and isinstance(record.get("session"), int):
            merged.setdefault(record["session"], {}).update(record)
    return [merged[number] for number in sorted(merged)]


def schema() -> dict[str, Any]:
    """Give the JSON schema of one session."""
    text = files("vasc.timeline").joinpath("provenance.schema.json").read_text(encoding="utf-8")
    return json.loads(text)


@cache
def software() -> dict[str, str]:
    """Give the versions of vasc, Python, HDF5 and the packages that are installed."""
    versions = {
        "vasc": vasc.__version__,
        "python": platform.python_version(),
        "hdf5": h5py.version.hdf5_version,
    }
    for name in SOFTWARE:
        try:
            versions[name] = importlib.metadata.version(name)
        except importlib.metadata.PackageNotFoundError:
            continue
    return versions


@cache
def machine() -> dict[str, Any]:
    """Describe the machine: system, processor, its vector units, and numpy's BLAS."""
    build = cast(dict[str, Any], np.show_config(mode="dicts"))
    return {
        "system": platform.platform(),
        "machine": platform.machine(),
        "processor": _processor(),
        "simd": list(build.get("SIMD Extensions", {}).get("found", [])),
        "blas": str(build.get("Build Dependencies", {}).get("blas", {}).get("name", "unknown")),
    }


def _processor() -> str:
    """Give the processor's name, as the system knows it."""
    try:
        for line in Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    except OSError:
        pass
    return platform.processor() or platform.machine()


def _now() -> str:
    """Give the time of day in UTC, ISO 8601."""
    return datetime.now(UTC).isoformat(timespec="milliseconds")
