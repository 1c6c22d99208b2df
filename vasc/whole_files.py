"""Files that are there as a whole or not at all, whenever the process ends."""

import os
from pathlib import Path


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
    """
    new = path.with_name(f".{path.name}.{os.getpid()}.new")
    try:
        with new.open("wb") as file:
            file.write(content.encode() if isinstance(content, str) else content)
            file.flush()
            os.fsync(file.fileno())
        os.replace(new, path)
    finally:
        new.unlink(missing_ok=True)
