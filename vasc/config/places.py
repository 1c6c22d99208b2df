"""From the location of a validation error to the key of the config and its schema."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from vasc.config.allowed import Schema, resolved
from vasc.config.values import Path

ABSENT: Any = object()
"""Stands for the value of a key that is not in the config."""

_TYPES = {dict: "object", list: "array", str: "string", bool: "boolean"}


@dataclass(frozen=True)
class Place:
    """A key of a config.

    Parameters
    ----------
    path : tuple of str or int
        Keys and list rows from the top.
    value : object
        What the config has there, or ``ABSENT``.
    node : mapping or None
        Schema of the key, None if no such key exists.
    table : mapping or None
        Schema of the table that the key is in.
    is_off_branch : bool
        True for an error about an alternative that the value never meant to be;
        the place is then that of the alternatives.
    """

    path: Path
    value: Any
    node: Schema | None
    table: Schema | None = None
    is_off_branch: bool = False


def find_place(location: Sequence[str | int], tables: Any, root: Schema) -> Place:
    """Find the key that a validation error speaks of.

    The location holds more than keys: the kind that was chosen for a table, and
    the name of each alternative that was tried.

    Parameters
    ----------
    location : sequence of str or int
        The error's ``loc``.
    tables : dict
        The config.
    root : mapping
        JSON schema of the parameters.

    Returns
    -------
    Place
        The key, its value and its schema.
    """
    place = Place((), tables, resolved(root, root))
    for part in location:
        node = place.node or {}
        branches = [b for b in node.get("anyOf", ()) if b.get("type") != "null"]
        if len(branches) == 1:
            node = resolved(branches[0], root)
        if part in node.get("discriminator", {}).get("mapping", ()):
            kind = {"$ref": node["discriminator"]["mapping"][part]}
            place = Place(place.path, place.value, resolved(kind, root), place.table)
        elif len(branches) > 1:
            branch = _branch(str(part), branches, root)
            if branch is None or not _fits(place.value, branch):
                return Place(place.path, place.value, node, place.table, is_off_branch=True)
            place = Place(place.path, place.value, branch, place.table)
        else:
            place = _inside(place, node, part, root)
    return place


def _inside(place: Place, node: Schema, part: str | int, root: Schema) -> Place:
    """Go one key or list row deeper."""
    child: Schema | None = None
    if isinstance(part, int):
        rows = node.get("prefixItems", ())
        child = rows[part] if part < len(rows) else node.get("items")
    elif part in node.get("properties", ()):
        child = node["properties"][part]
    elif isinstance(node.get("additionalProperties"), dict):
        child = node["additionalProperties"]
    try:
        value = place.value[part]
    except (KeyError, IndexError, TypeError):
        value = ABSENT
    found = None if child is None else resolved(child, root)
    return Place((*place.path, part), value, found, node)


def _branch(label: str, branches: list[Schema], root: Schema) -> Schema | None:
    """Find the alternative that a label of the validator names."""
    for branch in branches:
        node = resolved(branch, root)
        if "title" in node and node["title"] in label:
            return node
        names = {
            "array": ("list", "tuple"),
            "object": ("dict",),
            "number": ("float",),
            "integer": ("int",),
            "string": ("str",),
            "boolean": ("bool",),
        }.get(node.get("type", ""), ())
        if any(name in label for name in names):
            return node
    return None


def _fits(value: Any, node: Schema) -> bool:
    """Tell whether a value has the type of an alternative, whatever it holds."""
    kind = node.get("type")
    if isinstance(value, bool) or not isinstance(value, int | float):
        return _TYPES.get(type(value)) == kind
    return kind == "number" or (kind == "integer" and isinstance(value, int))
