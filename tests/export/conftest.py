"""What tests of exports share: four small runs, recorded once."""

from types import SimpleNamespace

import pytest
from reference.export_configs import KINDS, LEAF
from reference.stem_run import recorded_in

from vasc.config import load
from vasc.experiment import run
from vasc.timeline import Timeline


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
