"""``vasc stats``: the numbers that describe a venation pattern."""

from vasc.cli.options import AsJson, RunFile, Step

EXAMPLES = ("vasc stats poplar-leaf.h5 --step 500",)


def stats(path: RunFile, step: Step = -1, as_json: AsJson = False) -> None:
    """Measure the veins of a run, at its last step or another."""
    from vasc.analysis import statistics
    from vasc.cli.printing import print_json, print_pairs
    from vasc.timeline import Timeline

    with Timeline(path) as timeline:
        found = statistics(timeline.frame(step), timeline.units)
    if as_json:
        print_json(found)
    else:
        print_pairs(found)
