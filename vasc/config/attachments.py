"""The files that a config refers to, and how a timeline carries them."""

import base64
import binascii
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from vasc.config.values import Path as KeyPath
from vasc.config.values import assignment
from vasc.errors import ConfigError, OutputError, TimelineError
from vasc.limits import FILE_BYTES

FILE_KEY = "file"
"""A key of this name, in any table, names a file, relative to the config's folder."""


def referenced_files(tables: Any, path: KeyPath = ()) -> dict[KeyPath, str]:
    """Find the files that a config refers to.

    Parameters
    ----------
    tables : dict
        The config.
    path : tuple of str or int
        Where the tables sit.

    Returns
    -------
    dict
        From the path of a key to the file it names.
    """
    found: dict[KeyPath, str] = {}
    if isinstance(tables, dict):
        for key, value in tables.items():
            if key == FILE_KEY and isinstance(value, str):
                found[(*path, key)] = value
            else:
                found.update(referenced_files(value, (*path, key)))
    elif isinstance(tables, list):
        for row, value in enumerate(tables):
            found.update(referenced_files(value, (*path, row)))
    return found


def missing_files(tables: dict[str, Any], folder: Path) -> list[str]:
    """Describe every referenced file that cannot be used, one line each."""
    lines = []
    for key, name in referenced_files(tables).items():
        if problem := _problem(folder, name):
            lines.append(f"{assignment(key, name)}: {problem}")
    return lines


def packed(tables: dict[str, Any], folder: Path) -> dict[str, str]:
    """Read the referenced files, as texts that JSON can hold, by their names.

    Raises
    ------
    ConfigError
        If a file cannot be read.
    """
    files = {}
    for key, name in referenced_files(tables).items():
        try:
            files[name] = base64.b64encode((folder / name).read_bytes()).decode("ascii")
        except OSError as error:
            reason = error.strerror or error
            raise ConfigError(f"{assignment(key, name)}: cannot be read: {reason}") from error
    return files


def refuse_referenced(tables: Any, folder: Path, output: Path, hint: str = "") -> None:
    """Refuse to write over a file that a config refers to.

    Parameters
    ----------
    tables : dict
        The config.
    folder : Path
        What the names of its files are relative to.
    output : Path
        Where something is to be written.
    hint : str
        What else can be done.

    Raises
    ------
    OutputError
        If it is one of these files.
    """
    for key, name in referenced_files(tables).items():
        path = folder / name
        if path.exists() and output.exists() and path.samefile(output):
            raise _never_replaced(output, assignment(key, name), hint)


def refuse_recorded(record: Any, output: Path, hint: str = "") -> None:
    """Refuse to write over a file that a recorded config refers to, wherever its folder is.

    What has the name of such a file, or is its copy byte for byte, is taken for it.

    Parameters
    ----------
    record : dict
        The config that a timeline holds, with the packed files under ``files``.
    output : Path
        Where something is to be written.
    hint : str
        What else can be done.

    Raises
    ------
    OutputError
        If it is one of these files.
    """
    if not output.is_file():
        return
    files = record.get("files") if isinstance(record, dict) else None
    for key, name in referenced_files(record).items():
        content = files.get(name) if isinstance(files, dict) else None
        if Path(name).name == output.name or _is_copy(output, content):
            raise _never_replaced(output, assignment(key, name), hint)


def _is_copy(path: Path, content: Any) -> bool:
    """Tell whether a file holds what was packed."""
    # four letters for three bytes: most files are told apart by their size
    if not isinstance(content, str) or -(-path.stat().st_size // 3) * 4 != len(content):
        return False
    return base64.b64encode(path.read_bytes()).decode("ascii") == content


def _never_replaced(output: Path, key: str, hint: str) -> OutputError:
    """Say that a file is needed by a config."""
    return OutputError(f"{output}: is the file of {key}, and is never replaced{hint}")


@contextmanager
def unpacked(
    tables: dict[str, Any], files: dict[str, str]
) -> Iterator[tuple[dict[str, Any], Path]]:
    """Put packed files into a folder of their own, for as long as they are needed.

    Parameters
    ----------
    tables : dict
        The config that refers to them.
    files : dict
        What :func:`packed` gave.

    Yields
    ------
    tuple
        The config with the files renamed, and the folder they are in.

    Raises
    ------
    TimelineError
        If the files are not what :func:`packed` gives.
    """
    with TemporaryDirectory(prefix="vasc-") as name:
        folder = Path(name)
        renamed: dict[str, str] = {}
        for index, (original, content) in enumerate(files.items()):
            # a number before the name: two folders may hold files of one name, and a
            # name from a timeline must not lead out of the folder
            renamed[original] = f"{index}-{Path(original).name}"
            try:
                (folder / renamed[original]).write_bytes(base64.b64decode(content, validate=True))
            except (binascii.Error, TypeError, ValueError) as error:
                raise TimelineError(f"the recorded file {original!r} is damaged") from error
        yield _renamed(tables, renamed), folder


def _renamed(tables: Any, names: dict[str, str]) -> Any:
    """Give the tables with the names of files replaced."""
    if isinstance(tables, list):
        return [_renamed(value, names) for value in tables]
    if not isinstance(tables, dict):
        return tables
    return {
        key: names.get(value, value)
        if key == FILE_KEY and isinstance(value, str)
        else _renamed(value, names)
        for key, value in tables.items()
    }


def _problem(folder: Path, name: str) -> str:
    """Say why a file cannot be used; empty if it can."""
    if not name or "\0" in name:
        return "is not the name of a file"
    path = folder / name
    try:
        if not path.exists():
            return f"there is no such file in {folder.resolve()}"
        if not path.is_file():
            return "is not a file"
        if path.stat().st_size > FILE_BYTES:
            return f"is larger than {FILE_BYTES:,} bytes"
        with path.open("rb") as file:
            file.read(1)
    except OSError as error:
        return f"cannot be read: {error.strerror or error}"
    return ""
