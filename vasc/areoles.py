"""Areoles: pieces of blade that veins enclose, born when a loop closes and split by veins."""

from vasc.arrays import Column

AREOLE_COLUMNS = {
    "birth": Column("i4", "step of birth"),
    "parent": Column("i4", "areole it was split from, -1 if it was born in open tissue"),
    "segment": Column("i4", "segment that closed it"),
}

BOUNDARY_COLUMNS = {
    "areole": Column("i4", "areole"),
    "node": Column("i4", "one node around it at its birth, counterclockwise"),
}
