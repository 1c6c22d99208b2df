"""Vein length, and vein length per leaf area."""

from vasc.network import VeinNetwork


def vein_length(network: VeinNetwork) -> float:
    """Give the summed length of all segments, in D; 0 for an empty network."""
    return float(network.lengths.sum())


def vein_density(network: VeinNetwork, area: float) -> float:
    """Give vein length per area.

    Parameters
    ----------
    network : VeinNetwork
        Any network; it may be empty.
    area : float
        Area of the blade, in D^2, above 0.

    Returns
    -------
    float
        In 1/D.
    """
    return vein_length(network) / area
