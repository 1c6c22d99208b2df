"""The public names exist, and each is what its module says."""

import re
from pathlib import Path

import pytest

import vasc


@pytest.mark.parametrize("name", vasc.__all__)
def test_a_public_name_is_there_and_documented(name):
    assert getattr(vasc, name).__doc__


def test_the_list_is_complete():
    assert set(vasc.__all__) == set(vasc._HOMES)


def test_the_page_on_python_lists_the_interface():
    page = (Path(__file__).resolve().parent.parent / "docs" / "api.md").read_text()
    assert set(re.findall(r"^   vasc\.(\w+)$", page, flags=re.MULTILINE)) == set(vasc.__all__)


def test_another_name_is_refused():
    with pytest.raises(AttributeError, match="no attribute 'grow'"):
        vasc.grow  # noqa: B018
