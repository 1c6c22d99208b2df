"""``vasc stats``: the numbers that describe a venation pattern."""

from pathlib import Path
from typing import Annotated, Any

import typer

from vasc.cli.options import AsJson, Step

EXAMPLES = ("vasc stats poplar-leaf.h5 --step 500", "vasc stats leaf_edges.csv")

Veins = Annotated[
    Path,
    typer.Argument(
        metavar="FILE", help="A recorded run, or a real network: csv, graphml, geojson, txt."
    ),
]

Seed = Annotated[int, typer.Option("--seed", min=0, help="Of the shuffled controls.")]


def stats(path: Veins, step: Step = -1, seed: Seed = 0, as_json: AsJson = False) -> None:
    """Measure the veins of a run, at its last step or another, or those of a real leaf."""
    from vasc.cli.printing import print_json, print_pairs, print_table

    found = measured(path, step, seed)
    if as_json:
        print_json(found)
        return
    orders = found.pop("orders")
    print_pairs(found)
    if orders:
        typer.echo()
        header = ("vein order", *next(iter(orders.values())))
        print_table(header, [(order, *row.values()) for order, row in orders.items()])


def measured(path: Path, step: int, seed: int) -> dict[str, Any]:
    """Give the statistics of a recorded run or of a real network.

    Parameters
    ----------
    path : Path
        A timeline, or a file of a network.
    step : int
        A recorded step, -1 for the last one.
    seed : int
        Of the shuffled controls.

    Returns
    -------
    dict
        Plain numbers.

    Raises
    ------
    VascError
        If a step of a real network is asked for, or the file is neither.
    """
    from vasc.networks_in import is_network_file, read_network

    if is_network_file(path):
        from vasc.analysis import network_statistics
        from vasc.errors import VascError

        if step != -1:
            raise VascError(f"--step {step}: {path} is no run, a real network has no steps")
        return network_statistics(read_network(path), seed=seed)
    from vasc.analysis import run_widths, statistics
    from vasc.analysis.run_widths import widths_of
    from vasc.timeline import Timeline

    with Timeline(path) as timeline:
        frame = timeline.frame(step)
        if timeline.dimensions != 2:
            return statistics(frame, timeline.units)
        widths = run_widths(timeline.frame, frame.step, widths_of(timeline.config))
        return statistics(frame, timeline.units, widths=widths, seed=seed)
