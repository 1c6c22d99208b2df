"""Numbers and words of papers, each with where they stand; nothing here is computed.

What a check holds a run against is entered here once. Thresholds that a paper gives in words
alone carry a number of our own and say so: ``THESIS`` or ``OURS`` is printed beside each.
"""

from dataclasses import dataclass
from typing import Literal

Basis = Literal["thesis", "ours"]

THESIS: Basis = "thesis"
"""The threshold is what the words of the thesis say."""
OURS: Basis = "ours"
"""The thesis gives words; the number put to them is ours."""

CITATIONS = {
    "Runions 2008": "A. Runions (2008). Modeling biological patterns using the space colonization"
    " algorithm. Master's thesis, University of Calgary. Section 5.1 and Figure 5.1 for what is"
    " observed, section 5.3 for what simulations did.",
    "Scarpella 2006": "E. Scarpella, D. Marcos, J. Friml and T. Berleth (2006). Control of leaf"
    " vascular patterning by polar auxin transport. Genes and Development 20, 1015-1027."
    " Captions of the figures (PMC1472298).",
    "Scarpella 2004": "E. Scarpella, P. Francis and T. Berleth (2004). Stage-specific markers"
    " define early steps of procambium development in Arabidopsis leaves and correlate termination"
    " of vein formation with mesophyll differentiation. Development 131, 3445-3455. Abstract.",
    "Verna 2019": "Verna et al. (2019). eLife, article 51061. Text and Figure 1.",
    "Sawchuk 2013": "Sawchuk et al. (2013). PLoS Genetics, article 1003294. Caption of Figure 2.",
    "Kang & Dengler 2004": "Kang and Dengler (2004). Abstract.",
}
"""Full references of the short names used below."""


@dataclass(frozen=True)
class Observation:
    """One event of the observed sequence.

    Parameters
    ----------
    number : int
        Its place in the sequence.
    words : str
        What was seen.
    sources : tuple of str
        Keys of :data:`CITATIONS`.
    events : tuple of str
        Names of the events of a run that stand for it; empty if a run has none.
    """

    number: int
    words: str
    sources: tuple[str, ...]
    events: tuple[str, ...] = ()


OBSERVED_SEQUENCE = (
    Observation(
        1,
        "a convergence point of auxin at the tip of the incipient leaf",
        ("Scarpella 2006", "Runions 2008"),
        ("tip_source",),
    ),
    Observation(2, "the midvein below it", ("Scarpella 2006", "Runions 2008"), ("midvein",)),
    Observation(
        3,
        "convergence points on both flanks, half-way between tip and base;"
        " the lower half of the first loop joins the midvein",
        ("Scarpella 2006", "Runions 2008"),
        ("pair_1", "lower_halves"),
    ),
    Observation(
        4,
        "the upper half of the first loop, and the two halves meet",
        ("Scarpella 2006", "Runions 2008"),
        ("upper_pair", "loop_1"),
    ),
    Observation(
        5,
        "second loops nearer the base; each joins the midvein and the older, more distal loop",
        ("Runions 2008", "Verna 2019"),
        ("pair_2", "loop_2"),
    ),
    Observation(
        6,
        "third loops nearer the base still",
        ("Runions 2008", "Verna 2019"),
        ("pair_3", "loop_3"),
    ),
    Observation(
        7,
        "minor veins inside a loop after the loop, from tip to base",
        ("Verna 2019", "Sawchuk 2013", "Runions 2008"),
        ("minor_in_loop_1", "minor_in_loop_2", "minor_in_loop_3"),
    ),
    Observation(
        8,
        "veins cease to meet when mesophyll differentiates, and end freely",
        ("Scarpella 2004", "Runions 2008"),
        ("mesophyll_event", "first_free_end"),
    ),
    Observation(
        9,
        "higher-order veins, free endings above all, form throughout expansion",
        ("Kang & Dengler 2004",),
    ),
)
"""What is observed in the first leaf, oldest event first."""

N_LOOP_PAIRS = 3
"""Loops on each side of the first leaf (Runions 2008, section 5.1: 'usually has three loops')."""

FEATURES = {
    "a": "one narrow I-shaped midvein along the whole leaf",
    "b": "lateral veins branch from the midvein and join distal veins into closed loops",
    "c": "minor veins branch from midvein and loops and either end freely or join other veins",
    "d": "loops and minor veins curve near the margin, so the outline of the network is scalloped",
}
"""Four reproducible features of the wild-type first leaf (Verna 2019)."""


@dataclass(frozen=True)
class SequenceThresholds:
    """Numbers put to the words about the first leaf; those marked ours are in no paper.

    Lengths are shares of the leaf length at birth, times are in steps of model time.
    """

    half_way: tuple[float, float] = (0.38, 0.62)
    """Ours, for 'approximately half-way between the tip and base' (Runions 2008, Figure 5.1 c)."""
    pair_time: float = 3.0
    """Ours: births of the two sources of a pair are not farther apart."""
    mirrored: float = 0.02
    """Ours: the mirror image of a source is not farther from its partner, along each axis."""
    tip: float = 0.02
    """Ours: the tip source is not farther from the tip, along the leaf and across."""
    minor_delay: float = 40.0
    """Ours, for minor veins in the first loop 'about with' the third (Runions 2008, 5.1 f)."""
    formed_ratio: float = 1.0
    """Thesis: the second loops enclose a larger area than the first 'much later' (5.3.1)."""
    third_formed_ratio: float = 0.6
    """Ours, for 'much smaller than the second loops when formed' (5.3.1)."""
    third_final_ratio: tuple[float, float] = (0.5, 2.0)
    """Ours, for 'an area approximately the same size in the final pattern' (5.3.1)."""
    margin: float = 0.15
    """Ours, in birth distances: a source not farther from the outline is on the margin."""
    midvein_span: float = 0.9
    """Ours: feature (a), share of the leaf length that the midvein runs along."""
    midvein_straightness: float = 0.95
    """Ours: feature (a), straight distance over length of the midvein."""
    unfinished_share: float = 0.1
    """Ours: feature (c), minor veins that may still be under way."""
    notch_depth: float = 0.01
    """Ours: feature (d), depth of a notch of the network's outline, in leaf lengths."""


SEQUENCE = SequenceThresholds()
