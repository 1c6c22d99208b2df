"""A quick start: what libraries do while they load, and no run needs."""

import atexit
import gc
from collections.abc import Iterator
from contextlib import contextmanager, suppress

N_OBJECTS = 500_000
"""New objects after which garbage is looked for: more than a start makes, and keeps."""


@contextmanager
def rare_collections() -> Iterator[None]:
    """Look for garbage rarely: modules are kept, a run makes little, and the end frees all."""
    thresholds = gc.get_threshold()
    gc.set_threshold(N_OBJECTS, *thresholds[1:])
    atexit.unregister(gc.disable)
    atexit.register(gc.disable)
    try:
        yield
    finally:
        gc.set_threshold(*thresholds)


def load_numba() -> None:
    """Load numba without scipy's linear algebra, a seventh of the time of a start.

    As it loads cached kernels, numba loads scipy's linear algebra only to know
    whether there is any. It asks again where a kernel uses some, so that kernels
    of installed models may.
    """
    # names of numba's inside: where they are gone, the start takes its time
    with suppress(ImportError, AttributeError):
        from numba.np import linalg

        ensure_blas = linalg.ensure_blas
        linalg.ensure_blas = lambda: None
        try:
            import numba.np.arraymath  # noqa: F401
        finally:
            linalg.ensure_blas = ensure_blas
