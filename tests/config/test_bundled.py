"""The experiments that come with vasc, and their copies."""

import pytest

from vasc.config import bundled, load
from vasc.errors import ConfigError, OutputError

CONFIG = """kind = "closed"
title = "A leaf"
[domain]
file = "outlines/leaf.csv"
length = 20.0
[placement]
kind = "given"
points = [[0.0, 5.0]]
[arrival]
kill_distance = 1.0
"""


@pytest.fixture
def shelf(tmp_path, monkeypatch):
    """Put two experiments, one with an outline, where the bundled ones are looked for."""
    folder = tmp_path / "shelf"
    (folder / "outlines").mkdir(parents=True)
    (folder / "with-outline.toml").write_text(CONFIG)
    (folder / "outlines" / "leaf.csv").write_text("x,y\n0,0\n1,0\n0,1\n")
    (folder / "plain.toml").write_text(
        CONFIG.replace('file = "outlines/leaf.csv"', 'shape = "fan"')
    )
    monkeypatch.setattr(bundled, "bundled_folder", lambda: folder)
    return folder


@pytest.fixture
def here(tmp_path, monkeypatch):
    """Give a folder to copy to."""
    folder = tmp_path / "here"
    folder.mkdir()
    monkeypatch.chdir(folder)
    return folder


@pytest.mark.parametrize("config", bundled.bundled_configs(), ids=lambda config: config.name)
def test_a_bundled_experiment_is_sound(config):
    experiment = load(config.name)
    assert experiment.name == config.name
    assert experiment.parameters.title == config.title != ""


def test_names_and_titles_are_listed_in_order(shelf):
    found = [(one.name, one.title) for one in bundled.bundled_configs()]
    assert found == [("plain", "A leaf"), ("with-outline", "A leaf")]


def test_a_copy_comes_with_its_files(shelf, here):
    files = bundled.copy_bundled("with-outline", here)
    assert files == [here / "with-outline.toml", here / "outlines" / "leaf.csv"]
    assert files[0].read_text() == CONFIG
    assert load("with-outline.toml").files.keys() == {"outlines/leaf.csv"}


def test_a_copy_replaces_nothing(shelf, here):
    (here / "with-outline.toml").write_text("mine")
    with pytest.raises(OutputError, match=r"with-outline\.toml: exists"):
        bundled.copy_bundled("with-outline", here)
    assert (here / "with-outline.toml").read_text() == "mine"
    assert not (here / "outlines").exists()


def test_a_copy_replaces_no_other_outline_and_leaves_no_half(shelf, here):
    (here / "outlines").mkdir()
    (here / "outlines" / "leaf.csv").write_text("mine")
    with pytest.raises(OutputError, match=r"leaf\.csv: exists"):
        bundled.copy_bundled("with-outline", here)
    assert not (here / "with-outline.toml").exists()


def test_an_outline_that_is_there_already_is_shared(shelf, here):
    (here / "outlines").mkdir()
    (here / "outlines" / "leaf.csv").write_bytes((shelf / "outlines/leaf.csv").read_bytes())
    assert bundled.copy_bundled("with-outline", here) == [here / "with-outline.toml"]


@pytest.mark.parametrize("name", ["plian", "../shelf/plain", ""])
def test_only_bundled_experiments_are_copied(shelf, here, name):
    with pytest.raises(ConfigError, match="no bundled experiment"):
        bundled.copy_bundled(name, here)
    assert list(here.iterdir()) == []


def test_a_folder_that_is_not_there_is_refused(shelf, tmp_path):
    with pytest.raises(OutputError, match="no such folder"):
        bundled.copy_bundled("plain", tmp_path / "nowhere")


def test_a_file_comes_before_a_name_and_a_folder_does_not(shelf, here):
    assert bundled.find_config("plain") == shelf / "plain.toml"
    (here / "plain").mkdir()
    assert bundled.find_config("plain") == shelf / "plain.toml"
    (here / "plain").rmdir()
    (here / "plain").write_text(CONFIG)
    assert bundled.find_config("plain").absolute() == here / "plain"


def test_a_misspelt_name_is_told_with_the_nearest(shelf, here):
    with pytest.raises(ConfigError, match="nearest: plain"):
        bundled.find_config("plian.toml")
