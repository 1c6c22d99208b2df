"""Files that are there as a whole or not at all, whenever the process ends."""

import os
from pathlib import Path

from vasc.errors import OutputError


def refuse_special(path: Path) -> None:
    """Refuse to put a file in the place of a device, a pipe, or a link that leads to no file.

    Raises
    ------
    OutputError
        If one of these is there.
    """
    if os.path.lexists(path) and not (path.is_file() or path.is_dir()):
        raise OutputError(
            f"{path}: is a device, a pipe or a link to nothing, and is not replaced by a file;"
            " choose another name"
        )


def write_whole(path: Path, content: str | bytes) -> None:
    """Write a file under another name, and give it its own when all of it is on the disk.

    Parameters
    ----------
    path : Path
        The file; an old one is replaced.
    content : str or bytes
        What it is to hold; a text is written in UTF-8, with its line ends as they are.

    Raises
    ------
    OSError
        If it cannot be written; an old one is then as it was.
    OutputError
        If a device or a pipe is there.
    """
    refuse_special(path)
    new = path.with_name(f".{path.name}.{os.getpid()}.new")
    try:
        with new.open("wb") as file:
            file.write(content.encode() if isinstance(content, str) else content)
            file.flush()
            os.fsync(file.fileno())
        os.replace(new, path)
    finally:
        new.unlink(missing_ok=True)
