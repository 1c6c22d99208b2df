"""From a file to the tables of TOML; whatever is wrong with the text is one line."""

import re
import tomllib
from pathlib import Path
from typing import Any

from vasc.errors import ConfigError
from vasc.limits import CONFIG_BYTES, CONFIG_DEPTH

_HDF5_SIGNATURE = b"\x89HDF\r\n\x1a\n"
_PART = r"""(?:[\w-]++|"[^"\n]*+"|'[^'\n]*+')"""
_LONG_KEY = re.compile(rf"""(?<![\w."'-]){_PART}(?:[ \t]*+\.[ \t]*+{_PART}){{100}}""")
_PLACE = re.compile(r"\s*\(at (?:line (\d+), column (\d+)|end of document)\)$")


def read_text(path: Path) -> str:
    """Give the text of a config file, without a byte order mark.

    Parameters
    ----------
    path : Path
        The file.

    Returns
    -------
    str
        The text, as it is in the file.

    Raises
    ------
    ConfigError
        If the file cannot be read, is too large, or is not UTF-8 text.
    """
    try:
        if path.is_dir():
            raise ConfigError(f"{path}: is a folder; a config is a TOML file")
        with path.open("rb") as file:
            raw = file.read(CONFIG_BYTES + 1)
    except OSError as error:
        raise ConfigError(f"{path}: cannot be read: {error.strerror or error}") from error
    except ValueError as error:
        raise ConfigError(f"{str(path)!r}: is not the name of a file") from error
    if raw.startswith(_HDF5_SIGNATURE):
        raise ConfigError(f"{path}: is a timeline, not a config; try `vasc resume` or `vasc show`")
    if len(raw) > CONFIG_BYTES:
        raise ConfigError(f"{path}: is larger than {CONFIG_BYTES:,} bytes, the limit of a config")
    return _decoded(raw, path)


def parse(text: str, name: str) -> dict[str, Any]:
    """Read TOML.

    Parameters
    ----------
    text : str
        The TOML.
    name : str
        How messages call it.

    Returns
    -------
    dict
        The tables.

    Raises
    ------
    ConfigError
        If the text is not TOML; the message names line and column.
    """
    if _LONG_KEY.search(text):
        # tomllib would take memory for each level of each key
        raise ConfigError(f"{name}: lists or tables are nested too deeply")
    try:
        tables = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise ConfigError(f"{name}: {_located(str(error), text)}") from error
    except RecursionError as error:
        raise ConfigError(f"{name}: lists or tables are nested too deeply") from error
    except ValueError as error:
        # Python refuses to read integers of thousands of digits
        raise ConfigError(f"{name}: a number is too long to be read: {error}") from error
    refuse_deep(tables, name)
    return tables


def refuse_deep(tables: Any, name: str) -> None:
    """Refuse tables and lists that are nested so deeply that no code can walk them.

    Raises
    ------
    ConfigError
        If there are more than ``CONFIG_DEPTH`` levels.
    """
    level = [tables]
    for _ in range(CONFIG_DEPTH):
        inside: list[Any] = []
        for value in level:
            if isinstance(value, dict | list):
                inside += value.values() if isinstance(value, dict) else value
        level = inside
    if any(isinstance(value, dict | list) for value in level):
        raise ConfigError(f"{name}: lists or tables are nested too deeply")


def _decoded(raw: bytes, path: Path) -> str:
    """Decode UTF-8, or name the line where it stops being that."""
    if raw.startswith((b"\xff\xfe", b"\xfe\xff")):
        raise ConfigError(f"{path}: is UTF-16 text; save it as UTF-8")
    try:
        return raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = raw.count(b"\n", 0, error.start) + 1
        column = error.start - (raw.rfind(b"\n", 0, error.start) + 1) + 1
        byte = raw[error.start]
        raise ConfigError(
            f"{path}: line {line}, column {column}: byte 0x{byte:02x} is not UTF-8 text"
        ) from error


def _located(message: str, text: str) -> str:
    """Put the place of a syntax error before what is wrong there."""
    place = _PLACE.search(message)
    if place is None:
        return f"not TOML: {message}"
    line, column = place.groups()
    if line is None:
        lines = text.split("\n")
        line, column = str(len(lines)), str(len(lines[-1]) + 1)
    return f"line {line}, column {column}: not TOML: {message[: place.start()]}"
