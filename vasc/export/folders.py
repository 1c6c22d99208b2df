"""Folders of exports: they appear whole or not at all, and replace nothing that is not theirs."""

import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from vasc.errors import OutputError, writing
from vasc.timeline.storage import beside


@contextmanager
def new_folder(folder: Path) -> Iterator[Path]:
    """Give an empty folder that takes its place, and that of an older one, when it is filled.

    Parameters
    ----------
    folder : Path
        The folder to be.

    Yields
    ------
    Path
        Where to write what it is to hold.

    Raises
    ------
    OutputError
        If it cannot be written.
    """
    folder = folder.resolve()
    ready, old = beside(folder), beside(folder)
    with writing(folder):
        ready.mkdir()
    try:
        with writing(folder):
            yield ready
            if folder.exists():
                folder.rename(old)
            try:
                ready.rename(folder)
            except BaseException:
                if old.exists():
                    old.rename(folder)
                raise
    finally:
        for left in (ready, old):
            shutil.rmtree(left, ignore_errors=True)


def check_folder(folder: Path, is_part: Callable[[Path], bool], *, force: bool) -> None:
    """Refuse a folder that exists, unless it may be replaced and holds an older export alone.

    Parameters
    ----------
    folder : Path
        The folder to be.
    is_part : callable
        Tells of a path in it whether an export has made it.
    force : bool
        Replace an older export.

    Raises
    ------
    OutputError
        If it is to stay.
    """
    if not folder.exists():
        return
    if not folder.is_dir():
        raise OutputError(f"{folder}: exists already, and a folder of that name is to be written")
    for path in sorted(folder.rglob("*")):
        if not is_part(path):
            other = path.relative_to(folder).as_posix()
            raise OutputError(
                f"{folder}: the folder exists already and holds {other!r}, which is no part of an"
                " export; not replaced, choose another name"
            )
    if not force:
        raise OutputError(f"{folder}: the folder exists already; use --force to replace it")
