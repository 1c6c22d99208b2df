"""What tests of validation share: a leaf whose sources come one by one in the observed order."""

import pytest

from vasc import load, run

GIVEN = """kind = "closed"
seed = 1
title = "Sources given one by one, in the observed order"
reference = "none"

[domain]
points = [[-10, 0], [10, 0], [10, 60], [-10, 60]]
length = 60.0

[growth]
kind = "none"

[placement]
kind = "given"
points = [
    [0.0, 59.5],
    [-9.5, 32.25], [9.5, 32.75],
    [-9.5, 42.75], [9.5, 43.25],
    [-9.5, 22.25], [9.5, 22.75],
    [-9.5, 12.25], [9.5, 12.75],
    [-5.0, 37.25], [5.0, 37.75],
]
births = [1, 80, 80, 110, 110, 140, 140, 170, 170, 200, 200]

[arrival]
kill_distance = 1.5
"""


@pytest.fixture(scope="session")
def given(tmp_path_factory):
    """Run the leaf once; give its file."""
    folder = tmp_path_factory.mktemp("sequence")
    (folder / "given.toml").write_text(GIVEN)
    run(load(folder / "given.toml"), folder / "given.h5")
    return folder / "given.h5"
