"""Real networks in: files of other programs, read as the veins of a leaf with widths.

One file a format; nothing here knows a simulation.
"""

from vasc.networks_in.reading import is_network_file, read_network

__all__ = ["is_network_file", "read_network"]
