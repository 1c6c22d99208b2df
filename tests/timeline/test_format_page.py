"""The page that specifies the format names everything that the layout declares."""

import re
from pathlib import Path

import numpy as np
import pytest

from vasc.events import EventKind, StopReason
from vasc.timeline import areole_rules, layout, motion_rules, rules, tissue_rules, validation

PAGE = (Path(__file__).parents[2] / "docs" / "timeline-format.md").read_text(encoding="utf-8")
SOURCES = "".join(
    Path(module.__file__).read_text(encoding="utf-8")
    for module in (rules, motion_rules, areole_rules, tissue_rules, validation)
)


def cells(name):
    """Give the cells of the table row that begins with a name."""
    rows = [line for line in PAGE.splitlines() if line.startswith(f"| `{name}` |")]
    assert len(rows) == 1, name
    return [cell.strip() for cell in rows[0].strip("|").split("|")]


COLUMNS = {
    name: column
    for motion in layout.Motion
    for name, column in layout.growing_columns(1, motion).items()
} | layout.growing_columns(1, has_tissue=True)
IN_SPACE = layout.growing_columns(1, layout.Motion.NONE, dimensions=3)


@pytest.mark.parametrize("name", COLUMNS)
def test_every_growing_column_has_its_type_on_the_page(name):
    column = COLUMNS[name]
    kind = np.dtype(column.dtype).str[1:]
    shape = str(column.shape).replace("(1, 6)", "(s, 6)") if column.shape else ""
    if name in IN_SPACE and IN_SPACE[name].shape != column.shape:
        assert (column.shape, IN_SPACE[name].shape) == ((2,), (3,))
        shape = "(d,)"
    assert cells(name)[1] == f"{kind} {shape}".strip()


@pytest.mark.parametrize("name", [*layout.STATIC, *layout.MARKS, *layout.TEXTS, layout.PROVENANCE])
def test_every_other_dataset_is_on_the_page(name):
    assert cells(name)


@pytest.mark.parametrize("kind", EventKind, ids=lambda kind: kind.name)
def test_every_event_is_on_the_page_with_its_roles(kind):
    _, subject, other = cells(kind.name.lower())
    roles = layout.ROLES[kind]
    assert roles.subject is None or roles.subject.rstrip("s") in subject
    assert (roles.object is None) == (other == "-1")
    assert roles.object is None or roles.object.rstrip("s") in other


def test_every_code_is_on_the_page():
    for enums in layout.NAMES.values():
        for enum in enums.values():
            for member in enum:
                assert f"`{member.name.lower()}`" in PAGE, member
    assert all(f"`{reason.name.lower()}`" in PAGE for reason in StopReason)


def test_every_rule_a_finding_names_is_on_the_page():
    found = set(re.findall(r'f?"\[([a-z-]+)\]', SOURCES)) | set(
        re.findall(r'bad_rows\(\s*"([a-z-]+)"', SOURCES)
    )
    assert len(found) > 10
    for rule in found:
        assert f"`{rule}`" in PAGE, rule


def test_the_page_and_the_layout_are_of_one_version():
    assert f"`{layout.FORMAT}`, version {'.'.join(map(str, layout.VERSION))}." in PAGE
