"""From a sweep file, or the name of a bundled sweep, to a checked sweep."""

import hashlib
import json
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from vasc.config import Experiment, load_text
from vasc.config.bundled import IS_EXPERIMENT, bundled_folder, find_config, find_sweep
from vasc.config.messages import problems
from vasc.config.reading import parse, read_text
from vasc.config.schema import json_schema_of
from vasc.config.values import as_json, assignment, unusable_values, written
from vasc.errors import ConfigError
from vasc.sweeps.measures import name_problem
from vasc.sweeps.parameters import SweepParameters
from vasc.sweeps.plan import PlannedRun, as_overrides, choices, plan

MOST_CHECKED = 400
"""Choices that are checked before anything runs; of more, an even sample is."""

VARIED = ("set", "axes", "random")
"""Tables of a sweep file whose keys are those of the config."""

RANGE_KEYS = {"from", "to"}
"""A table below ``[axes]`` or ``[random]`` with one of these keys is a range of values."""


@dataclass(frozen=True)
class Sweep:
    """A sweep that has been read and checked.

    Parameters
    ----------
    name : str
        Name of the sweep file, without folder and suffix.
    parameters : SweepParameters
        What it says.
    base : str
        The text of the config that is varied.
    base_name : str
        What messages call that config.
    folder : str or None
        What the files of that config are relative to; None for a bundled one.
    files : dict
        From the name of each of these files to the digest of its bytes.
    kind : str
        The model.
    runs : tuple of PlannedRun
        All runs.
    """

    name: str
    parameters: SweepParameters
    base: str
    base_name: str
    folder: str | None
    files: dict[str, str]
    kind: str
    runs: tuple[PlannedRun, ...]

    def description(self) -> dict[str, Any]:
        """Give all that a worker needs to know, and what makes the sweep this one, as JSON."""
        return {
            "name": self.name,
            "sweep": self.parameters.model_dump(mode="json", by_alias=True),
            "base": self.base,
            "base_name": self.base_name,
            "folder": self.folder,
            "files": self.files,
            "runs": [run.as_json() for run in self.runs],
        }


def load_sweep(source: str | Path) -> Sweep:
    """Read and check a sweep.

    Parameters
    ----------
    source : str or Path
        A TOML file, or the name of a bundled sweep.

    Returns
    -------
    Sweep
        With all its runs, and the config they vary.

    Raises
    ------
    ConfigError
        With one line for every problem: key, value and what is allowed.
    """
    path = find_sweep(source)
    label = str(source)
    parameters = _checked(parse(read_text(path), label), label)
    base_path, is_bundled = _base_of(path, parameters.base, label)
    text = read_text(base_path)
    experiment = load_text(text, name=base_path.stem, folder=base_path.parent, label=str(base_path))
    _refuse_hopeless(parameters, text, base_path, label)
    if parameters.figure == "pictures":
        _refuse_pictures(parameters, experiment, label)
    digests = {
        name: hashlib.sha256(content.encode()).hexdigest()
        for name, content in experiment.files.items()
    }
    return Sweep(
        name=path.stem,
        parameters=parameters,
        base=text,
        base_name=base_path.stem,
        folder=None if is_bundled else str(base_path.parent.resolve()),
        files=digests,
        kind=experiment.kind,
        runs=tuple(plan(parameters)),
    )


def _checked(tables: dict[str, Any], label: str) -> SweepParameters:
    """Make the parameters; a problem becomes one line that begins with the label."""
    if "kind" in tables and "base" not in tables:
        raise ConfigError(f"{label}: {IS_EXPERIMENT}")
    for name in VARIED:
        if isinstance(tables.get(name), dict):
            tables[name] = dict(_flattened(tables[name]))
    found = unusable_values(tables)
    parameters = None
    try:
        text = as_json(tables)
        parameters = SweepParameters.model_validate_json(text, strict=True)
    except ValidationError as error:
        found = {**problems(error, tables, json_schema_of(SweepParameters)), **found}
    lines = [line for text in found.values() for line in text.split("\n")]
    lines += _key_problems(tables)
    if lines or parameters is None:
        raise ConfigError([f"{label}: {line}" for line in lines])
    return parameters


def _key_problems(tables: dict[str, Any]) -> list[str]:
    """Describe measures that do not exist, and keys that are not for a sweep to vary."""
    lines = []
    measures = tables.get("measures")
    measures = measures if isinstance(measures, list) else []
    for row, name in enumerate(measures):
        if isinstance(name, str) and (problem := name_problem(name)):
            lines.append(f"{assignment(('measures', row), name)}: {problem}")
        elif isinstance(name, str) and name in measures[:row]:
            lines.append(f"{assignment(('measures', row), name)}: is there twice")
    for table in VARIED:
        values = tables.get(table)
        for key in values if isinstance(values, dict) else ():
            if key == "seed":
                lines.append(f"{table}.seed: every run has its own; set replicates for several")
            elif not _is_key(key):
                lines.append(
                    f"{table}.{written(key)}: is not a dotted key, as arrival.kill_distance is"
                )
    return lines


def _is_key(key: str) -> bool:
    """Tell whether a text is a dotted key."""
    try:
        as_overrides({key: 0})
    except ConfigError:
        return False
    return True


def _flattened(tables: dict[str, Any], above: str = "") -> Iterator[tuple[str, Any]]:
    """Give the keys of nested tables dotted, as ``a.b = [...]`` and ``"a.b" = [...]`` are one."""
    for key, value in tables.items():
        name = f"{above}.{key}" if above else key
        if isinstance(value, dict) and value and not RANGE_KEYS & value.keys():
            yield from _flattened(value, name)
        else:
            yield name, value


def _base_of(path: Path, base: str, label: str) -> tuple[Path, bool]:
    """Find the config of a sweep, beside its file or among the bundled ones."""
    beside = path.parent / base
    try:
        found = beside if beside.is_file() else find_config(base)
    except (ConfigError, OSError, ValueError) as error:
        # the words of the system repeat the whole path
        words = getattr(error, "strerror", None) or str(error)
        reason = words.removeprefix(f"{base}: ")
        raise ConfigError(f"{label}: {assignment(('base',), base)}: {reason}") from error
    return found, found.parent.resolve() == bundled_folder().resolve()


def _refuse_hopeless(parameters: SweepParameters, text: str, base: Path, label: str) -> None:
    """Refuse values with which no run can be made.

    A choice that fails while others with each of its values can be made stays: it may be
    a corner of a grid, and its error goes into the table.
    """
    good: dict[str, set[str]] = {key: set() for key in parameters.axes}
    bad: list[tuple[dict[str, Any], list[str]]] = []
    sample = _sample([values for _, values in choices(parameters)])
    for values in sample:
        try:
            changes = as_overrides(parameters.changes | values)
            load_text(text, folder=base.parent, label=label, overrides=changes)
        except ConfigError as error:
            bad.append((values, [_labelled(line, label) for line in error.problems]))
        else:
            for key in good:
                good[key].add(json.dumps(values[key]))
    if len(bad) == len(sample):
        raise ConfigError(bad[0][1])
    lines: dict[str, None] = {}
    for values, problems_of_one in bad:
        if any(json.dumps(values[key]) not in known for key, known in good.items()):
            lines.update(dict.fromkeys(problems_of_one))
    if lines:
        raise ConfigError(list(lines))


def _sample(every: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Give all choices, or so many as can be checked soon, which meet all values of all axes."""
    if len(every) <= MOST_CHECKED:
        return every
    step = len(every) / MOST_CHECKED
    # not every n-th, which might meet a single value of an inner axis
    return [every[int(k * step + k % step)] for k in range(MOST_CHECKED)]


def _labelled(line: str, label: str) -> str:
    """Let a line about a changed value begin with the sweep."""
    return line if line.startswith(f"{label}: ") else f"{label}: {line.removeprefix('--set ')}"


def _refuse_pictures(parameters: SweepParameters, experiment: Experiment, label: str) -> None:
    """Refuse a grid of pictures of what is no leaf, or of too few or many axes."""
    line = ""
    if experiment.kind == "stem":
        line = "only leaves are drawn in a grid, not stems"
    elif len(parameters.axes) not in (1, 2):
        line = f"needs one or two axes, not {len(parameters.axes)}"
    if line:
        raise ConfigError(f'{label}: figure = "pictures": {line}')
