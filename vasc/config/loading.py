"""From a config, a file or a bundled name, to checked parameters."""

from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from vasc.config.attachments import missing_files, packed, refuse_referenced, unpacked
from vasc.config.bundled import IS_SWEEP, find_config
from vasc.config.changes import heading
from vasc.config.limits import blade_problems, size_problems
from vasc.config.overrides import Override, overridden
from vasc.config.reading import parse, read_text, refuse_deep
from vasc.config.values import Path as KeyPath
from vasc.config.values import assignment
from vasc.errors import ConfigError, OutlineError, TimelineError, VascError

if TYPE_CHECKING:
    from vasc.models.base import Model
    from vasc.models.leaf import LeafVenation

FILES_KEY = "files"
"""Key of a timeline's config under which the referenced files travel."""


@dataclass(frozen=True)
class Experiment:
    """A config that has been read and checked.

    Parameters
    ----------
    name : str
        Name of the config, without folder and suffix.
    parameters : LeafVenation
        What to run.
    toml : str
        The config as it was given, with the values set outside of the file.
    folder : Path
        What the files that the config refers to are relative to.
    files : dict
        The referenced files by name, packed as texts.
    label : str
        What messages about it begin with; the name if it is empty.
    """

    name: str
    parameters: "LeafVenation"
    toml: str
    folder: Path
    files: dict[str, str] = field(default_factory=dict, repr=False)
    label: str = ""

    @property
    def kind(self) -> str:
        """Name of the model."""
        return str(self.parameters.model_dump(include={"kind"})["kind"])

    @property
    def tables(self) -> dict[str, Any]:
        """The config as plain tables, with every default filled in."""
        from vasc.config.schema import resolved_tables

        return resolved_tables(self.parameters)

    @property
    def record(self) -> dict[str, Any]:
        """What a timeline keeps, so that the run can be repeated from it alone."""
        return self.tables | ({FILES_KEY: self.files} if self.files else {})

    def refuse_own_file(self, output: Path, hint: str = "; choose another name") -> None:
        """Refuse to write over a file that the config refers to.

        Raises
        ------
        OutputError
            If ``output`` is one of them; the message ends in the hint.
        """
        refuse_referenced(self.tables, self.folder, output, hint)

    def model(self) -> "Model":
        """Give the model, ready to run.

        Raises
        ------
        ConfigError
            If its outline, or the sources it is given, cannot be used; every
            line begins with the label.
        """
        label = self.label or self.name
        try:
            return self.parameters.model(self.folder)
        except ConfigError as error:
            problems = [f"{label}: {problem}" for problem in error.problems]
            raise ConfigError(problems) from error
        except VascError as error:
            raise ConfigError(f"{label}: {error}") from error


def load(source: str | Path, overrides: Iterable[Override] = ()) -> Experiment:
    """Read and check a config.

    Parameters
    ----------
    source : str or Path
        A TOML file, or the name of a bundled experiment.
    overrides : iterable of Override
        Values that replace those of the file, see :func:`parse_override`.

    Returns
    -------
    Experiment
        The checked parameters, and what is needed to run them again.

    Raises
    ------
    ConfigError
        With one line for every problem: key, value and what is allowed.
    """
    path = find_config(source)
    text = read_text(path)
    changes = list(overrides)
    return load_text(text, name=path.stem, folder=path.parent, label=str(source), overrides=changes)


def load_text(
    text: str,
    *,
    name: str = "config",
    folder: Path = Path(),
    label: str = "",
    overrides: Iterable[Override] = (),
) -> Experiment:
    """Check a config that is already in memory.

    Parameters
    ----------
    text : str
        The TOML.
    name : str
        Name of the experiment.
    folder : Path
        What files are relative to.
    label : str
        What messages begin with; the name if not given.
    overrides : iterable of Override
        Values that replace those of the text.

    Returns
    -------
    Experiment
        The checked parameters.

    Raises
    ------
    ConfigError
        With one line for every problem.
    """
    label, changes = label or name, list(overrides)
    tables = parse(text, label)
    if "base" in tables and "kind" not in tables:
        raise ConfigError(f"{label}: {IS_SWEEP}")
    if changes:
        tables = overridden(tables, changes)
        refuse_deep(tables, label)
    parameters = _checked(tables, folder, label)
    toml = _rewritten(tables, changes) if changes else text
    return Experiment(name, parameters, toml, folder, packed(tables, folder), label)


@contextmanager
def experiment_from_record(record: Mapping[str, Any], *, name: str) -> Iterator[Experiment]:
    """Make the experiment that a timeline holds; its files exist as long as the context.

    Parameters
    ----------
    record : mapping
        What :attr:`Experiment.record` gave.
    name : str
        What messages begin with.

    Yields
    ------
    Experiment
        The same experiment.

    Raises
    ------
    ConfigError
        If this version cannot read the config, or a package is not installed whose model or
        growth it names.
    TimelineError
        If the recorded files are damaged.
    """
    tables = {key: value for key, value in record.items() if key != FILES_KEY}
    files = record.get(FILES_KEY, {})
    if not isinstance(files, dict):
        raise TimelineError(f"{name}: the recorded files are damaged")
    with unpacked(tables, files) as (renamed, folder):
        label = f"{name}: config"
        if absent := _not_installed(tables):
            raise ConfigError([f"{label}: {problem}" for problem in absent])
        parameters = _checked(renamed, folder, label)
        yield Experiment(name, parameters, "", folder, files, label)


def _not_installed(tables: dict[str, Any]) -> list[str]:
    """Describe the model and the growth of a recorded run that no installed package offers."""
    from vasc.config.schema import installed, models
    from vasc.growth import GROWTHS
    from vasc.models import MODELS

    growth = tables.get("growth")
    asked: list[tuple[KeyPath, Any, Iterable[str]]] = [(("kind",), tables.get("kind"), models())]
    # a model of another package may have growths of its own
    if isinstance(growth, dict) and tables.get("kind") in MODELS:
        known = {**installed("vasc.growth"), **GROWTHS}
        asked.append((("growth", "kind"), growth.get("kind"), known))
    return [
        f"{assignment(path, kind)}: is not known here; install the package that offers it"
        for path, kind, known in asked
        if isinstance(kind, str) and kind not in known
    ]


def _checked(tables: dict[str, Any], folder: Path, label: str) -> "LeafVenation":
    """Check tables, files and the blade; a problem becomes one line that begins with the label."""
    from vasc.config.schema import parameters_from

    problems: list[str] = []
    try:
        parameters: Any = parameters_from(tables)
    except ConfigError as error:
        problems += error.problems
    problems += missing_files(tables, folder)
    problems = problems or _geometry_problems(parameters, folder)
    if problems:
        raise ConfigError([f"{label}: {problem}" for problem in problems])
    return parameters


def _geometry_problems(parameters: Any, folder: Path) -> list[str]:
    """Describe a blade that cannot be made, or is of a size that no run can hold."""
    from vasc.models import LeafVenation
    from vasc.models.on_tissue import TissueExperiment

    try:
        if isinstance(parameters, TissueExperiment):
            parameters.domain.outline(folder)
            return []
    except OutlineError as error:
        return [str(error)]
    if not isinstance(parameters, LeafVenation):
        return []  # its own rules have judged its size
    if problems := size_problems(parameters):
        return problems
    if parameters.domain is None:
        return []  # the model tells whether key-frames make a blade
    try:
        return blade_problems(parameters, parameters.domain.blade(folder))
    except OutlineError as error:
        return [str(error)]


def _rewritten(tables: dict[str, Any], overrides: list[Override]) -> str:
    """Write changed tables as TOML, headed by what was changed."""
    import tomli_w

    head = heading(assignment(*change) for change in overrides)
    return f"{head}\n{tomli_w.dumps(tables)}"
