"""Timelines in, pictures and films out; matplotlib is loaded when something is drawn."""

from vasc.render.animation import FILM_SUFFIXES, Film, animate
from vasc.render.births import draw_births
from vasc.render.files import render
from vasc.render.genealogy import draw_genealogy
from vasc.render.growth import GrownGrid, GrowthMap, draw_growth
from vasc.render.leaf import View, draw_leaf
from vasc.render.leaf_checks import draw_leaf_check, draw_leaf_checks, save_leaf_checks
from vasc.render.saving import PICTURE_SUFFIXES, save
from vasc.render.sequence import draw_sequence
from vasc.render.stems import StemStyle, draw_stem
from vasc.render.styles import COLOR_CHOICES, TISSUE_COLOR_CHOICES, LeafStyle
from vasc.render.survival import draw_survival
from vasc.render.tissue import draw_tissue
from vasc.render.tissue_style import TissueScale, TissueStyle, scale_of
from vasc.render.transitions import draw_transitions
from vasc.render.unrolled import UnrolledStyle, draw_unrolled

__all__ = [
    "COLOR_CHOICES",
    "FILM_SUFFIXES",
    "PICTURE_SUFFIXES",
    "TISSUE_COLOR_CHOICES",
    "Film",
    "GrownGrid",
    "GrowthMap",
    "LeafStyle",
    "StemStyle",
    "TissueScale",
    "TissueStyle",
    "UnrolledStyle",
    "View",
    "animate",
    "draw_births",
    "draw_genealogy",
    "draw_growth",
    "draw_leaf",
    "draw_leaf_check",
    "draw_leaf_checks",
    "draw_sequence",
    "draw_stem",
    "draw_survival",
    "draw_tissue",
    "draw_transitions",
    "draw_unrolled",
    "render",
    "save",
    "save_leaf_checks",
    "scale_of",
]
