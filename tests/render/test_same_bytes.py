"""A picture of one run is the same bytes whenever, and in whichever process, it is drawn."""

import os
import subprocess
import sys

import pytest
from PIL import Image
from reference.export_configs import KINDS, LEAF
from reference.stem_run import recorded_in

from vasc.config import load
from vasc.experiment import run


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """Give a small leaf and a small stem."""
    folder = tmp_path_factory.mktemp("drawn")
    (folder / "leaf.toml").write_text(LEAF.format(**KINDS["closed"]))
    run(load(str(folder / "leaf.toml")), folder / "leaf.h5")
    return {"leaf": folder / "leaf.h5", "stem": recorded_in(folder)}


def drawn(path, output, hash_seed, *options):
    """Draw in a process of its own; give the bytes."""
    command = [sys.executable, "-m", "vasc", "render", path, "-o", output, *options]
    # a clock that a picture must not know, and an order of sets that it must not follow
    environment = os.environ | {"PYTHONHASHSEED": hash_seed, "SOURCE_DATE_EPOCH": hash_seed}
    subprocess.run(command, env=environment, check=True, capture_output=True)
    return output.read_bytes()


@pytest.mark.parametrize("suffix", ["png", "svg", "pdf"])
@pytest.mark.parametrize(
    ("kind", "options"),
    [("leaf", ()), ("stem", ("--unroll",)), pytest.param("stem", (), marks=pytest.mark.slow)],
    ids=["leaf", "flat-stem", "stem"],
)
def test_two_processes_draw_the_same_bytes(runs, kind, options, suffix, tmp_path):
    first, second = (
        drawn(runs[kind], tmp_path / f"{seed}.{suffix}", seed, *options) for seed in ("1", "86400")
    )
    assert first == second


def test_pictures_know_no_date_and_no_program(runs, tmp_path):
    svg = drawn(runs["leaf"], tmp_path / "a.svg", "1")
    pdf = drawn(runs["leaf"], tmp_path / "a.pdf", "1")
    drawn(runs["leaf"], tmp_path / "a.png", "1")
    for mark in (b"<dc:date>", b"Matplotlib v"):
        assert mark not in svg
    for mark in (b"CreationDate", b"ModDate", b"Producer"):
        assert mark not in pdf
    with Image.open(tmp_path / "a.png") as png:
        assert set(png.info) <= {"dpi"}
