"""The experiments that come with vasc, by name."""

import difflib
from dataclasses import dataclass
from pathlib import Path

from vasc.config.attachments import referenced_files
from vasc.config.reading import parse, read_text
from vasc.config.values import shortened
from vasc.errors import ConfigError, OutputError
from vasc.whole_files import write_whole

SWEEPS = "sweeps"
"""Folder of the sweeps, among the experiments."""

IS_SWEEP = "is a sweep, not an experiment; `vasc sweep` runs it"
IS_EXPERIMENT = "is an experiment, not a sweep; `vasc run` runs it, a sweep names it as its base"

_PACKAGE = Path(__file__).resolve().parent.parent


@dataclass(frozen=True)
class Bundled:
    """One experiment, or sweep of experiments, that comes with vasc.

    Parameters
    ----------
    name : str
        The name ``vasc run`` takes, or ``vasc sweep``.
    title : str
        A sentence on what it grows.
    path : Path
        Its file.
    """

    name: str
    title: str
    path: Path


def bundled_folder() -> Path:
    """Give the folder of the bundled experiments, of the package or of a source checkout."""
    packaged = _PACKAGE / "_configs"
    return packaged if packaged.is_dir() else _PACKAGE.parent / "configs"


def bundled_paths() -> dict[str, Path]:
    """Give the files of the bundled experiments by name, in the order of the names."""
    return {path.stem: path for path in sorted(bundled_folder().glob("*.toml"))}


def sweep_paths() -> dict[str, Path]:
    """Give the files of the bundled sweeps by name, in the order of the names."""
    return {path.stem: path for path in sorted((bundled_folder() / SWEEPS).glob("*.toml"))}


def bundled_configs() -> list[Bundled]:
    """Give the bundled experiments, in the order of their names."""
    return _described(bundled_paths())


def bundled_sweeps() -> list[Bundled]:
    """Give the bundled sweeps, in the order of their names."""
    return _described(sweep_paths())


def find_config(source: str | Path) -> Path:
    """Give the file of a config, which is a file or the name of a bundled experiment.

    Parameters
    ----------
    source : str or Path
        What the user wrote; a file comes before a bundled name.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    ConfigError
        If there is neither.
    """
    return _find(source, bundled_paths(), "experiment", dict.fromkeys(sweep_paths(), IS_SWEEP))


def find_sweep(source: str | Path) -> Path:
    """Give the file of a sweep, which is a file or the name of a bundled one.

    Parameters
    ----------
    source : str or Path
        What the user wrote; a file comes before a bundled name.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    ConfigError
        If there is neither.
    """
    return _find(source, sweep_paths(), "sweep", dict.fromkeys(bundled_paths(), IS_EXPERIMENT))


def _find(source: str | Path, known: dict[str, Path], what: str, others: dict[str, str]) -> Path:
    """Give a file of that name, or a bundled one of those known; tell those of another kind."""
    if not str(source).isprintable():
        raise ConfigError(f"{str(source)[:80]!r}: is not the name of a file")
    path = Path(source)
    try:
        if path.is_file() or (path.exists() and str(source) not in known):
            return path
    except (OSError, ValueError) as error:
        raise ConfigError(f"{str(source)[:80]!r}: is not the name of a file") from error
    if str(source) in known:
        return known[str(source)]
    if str(source) in others:
        raise ConfigError(f"{source}: {others[str(source)]}")
    close = difflib.get_close_matches(path.stem, known, n=1)
    nearest = f"; nearest: {close[0]}" if close else ""
    raise ConfigError(
        f"{source}: there is no such file and no bundled {what} of that name{nearest}"
        " (`vasc configs` lists them)"
    )


def copy_bundled(name: str, folder: Path) -> list[Path]:
    """Write a bundled experiment or sweep, and the files it refers to, into a folder.

    Parameters
    ----------
    name : str
        Its name.
    folder : Path
        An existing folder.

    Returns
    -------
    list of Path
        The files written, the config first; a file that is there with the same
        bytes is left alone.

    Raises
    ------
    ConfigError
        If there is no experiment of that name.
    OutputError
        If the folder does not exist or cannot be written to, or a file would be overwritten.
    """
    known = sweep_paths() | bundled_paths()
    if name not in known:
        close = difflib.get_close_matches(name, known, n=1)
        nearest = f"; nearest: {close[0]}" if close else ""
        raise ConfigError(
            f"{shortened(name)}: no bundled experiment has that name{nearest}"
            " (`vasc configs` lists them)"
        )
    if not folder.is_dir():
        raise OutputError(f"{folder}: there is no such folder")
    tables = parse(read_text(known[name]), name)
    sources = {known[name].name: known[name]}
    for reference in referenced_files(tables).values():
        sources[reference] = known[name].parent / reference
    contents = {folder / target: source.read_bytes() for target, source in sources.items()}
    for index, (target, content) in enumerate(contents.items()):
        if target.exists() and (index == 0 or target.read_bytes() != content):
            raise OutputError(f"{target}: exists; move it away or copy into another folder")
    missing = {target: content for target, content in contents.items() if not target.exists()}
    for target, content in missing.items():
        try:
            target.parent.mkdir(parents=True, exist_ok=True)
            write_whole(target, content)
        except OSError as error:
            raise OutputError(
                f"{target}: cannot be written: {error.strerror or error}; --to names another folder"
            ) from error
    return list(missing)


def _described(paths: dict[str, Path]) -> list[Bundled]:
    """Read the titles of bundled files."""
    found = []
    for name, path in paths.items():
        tables = parse(read_text(path), name)
        found.append(Bundled(name, str(tables.get("title", "")), path))
    return found
