"""What a crate says of its files: JSON-LD by the package rocrate, after RO-Crate 1.1.

The action is that of a Process Run Crate: a program, its config, and the timeline that
came out, once for each session of the run.

References
----------
RO-Crate 1.1, https://w3id.org/ro/crate/1.1; Process Run Crate 0.5,
https://w3id.org/ro/wfrun/process/0.5.
"""

import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from vasc.config.changes import title_with_changes
from vasc.crates.citation import FIRST_AUTHOR, LICENSE, WORKS
from vasc.export.words import plain
from vasc.timeline import Timeline
from vasc.timeline.frame import require
from vasc.timeline.provenance import SOFTWARE

VERSION = "1.1"
PROFILE = "https://w3id.org/ro/wfrun/process/0.5"
METADATA = "ro-crate-metadata.json"
"""Name of the file that describes the others."""
TIMELINE, CONFIG, CITATION = "run.h5", "config/config.toml", "CITATION.cff"
"""Names of files that each crate has."""
NO_LICENSE = "no licence given: ask the authors of the run before you use it"

FORMATS = {
    ".h5": "application/x-hdf5",
    ".toml": "application/toml",
    ".png": "image/png",
    ".svg": "image/svg+xml",
    ".csv": "text/csv",
    ".json": "application/json",
    ".cff": "application/yaml",
}
"""Media types of what vasc itself writes."""


def described(
    timeline: Timeline,
    files: Mapping[str, str],
    folder: Path,
    *,
    authors: Sequence[str] = (),
    license: str | None = None,
) -> Any:
    """Describe the files of a crate.

    Parameters
    ----------
    timeline : Timeline
        The recorded run.
    files : mapping of str to str
        What each file is, by its name in the folder, the timeline and the config among them.
    folder : Path
        Where they are.
    authors : sequence of str
        Names of who made the run.
    license : str, optional
        The licence of the run, the address of its text.

    Returns
    -------
    rocrate.rocrate.ROCrate
        Everything in it is from the run: equal runs give equal crates.

    Raises
    ------
    VascError
        If rocrate is not installed.
    """
    require("rocrate", "crate")
    from rocrate.rocrate import ROCrate

    crate = ROCrate(version=VERSION)
    people = [
        _add(crate, f"#author-{number}", {"@type": "Person", "name": plain(name)})
        for number, name in enumerate(authors, start=1)
    ]
    _describe_root(crate, timeline, people, license)
    for name, meaning in files.items():
        path = folder / name
        properties = {"name": meaning, "contentSize": str(path.stat().st_size)}
        if path.suffix in FORMATS:
            properties["encodingFormat"] = FORMATS[path.suffix]
        crate.add_file(path, name, properties=properties)
    _describe_sessions(crate, timeline, people)
    return crate


def _describe_root(
    crate: Any, timeline: Timeline, people: Sequence[Any], license: str | None
) -> None:
    """Say what the run is, who made it and when, and what to cite."""
    root, config = crate.root_dataset, timeline.config
    title = str(config.get("title") or f"A run of {timeline.model} venation")
    root["name"] = plain(title_with_changes(title, timeline.config_toml))
    after = f", after {plain(str(config['reference']))}" if config.get("reference") else ""
    root["description"] = (
        f"A simulation of plant vasculature by vasc: model {timeline.model}, growth"
        f" {timeline.growth}, seed {timeline.seed}, steps 0 to {timeline.last_step}{after}."
    )
    root["datePublished"] = _recorded_time(timeline)
    root["license"] = NO_LICENSE
    if license is not None:
        root["license"] = _add(crate, license, {"@type": "CreativeWork", "name": license})
    if people:
        root["author"] = _one_or_all(people)
    _add(crate, "#adam-runions", FIRST_AUTHOR)
    root["citation"] = [_add(crate, name, work) for name, work in WORKS.items()]
    profile = {"@type": "CreativeWork", "name": "Process Run Crate", "version": "0.5"}
    root["conformsTo"] = _add(crate, PROFILE, profile)


def _describe_sessions(crate: Any, timeline: Timeline, people: Sequence[Any]) -> None:
    """Say which software made the timeline from the config, session by session."""
    config, recorded = crate.get(CONFIG), crate.get(TIMELINE)
    actions = []
    for session in timeline.provenance:
        software = session.get("software")
        program = _program(crate, software if isinstance(software, Mapping) else {})
        action = {
            "@type": "CreateAction",
            "name": f"vasc {_said(session, 'kind')}",
            "description": f"Session {session['session']} of the run, to step"
            f" {_said(session, 'last_step')}: {_said(session, 'outcome')}",
            "instrument": {"@id": program.id},
            "object": {"@id": config.id},
            "result": {"@id": recorded.id},
        }
        for name, key in (("startTime", "started"), ("endTime", "ended")):
            if key in session:
                action[name] = _said(session, key)
        if "outcome" in session:
            word = "Failed" if "failed" in _said(session, "outcome") else "Completed"
            action["actionStatus"] = f"http://schema.org/{word}ActionStatus"
        if people:
            action["agent"] = _one_or_all([{"@id": person.id} for person in people])
        actions.append(_add(crate, f"#session-{session['session']}", action))
    if actions:
        crate.root_dataset["mentions"] = _one_or_all(actions)


def _program(crate: Any, software: Mapping[str, str]) -> Any:
    """Describe vasc as it was in a session, and the packages that it ran with."""
    versions = {plain(str(name)): plain(str(version)) for name, version in software.items()}
    names = {name: _identifier(name, version) for name, version in versions.items()}
    for name, version in versions.items():
        if crate.get(names[name]) is None:
            properties: dict[str, Any] = {
                "@type": "SoftwareApplication",
                "name": name,
                "softwareVersion": version,
            }
            if name in SOFTWARE:
                properties["url"] = names[name]
            if name == "vasc":
                others = [{"@id": names[each]} for each in names if each != "vasc"]
                properties |= {"softwareRequirements": others, "license": {"@id": LICENSE}}
            _add(crate, names[name], properties)
    if crate.get(LICENSE) is None:
        _add(crate, LICENSE, {"@type": "CreativeWork", "name": "MIT License", "identifier": "MIT"})
    return crate.get(names.get("vasc", "#vasc")) or _add(
        crate, "#vasc", {"@type": "SoftwareApplication", "name": "vasc"}
    )


def _identifier(name: str, version: str) -> str:
    """Give the address of a package, or a name within the crate of what is not on PyPI."""
    name, version = (re.sub(r"[^\w.+-]", "_", text, flags=re.ASCII) for text in (name, version))
    if name in SOFTWARE:
        return f"https://pypi.org/project/{name}/{version}/"
    return f"#{name}-{version}"


def _one_or_all(values: Sequence[Any]) -> Any:
    """Give a list, or the only thing in it, as RO-Crate asks for."""
    return values[0] if len(values) == 1 else list(values)


def _said(session: Mapping[str, Any], key: str) -> str:
    """Give what a session says of itself, on one line."""
    return plain(str(session.get(key, "unknown")))


def _recorded_time(timeline: Timeline) -> str:
    """Give when the run ended, or last began if it was killed: no clock is asked."""
    for session in reversed(timeline.provenance):
        for key in ("ended", "started"):
            if key in session:
                return _said(session, key)
    return "1970-01-01"


def _add(crate: Any, identifier: str, properties: Mapping[str, Any]) -> Any:
    """Add an entity that is no file."""
    from rocrate.model import ContextEntity

    return crate.add(ContextEntity(crate, identifier, properties=dict(properties)))
