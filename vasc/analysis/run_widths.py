"""How wide the veins of a run are, by the rule that its config asks for."""

from collections.abc import Callable

from vasc.analysis.elongation import Elongation, stretched_pipes
from vasc.analysis.moment import Moment
from vasc.analysis.widths import WidthParameters, radii, segment_radii
from vasc.arrays import Floats


def run_widths(frame: Callable[[int], Moment], step: int, parameters: WidthParameters) -> Floats:
    """Give the width of every segment at a step of a run.

    Parameters
    ----------
    frame : callable
        Gives the moment of a step, as :meth:`vasc.timeline.Timeline.frame` does.
    step : int
        The step, at least 0; by elongation all steps up to it are read.
    parameters : WidthParameters
        The rule, exponent and radii.

    Returns
    -------
    ndarray of shape (m,), float64
        Twice the radius, in D, in the order of the network's segments.
    """
    network = frame(step).network
    if parameters.rule != "elongation":
        return 2.0 * segment_radii(network, parameters)
    elongation = Elongation(parameters.kappa)
    for earlier in range(step + 1):
        elongation.update(frame(earlier))
    exponent = parameters.exponent
    pipes = stretched_pipes(network, elongation.widths, exponent)
    return 2.0 * radii(pipes.segments, parameters, float(pipes.nodes.max(initial=1.0)))
