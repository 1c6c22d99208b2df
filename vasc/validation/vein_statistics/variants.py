"""Choices that the thesis leaves open, changed one at a time: what the checks of a leaf say."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from vasc.validation.vein_statistics.checks import check_leaf
from vasc.validation.vein_statistics.samples import sample_of_run
from vasc.validation.vein_statistics.suite import CLOSED, MATURE, Progress, changed, recorded

Change = Mapping[str, Mapping[str, Any]]


@dataclass(frozen=True)
class LeafVariant:
    """A bundled leaf with one choice changed.

    Parameters
    ----------
    base : str
        The bundled experiment.
    kind : {"closed", "areole"}
        Its model.
    name : str
        What is changed.
    change : mapping
        Keys of the config, by table; with a ``kind``, the table is a new one.
    """

    base: str
    kind: str
    name: str
    change: Change = field(default_factory=dict)


def _closed(name: str, **change: Mapping[str, Any]) -> LeafVariant:
    """Change closed venation."""
    return LeafVariant(CLOSED, "closed", name, change)


def _areole(name: str, **change: Mapping[str, Any]) -> LeafVariant:
    """Change areole venation."""
    return LeafVariant(MATURE, "areole", name, change)


LEAF_VARIANTS = (
    _areole("as bundled"),
    _areole("no refinement", refinement={"kind": "none"}),
    _areole("corners cut with alpha 0.75", refinement={"alpha": 0.75}),
    _areole("corners cut from 2 D on", refinement={"threshold": 2.0}),
    _areole("widths by Murray's law", widths={"rule": "murray"}),
    _areole("veins lean by 0.3", extension={"lean": 0.3}),
    _areole("sources wander by 0.3", placement={"wander": 0.3}),
    _areole("lean and wander by 0.3", extension={"lean": 0.3}, placement={"wander": 0.3}),
    _closed("as bundled"),
    _closed("join distance 1 D", arrival={"join_distance": 1.0}),
    _closed("join distance 4 D", arrival={"join_distance": 4.0}),
    _closed("subdivision", refinement={"kind": "subdivision"}),
    _closed("corner cutting", refinement={"kind": "corner_cutting"}),
    _closed("Murray exponent 3", widths={"exponent": 3.0}),
    _closed("widths by elongation", widths={"rule": "elongation"}),
)
"""Refinement, joins and widths, on closed and on areole venation."""


def compare_variants(
    variants: tuple[LeafVariant, ...] = LEAF_VARIANTS, progress: Progress = lambda name: None
) -> list[dict[str, Any]]:
    """Run leaves with one choice changed, and check each; a minute or less a leaf.

    Parameters
    ----------
    variants : tuple of LeafVariant
        What to run.
    progress : callable
        Told the name of each before it begins.

    Returns
    -------
    list of dict
        ``base`` and ``variant``, the number of ``areoles``, the ``values`` of the checks by
        key, and the keys of those that it ``fails``.
    """
    rows = []
    for variant in variants:
        progress(f"{variant.base}: {variant.name}")
        change = {table: dict(keys) for table, keys in variant.change.items()}
        with TemporaryDirectory() as folder:
            path = recorded(changed(variant.base, change), Path(folder))
            sample = sample_of_run(variant.name, variant.kind, path)
        checks = check_leaf(sample)
        rows.append(
            {
                "base": variant.base,
                "variant": variant.name,
                "areoles": sample.numbers["areoles"],
                "values": {check.asked.key: check.value for check in checks},
                "fails": [check.asked.key for check in checks if check.passed is False],
            }
        )
    return rows
