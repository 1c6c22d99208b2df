"""What is wrong with a config: one line a problem, with key, value and what is allowed."""

import difflib
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from vasc.config.allowed import Schema, allowed, choices, kinds, listed, resolved
from vasc.config.places import ABSENT, Place, find_place
from vasc.config.values import Path, assignment, dotted, written
from vasc.limits import NAME_LENGTH

if TYPE_CHECKING:
    from pydantic import ValidationError

FREE_TABLES = ("printed",)
"""Tables whose keys are the writer's own, so that none of them is a misplaced one."""


def problems(
    error: "ValidationError",
    tables: dict[str, Any],
    root: Schema,
    elsewhere: frozenset[str] = frozenset(),
) -> dict[Path, str]:
    """Describe every problem that a validation found.

    Parameters
    ----------
    error : pydantic.ValidationError
        What the parameters refused.
    tables : dict
        The config as it was read.
    root : mapping
        JSON schema of the parameters.
    elsewhere : frozenset of str
        Keys that other models have at the top of a config.

    Returns
    -------
    dict
        From the path of a key to one line.
    """
    lines: dict[Path, str] = {}
    off_branch: dict[Path, str] = {}
    details = error.errors(include_url=False)
    missing = {tuple(detail["loc"]) for detail in details if detail["type"] == "missing"}
    misspelt = _misspelt(details, missing, tables, root)
    for detail in details:
        if tuple(detail["loc"]) in misspelt:
            continue
        place = find_place(detail["loc"], tables, root)
        if place.is_off_branch:
            off_branch[place.path] = _wrong_value(place, root)
            continue
        path, line = _described(detail, place, tables, root)
        if detail["type"] == "extra_forbidden" and len(path) == 1 and path[0] in elsewhere:
            line = _of_other_models(place, root) or line
        # several rules of one table may fail, and each is worth its line
        said = lines[path].split("\n") if path in lines else []
        lines[path] = "\n".join(said if line in said else [*said, line])
    for path, line in off_branch.items():
        if not any(found[: len(path)] == path for found in lines):
            lines[path] = line
    return lines


def _misspelt(details: Any, missing: set[Any], tables: dict[str, Any], root: Schema) -> set[Any]:
    """Give the locations of missing keys that are there, under a name nearly the same."""
    found = set()
    for detail in details:
        if detail["type"] == "extra_forbidden":
            place, around = find_place(detail["loc"], tables, root), tuple(detail["loc"][:-1])
            key = str(place.path[-1])
            if not _owning_tables(place, key, root):
                found |= {(*around, name) for name in _close(key, _keys_of(place))} & missing
    return found


def unknown_kind(kind: Any, known: Sequence[str]) -> str:
    """Describe a ``kind`` at the top of a config that names no model."""
    if kind is ABSENT:
        return f"kind: missing; must be one of {listed(list(known))}"
    return f"{assignment(['kind'], kind)}: must be one of {listed(list(known))}" + nearest(
        kind, known
    )


def nearest(word: Any, known: Iterable[str]) -> str:
    """Give ``; nearest: ...`` for the known word most like this one, or nothing."""
    close = _close(word, known)
    return f"; nearest: {written(close[0])}" if close else ""


def _close(word: Any, known: Iterable[str]) -> list[str]:
    """Give the known word most like this one, or none."""
    if not isinstance(word, str) or len(word) > NAME_LENGTH:
        return []
    return difflib.get_close_matches(word, list(known), n=1, cutoff=0.5)


def _described(detail: Any, place: Place, tables: dict[str, Any], root: Schema) -> tuple[Path, str]:
    """Give the key that is wrong and the line that says so."""
    code = detail["type"]
    if code in ("value_error", "assertion_error"):
        return place.path, _broken_rule(place, str(detail["ctx"]["error"]))
    if code == "extra_forbidden":
        return place.path, _unknown_key(place, tables, root)
    if code == "union_tag_not_found":
        path = (*place.path, "kind")
        return path, f"{dotted(path)}: missing; must be one of {listed(kinds(place.node or {}))}"
    if code == "union_tag_invalid":
        path, known = (*place.path, "kind"), kinds(place.node or {})
        value = place.value["kind"]
        line = f"{assignment(path, value)}: must be one of {listed(known)}{nearest(value, known)}"
        return path, line
    if code == "missing" and isinstance(place.path[-1], int):
        # a list that is too short: the list is wrong, not its absent row
        place = find_place(detail["loc"][:-1], tables, root)
        return place.path, _wrong_value(place, root)
    if code == "missing":
        return place.path, _missing(place, root)
    if code == "json_invalid" or place.node is None:
        return place.path, _broken_rule(place, detail["msg"])
    return place.path, _wrong_value(place, root)


def _broken_rule(place: Place, reason: str) -> str:
    """Describe what a rule of the parameters refused, in the rule's own words."""
    if not place.path:
        return reason
    if place.value is ABSENT or isinstance(place.value, dict):
        return f"{dotted(place.path)}: {reason}"
    return f"{assignment(place.path, place.value)}: {reason}"


def _wrong_value(place: Place, root: Schema) -> str:
    """Describe a value that is of the wrong type or out of range."""
    node = place.node or {}
    line = f"{assignment(place.path, place.value)}: must be {allowed(node, root)}"
    return line + nearest(place.value, choices(node, root))


def _missing(place: Place, root: Schema) -> str:
    """Describe a key or table that has to be there."""
    name, node = dotted(place.path), place.node or {}
    if kinds(node):
        return f"{name}: missing; add a table [{name}] with kind one of {listed(kinds(node))}"
    if node.get("type") == "object":
        needed = ", ".join(node.get("required", ()))
        return f"{name}: missing; add a table [{name}]" + (f" with {needed}" if needed else "")
    return f"{name}: missing; must be {allowed(node, root)}"


def _unknown_key(place: Place, tables: dict[str, Any], root: Schema) -> str:
    """Describe a key that does not exist, and the one that was probably meant."""
    key, known = str(place.path[-1]), _keys_of(place)
    kind = (place.table or {}).get("properties", {}).get("kind", {}).get("const")
    of_kind = f" for kind {written(kind)}" if kind and len(place.path) > 1 else ""
    line = f"{assignment(place.path, place.value)}: unknown key{of_kind}"
    if others := _kinds_with(place, key, root):
        choice = " or ".join(written(other) for other in others)
        return f"{line}{nearest(key, known)}; leave it out, or choose kind {choice}"
    if owners := _owning_tables(place, key, root):
        return f"{line}; it belongs in [{'] or ['.join(owners)}]"
    return line + (nearest(key, known) or f"; allowed: {', '.join(known)}")


def _of_other_models(place: Place, root: Schema) -> str:
    """Describe a key of other models at the top; nothing where a table of this one has it."""
    key = str(place.path[-1])
    if _owning_tables(place, key, root):
        return ""
    kind = (place.table or {}).get("properties", {}).get("kind", {}).get("const")
    what = f"the table [{key}]" if isinstance(place.value, dict) else key
    return (
        f"{assignment(place.path, place.value)}: unknown key; other models have {key}, kind"
        f" {written(kind)} has none: remove {what}"
    )


def _keys_of(place: Place) -> list[str]:
    """Give the keys of the table that a key is in."""
    return list((place.table or {}).get("properties", ()))


def _kinds_with(place: Place, key: str, root: Schema) -> list[str]:
    """Give the kinds of the table a key is in that have it, where that comes in several."""
    node = root.get("properties", {}).get(dotted(place.path[:-1]), {})
    mapping = resolved(node, root).get("discriminator", {}).get("mapping", {})
    return [
        kind
        for kind, reference in mapping.items()
        if key in resolved({"$ref": reference}, root).get("properties", ())
    ]


def _owning_tables(place: Place, key: str, root: Schema) -> list[str]:
    """Give the other tables that have a key."""
    return [name for name in _owners(key, root) if name != dotted(place.path[:-1])]


def _owners(key: str, root: Schema) -> list[str]:
    """Give the tables that have a key."""
    return [
        name
        for name, node in resolved(root, root).get("properties", {}).items()
        if name not in FREE_TABLES
        and any(key in part.get("properties", ()) for part in _parts(node, root))
    ]


def _parts(node: Schema, root: Schema) -> list[Schema]:
    """Give the schemas of all kinds of a table."""
    node = resolved(node, root)
    alternatives = node.get("oneOf") or node.get("anyOf") or [node]
    return [resolved(part, root) for part in alternatives]
