"""What tests of sweeps share: sweeps that were made without any disturbance."""

import os

import pytest
from sweeps.sweep_files import LONG, SHORT, write

from vasc.cli import main


@pytest.fixture
def here(tmp_path, monkeypatch):
    """Work in a folder that holds a sweep and its base alone."""
    monkeypatch.chdir(tmp_path)
    write(tmp_path)
    return tmp_path


def _made(folder, text):
    write(folder, text)
    before = os.getcwd()
    os.chdir(folder)
    try:
        assert main(["sweep", "small.toml", "-o", "out", "--workers", "1", "-q"]) == 0
    finally:
        os.chdir(before)
    return folder / "out"


@pytest.fixture(scope="session")
def short(tmp_path_factory):
    """Give the folder of a sweep of eight short runs, made by one worker."""
    return _made(tmp_path_factory.mktemp("short"), SHORT)


@pytest.fixture(scope="session")
def long(tmp_path_factory):
    """Give the folder of a sweep of three runs of some seconds, made by one worker."""
    return _made(tmp_path_factory.mktemp("long"), LONG)
