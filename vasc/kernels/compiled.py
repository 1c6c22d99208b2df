"""How kernels are compiled: cached on disk, without fast-math, and with numpy's division.

No fast-math: results must not depend on the processor. Division by zero gives inf
or nan as in numpy instead of raising, which would put a branch into every loop.
"""

from numba import njit

compiled = njit(cache=True, error_model="numpy")
"""Decorator of a kernel that makes arrays of its own."""

unowned = njit(cache=True, error_model="numpy", _nrt=False)  # type: ignore[call-overload]
"""Decorator of a kernel that only reads and writes the arrays it is given.

The arrays belong to the caller, so that nothing need count references to them:
counting took almost half of the time of a run.
"""

inlined = njit(  # type: ignore[call-overload]
    cache=True, error_model="numpy", _nrt=False, inline="always"
)
"""Decorator of a part of such a kernel that is called from one place in an inner loop."""
