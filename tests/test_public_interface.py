"""The public names exist, and each is what its module says."""

import pytest

import vasc


@pytest.mark.parametrize("name", vasc.__all__)
def test_a_public_name_is_there_and_documented(name):
    assert getattr(vasc, name).__doc__


def test_the_list_is_complete():
    assert set(vasc.__all__) == set(vasc._HOMES)


def test_another_name_is_refused():
    with pytest.raises(AttributeError, match="no attribute 'grow'"):
        vasc.grow  # noqa: B018
