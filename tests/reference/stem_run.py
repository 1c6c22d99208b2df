"""A small stem, grown and recorded."""

from vasc.config import load
from vasc.experiment import run

STEM = """kind = "stem"
title = "A small stem"

[domain]
radius = 12.0

[placement]
kind = "phyllotaxis"
divergence = 137.5
rise = 10.0
primordia = 8
"""


def recorded_in(folder, text=STEM, name="stem"):
    """Grow a stem; give its timeline, in a folder that holds its config as well."""
    config = folder / f"{name}.toml"
    config.write_text(text)
    path = folder / f"{name}.h5"
    run(load(str(config)), path)
    return path
