"""Steps that a tie leaves undecided: what a stem may have of them, and why."""

from dataclasses import dataclass

from vasc.validation.stem_phyllotaxis.connectivity import Connectivity, Steps
from vasc.validation.stem_phyllotaxis.lattice import Prediction


@dataclass(frozen=True)
class TieVerdict:
    """How the links turned out that a tie leaves undecided.

    Parameters
    ----------
    steps : tuple of int
        The steps that are tied.
    kept : float
        Share of the judged primordia that have one of them.
    allowed : float
        Share of the judged primordia that have all other steps predicted, and none that
        is not predicted.
    doubled : tuple of tuple of int
        Judged primordia that follow each other along a tied step and both have it, though
        the step twice as long is shorter than it.
    explanation : str
        The tie in words.
    """

    steps: Steps
    kept: float
    allowed: float
    doubled: tuple[tuple[int, int], ...]
    explanation: str

    @property
    def passed(self) -> bool:
        """All other links are there, and of two equal sides no more than one is kept."""
        return self.allowed == 1.0 and not self.doubled


def judge_tie(connectivity: Connectivity, prediction: Prediction) -> TieVerdict | None:
    """Judge the links of a stem whose lattice is tied; None if it is not.

    Parameters
    ----------
    connectivity : Connectivity
        What the veins connect.
    prediction : Prediction
        What the lattice predicts.

    Returns
    -------
    TieVerdict or None
    """
    if not prediction.tied:
        return None
    tied, firm = set(prediction.tied), set(prediction.firm)
    steps = {m: set(connectivity.steps[m]) for m in connectivity.judged}
    doubled = tuple(
        (m, m + step)
        for step in prediction.tied
        if 2 * step in firm
        for m in steps
        if step in steps[m] and step in steps.get(m + step, set())
    )
    return TieVerdict(
        steps=prediction.tied,
        kept=sum(bool(each & tied) for each in steps.values()) / len(steps),
        allowed=sum(each - tied == firm for each in steps.values()) / len(steps),
        doubled=doubled,
        explanation=_explained(prediction),
    )


def _explained(prediction: Prediction) -> str:
    """Say in words what a tie is, and what it asks for."""
    told = []
    for step in prediction.tied:
        if 2 * step in prediction.firm:
            told.append(
                f"Primordia n, n + {step} and n + {2 * step} are the corners of an isosceles"
                f" triangle whose equal sides, n to n + {step} and n + {step} to n + {2 * step},"
                f" are its longest. Strictly no longest side is an edge; as the two are equal,"
                f" small differences in growth decide which is cut, and of two that follow each"
                f" other no more than one can be kept."
            )
        else:
            told.append(
                f"A rival of step {step} is exactly as long as it, so small differences in growth"
                f" decide whether n and n + {step} are connected."
            )
    asked = ", ".join(f"n + {step}" for step in prediction.firm)
    return " ".join([*told, f"Every n has to be connected to {asked or 'no other'} at any rate."])
