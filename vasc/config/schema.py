"""What a config may say: the parameters of the models, joined by ``kind``."""

from collections.abc import Mapping
from functools import cache
from importlib.metadata import entry_points
from typing import Annotated, Any, Union

from pydantic import Field, ValidationError, create_model

from vasc.analysis.widths import WidthParameters
from vasc.config.messages import problems, unknown_kind
from vasc.config.places import ABSENT
from vasc.config.values import Path, as_json, unusable_values
from vasc.errors import ConfigError
from vasc.parameters import Parameters, quantity

Models = Mapping[str, type[Parameters]]


@cache
def models() -> Models:
    """Give what a config may hold for every model by kind: installed ones, and ours.

    Our models know installed growths, too. None of ours can be replaced.
    """
    from vasc.growth import GROWTHS
    from vasc.models import MODELS

    growths = {**installed("vasc.growth"), **GROWTHS}
    ours = {
        # a stem has no growth to choose: what its apex leaves behind stays
        kind: with_growths(model, growths) if "growth" in model.model_fields else model
        for kind, model in MODELS.items()
    }
    known = {**installed("vasc.models"), **ours}
    return {kind: with_drawing(model) for kind, model in known.items()}


def installed(group: str) -> dict[str, type[Parameters]]:
    """Load what installed packages offer as entry points of a group, by name.

    Raises
    ------
    ConfigError
        If a package cannot be loaded; the message names it.
    """
    found = {}
    for point in entry_points(group=group):
        try:
            found[point.name] = point.load()
        except Exception as error:
            raise ConfigError(
                f"the installed {group} {point.name!r} ({point.value}) cannot be loaded: {error}"
            ) from error
    return found


def with_growths(
    model: type[Parameters], growths: Mapping[str, type[Parameters]]
) -> type[Parameters]:
    """Let the growth of a model be any of those given."""
    any_growth: Any = Union[tuple(growths.values())]  # noqa: UP007
    any_growth = Annotated[any_growth, Field(discriminator="kind")]
    field = model.model_fields["growth"]
    growth = quantity(field.description or "", default=field.default)
    return _widened(model, growth=(any_growth, growth))


def with_drawing(model: type[Parameters]) -> type[Parameters]:
    """Add to a model's parameters the table that only drawing and statistics read.

    A model does not know how it will be drawn, and a config is one file.
    """
    widths = quantity("How wide veins are, for pictures.", default=WidthParameters())
    return _widened(model, widths=(WidthParameters, widths))


def _widened(model: type[Parameters], **fields: Any) -> type[Parameters]:
    """Give a model's parameters with fields added or replaced."""
    widened: type[Parameters] = create_model(
        model.__name__,
        __base__=model,
        __module__=model.__module__,
        __doc__=model.__doc__,
        **fields,
    )
    return widened


def parameters_from(tables: dict[str, Any], known: Models | None = None) -> Parameters:
    """Make the parameters that the tables of a config describe.

    Types are taken as TOML has them: a number in quotes is a text, ``1.0`` is
    not a whole number, and ``true`` is no number.

    Parameters
    ----------
    tables : dict
        What was read from TOML or JSON.
    known : mapping, optional
        Classes by kind; all models when not given.

    Returns
    -------
    object
        The parameters of one model.

    Raises
    ------
    ConfigError
        With one line for every problem.
    """
    known = models() if known is None else known
    found: dict[Path, str] = {}
    try:
        found = unusable_values(tables)
        kind = tables.get("kind", ABSENT)
        if not isinstance(kind, str) or kind not in known:
            found[("kind",)] = unknown_kind(kind, list(known))
            raise ConfigError(_refused(tables, known, found))
        text = as_json(tables)
        parameters = known[kind].model_validate_json(text, strict=True)
    except ValidationError as error:
        others = frozenset(key for model in known.values() for key in model.model_fields)
        elsewhere = others - set(known[kind].model_fields)
        found = {**problems(error, tables, json_schema_of(known[kind]), elsewhere), **found}
    if found:
        raise ConfigError(_in_order(found, tables))
    return parameters


def resolved_tables(parameters: Parameters) -> dict[str, Any]:
    """Give parameters as plain tables, with every default filled in and no nulls."""
    return parameters.model_dump(mode="json", exclude_none=True)


def to_toml(parameters: Parameters) -> str:
    """Write parameters as a config; reading it gives equal parameters."""
    import tomli_w

    return tomli_w.dumps(resolved_tables(parameters))


def json_schema(kind: str | None = None, known: Models | None = None) -> dict[str, Any]:
    """Give the JSON schema of a config.

    Parameters
    ----------
    kind : str, optional
        A model; the schema of all of them, told apart by ``kind``, if not given.
    known : mapping, optional
        Classes by kind; all models when not given.

    Returns
    -------
    dict
        A JSON schema (draft 2020-12).

    Raises
    ------
    ConfigError
        If there is no such model.
    """
    from pydantic.json_schema import models_json_schema

    known = models() if known is None else known
    head = {"$schema": "https://json-schema.org/draft/2020-12/schema"}
    if kind is not None:
        if kind not in known:
            raise ConfigError(unknown_kind(kind, list(known)))
        return head | json_schema_of(known[kind])
    references, definitions = models_json_schema(
        [(model, "validation") for model in known.values()], title="A vasc experiment"
    )
    by_kind = {name: references[model, "validation"]["$ref"] for name, model in known.items()}
    return {
        **head,
        **definitions,
        "oneOf": [{"$ref": reference} for reference in by_kind.values()],
        "discriminator": {"propertyName": "kind", "mapping": by_kind},
        "required": ["kind"],
    }


@cache
def json_schema_of(model: type[Parameters]) -> dict[str, Any]:
    """Give the JSON schema of one class of parameters."""
    return model.model_json_schema()


def _refused(tables: dict[str, Any], known: Models, found: dict[Path, str]) -> list[str]:
    """Give what is wrong with a config of no known kind: also what no model would accept."""
    shared: list[str] | None = None
    for kind in known:
        try:
            parameters_from({**tables, "kind": kind}, known)
            lines = []
        except ConfigError as error:
            lines = error.problems
        shared = lines if shared is None else [line for line in shared if line in lines]
    first = found.pop(("kind",))
    return [first, *(shared or _in_order(found, tables))]


def _in_order(found: dict[Path, str], tables: dict[str, Any]) -> list[str]:
    """Give the lines in the order of the keys in the config, the missing ones first."""
    order = list(tables)

    def rank(path: Path) -> int:
        return order.index(path[0]) if path and path[0] in tables else -1

    return [line for path in sorted(found, key=rank) for line in found[path].split("\n")]
