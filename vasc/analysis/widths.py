"""Vein widths by Murray's law, on trees and on networks with loops."""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from pydantic import model_validator

from vasc import kernels
from vasc.analysis.ancestry import Descent, descent
from vasc.arrays import Floats
from vasc.network import VeinNetwork
from vasc.parameters import Parameters, quantity

TIP_RADIUS = 0.25
"""Radius of a veinlet, in D, where the parameters leave it open."""


class WidthParameters(Parameters):
    """How wide the veins are (thesis equation 3.5, sections 4.2.5 and 5.2)."""

    rule: Literal["murray", "elongation"] = quantity(
        "'murray': as wide as the veinlets it serves ask for; 'elongation': the wider the more"
        " growth has stretched its segments",
        default="murray",
    )
    kappa: float = quantity(
        "increase of the width relative to that of the length, by elongation", default=1.0, ge=0.0
    )
    exponent: float = quantity(
        "n in r^n = r1^n + r2^n; 2 adds up cross-sections, 3 is Murray's optimum",
        default=2.0,
        ge=1.0,
        le=20.0,
    )
    tip_radius: float | None = quantity(
        "radius of the veinlets; left out, 0.25 D in numbers and a readable line in pictures",
        unit="D",
        default=None,
        gt=0.0,
    )
    base_radius: float | None = quantity(
        "radius of the thickest vein; given, it takes the place of the exponent",
        unit="D",
        default=None,
        gt=0.0,
    )
    veinlets: float = quantity(
        "undrawn veinlets that enter a vein at each of its nodes",
        unit="veinlets per node",
        default=0.0,
        ge=0.0,
    )

    @model_validator(mode="after")
    def _base_is_thicker(self) -> "WidthParameters":
        """Refuse a base thinner than the tips."""
        if self.base_radius is not None and self.base_radius < (self.tip_radius or TIP_RADIUS):
            raise ValueError(
                f"base_radius {self.base_radius:g} is below "
                f"tip_radius {self.tip_radius or TIP_RADIUS:g}"
            )
        return self


@dataclass(frozen=True)
class Pipes:
    """How many veinlets each node and each segment serves.

    Parameters
    ----------
    nodes : ndarray of shape (n,), float64
        ``a(v) = (r / r0)^n`` of every node; 1 at a tip.
    segments : ndarray of shape (m,), float64
        What every segment carries, in the order of the network's segments: the
        share that its distal node sends this way.
    """

    nodes: Floats
    segments: Floats


def pipes(
    network: VeinNetwork, *, veinlets: float = 0.0, directions: Descent | None = None
) -> Pipes:
    """Count the veinlets that every node and every segment serves.

    Every tip begins one pipe. Nodes are taken from the newest to the oldest;
    each sends what it serves to its parents, in equal shares: the node that it
    extends and, where veins joined, the older nodes it was joined to. What the
    seeds serve is therefore exactly what began at the tips.

    Parameters
    ----------
    network : VeinNetwork
        Any network; it may be empty.
    veinlets : float
        Pipes that begin at every node which is no tip, for veinlets not drawn.
    directions : Descent, optional
        The network's :func:`vasc.analysis.ancestry.descent`, if known already.

    Returns
    -------
    Pipes

    Notes
    -----
    "We assume that all child veins entering a vein node contribute equally to
    the width of the parent nodes" (Runions, 2008, section 4.3).
    """
    directions = descent(network) if directions is None else directions
    amounts = np.where(directions.n_children == 0, 1.0, veinlets)
    rows = directions.from_tips
    carried = np.empty(network.n_segments)
    carried[rows] = kernels.murray.add_pipes(
        directions.proximal[rows], directions.distal[rows], directions.n_parents, amounts
    )
    return Pipes(amounts, carried)


def radii(amounts: Floats, parameters: WidthParameters, largest: float) -> Floats:
    """Give the radii of veins that serve given numbers of veinlets.

    Parameters
    ----------
    amounts : ndarray of any shape, float64
        Veinlets served.
    parameters : WidthParameters
        Exponent and radii.
    largest : float
        The most that any node of the network serves; ``base_radius`` is its radius.

    Returns
    -------
    ndarray, float64
        Radii in D, none below the tip radius.

    Notes
    -----
    With ``N`` veinlets ``r = r0 N^(1/n)`` obeys ``r^n = r1^n + r2^n`` for any n.
    A wanted base radius therefore only picks another n, and stays Murray's law.

    Examples
    --------
    >>> radii(np.array([1.0, 2.0, 4.0]), WidthParameters(tip_radius=3.0), 4.0).round(2).tolist()
    [3.0, 4.24, 6.0]
    >>> base = WidthParameters(tip_radius=3.0, base_radius=12.0)
    >>> radii(np.array([1.0, 2.0, 4.0]), base, 4.0).tolist()
    [3.0, 6.0, 12.0]
    """
    tip = parameters.tip_radius or TIP_RADIUS
    power = 1.0 / parameters.exponent
    if parameters.base_radius is not None and largest > 1.0:
        power = float(np.log(parameters.base_radius / tip) / np.log(largest))
    return tip * np.maximum(amounts, 1.0) ** power


def murray_radii(network: VeinNetwork, parameters: WidthParameters | None = None) -> Floats:
    """Give every node its radius by Murray's law.

    Parameters
    ----------
    network : VeinNetwork
        Any network; it may be empty.
    parameters : WidthParameters, optional
        Exponent, radii and undrawn veinlets.

    Returns
    -------
    ndarray of shape (n,), float64
        Radii in D.
    """
    parameters = WidthParameters() if parameters is None else parameters
    amounts = pipes(network, veinlets=parameters.veinlets).nodes
    return radii(amounts, parameters, float(amounts.max(initial=1.0)))


def segment_radii(network: VeinNetwork, parameters: WidthParameters | None = None) -> Floats:
    """Give every segment its radius: that of the share of the pipes it carries.

    Parameters
    ----------
    network : VeinNetwork
        Any network; it may be empty.
    parameters : WidthParameters, optional
        Exponent, radii and undrawn veinlets.

    Returns
    -------
    ndarray of shape (m,), float64
        Radii in D, in the order of the network's segments.
    """
    parameters = WidthParameters() if parameters is None else parameters
    counted = pipes(network, veinlets=parameters.veinlets)
    return radii(counted.segments, parameters, float(counted.nodes.max(initial=1.0)))
