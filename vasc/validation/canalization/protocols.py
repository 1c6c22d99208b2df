"""Protocols: how canals are let form in the experiments."""

from dataclasses import dataclass

from vasc.models.transport import (
    FacilitatedDiffusion,
    PolarTransport,
    PooledTransport,
    Transport,
)


@dataclass(frozen=True)
class Protocol:
    """How canals are let form.

    Parameters
    ----------
    name : str
        What tables call it.
    transport : Transport
        Transport and its feedback.
    background : float
        What all ground cells make together, over what one source makes. The tissue comes
        to rest with it before the source appears.
    """

    name: str
    transport: Transport
    background: float = 0.0


PROTOCOLS = {
    one.name: one
    for one in (
        Protocol("facilitated", FacilitatedDiffusion()),
        Protocol("pool, background", PooledTransport(), 0.5),
        Protocol("pool", PooledTransport()),
        Protocol("polar, background", PolarTransport(), 0.1),
    )
}
"""Protocols by name, with the values that models have by default."""
