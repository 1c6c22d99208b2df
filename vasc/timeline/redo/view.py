"""Pages as a binary file that HDF5 can read through h5py."""

import io
import os

from vasc.timeline.redo.pages import Pages


class View(io.RawIOBase):
    """A file that is read at a position.

    Parameters
    ----------
    pages : Pages
        What is in it.
    """

    def __init__(self, pages: Pages) -> None:
        super().__init__()
        self._pages = pages
        self._position = 0

    def readable(self) -> bool:
        """Say that it can be read."""
        return True

    def seekable(self) -> bool:
        """Say that it has a position."""
        return True

    def seek(self, offset: int, whence: int = os.SEEK_SET) -> int:
        """Go to a position."""
        self._position = (0, self._position, self._pages.size)[whence] + offset
        return self._position

    def tell(self) -> int:
        """Give the position."""
        return self._position

    def readinto(self, target: memoryview) -> int:  # type: ignore[override]
        """Fill a buffer from the position on."""
        n_bytes = self._pages.read_into(self._position, memoryview(target))
        self._position += n_bytes
        return n_bytes
