"""Key-framed leaves for tests: the first leaf of Arabidopsis, and smaller ones.

The rows of the first leaf of Arabidopsis are control data that were made for this
project (by hand, then a local search) so that its veins appear in the sequence of
Runions 2008, chapter 5; the thesis prints no numbers. A row is height on the
midline, half-width, and rise of the margin, in D, from the base to the tip.
"""

ARABIDOPSIS = {
    0.0: [
        (0.0, 5.0, 0.0),
        (0.44, 5.0, 0.0),
        (1.33, 5.0, 0.0),
        (2.67, 5.0, 0.0),
        (4.0, 4.9, 0.0),
        (5.33, 4.6, -0.3),
        (6.67, 4.0, -0.5),
        (7.56, 2.9, -0.6),
        (8.0, 1.5, -0.2),
    ],
    60.0: [
        (0.0, 6.0, 0.0),
        (1.67, 6.0, 0.0),
        (5.0, 6.2, 0.0),
        (10.0, 7.2, 0.0),
        (15.0, 7.7, 0.0),
        (20.0, 7.7, -0.3),
        (25.0, 7.0, -0.6),
        (28.33, 4.8, -1.0),
        (30.0, 2.6, -0.55),
    ],
    114.0: [
        (0.0, 6.0, 0.0),
        (3.2, 6.3, 0.0),
        (8.0, 6.8, 0.0),
        (15.2, 9.0, 0.0),
        (21.6, 12.8, 0.5),
        (28.5, 11.4, 0.5),
        (36.0, 10.0, -0.6),
        (41.3, 6.9, -1.4),
        (44.0, 3.0, -0.65),
    ],
    160.0: [
        (0.0, 6.4, 0.0),
        (3.4, 6.6, 0.0),
        (9.4, 6.9, 0.0),
        (17.8, 9.6, 0.5),
        (27.4, 13.4, 2.0),
        (37.8, 15.6, 2.0),
        (46.4, 13.6, 0.0),
        (52.0, 8.8, -1.5),
        (54.8, 4.5, -0.83),
    ],
    276.0: [
        (0.0, 6.9, 0.0),
        (5.6, 8.0, 0.0),
        (15.4, 13.5, 1.5),
        (29.2, 26.0, 8.0),
        (46.0, 34.0, 15.0),
        (71.0, 36.0, 9.0),
        (91.0, 27.0, -1.0),
        (99.5, 13.0, -2.0),
        (103.0, 5.5, -0.84),
    ],
    600.0: [
        (0.0, 7.5, 0.0),
        (30.0, 8.8, 0.0),
        (63.0, 80.0, 3.0),
        (108.0, 130.0, 28.0),
        (167.0, 130.0, 50.0),
        (210.0, 110.0, 28.0),
        (256.0, 82.0, 2.0),
        (283.0, 44.0, -5.0),
        (290.0, 12.0, -1.1),
    ],
}

SMALL = {
    0.0: [(0.0, 5.0, 0.0), (2.0, 6.0, 0.0), (5.0, 6.0, 0.0), (9.0, 5.0, -0.5), (11.0, 2.0, -0.4)],
    60.0: [
        (0.0, 9.0, 0.0),
        (8.0, 16.0, 0.0),
        (20.0, 20.0, 3.0),
        (34.0, 14.0, 0.0),
        (42.0, 4.0, -0.6),
    ],
    130.0: [
        (0.0, 12.0, 0.0),
        (12.0, 34.0, 2.0),
        (40.0, 44.0, 9.0),
        (66.0, 24.0, 0.0),
        (80.0, 7.0, -0.9),
    ],
}
"""A small leaf of our own, with a mesophyll event to its end in a second."""

FOLDING = {
    0.0: [(0.0, 5.0, 0.0), (4.0, 5.0, 0.0), (8.0, 5.0, 0.0), (12.0, 5.0, 0.0)],
    10.0: [(0.0, 5.0, 0.0), (4.0, 5.0, 0.0), (8.0, 5.0, 40.0), (12.0, 5.0, 0.0)],
}
"""Sound at first; the margin of its third row rises above that of the fourth."""


def keyframed(frames, **tables):
    """The growth table of a key-framed leaf."""
    rows = [{"time": time, "rows": rows} for time, rows in frames.items()]
    return {"kind": "keyframed", "frames": rows, **tables}


def leaf(kind, frames=None, birth_distance=10.0, until=None, **tables):
    """A config of venation on a key-framed leaf, with sources in largest empty circles."""
    config = {
        "kind": kind,
        "growth": keyframed(ARABIDOPSIS if frames is None else frames),
        "placement": {
            "kind": "empty_circles",
            "birth_distance": birth_distance,
            "until": until,
        },
        "arrival": {"kill_distance": 1.5},
        "refinement": {"kind": "corner_cutting"},
    }
    return {**config, **tables}
