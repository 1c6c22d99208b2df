"""A recorded run with all that belongs to it, as a Research Object Crate."""

from vasc.crates.writing import export_crate, is_crate

__all__ = ["export_crate", "is_crate"]
