"""The tier that is asked for, the report of a test, and the table at the end of all."""

import pytest
from faults.tiers import TIERS, Report, table


def pytest_collection_modifyitems(config, items):
    """Leave out the tests of tiers that are not asked for."""
    wanted = config.getoption("--tier")
    others = [tier for tier in TIERS if tier not in ("fast", wanted)]
    left_out = [
        item
        for item in items
        if item.get_closest_marker("faults")
        and any(tier in item.name.partition("[")[2] for tier in others)
    ]
    if left_out:
        config.hook.pytest_deselected(items=left_out)
        items[:] = [item for item in items if item not in left_out]


@pytest.fixture
def report(request):
    return Report(request.node)


def pytest_terminal_summary(terminalreporter):
    """Print what was tried, survived and lost."""
    rows = [
        value
        for reports in terminalreporter.stats.values()
        for one in reports
        if getattr(one, "when", "") == "call"
        for name, value in getattr(one, "user_properties", ())
        if name == "faults"
    ]
    if rows:
        terminalreporter.section("faults")
        for line in table(rows):
            terminalreporter.write_line(line)
