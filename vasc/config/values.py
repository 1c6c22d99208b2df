"""How keys and values of a config are written in messages."""

import json
import math
import re
from collections.abc import Sequence
from datetime import date, datetime, time
from typing import Any

Path = tuple[str | int, ...]
"""Where a value sits in a config: keys of tables and row numbers of lists."""

LONGEST_VALUE = 60
LARGEST_INTEGER = 2**63 - 1

_BARE_KEY = re.compile(r"[A-Za-z0-9_-]+")


def dotted(path: Sequence[str | int]) -> str:
    """Write a path as TOML does: ``domain.seeds[2].x``.

    Examples
    --------
    >>> dotted(("placement", "points", 3))
    'placement.points[3]'
    """
    text = ""
    for part in path:
        if isinstance(part, int):
            text += f"[{part}]"
        else:
            key = part if _BARE_KEY.fullmatch(part) else json.dumps(part)
            text += f".{key}" if text else key
    return shortened(text, 2 * LONGEST_VALUE)


def written(value: Any) -> str:
    """Write a value as in a TOML file, on one line, shortened in the middle.

    Examples
    --------
    >>> written({"kind": "none", "flag": True})
    '{ kind = "none", flag = true }'
    """
    return shortened(_written(value, depth=0), LONGEST_VALUE)


def assignment(path: Sequence[str | int], value: Any) -> str:
    """Write a key and its value, ``growth.final_length = -3``."""
    return f"{dotted(path)} = {written(value)}"


def unusable_values(value: Any, path: Path = ()) -> dict[Path, str]:
    """Find the values that TOML allows and no parameter can hold.

    Parameters
    ----------
    value : object
        What ``tomllib`` read.
    path : tuple of str or int
        Where the value sits.

    Returns
    -------
    dict
        From the path of a value to the line that describes the problem; dates,
        numbers that are not finite, and integers beyond 64 bits.
    """
    if isinstance(value, dict):
        items: Any = value.items()
    elif isinstance(value, list):
        items = enumerate(value)
    else:
        problem = _problem(value)
        return {path: f"{assignment(path, value)}: {problem}"} if problem else {}
    problems: dict[Path, str] = {}
    for key, item in items:
        problems.update(unusable_values(item, (*path, key)))
    return problems


def as_json(value: Any) -> str:
    """Write tables as JSON for the parameters to check; what no parameter can hold is left out.

    Integers beyond 64 bits become null, which is no number either: Python does not write
    those of thousands of digits. :func:`unusable_values` describes them.
    """
    return json.dumps(_without_huge(value), default=str)


def _without_huge(value: Any) -> Any:
    """Give tables without integers beyond 64 bits."""
    if isinstance(value, dict):
        return {key: _without_huge(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_without_huge(item) for item in value]
    return None if isinstance(value, int) and abs(value) > LARGEST_INTEGER else value


def _problem(value: Any) -> str:
    """Say why a single value cannot be used; empty if it can."""
    if isinstance(value, float) and not math.isfinite(value):
        return "must be a finite number"
    if isinstance(value, int) and abs(value) > LARGEST_INTEGER:
        return "must be a whole number of at most 64 bits"
    if isinstance(value, date | time):
        return "is a date or time, which no key takes; a text needs quotes"
    return ""


def _written(value: Any, depth: int) -> str:
    """Write a value in full, except below a few levels of nesting."""
    if depth > 3:
        return "..."
    if isinstance(value, dict):
        inside = ", ".join(
            f"{dotted([key])} = {_written(item, depth + 1)}" for key, item in _first(value.items())
        )
        return f"{{ {inside} }}" if inside else "{}"
    if isinstance(value, list | tuple):
        return f"[{', '.join(_written(item, depth + 1) for item in _first(value))}]"
    if isinstance(value, int) and not isinstance(value, bool) and abs(value) > 10**40:
        return f"{'-' if value < 0 else ''}(about 2^{value.bit_length() - 1})"
    if isinstance(value, datetime | date | time):
        return value.isoformat()
    if isinstance(value, str):
        # quoted by json so that line ends and control characters stay visible
        return json.dumps(value[: 4 * LONGEST_VALUE], ensure_ascii=not value.isprintable())
    return json.dumps(value, default=str).replace("Infinity", "inf").replace("NaN", "nan")


def _first(items: Any, limit: int = LONGEST_VALUE) -> list[Any]:
    """Give the first items, as many as a message could ever show."""
    return [item for item, _ in zip(items, range(limit), strict=False)]


def shortened(text: str, longest: int = LONGEST_VALUE) -> str:
    """Cut the middle out of a text that is longer than ``longest``, which is at least 30.

    Examples
    --------
    >>> shortened("9" * 20_000, 30)
    '999999999999999 ... 9999999999'
    """
    if len(text) <= longest:
        return text
    return f"{text[: longest - 15]} ... {text[-10:]}"
