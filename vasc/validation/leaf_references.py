"""Numbers of mature leaves in the literature and in published data, and what is asked of a leaf.

Nothing here was read off a run of ours. A range stands beside the numbers that were seen; where
it is wider than these, the margin is ours and the basis says so. Numbers that we only remember
from the literature are in :data:`REPORTED` and decide nothing. Angles are in degrees.
"""

from dataclasses import dataclass

from vasc.validation.references import OURS, THESIS, Basis

LEAF_CITATIONS = {
    "Runions 2008": "A. Runions (2008). Modeling biological patterns using the space colonization"
    " algorithm. Master's thesis, University of Calgary. Equation 3.5, sections 4.3 and 5.2.",
    "Ronellenfitsch 2015": "H. Ronellenfitsch, J. Lasser, D. C. Daly and E. Katifori (2015)."
    " Topological phenotypes constitute a new dimension in the phenotypic space of leaf venation"
    " networks. PLoS Computational Biology 11, e1004680. Network of a leaflet of Dalbergia"
    " miscolobium, published with it (github hronellenfitsch/nesting); measured by us.",
    "Matos": "I. S. Matos et al., venation tradeoffs (github ilamatos/venation_tradeoffs): networks"
    " of leaves of the University of California Botanical Garden; 45 species of rosids, asterids"
    " and basal eudicots, a sample each, measured by us.",
    "Iwamasa 2022": "Network of a leaf of Zelkova serrata, published as"
    " MorphometricsGroup/iwamasa-2022 (github); measured by us.",
    "Bohn 2002": "S. Bohn, B. Andreotti, S. Douady, J. Munzinger and Y. Couder (2002). Constitutive"
    " property of the local organization of leaf venation networks. Physical Review E 65, 061914."
    " Abstract.",
    "Katifori & Magnasco 2012": "E. Katifori and M. O. Magnasco (2012). Quantifying loopy network"
    " architectures. PLoS ONE 7, e37994. Abstract.",
    "Price 2012": "C. A. Price, S. Wing and J. S. Weitz (2012). Scaling and structure of"
    " dicotyledonous leaf venation networks. Ecology Letters 15, 87-95. Summary.",
    "Sack 2012": "L. Sack et al. (2012). Developmentally based scaling of leaf venation"
    " architecture explains global ecological patterns. Nature Communications 3, 837. Abstract,"
    " captions of Figures 3 to 6.",
    "Kang & Dengler 2004": "J. Kang and N. Dengler (2004). International Journal of Plant Sciences"
    " 165, 231. Abstract.",
    "Scarpella 2004": "E. Scarpella, P. Francis and T. Berleth (2004). Development 131, 3445-3455."
    " Abstract.",
}
"""Full references of the short names used below."""

DALBERGIA, SPECIES, ZELKOVA = "Ronellenfitsch 2015", "Matos", "Iwamasa 2022"


@dataclass(frozen=True)
class LeafRange:
    """What a number of a leaf has to be.

    Parameters
    ----------
    key : str
        Names it in the code.
    number : int
        The check that it belongs to.
    words : str
        What is measured.
    low, high : float
        Least and greatest value.
    sources : tuple of str
        Keys of :data:`LEAF_CITATIONS`.
    seen : str
        The numbers that the range is read from.
    basis : {"thesis", "ours"}
        Ours where the sources give numbers or words, and the margin around them is ours.
    """

    key: str
    number: int
    words: str
    low: float
    high: float
    sources: tuple[str, ...]
    seen: str
    basis: Basis = OURS


_RANGES = (
    LeafRange(
        "degree_three", 6, "junctions of three veins, share", 0.9, 1.0,
        (DALBERGIA, ZELKOVA), "1.00 in Dalbergia, 0.914 in Zelkova",
    ),
    LeafRange(
        "degree_most", 6, "most veins at a junction", 3, 5,
        (DALBERGIA, ZELKOVA), "3 in Dalbergia, 5 in Zelkova",
    ),
    LeafRange(
        "corners_mean", 7, "corners of areoles, mean", 5.7, 6.1,
        (DALBERGIA,), "5.946 in Dalbergia; Euler's formula asks for nearly 6",
    ),
    LeafRange(
        "corners_variance", 7, "corners of areoles, variance", 1.3, 3.0,
        (DALBERGIA,), "2.1 in Dalbergia",
    ),
    LeafRange(
        "elongation", 7, "elongation of areoles, median", 1.3, 1.7,
        (DALBERGIA, SPECIES), "1.46 in Dalbergia, 1.45 to 1.75 in 45 species",
    ),
    LeafRange(
        "circularity", 7, "circularity of areoles, median", 0.70, 0.85,
        (DALBERGIA, SPECIES), "0.78 in Dalbergia, median 0.76 of 45 species",
    ),
    LeafRange(
        "area_cv", 7, "area of areoles, variation", 0.4, 0.9,
        (DALBERGIA, SPECIES), "0.57 in Dalbergia, 0.65 to 1.5 in most of 45 species",
    ),
    LeafRange(
        "density_x_sqrt_areole", 8, "enclosed vein density x root of mean areole area", 1.9, 2.6,
        (DALBERGIA, SPECIES), "2.20 in Dalbergia, quartiles 1.80 and 2.52 of 45 species",
    ),
    LeafRange(
        "density_x_distance", 9, "enclosed vein density x mean distance to vein", 0.30, 0.45,
        (DALBERGIA,), "0.362 in Dalbergia",
    ),
    LeafRange(
        "ends_with_event", 10, "veins that end in an areole, with the event", 1, float("inf"),
        ("Scarpella 2004", "Runions 2008"), "mesophyll ends the extension of veins", THESIS,
    ),
    LeafRange(
        "ends_without_event", 10, "veins that end in an areole, without the event", 0, 0,
        ("Runions 2008",), "every strand reaches the vein of its canal", THESIS,
    ),
    LeafRange(
        "mst_closed", 11, "spanning tree over all veins, closed", 0.5, 0.75,
        (DALBERGIA, SPECIES), "0.543 in Dalbergia, 0.501 to 0.786 in 45 species",
    ),
    LeafRange(
        "mst_open", 11, "spanning tree over all veins, open", 1.0, 1.0,
        ("Runions 2008",), "open venation is a tree", THESIS,
    ),
    LeafRange(
        "force_residual", 12, "force residual over its shuffled control", 0.0, 1.0,
        ("Bohn 2002", DALBERGIA), "0.125 against 0.184 in Dalbergia",
    ),
    LeafRange(
        "angle_off", 12, "angle of the two widest veins, most off the law", 0.0, 15.0,
        ("Bohn 2002", DALBERGIA), "0 to 12 degrees above the law in Dalbergia",
    ),
    LeafRange(
        "hierarchy", 13, "loop asymmetry below its shuffled control by", 0.05, 1.0,
        ("Katifori & Magnasco 2012", DALBERGIA), "0.418 against 0.533 in Dalbergia",
    ),
    LeafRange(
        "murray", 14, "exponent at branchings, most off the one asked for", 0.0, 1e-6,
        ("Runions 2008",), "r^n = r1^n + r2^n (equation 3.5)", THESIS,
    ),
    LeafRange(
        "minor_change", 15, "minor vein density over the last doubling, largest change", 0.0, 0.2,
        ("Sack 2012", "Kang & Dengler 2004"), "minor vein density stabilizes",
    ),
    LeafRange(
        "major_exponent", 15, "exponent of major vein density against area", -0.65, -0.35,
        ("Sack 2012",), "-0.5, geometric similarity",
    ),
)  # fmt: skip
LEAF_RANGES = {one.key: one for one in _RANGES}
"""What is asked, by key."""


@dataclass(frozen=True)
class Reported:
    """A number that is printed beside one of the literature, and decides nothing.

    Parameters
    ----------
    key : str
        The key of the statistics.
    words : str
        What it is.
    seen : str
        The number of the literature.
    sources : tuple of str
        Keys of :data:`LEAF_CITATIONS`; empty for what we only remember.
    """

    key: str
    words: str
    seen: str
    sources: tuple[str, ...] = ()


REPORTED = (
    Reported("free_ends_per_areole", "free ends per areole", "0 to about 2, from memory"),
    Reported(
        "free_end_length_share", "share of length in free ends", "0.044 in Dalbergia", (DALBERGIA,)
    ),
    Reported(
        "section_length_cv",
        "length of veins between junctions, variation",
        "0.54 in Dalbergia; near exponential",
        (DALBERGIA, "Price 2012"),
    ),
    Reported(
        "murray_exponent_median",
        "Murray exponent, median",
        "3.1 in Dalbergia, quartiles 2.1 and 4.9",
        (DALBERGIA,),
    ),
    Reported(
        "loop_asymmetry",
        "loop asymmetry",
        "0.418 in Dalbergia, 0.36 to 0.64 in 45 species",
        (DALBERGIA, SPECIES),
    ),
)
"""What is told beside the checks."""

DALBERGIA_NUMBERS = {
    "nodes": 16474,
    "segments": 22871,
    "areoles": 6398,
    "free_ends_per_areole": 0.288,
    "free_end_length_share": 0.044,
    "density_x_sqrt_areole": 2.205,
    "density_x_distance": 0.362,
    "areole_area_cv": 0.569,
    "areole_circularity_median": 0.784,
    "areole_elongation_median": 1.464,
    "areole_corners_mean": 5.946,
    "section_length_cv": 0.542,
    "mst_ratio": 0.543,
    "box_dimension": 1.85,
    "loop_asymmetry": 0.418,
    "loop_asymmetry_shuffled": 0.533,
    "loop_asymmetry_weighted": 0.857,
    "loop_asymmetry_weighted_shuffled": 0.995,
}
"""The leaflet of Dalbergia, measured once by another program (data of Ronellenfitsch 2015)."""
SAME = 0.01
"""Ours: share by which our numbers of the leaflet may differ from these."""
LAST_DIGIT = 0.0005
"""Half of the last decimal place that was written down: no smaller difference counts."""

DALBERGIA_ANGLES = (
    (0.0, 0.2, 174.0, 171.0),
    (0.2, 0.3, 174.0, 166.0),
    (0.3, 0.4, 172.0, 160.0),
    (0.4, 0.5, 162.0, 153.0),
    (0.5, 0.6, 155.0, 146.0),
    (0.6, 0.7, 145.0, 140.0),
    (0.7, 0.8, 136.0, 134.0),
    (0.8, 0.9, 129.0, 128.0),
    (0.9, 1.0, 124.0, 123.0),
)
"""Classes of thinnest over widest vein: limits, median angle of the two widest, and the law's."""
NEARLY_AS_WIDE = 0.75
"""Second over widest vein, from which on a junction is in the classes."""
FEWEST = 10
"""Ours: junctions from which on the median of a class is judged."""

SPECIES_PERCENTILES = {
    "mst_ratio": (0.501, 0.597, 0.655, 0.713, 0.786),
    "areole_area_cv": (0.65, 0.94, 1.11, 1.52, 3.43),
    "areole_circularity_median": (0.70, 0.74, 0.76, 0.82, 0.95),
    "areole_elongation_median": (1.45, 1.54, 1.59, 1.63, 1.75),
    "loop_asymmetry": (0.36, 0.42, 0.45, 0.53, 0.64),
    "density_x_sqrt_areole": (1.00, 1.80, 2.26, 2.52, 3.19),
}
"""5, 25, 50, 75 and 95 percent of 45 species (data of Matos); areas hold artifacts of tracing."""

MOST_MAJOR = 3
"""Highest vein order that counts as major (Sack 2012): first to third."""
