"""The numbers that decide the pattern, against values worked out by hand."""

import pytest

from vasc.config import load_text
from vasc.config.regime import regime

DARTS = """[placement]
kind = "darts"
density = {density}
birth_distance_sources = {distance}
birth_distance_veins = 5.0
"""
GIVEN = '[placement]\nkind = "given"\npoints = [[0.0, 5.0]]\n'


def regime_of(growth, placement=GIVEN, length=115.0, extra=""):
    """Give the regime of a config."""
    text = f'kind = "closed"\n[domain]\nshape = "fan"\nlength = {length}\n{placement}'
    return regime(
        load_text(f"{text}[arrival]\nkill_distance = 3.0\n[growth]\n{growth}\n{extra}").parameters
    )


def linear(kind, final_length, length_per_step):
    """Give the table of a growth."""
    return f'kind = "{kind}"\nfinal_length = {final_length}\nlength_per_step = {length_per_step}'


def test_poplar_has_the_number_of_the_reading_of_table_4_1():
    # ln(3500 / 115) / 6 = 0.5693
    found = regime_of(linear("isogonic", 3500.0, 6.0))
    assert found.numbers == {"crossing": pytest.approx(0.56928, rel=1e-4)}
    assert "reticulation" in found.sentences[0]
    assert found.warnings == []


def test_reticulate_as_printed_is_a_fan():
    # ln(4500 / 225) / 40.5 = 0.0740: Table 4.1 as extracted, which gives a fan
    found = regime_of(linear("isogonic", 4500.0, 40.5), length=225.0)
    assert found.numbers["crossing"] == pytest.approx(0.07397, rel=1e-3)
    assert "fan" in found.sentences[0]
    assert "length_per_step" in found.warnings[0]


@pytest.mark.parametrize(
    ("speed", "word", "is_warned"),
    [
        (0.34, "pinnate", False),
        (0.8, "pinnate", False),
        (1.5, "ladder", False),
        (3.0, "ladder", False),
        (5.0, "between a midvein with secondaries and a fan", False),
        (6.0, "the margin outruns the veins", True),
        (6.5, "a fan, as without growth", True),
        (0.05, "pinnate", True),
    ],
)
def test_a_margin_has_the_class_of_the_thesis(speed, word, is_warned):
    found = regime_of(linear("marginal", 400.0, speed))
    assert found.numbers == {"margin_speed": pytest.approx(speed)}
    assert word in found.sentences[0]
    assert "in an ovate leaf of closed veins" in found.sentences[0]
    assert bool(found.warnings) == is_warned


def test_the_length_of_a_segment_counts():
    extra = "[extension]\nsegment_length = 2.0\n"
    assert regime_of(linear("marginal", 400.0, 3.0), extra=extra).numbers == {"margin_speed": 1.5}
    slow, fast = (
        regime_of(linear("isogonic", 3500.0, 6.0), extra=more).numbers["crossing"]
        for more in ("", extra)
    )
    assert fast == pytest.approx(2.0 * slow)


@pytest.mark.parametrize(
    ("density", "distance", "number", "is_warned"),
    [
        (200e-6, 20.0, 0.08, False),
        (6000e-6, 10.0, 0.6, False),
        (60e-6, 10.0, 0.006, False),
        (1e-6, 10.0, 1e-4, True),
        (0.1, 10.0, 10.0, True),
    ],
)
def test_darts_are_counted_per_spacing(density, distance, number, is_warned):
    found = regime_of('kind = "none"', DARTS.format(density=density, distance=distance))
    assert found.numbers == {"darts_per_spacing": pytest.approx(number)}
    assert bool(found.warnings) == is_warned


def test_a_blade_that_does_not_grow_has_a_sentence_and_no_number():
    found = regime_of('kind = "none"')
    assert found.numbers == {}
    assert "no growth" in found.sentences[0]
