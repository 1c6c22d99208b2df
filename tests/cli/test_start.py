"""The quick start: what it leaves as it was."""

import gc
import subprocess
import sys

from vasc.cli.start import N_OBJECTS, rare_collections

LOADED = """
import sys
from vasc.cli.start import load_numba
load_numba()
print("numba.np.arraymath" in sys.modules, "scipy.linalg" in sys.modules)
"""

ALGEBRA = """
import numba
import numpy as np
inverse = numba.njit(lambda matrix: np.linalg.inv(matrix) @ matrix)
print(np.allclose(inverse(np.diag([2.0, 3.0])), np.eye(2)))
"""


def test_collections_are_rare_only_within():
    before = gc.get_threshold()
    with rare_collections():
        assert gc.get_threshold()[0] == N_OBJECTS
    assert gc.get_threshold() == before


def test_numba_loads_without_linear_algebra_and_still_has_it():
    said = subprocess.run(
        [sys.executable, "-c", LOADED + ALGEBRA], capture_output=True, text=True, check=True
    )
    assert said.stdout.split() == ["True", "False", "True"]
