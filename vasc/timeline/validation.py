"""The validator: every MUST of docs/timeline-format.md, checked."""

import json
import tomllib
from pathlib import Path

import h5py
import numpy as np

from vasc.errors import OutlineError, TimelineError
from vasc.timeline import areole_rules, guard, layout, motion_rules, rules, tissue_rules
from vasc.timeline.checksums import check_marks, damaged
from vasc.timeline.opening import find_places
from vasc.timeline.provenance import schema
from vasc.timeline.reader import Timeline
from vasc.timeline.redo import problem_of
from vasc.timeline.rules import Findings, Record, bad_rows
from vasc.timeline.storage import reason

MAX_FINDINGS = 100
"""A file with more findings than this is not worth listing further."""


def validate(path: str | Path) -> list[str]:
    """Hold a timeline file against its format; every finding is one line.

    Parameters
    ----------
    path : str or Path
        A timeline file, also one that is not complete.

    Returns
    -------
    list of str
        What breaks a rule of docs/timeline-format.md; empty if the file is fine.
    """
    findings = [f"[log] {problem}" for problem in (problem_of(Path(path)),) if problem]
    try:
        with Timeline(path) as timeline:
            # what differs from its checksum may also break a rule, which tells more
            timeline.opened.trust()
            record = Record(timeline)
            for stage in STAGES:
                found = [finding for rule in stage for finding in rule(record)]
                findings.extend(found)
                if found and stage is not STAGES[0]:
                    break
            if not findings:
                check_marks(timeline.path, timeline.opened.file, timeline.opened.found)
                findings.extend(_checksums(record))
    except TimelineError as error:
        findings.append(f"[readable] {error}")
    except guard.TRANSIENT as error:
        findings.append(f"[readable] {path}: is damaged: {reason(error)}")
    if len(findings) > MAX_FINDINGS:
        findings[MAX_FINDINGS:] = ["... and more"]
    return findings


def _links(record: Record) -> Findings:
    """Check that no member of the file is a link to elsewhere."""
    found: list[str] = []

    def visit(name: str, link: object) -> bool | None:
        """Note a link to elsewhere; stop at many."""
        if not isinstance(link, h5py.HardLink):
            found.append(f"[hard-links] {name} is a link to elsewhere")
        return True if len(found) > MAX_FINDINGS else None

    record.file.visititems_links(visit)
    yield from found


def _header(record: Record) -> Findings:
    """Check attributes, groups, code names and marks."""
    for name in ("model", "growth"):
        if not guard.attribute(record.file, name):
            yield f"[header] the attribute {name!r} is missing or empty"
    dimensions, form = record.timeline.dimensions, record.timeline.opened.found.form
    for group in layout.groups(*form):
        record.timeline.opened.item(group)
    for group in (one for one in layout.TISSUE_MEANINGS if one not in layout.groups(*form)):
        if group in record.file:
            yield f"[header] {group}: a file without a tissue has no such group"
    for group in (one for d, one in layout.DOMAINS.items() if d != dimensions):
        if group in record.file:
            yield f"[header] {group}: a file of {dimensions} dimensions has no such group"
    for table, column in layout.NAMES:
        item = record.timeline.opened.item(f"{table}/{column}")
        for prefix in layout.NAMES[table, column]:
            if not guard.names(item, prefix):
                yield f"[header] {table}/{column}: the attributes name no {prefix}codes"
    complete = int(record.file[layout.COMPLETE][0])
    if complete not in (0, 1):
        yield f"[header] {layout.COMPLETE} is {complete}, must be 0 or 1"
    if len(record.timeline.stream_names) != record.timeline.opened.found.n_streams:
        yield "[header] frames/streams: as many names as streams are needed"
    for path in record.timeline.opened.found.growing_columns:
        dataset = record.file[path]
        if dataset.maxshape[0] is not None:
            yield f"[header] {path} cannot grow"


def _texts(record: Record) -> Findings:
    """Check that config and provenance are TOML and JSON with what they must hold."""
    try:
        tomllib.loads(record.timeline.config_toml)
    except (ValueError, RecursionError) as error:
        yield f"[texts] {layout.CONFIG_TOML}: {error}"
    try:
        _ = record.timeline.config
    except TimelineError as error:
        yield f"[texts] {error}"
    if not record.timeline.provenance:
        yield f"[texts] {layout.PROVENANCE} holds no session"
    required = schema()["required"]
    for session in record.timeline.provenance:
        missing = [name for name in required if name not in session]
        if missing:
            number = json.dumps(session.get("session"))
            yield f"[texts] {layout.PROVENANCE}: session {number} lacks {', '.join(missing)}"


def _checksums(record: Record) -> Findings:
    """Check that everything is what the last session that came to its end has recorded."""
    opened, timeline = record.timeline.opened, record.timeline
    starts = find_places(opened.path, record.file, opened.found, opened.read)
    for name in damaged(
        opened.path, record.file, opened.found, starts, opened.read, timeline.provenance
    ):
        yield f"[checksums] {name} is not what was recorded"


def _stem(record: Record) -> Findings:
    """Check that the ring at the base is made of different nodes of step 0."""
    timeline = record.timeline
    if timeline.dimensions != 3:
        return
    ring = timeline.base_ring
    known = int(record.counts["nodes"][0]) if timeline.n_frames else np.iinfo(ring.dtype).max
    is_bad = (ring < 0) | (ring >= known)
    yield from bad_rows("stem", layout.STEM_RING, is_bad, ring, "no node of step 0")
    is_bad = np.ones(len(ring), dtype=bool)
    is_bad[np.unique(ring, return_index=True)[1]] = False
    yield from bad_rows("stem", layout.STEM_RING, is_bad, ring, "is in the ring already")


def _blade(record: Record) -> Findings:
    """Check that the outline can be built and the seeds are finite."""
    if record.timeline.dimensions != 2:
        return
    for name in (layout.RING_XY, layout.SEEDS):
        values = record.timeline.opened.read_array(name)
        is_bad = ~np.isfinite(values).all(axis=1)
        yield from bad_rows("blade", name, is_bad, values, "must be finite")
        if is_bad.any():
            return
    try:
        _ = record.timeline.initial_blade
    except (TimelineError, OutlineError) as error:
        yield f"[blade] {error}"


STAGES = (
    (_links, _header, _texts, _blade, _stem, tissue_rules.tissue),
    (rules.frames,),
    (rules.filled, rules.codes, rules.steps, rules.ids, motion_rules.explicit),
    (rules.descent, rules.segments, motion_rules.positions, rules.states, rules.ends),
    (tissue_rules.fields,),
    (areole_rules.areoles, areole_rules.boundaries, areole_rules.retired),
)
"""All rules; those of a stage index with what the stages before have checked."""
