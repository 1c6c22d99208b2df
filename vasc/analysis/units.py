"""Real sizes: what one segment length is, for models that say so."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class LengthUnit:
    """The unit that lengths are given in.

    Parameters
    ----------
    name : str
        Its name: ``"D"``, the segment length, or a real one such as ``"um"``.
    per_segment : float
        How many of it one segment length is.
    """

    name: str = "D"
    per_segment: float = 1.0

    @classmethod
    def from_table(cls, units: Mapping[str, Any] | None) -> "LengthUnit":
        """Read the ``[units]`` table of a config; without one, lengths stay in D.

        Parameters
        ----------
        units : mapping, optional
            ``{"length": "um", "segment": 4.0, ...}`` means that D is 4 um.
        """
        if not units or not units.get("length"):
            return cls()
        return cls(str(units["length"]), float(units.get("segment") or 1.0))

    def label(self, length: float) -> str:
        """Write a length in this unit, with micrometres from 1000 on as millimetres.

        Parameters
        ----------
        length : float
            A length, in this unit.

        Returns
        -------
        str

        Examples
        --------
        >>> LengthUnit("um").label(200.0), LengthUnit("um").label(2000.0), LengthUnit().label(50.0)
        ('200 µm', '2 mm', '50 D')
        """
        if self.name not in ("um", "\N{MICRO SIGN}m"):
            return f"{length:g} {self.name}"
        if length >= 1000.0:
            return f"{length / 1000.0:g} mm"
        return f"{length:g} \N{MICRO SIGN}m"
