"""Changes to a config from outside the file: ``growth.final_length=2000``."""

import copy
import tomllib
from collections.abc import Iterable
from typing import Any

from vasc.config.values import dotted, shortened
from vasc.errors import ConfigError

Override = tuple[tuple[str, ...], Any]
"""Keys from the top of a config, and the new value."""


def parse_override(text: str) -> Override:
    """Read one ``KEY=VALUE``; the value is TOML, or a text if it is not TOML.

    Parameters
    ----------
    text : str
        A dotted key, an equals sign, a value.

    Returns
    -------
    tuple
        The keys from the top of the config, and the value.

    Raises
    ------
    ConfigError
        If there is no equals sign, what is before it is not a TOML key, or it is no text.

    Examples
    --------
    >>> parse_override("growth.final_length=2e3")
    (('growth', 'final_length'), 2000.0)
    >>> parse_override("growth.kind=none")
    (('growth', 'kind'), 'none')
    """
    key, equals, value = text.partition("=")
    if not equals:
        raise ConfigError(
            f"--set {shortened(text)}: must be KEY=VALUE, as in growth.final_length=2000"
        )
    try:
        text.encode()
    except UnicodeEncodeError as error:
        raise ConfigError(f"--set {shortened(text)!a}: is not a text in UTF-8") from error
    return _keys(key.strip(), text), _value(value.strip())


def overridden(tables: dict[str, Any], overrides: Iterable[Override]) -> dict[str, Any]:
    """Give a copy of the tables of a config with values set, in order.

    Parameters
    ----------
    tables : dict
        What was read; left as it is.
    overrides : iterable of Override
        The changes; tables that do not exist are made.

    Returns
    -------
    dict
        The changed tables.

    Raises
    ------
    ConfigError
        If a key leads through something that is not a table.
    """
    changed = copy.deepcopy(tables)
    for keys, value in overrides:
        table = changed
        for depth, key in enumerate(keys[:-1], start=1):
            table = table.setdefault(key, {})
            if not isinstance(table, dict):
                raise ConfigError(
                    f"--set {dotted(keys)}: {dotted(keys[:depth])} is not a table in this config"
                )
        table[keys[-1]] = copy.deepcopy(value)
    return changed


def _keys(key: str, text: str) -> tuple[str, ...]:
    """Split a dotted key as TOML does, quotes included."""
    try:
        table: Any = tomllib.loads(f"{key} = 0")
    except (ValueError, RecursionError):
        table = None
    keys: list[str] = []
    while isinstance(table, dict) and len(table) == 1:
        ((name, table),) = table.items()
        keys.append(name)
    if table != 0 or not keys:
        raise ConfigError(
            f"--set {shortened(text)}: {shortened(repr(key))} is not a key,"
            " as growth.final_length is"
        )
    return tuple(keys)


def _value(value: str) -> Any:
    """Read a TOML value; what is not TOML is a text."""
    try:
        tables = tomllib.loads(f"value = {value}")
    except (ValueError, RecursionError):
        return value
    return tables["value"] if len(tables) == 1 else value
