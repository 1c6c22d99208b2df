"""What tests of exports share: four small runs, recorded once."""

from types import SimpleNamespace

import pytest
from reference.stem_run import recorded_in

from vasc.config import load
from vasc.experiment import run
from vasc.timeline import Timeline

LEAF = """kind = "{kind}"
seed = 3
title = "A leaf -- for <export> & co"
reference = "none"

[domain]
shape = "ovate"
length = 20.0

[growth]
kind = "{growth}"
final_length = 70.0
length_per_step = 1.0

[placement]
kind = "darts"
density = 0.01
birth_distance_sources = 5.0
birth_distance_veins = 5.0

[arrival]
kill_distance = {kill_distance}

[refinement]
kind = "{refinement}"

[widths]
tip_radius = 0.2
exponent = 2.5

[units]
length = "um"
segment = 4.0
"""
KINDS = {
    "closed": {
        "kind": "closed",
        "growth": "isogonic",
        "kill_distance": 1.0,
        "refinement": "subdivision",
    },
    "open": {"kind": "open", "growth": "marginal", "kill_distance": 3.0, "refinement": "none"},
}


@pytest.fixture(scope="session")
def runs(tmp_path_factory):
    """Give the timelines: a leaf with loops and one without, in um; areoles; a stem."""
    folder = tmp_path_factory.mktemp("exported")
    paths = {"stem": recorded_in(folder), "areoles": folder / "areoles.h5"}
    for name, values in KINDS.items():
        config = folder / f"{name}.toml"
        config.write_text(LEAF.format(**values))
        paths[name] = folder / f"{name}.h5"
        run(load(str(config)), paths[name])
    # corners are cut, so that nodes are retired; widths are by elongation
    run(load("arabidopsis-first-leaf"), paths["areoles"], steps=150)
    return SimpleNamespace(**paths)


@pytest.fixture(params=["closed", "open", "areoles", "stem"])
def path(request, runs):
    """Give each run in turn."""
    return getattr(runs, request.param)


@pytest.fixture
def timeline(path):
    """Give each run in turn, open."""
    with Timeline(path) as timeline:
        yield timeline
