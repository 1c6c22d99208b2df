"""Timelines in, pictures and films out; matplotlib is loaded when something is drawn."""

from vasc.render.animation import FILM_SUFFIXES, Film, animate
from vasc.render.files import render
from vasc.render.growth import GrownGrid, GrowthMap, draw_growth
from vasc.render.leaf import draw_leaf
from vasc.render.leaf_checks import draw_leaf_check, draw_leaf_checks, save_leaf_checks
from vasc.render.saving import PICTURE_SUFFIXES, save
from vasc.render.sequence import draw_sequence
from vasc.render.stems import StemStyle, draw_stem
from vasc.render.styles import COLOR_CHOICES, LeafStyle
from vasc.render.transitions import draw_transitions
from vasc.render.unrolled import UnrolledStyle, draw_unrolled

__all__ = [
    "COLOR_CHOICES",
    "FILM_SUFFIXES",
    "PICTURE_SUFFIXES",
    "Film",
    "GrownGrid",
    "GrowthMap",
    "LeafStyle",
    "StemStyle",
    "UnrolledStyle",
    "animate",
    "draw_growth",
    "draw_leaf",
    "draw_leaf_check",
    "draw_leaf_checks",
    "draw_sequence",
    "draw_stem",
    "draw_transitions",
    "draw_unrolled",
    "render",
    "save",
    "save_leaf_checks",
]
