"""How much each test of faults tries: a little in every suite, more at night, all for a release."""

from collections.abc import Mapping

import pytest

TIERS = ("fast", "nightly", "release")


def tiered(**sizes: tuple) -> pytest.MarkDecorator:
    """Run a test at every tier with a size of its own; all but the fast one are asked for.

    A tier whose size is 0 is left out.
    """
    names = ",".join(sizes)
    cases = []
    for number, tier in enumerate(TIERS):
        values = [size[number] for size in sizes.values()]
        if values[0] == 0:
            continue
        marks = () if tier == "fast" else (pytest.mark.faults,)
        cases.append(pytest.param(*values, id=tier, marks=marks))
    return pytest.mark.parametrize(names, cases)


class Report:
    """What a test tried, kept for the table at the end."""

    def __init__(self, node: pytest.Item) -> None:
        self._node = node

    def add(self, fault: str, *, tried: int, lost: int, note: str = "") -> None:
        """Add a row."""
        row = {"fault": fault, "tried": tried, "survived": tried - lost, "lost": lost, "note": note}
        self._node.user_properties.append(("faults", row))


def table(rows: list[Mapping[str, object]]) -> list[str]:
    """Give the lines of the table."""
    lines = ["| fault | tried | survived | lost | |", "|---|---|---|---|---|"]
    lines += ["| {fault} | {tried} | {survived} | {lost} | {note} |".format(**row) for row in rows]
    return lines
