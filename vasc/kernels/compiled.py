"""How kernels are compiled: cached on disk, without fast-math, and with numpy's division."""

from numba import njit

compiled = njit(cache=True, error_model="numpy")
"""Decorator of every kernel.

No fast-math: results must not depend on the processor. Division by zero gives inf
or nan as in numpy instead of raising, which would put a branch into every loop.
"""

inlined = njit(cache=True, error_model="numpy", inline="always")
"""Decorator of a part of a kernel that is called from one place in an inner loop."""
