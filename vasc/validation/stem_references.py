"""Patterns of stem vasculature in the literature, and what is asked of a simulated stem.

Angles are in degrees here, as in the papers; lengths in D.
"""

from dataclasses import dataclass

from vasc.validation.references import OURS, THESIS, Basis

STEM_CITATIONS = {
    "Runions 2008": "A. Runions (2008). Modeling biological patterns using the space colonization"
    " algorithm. Master's thesis, University of Calgary. Chapter 6, captions of Figures 6.7 to"
    " 6.10.",
    "Jean 1982": "R. V. Jean (1982). The hierarchical control of phyllotaxis. Annals of Botany,"
    " 747-760; links along one number of the sequence in open systems, as cited in section 6.1.2.",
    "Girolami 1953": "G. Girolami (1953). Relation between phyllotaxis and primary vascular"
    " organization in Linum. American Journal of Botany 40(8), 618-625.",
    "Gunckel & Wetmore 1946": "J. E. Gunckel and R. H. Wetmore (1946). Studies of development in"
    " long shoots and short shoots of Ginkgo biloba L. II. American Journal of Botany 33(6),"
    " 532-543.",
    "Kang 2003": "J. Kang, J. Tang, P. Donnelly and N. Dengler (2003). Primary vascular pattern and"
    " expression of ATHB-8 in shoots of Arabidopsis. New Phytologist, 443-454.",
}
"""Full references of the short names used below."""


@dataclass(frozen=True)
class StemPattern:
    """A stem of the thesis, and the connectivity that its caption gives.

    Parameters
    ----------
    divergence : float
        Turn from one primordium to the next, in degrees.
    radius, rise : float
        R and H, in D.
    pair : tuple of int
        Each primordium is connected to those so many after it.
    plastochron : int
        Iterations between two primordia at which the pattern is to be looked for; ours,
        as the thesis gives none. Half the rise, so that the apex rises as fast as two
        tips close in on each other, except where a pattern asks for another one.
    least_fraction : float
        Share of the primordia, after the base, that have exactly the pair.
    figure : str
        Where the thesis gives it.
    words : str
        What the thesis says beyond the pair; empty for nothing.
    basis : {"thesis", "ours"}
        Who says what share is asked for: the thesis names exceptions for (1, 2) alone.
    """

    divergence: float
    radius: float
    rise: float
    pair: tuple[int, int]
    plastochron: int
    figure: str
    least_fraction: float = 1.0
    words: str = ""
    basis: Basis = THESIS

    @property
    def ratio(self) -> float:
        """Radius over rise."""
        return self.radius / self.rise


STEM_PATTERNS = (
    StemPattern(137.5, 115.0, 10.0, (5, 8), 5, "6.8, 6.9"),
    StemPattern(137.5, 115.0, 23.0, (3, 5), 12, "6.8"),
    StemPattern(137.5, 115.0, 33.0, (2, 3), 7, "6.8", 0.9, basis=OURS),
    StemPattern(137.5, 115.0, 96.0, (1, 1), 48, "6.8"),
    StemPattern(137.5, 50.0, 10.0, (3, 5), 5, "6.7, 6.9"),
    StemPattern(137.5, 35.0, 10.0, (2, 3), 2, "6.9", 0.9, basis=OURS),
    StemPattern(137.5, 16.0, 10.0, (1, 2), 5, "6.9", 0.0, "predominantly (1,2)"),
    StemPattern(137.5, 12.0, 10.0, (1, 1), 5, "6.9"),
    StemPattern(99.5, 180.0, 10.0, (7, 11), 10, "6.10"),
    StemPattern(99.5, 115.0, 10.0, (4, 7), 5, "6.10"),
    StemPattern(99.5, 50.0, 10.0, (3, 4), 5, "6.10"),
    StemPattern(99.5, 25.0, 10.0, (1, 3), 5, "6.10"),
    StemPattern(99.5, 12.0, 10.0, (1, 1), 5, "6.10"),
)
"""The thirteen stems of the thesis (Runions 2008, Figures 6.8 to 6.10)."""

MISSING_FIRST_LINKS = (2, 3, 7, 9, 10, 12, 14, 15, 17, 18, 20, 21, 23)
"""Primordia without a link to the next one in the stem of R = 16 D (Figure 6.9)."""


@dataclass(frozen=True)
class StemObservation:
    """Connectivity seen in a plant.

    Parameters
    ----------
    plant : str
        Which.
    pair : tuple of int
        Primordia are connected to those so many after them.
    source : str
        A key of :data:`STEM_CITATIONS`; as Runions (2008), section 6.3, cites it.
    """

    plant: str
    pair: tuple[int, int]
    source: str


STEM_OBSERVATIONS = (
    StemObservation("Arabidopsis thaliana, rosette", (5, 8), "Kang 2003"),
    StemObservation("Ginkgo biloba", (5, 8), "Gunckel & Wetmore 1946"),
    StemObservation("Linum usitatissimum", (7, 11), "Girolami 1953"),
)
"""Patterns of :data:`STEM_PATTERNS` that were seen in plants."""

LEAST_FRACTION = 0.9
"""Ours: share of the primordia with exactly the pair, for any stem."""

CHORD_THRESHOLDS: dict[float, tuple[tuple[tuple[int, int], float], ...]] = {
    137.5: (
        ((1, 1), 1.349),
        ((1, 2), 1.724),
        ((2, 3), 3.726),
        ((3, 5), 9.116),
        ((5, 8), 23.275),
    ),
    99.5: (((1, 1), 1.326), ((1, 3), 2.805), ((3, 4), 6.743), ((4, 7), 17.072)),
    77.96: (((1, 1), 1.95), ((1, 4), 4.27), ((4, 5), 10.7)),
    151.14: (((1, 1), 1.03), ((1, 2), 2.2), ((2, 3), 3.03), ((2, 5), 7.56)),
    64.08: (((1, 1), 2.14), ((1, 5), 6.08)),
}
"""Ours: radius over rise up to which a pair is predicted along chords, by divergence."""
ARC_THRESHOLDS: dict[float, tuple[tuple[tuple[int, int], float], ...]] = {
    137.5: (((1, 1), 0.918), ((1, 2), 1.276), ((2, 3), 3.343), ((3, 5), 8.755)),
    99.5: (((1, 1), 0.861), ((1, 3), 2.414), ((3, 4), 6.379), ((4, 7), 16.718)),
}
"""Ours: the same along arcs, which contradicts seven of the thirteen stems."""
