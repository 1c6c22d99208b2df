"""Parameters: frozen, typed, bounded values with unit and meaning; unknown keys refused."""

from typing import Any, ClassVar

from pydantic import BaseModel, ConfigDict, Field


class Parameters(BaseModel):
    """Base of all parameter classes.

    A subclass sits beside the code that uses it and holds the only copy of its
    defaults. Values are checked once, when the object is made.
    """

    evidence: ClassVar[str] = ""
    """How far the equations behind the values were read where they were published, as a mark
    and a sentence: [V] read there, [C] confirmed by computing, [T] as the vein thesis tells
    them, [R] recalled, not checked. Empty where the page of the model says it."""

    model_config = ConfigDict(
        frozen=True,
        extra="forbid",
        allow_inf_nan=False,
        use_attribute_docstrings=False,
        validate_default=True,
        hide_input_in_errors=False,
    )


def evidence(parameters: Parameters) -> list[str]:
    """Give what parameters and those within them say on the evidence of their equations."""
    found = [parameters.evidence] if parameters.evidence else []
    for name in type(parameters).model_fields:
        part = getattr(parameters, name)
        if isinstance(part, Parameters):
            found += evidence(part)
    return found


def quantity(meaning: str, *, unit: str = "", default: Any = ..., **bounds: Any) -> Any:
    """Declare a parameter with its meaning, unit and bounds.

    Parameters
    ----------
    meaning : str
        What the number is, in a sentence a biologist can read.
    unit : str
        For example ``"D"`` (segment lengths), ``"steps"``, ``"1/D^2/step"``.
    default : object
        The default; the parameter is required when none is given.
    **bounds
        pydantic's bounds: ``gt``, ``ge``, ``lt``, ``le``, ``min_length``, ...
    """
    extra: dict[str, Any] | None = {"unit": unit} if unit else None
    return Field(default, description=meaning, json_schema_extra=extra, **bounds)
