"""What is loaded when pictures are only thought of."""

import subprocess
import sys


def test_nothing_heavy_is_loaded_before_something_is_drawn():
    heavy = ("matplotlib", "scipy", "numba", "shapely", "h5py", "PIL")
    code = (
        f"import sys, vasc.render, vasc.analysis; print([m for m in {heavy} if m in sys.modules])"
    )
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert found.stdout.strip() == "[]"
