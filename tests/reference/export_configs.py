"""Configs of small leaves with units, for exports."""

LEAF = """kind = "{kind}"
seed = 3
title = "A leaf -- for <export> & co"
reference = "none"

[domain]
shape = "ovate"
length = 20.0

[growth]
kind = "{growth}"
final_length = 70.0
length_per_step = 1.0

[placement]
kind = "darts"
density = 0.01
birth_distance_sources = 5.0
birth_distance_veins = 5.0

[arrival]
kill_distance = {kill_distance}

[refinement]
kind = "{refinement}"

[widths]
tip_radius = 0.2
exponent = 2.5

[units]
length = "um"
segment = 4.0
"""
KINDS = {
    "closed": {
        "kind": "closed",
        "growth": "isogonic",
        "kill_distance": 1.0,
        "refinement": "subdivision",
    },
    "open": {"kind": "open", "growth": "marginal", "kill_distance": 3.0, "refinement": "none"},
}
