"""How wide the veins of a run are, by the rule that its config asks for."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any, TypeVar

from vasc.analysis.elongation import Elongation, stretched_pipes
from vasc.analysis.moment import Moment
from vasc.analysis.widths import WidthParameters, radii, segment_radii
from vasc.arrays import Floats

M = TypeVar("M", bound=Moment)


def widths_of(config: Mapping[str, Any]) -> WidthParameters:
    """Give the widths that a config asks for; the default ones where it has no ``[widths]``."""
    return WidthParameters.model_validate(config.get("widths") or {})


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
    _, found = next(widths_at(frame, [step], parameters))
    return found


def widths_at(
    frame: Callable[[int], M], steps: Iterable[int], parameters: WidthParameters
) -> Iterator[tuple[M, Floats]]:
    """Give moments of a run, each with the widths of its segments.

    Parameters
    ----------
    frame : callable
        Gives the moment of a step, as :meth:`vasc.timeline.Timeline.frame` does.
    steps : iterable of int
        Steps of at least 0, ascending; by elongation all steps up to the last are read, once.
    parameters : WidthParameters
        The rule, exponent and radii.

    Yields
    ------
    moment : Moment
        That of each step asked for.
    widths : ndarray of shape (m,), float64
        Twice the radius, in D, in the order of the network's segments.
    """
    if parameters.rule != "elongation":
        for step in steps:
            moment = frame(step)
            yield moment, 2.0 * segment_radii(moment.network, parameters)
        return
    elongation, n_read = Elongation(parameters.kappa), 0
    for step in steps:
        for earlier in range(n_read, step + 1):
            moment = frame(earlier)
            elongation.update(moment)
        n_read = step + 1
        pipes = stretched_pipes(moment.network, elongation.widths, parameters.exponent)
        largest = float(pipes.nodes.max(initial=1.0))
        yield moment, 2.0 * radii(pipes.segments, parameters, largest)
