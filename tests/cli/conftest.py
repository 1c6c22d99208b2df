"""What tests of the command line share: a small closed leaf, recorded once."""

import pytest

from vasc.cli import main

LEAF = """kind = "closed"
seed = 3
title = "A small leaf with loops"
reference = "none"

[domain]
shape = "ovate"
length = 20.0

[growth]
kind = "marginal"
final_length = 60.0
length_per_step = 1.0

[placement]
kind = "darts"
density = 0.02
birth_distance_sources = 5.0
birth_distance_veins = 5.0

[arrival]
kill_distance = 1.0

[units]
length = "um"
segment = 4.0
"""


@pytest.fixture(scope="session")
def recorded(tmp_path_factory):
    """Run the leaf once; give its folder, with leaf.toml, leaf.h5 and leaf.png."""
    folder = tmp_path_factory.mktemp("recorded")
    (folder / "leaf.toml").write_text(LEAF)
    output = ["-o", str(folder / "leaf.h5"), "--quiet"]
    assert main(["run", str(folder / "leaf.toml"), *output]) == 0
    return folder


@pytest.fixture
def here(tmp_path, monkeypatch):
    """Work in a folder that holds the config of the leaf alone."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "leaf.toml").write_text(LEAF)
    return tmp_path
