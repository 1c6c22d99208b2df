"""What a run left beside its file and cannot be used, or is missing there."""

from pathlib import Path

from vasc.timeline.reader import Timeline
from vasc.timeline.redo import log_of, problem_of


def concerns(path: str | Path) -> list[str]:
    """Say what is wrong with the log of a file, and where one is missing.

    Parameters
    ----------
    path : str or Path
        A timeline file.

    Returns
    -------
    list of str
        Sentences; none as a rule.

    Raises
    ------
    TimelineError
        If it is no timeline.
    """
    place = Path(path)
    log = log_of(place)
    # before the provenance: a run notes its end, and then removes its log
    is_there = log.exists()
    with Timeline(place) as timeline:
        is_killed = bool(timeline.provenance) and "ended" not in timeline.provenance[-1]
    found = [problem] if (problem := problem_of(place)) else []
    if is_killed and not is_there:
        found.append(
            f"{place}: its run was killed, and {log.name} is not beside it; if the file was moved"
            " or copied without it, bring it here, or the last second of the run is missing"
        )
    return found
