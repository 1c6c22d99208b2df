"""Simulated leaves against real ones: statistics of veins with the ranges of the literature."""

from vasc.validation.vein_statistics.checks import AngleClass, LeafCheck, angle_classes, check_leaf
from vasc.validation.vein_statistics.densities import Densities, densities_of
from vasc.validation.vein_statistics.own_leaves import validate_leaves
from vasc.validation.vein_statistics.samples import LeafSample, dalbergia, sample_of_run
from vasc.validation.vein_statistics.suite import LeafReport, leaf_suite, validate_leaf

__all__ = [
    "AngleClass",
    "Densities",
    "LeafCheck",
    "LeafReport",
    "LeafSample",
    "angle_classes",
    "check_leaf",
    "dalbergia",
    "densities_of",
    "leaf_suite",
    "sample_of_run",
    "validate_leaf",
    "validate_leaves",
]
