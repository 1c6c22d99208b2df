"""Fields on a tissue: auxin and its carriers in every cell and wall at one step."""

from enum import IntEnum
from typing import NamedTuple

from vasc.arrays import Codes, Column, Columns, Floats


class Role(IntEnum):
    """What a cell does with auxin."""

    GROUND = 0
    """Passes on what it gets, and makes some where the tissue has background production."""
    SOURCE = 1
    """Makes auxin."""
    VEIN = 2
    """Differentiated vein: a sink, which keeps the concentration 0."""


class Fields(NamedTuple):
    """Auxin in a tissue at one step, in the units of the model.

    The flux of a wall is what passes through all of it, in units of what one source
    makes; it is above 0 from the first cell of the wall to the second.
    """

    concentration: Floats
    """Auxin in each cell, shape (n,)."""
    flux: Floats
    """Net flux through each wall, shape (w,)."""
    carriers: Floats
    """State of each wall, shape (w, 2): carriers from its first cell to the second, and back.

    Facilitated diffusion has one state a wall, its permeability, which is in both columns.
    """
    roles: Codes
    """What each cell does, values of :class:`Role`, shape (n,)."""


FIELD_COLUMNS: Columns = {
    "concentration": Column("f8", "auxin in every cell at step 0, at step 1, ..."),
    "flux": Column("f8", "net flux through every wall, from its first cell to the second"),
    "carriers": Column("f8", "carriers of every wall, from its first cell on, and back", "", (2,)),
    "roles": Column("i1", "0 ground, 1 source, 2 vein"),
}
"""Columns of the group ``fields`` of a timeline; a step is a slice, row = cell or wall id."""
VORTEX = 1.1
"""A cell that passes more than that, over all that is made, is part of a vortex."""
OF_WALLS = ("flux", "carriers")
"""Fields with a row a wall; the others have one a cell."""
