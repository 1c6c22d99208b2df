"""Classes of parameters as a list of their keys, with meaning, unit and default."""

from typing import Any

from pydantic_core import PydanticUndefined
from sphinx.application import Sphinx

from vasc.parameters import Parameters


def is_parameters(thing: Any) -> bool:
    """Tell whether a thing is a class of parameters."""
    return isinstance(thing, type) and issubclass(thing, Parameters)


def without_signature(
    app: Sphinx, what: str, name: str, thing: Any, options: Any, signature: str, returned: str
) -> tuple[str, None] | None:
    """Leave the signature of a class of parameters out: it says less than the list."""
    return ("", None) if is_parameters(thing) else None


def list_keys(
    app: Sphinx, what: str, name: str, thing: Any, options: Any, lines: list[str]
) -> None:
    """Add a list of the keys to the docstring of a class of parameters."""
    if not is_parameters(thing):
        return
    lines += ["", ":Keys:", ""]
    for key, field in thing.model_fields.items():
        extra = field.json_schema_extra
        unit = extra.get("unit") if isinstance(extra, dict) else None
        default = told(field.default)
        meaning = (field.description or "The model.").replace("*", r"\*")
        facts = f"{unit}; {default}" if unit else default
        lines += [f"    ``{key}`` ({facts})", f"        {meaning}", ""]


def told(default: Any) -> str:
    """Give the words for a default; tables have defaults of their own."""
    if default is PydanticUndefined:
        return "required"
    if default is None or isinstance(default, Parameters):
        return "optional"
    return f"``{default!r}``"


def setup(app: Sphinx) -> dict[str, bool]:
    """Tell autodoc."""
    app.connect("autodoc-process-signature", without_signature)
    app.connect("autodoc-process-docstring", list_keys)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
