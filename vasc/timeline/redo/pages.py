"""A file in memory over one on the disk: pages that have changed, and how long it is."""

import os
from collections.abc import Iterable

from vasc.timeline.redo import disk

PAGE = 4096
"""Bytes of a page."""

Run = tuple[int, bytes]
"""An offset, and the bytes from there on."""


class Pages:
    """What a file holds once some runs of bytes are written to it.

    Parameters
    ----------
    handle : int
        The open file below; it may be shorter.

    Attributes
    ----------
    size : int
        Bytes of the file as it is seen.
    """

    def __init__(self, handle: int) -> None:
        self._handle = handle
        self._pages: dict[int, bytearray] = {}
        self.size = self._below = os.fstat(handle).st_size

    def write(self, offset: int, content: bytes | memoryview) -> None:
        """Write bytes, over the file and beyond its end."""
        pages, stop = self._pages, offset + len(content)
        number, start = divmod(offset, PAGE)
        done, n_bytes = 0, len(content)
        while done < n_bytes:
            n_here = min(PAGE - start, n_bytes - done)
            page = pages.get(number)
            if page is None:
                # a page that is written as a whole need not be read
                page = bytearray(PAGE) if n_here == PAGE else self._load(number)
                pages[number] = page
            page[start : start + n_here] = content[done : done + n_here]
            done, number, start = done + n_here, number + 1, 0
        self.size = max(self.size, stop)

    def write_runs(self, runs: Iterable[Run]) -> None:
        """Write runs of bytes, in their order."""
        for offset, content in runs:
            self.write(offset, content)

    def read_into(self, offset: int, target: memoryview) -> int:
        """Fill a buffer from an offset on; give how many bytes there were."""
        n_bytes = max(0, min(len(target), self.size - offset))
        if not n_bytes:
            return 0
        first, last = offset // PAGE, (offset + n_bytes - 1) // PAGE
        changed = self._pages
        if len(changed) < last - first:
            numbers = sorted(number for number in changed if first <= number <= last)
        else:
            numbers = [number for number in range(first, last + 1) if number in changed]
        if len(numbers) <= last - first:
            below = disk.read(self._handle, min(n_bytes, self._below - offset), offset)
            target[: len(below)] = below
            target[len(below) : n_bytes] = bytes(n_bytes - len(below))
        for number in numbers:
            begin = number * PAGE
            start, stop = max(begin, offset), min(begin + PAGE, offset + n_bytes)
            target[start - offset : stop - offset] = changed[number][start - begin : stop - begin]
        return n_bytes

    def truncate(self, size: int) -> None:
        """Give the file a length."""
        if size < self.size:
            for number in [number for number in self._pages if number * PAGE >= size]:
                del self._pages[number]
            self._below = min(self._below, size)
        self.size = size

    def forget(self) -> None:
        """Forget all pages: the file below holds them by now."""
        self._pages.clear()
        self._below = self.size

    def _load(self, number: int) -> bytearray:
        """Read a page of the file below; zeros beyond its end."""
        begin = number * PAGE
        page = bytearray(PAGE)
        n_below = min(PAGE, self._below - begin)
        if n_below > 0:
            content = disk.read(self._handle, n_below, begin)
            page[: len(content)] = content
        return page
