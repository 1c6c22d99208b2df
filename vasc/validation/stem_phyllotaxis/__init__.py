"""Stem vasculature: which primordia veins connect, held against phyllotaxis."""

from vasc.validation.stem_phyllotaxis.connectivity import (
    Connectivity,
    Deviation,
    measure_connectivity,
)
from vasc.validation.stem_phyllotaxis.lattice import Prediction, PrimordiumLattice, predict
from vasc.validation.stem_phyllotaxis.parastichies import (
    ContactParastichies,
    PrimordiumRow,
    contact_parastichies,
    n_sympodia,
    sympodia,
    topology_table,
)
from vasc.validation.stem_phyllotaxis.report import ConnectivityReport, check_connectivity
from vasc.validation.stem_phyllotaxis.stem_graph import StemGraph
from vasc.validation.stem_phyllotaxis.ties import TieVerdict, judge_tie
from vasc.validation.stem_phyllotaxis.transitions import Interval, crossing, intervals

__all__ = [
    "Connectivity",
    "ConnectivityReport",
    "ContactParastichies",
    "Deviation",
    "Interval",
    "Prediction",
    "PrimordiumLattice",
    "PrimordiumRow",
    "StemGraph",
    "TieVerdict",
    "check_connectivity",
    "contact_parastichies",
    "crossing",
    "intervals",
    "judge_tie",
    "measure_connectivity",
    "n_sympodia",
    "predict",
    "sympodia",
    "topology_table",
]
