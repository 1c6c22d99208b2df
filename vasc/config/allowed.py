"""What a key takes, said in words, from the JSON schema of the parameters."""

from collections.abc import Mapping
from typing import Any

from vasc.config.values import written

Schema = Mapping[str, Any]

_NAMES = {
    "number": "a number",
    "integer": "a whole number",
    "boolean": "true or false",
    "string": "a text in quotes",
    "object": "a table",
}
_PLURALS = {"a number": "numbers", "a whole number": "whole numbers", "a text in quotes": "texts"}


def resolved(node: Schema, root: Schema) -> Schema:
    """Follow references of a JSON schema; keys beside a reference are kept."""
    while "$ref" in node:
        beside = {key: value for key, value in node.items() if key != "$ref"}
        node = {**root["$defs"][node["$ref"].rpartition("/")[2]], **beside}
    return node


def allowed(node: Schema, root: Schema) -> str:
    """Say what a key takes.

    Parameters
    ----------
    node : mapping
        The part of the schema that belongs to the key.
    root : mapping
        The whole schema.

    Returns
    -------
    str
        For example ``a number greater than 0, in D``.

    Examples
    --------
    >>> allowed({"type": "number", "exclusiveMinimum": 0, "unit": "D"}, {})
    'a number greater than 0, in D'
    """
    unit = _unit(node, root)
    return _without_unit(node, root) + (f", in {unit}" if unit else "")


def kinds(node: Schema) -> list[str]:
    """Give the kinds of a table that comes in several, empty if it does not."""
    return list(node.get("discriminator", {}).get("mapping", ()))


def choices(node: Schema, root: Schema) -> list[str]:
    """Give the words a key takes, empty if it takes others, too."""
    node = resolved(node, root)
    found = [word for part in node.get("anyOf", ()) for word in choices(part, root)]
    return found or list(node.get("enum", ()))


def listed(values: list[str]) -> str:
    """Write the kinds or words that are allowed."""
    return ", ".join(written(value) for value in values)


def _unit(node: Schema, root: Schema) -> str:
    """Give the unit of a key, wherever the schema keeps it."""
    node = resolved(node, root)
    if "unit" in node:
        return str(node["unit"])
    return next((unit for part in node.get("anyOf", ()) if (unit := _unit(part, root))), "")


def _without_unit(node: Schema, root: Schema) -> str:
    """Say what a key takes, but for the unit."""
    node = resolved(node, root)
    if kinds(node):
        return f"a table with kind one of {listed(kinds(node))}"
    if "anyOf" in node or "oneOf" in node:
        parts = [_without_unit(part, root) for part in node.get("anyOf") or node["oneOf"]]
        return " or ".join(dict.fromkeys(part for part in parts if part))
    if "const" in node:
        return written(node["const"])
    if "enum" in node:
        return f"one of {listed(node['enum'])}"
    kind = node.get("type", "")
    if kind == "null":
        return ""
    if kind == "array":
        return _list(node, root)
    return _NAMES.get(kind, "a value") + _bounds(node)


def _list(node: Schema, root: Schema) -> str:
    """Say what a list holds, and how many."""
    items = node.get("prefixItems") or ([node["items"]] if "items" in node else [])
    said = dict.fromkeys(_without_unit(item, root) for item in items)
    fewest, most = node.get("minItems"), node.get("maxItems")
    if not said:
        content = "values"
    elif len(said) > 1:
        return f"a list [{', '.join(_without_unit(item, root) for item in items)}]"
    else:
        content = _many(next(iter(said)))
    if fewest is not None and fewest == most:
        return f"a list of {fewest} {content}"
    if fewest and most:
        return f"a list of {fewest} to {most} {content}"
    if fewest:
        return f"a list of at least {fewest} {content}"
    return f"a list of {content}"


def _many(single: str) -> str:
    """Say of many what was said of one."""
    for one, many in _PLURALS.items():
        if single.startswith(one):
            return many + single[len(one) :]
    return f"entries, each {single}"


def _bounds(node: Schema) -> str:
    """Say between which bounds a number lies, or how long a text is."""
    said = []
    for key, words in (
        ("exclusiveMinimum", "greater than"),
        ("minimum", "of at least"),
        ("exclusiveMaximum", "less than"),
        ("maximum", "of at most"),
    ):
        if key in node:
            said.append(f"{words} {node[key]:g}")
    if node.get("minLength"):
        said.append("not empty" if node["minLength"] == 1 else f"of {node['minLength']} or more")
    if "maxLength" in node:
        said.append(f"of at most {node['maxLength']} characters")
    return f" {' and '.join(said)}" if said else ""
