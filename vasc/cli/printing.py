"""Figures on the terminal: aligned for people, JSON for scripts."""

import json
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import typer


def print_json(value: Any) -> None:
    """Write JSON; what is not a number in JSON has to be None already."""
    typer.echo(json.dumps(value, indent=2, allow_nan=False))


def print_pairs(pairs: Mapping[str, Any], indent: str = "") -> None:
    """Write names and values in two columns."""
    width = max((len(name) for name in pairs), default=0)
    for name, value in pairs.items():
        typer.echo(f"{indent}{name:<{width}}  {shown(value)}")


def print_table(header: Sequence[str], rows: Iterable[Sequence[Any]]) -> None:
    """Write rows below a header, every column as wide as its widest entry."""
    lines = [list(header), *([shown(value) for value in row] for row in rows)]
    widths = [max(len(line[column]) for line in lines) for column in range(len(header))]
    for line in lines:
        cells = (f"{cell:<{width}}" for cell, width in zip(line, widths, strict=True))
        typer.echo("  ".join(cells).rstrip())


def shown(value: Any) -> str:
    """Give a value as people read it: thousands apart, few digits, a dash for none."""
    if value is None:
        return "-"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, int):
        return f"{value:,}"
    if isinstance(value, float):
        return f"{value:.6g}"
    if isinstance(value, Mapping):
        return ", ".join(f"{name}: {shown(item)}" for name, item in value.items()) or "-"
    return printable(str(value))


def printable(text: str) -> str:
    r"""Give a text of others on one line, so that no character of it can steer a terminal.

    Examples
    --------
    >>> print(printable("leaf\x1b[2J é"))
    leaf\x1b[2J é
    """
    if text.isprintable():
        return text
    return "".join(
        mark if mark.isprintable() else mark.encode("unicode_escape").decode() for mark in text
    )


def file_size(n_bytes: int) -> str:
    """Give a size in a unit that leaves few digits."""
    for unit, size in (("GB", 1e9), ("MB", 1e6), ("kB", 1e3)):
        if n_bytes >= size:
            return f"{n_bytes / size:.1f} {unit}"
    return f"{n_bytes} bytes"
