"""How far a suite is: each part with its number, and how many there are."""

from collections.abc import Callable


class Counted:
    """Tells the name of each part of known many as ``k of n: name``.

    Parameters
    ----------
    tell : callable
        Told that.
    n : int
        Parts in all.
    """

    def __init__(self, tell: Callable[[str], None], n: int) -> None:
        self.tell = tell
        self.n = n
        self.k = 0

    def __call__(self, name: str) -> None:
        """Tell the name of the next part."""
        self.k += 1
        self.tell(f"{self.k} of {self.n}: {name}")
