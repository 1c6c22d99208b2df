"""The folder of a crate: whole, or not at all."""

import base64
import json
import re
import shutil
from collections.abc import Sequence
from pathlib import Path, PurePosixPath
from typing import Any

from vasc.config.values import shortened
from vasc.crates.citation import citation_file
from vasc.crates.description import CITATION, CONFIG, METADATA, TIMELINE, described
from vasc.errors import OutputError, TimelineError
from vasc.export.folders import check_folder, new_folder
from vasc.export.tables import DESCRIPTION, write_tables
from vasc.export.words import plain
from vasc.render import render
from vasc.timeline import Timeline

ENDING = "crate"
"""What the name of a crate ends in: ``crate/``, ``leaf.crate``, ``leaf-crate``."""
FILES_KEY = "files"
"""Key of a recorded config under which the files that it refers to travel."""
ADDRESS = re.compile(r"https?://[^\s<>\"\x00-\x1f]+")
FOLDERS = {"config", "config/files", "figures", "tables"}


def is_crate(output: Path) -> bool:
    """Tell whether a name is that of a crate.

    Examples
    --------
    >>> is_crate(Path("leaf.crate")), is_crate(Path("crate/")), is_crate(Path("leaf.csv"))
    (True, True, False)
    """
    return output.name.lower().endswith(ENDING)


def export_crate(
    run: str | Path,
    output: str | Path,
    step: int = -1,
    *,
    authors: Sequence[str] = (),
    license: str | None = None,
    force: bool = False,
) -> Path:
    """Write a recorded run as a Research Object Crate.

    Parameters
    ----------
    run : path
        The recorded run.
    output : path
        The folder to write; its name ends in ``crate``.
    step : int
        The step of the figures and tables; -1 is the last.
    authors : sequence of str
        Names of who made the run.
    license : str, optional
        The licence of the run, the address of its text.
    force : bool
        Replace an older crate.

    Returns
    -------
    Path
        The folder. The same run gives the same bytes.

    Raises
    ------
    OutputError
        If the name is not that of a crate, its folder does not exist, or something of that name
        exists and may not be replaced; if an author has no name or the licence no address.
    TimelineError
        If ``run`` is no timeline, lacks the step, or is being written.
    VascError
        If rocrate is not installed.
    """
    output = Path(output)
    if not is_crate(output):
        raise OutputError(f"{output}: the name of a crate ends in {ENDING!r}")
    if not output.parent.is_dir():
        raise OutputError(f"{output}: folder {output.parent} does not exist")
    _check_words(authors, license)
    with Timeline(run) as timeline:
        timeline.frame(step)
    listed = _listed(output)
    check_folder(output, lambda path: _is_part(path.relative_to(output), path, listed), force=force)
    with new_folder(output) as folder:
        shutil.copyfile(run, folder / TIMELINE)
        with Timeline(run) as timeline, Timeline(folder / TIMELINE) as copied:
            if timeline.n_frames != copied.n_frames:
                raise TimelineError(
                    f"{run}: is being written, or was killed; wait, or `vasc resume` it first"
                )
            files = _fill(copied, folder, step)
            crate = described(copied, files, folder, authors=authors, license=license)
        crate.metadata.write(folder)
    return output


def _check_words(authors: Sequence[str], license: str | None) -> None:
    """Refuse authors without a name, and a licence that has no address."""
    for name in authors:
        if not plain(name).strip():
            raise OutputError(f"author {name!r}: must be a name, as 'A. Botanist'")
    if license is not None and not ADDRESS.fullmatch(license):
        raise OutputError(
            f"license {shortened(license)!r}: must be the address of its text, as"
            " https://spdx.org/licenses/CC-BY-4.0"
        )


def _fill(timeline: Timeline, folder: Path, step: int) -> dict[str, str]:
    """Write all files but the timeline and the description; give what each is."""
    for name in sorted(FOLDERS):
        (folder / name).mkdir()
    files = {TIMELINE: "The recorded run: every step, with its config and provenance"}
    (folder / CONFIG).write_text(timeline.config_toml, encoding="utf-8")
    files[CONFIG] = "The config as it was given"
    for name, content in _attached(timeline).items():
        place = _place(name, len(files))
        (folder / place).parent.mkdir(parents=True, exist_ok=True)
        (folder / place).write_bytes(_decoded(timeline, name, content))
        files[place] = f"A file of the config, there named {name!r}"
    at = timeline.last_step if step == -1 else step
    for suffix in ("png", "svg"):
        name = f"figures/step-{at}.{suffix}"
        render(timeline, folder / name, at, unroll=timeline.dimensions == 3)
        files[name] = f"Picture of step {at}"
    write_tables(timeline, folder / "tables", at)
    for path in sorted((folder / "tables").iterdir()):
        what = "What the tables hold" if path.name == DESCRIPTION else f"Table {path.stem}"
        files[f"tables/{path.name}"] = f"{what}, up to step {at}"
    shutil.copyfile(citation_file(), folder / CITATION)
    files[CITATION] = "How to cite vasc and the works whose model it is"
    if not any((folder / "config/files").iterdir()):
        (folder / "config/files").rmdir()
    return files


def _attached(timeline: Timeline) -> dict[str, Any]:
    """Give the files that travelled with a timeline, packed, by the names in its config."""
    files = timeline.config.get(FILES_KEY, {})
    if not isinstance(files, dict):
        raise TimelineError(f"{timeline.path}: the files of the config are no table")
    return files


def _place(name: str, number: int) -> str:
    """Give where a file of the config goes: beside it by its name, if that leads nowhere else."""
    if re.fullmatch(r"\w[\w .()+-]{0,99}", name) and name != PurePosixPath(CONFIG).name:
        return f"config/{name}"
    last = re.sub(r"[^\w.+-]", "_", PurePosixPath(name).name)[-100:]
    return f"config/files/{number}-{last}"


def _decoded(timeline: Timeline, name: str, content: Any) -> bytes:
    """Give the bytes of a file that travelled with a timeline."""
    try:
        return base64.b64decode(content, validate=True)
    except (TypeError, ValueError) as error:
        raise TimelineError(f"{timeline.path}: the recorded file {name!r} is damaged") from error


def _listed(output: Path) -> set[str]:
    """Give the files of an older crate, as it lists them; none if vasc did not make it."""
    try:
        graph = json.loads((output / METADATA).read_text(encoding="utf-8"))["@graph"]
        names = {str(entity["@id"]) for entity in graph}
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        return set()
    return names if {TIMELINE, CONFIG, "#session-0"} <= names else set()


def _is_part(name: Path, path: Path, listed: set[str]) -> bool:
    """Tell whether a path in a folder is one that a crate has."""
    if path.is_dir():
        return name.as_posix() in FOLDERS
    # a crate lists the addresses of its files
    address = PurePosixPath("/", name.as_posix()).as_uri().removeprefix("file:///")
    return address in listed or name.as_posix() in listed
