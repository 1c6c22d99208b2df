"""Murray's law, the slow obvious way: exact fractions and recursion over children."""

from fractions import Fraction


def pipes(n_nodes, parents_of, veinlets=0):
    """What every node serves, for ``parents_of[node]`` a list of its parents."""
    children = {node: [] for node in range(n_nodes)}
    for node, parents in enumerate(parents_of):
        for parent in parents:
            children[parent].append(node)
    served = {}

    def serve(node):
        if node not in served:
            own = Fraction(veinlets) if children[node] else Fraction(1)
            shares = [serve(child) / len(parents_of[child]) for child in children[node]]
            served[node] = own + sum(shares, Fraction(0))
        return served[node]

    return [serve(node) for node in range(n_nodes)]
