"""A run that obeys every rule of the format and computes nothing: rows at given rates.

It draws from one stream and can be restored from recorded tables, so that what
holds for it holds for the models: equal seeds give equal rows, also after a resume.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from vasc import experiment
from vasc.domain import Blade
from vasc.domain.tilings import rectangular
from vasc.events import EventKind, StopReason
from vasc.fields import FIELD_COLUMNS, Fields, Role
from vasc.network import Origin
from vasc.sources import Cause
from vasc.state import Places, State, Tables, affine, moved, source_states
from vasc.states import CanalState, Kind, SourceState, check_transitions
from vasc.streams import Streams
from vasc.timeline import Motion, Recorder, Timeline
from vasc.timeline.tissues import arrays_of

NAMES = ("placement",)
SEED = 5
N_RING = 6
"""Nodes of the ring at the base of a stem."""
SQUARE = np.array([[-1.0, 0.0], [1.0, 0.0], [1.0, 2.0], [-1.0, 2.0]])
TOML = 'kind = "synthetic"\nseed = 5  # größer als null\n'
CONFIG = {"kind": "synthetic", "seed": SEED}


def blade() -> Blade:
    return Blade.from_rings((SQUARE,), np.zeros((1, 2)))


class SyntheticRun:
    """Isogonic growth by 1 % of the first size a step; rows appended at given rates."""

    motion = Motion.AFFINE
    dimensions = 2
    cause = Cause.DART

    def __init__(
        self, last_step: int, *, nodes: int = 5, perceived: int = 4, sources: int = 3
    ) -> None:
        self.last_step = last_step
        self.rates = {"nodes": nodes, "perceived": perceived, "sources": sources}
        self.tables = Tables(self.dimensions)
        self.step = -1
        self.blade = blade()

    def restore(self, tables: Tables, step: int) -> None:
        self.tables, self.step = tables, step

    def states(self, streams: Streams) -> Iterator[State]:
        if self.step < 0:
            yield self._initial()
        while self.step < self.last_step:
            yield self._advance(streams)

    def _where(self) -> dict:
        """Give the fields of a state that say where everything is."""
        scale = 1.0 + 0.01 * self.step
        return {
            "blade": self.blade.scaled(scale),
            "motion": affine(scale),
            "outline_motion": affine(scale),
        }

    def _state(self) -> State:
        states = self._source_states()
        return State(
            step=self.step,
            time=0.5 * self.step,
            **self._where(),
            counts=self.tables.counts(),
            live=np.flatnonzero(states != SourceState.DRAINED).astype(np.int32),
            tables=self.tables,
            is_finished=self.step == self.last_step,
        )

    def _source_states(self) -> np.ndarray:
        states = self.tables["states"]
        columns = {name: states.view(name) for name in ("what", "id", "state")}
        return source_states(columns, self.tables["sources"].n_rows)

    def _initial(self) -> State:
        self.step = 0
        points = self._seeds()
        self.tables["nodes"].append(
            birth=0, parent=-1, origin=0, source=-1, position=points, material=points
        )
        return self._state()

    def _seeds(self) -> np.ndarray:
        return np.zeros((1, 2))

    def _advance(self, streams: Streams) -> State:
        self.step += 1
        random = streams["placement"]
        self._place(random)
        self._extend(random)
        self._perceive(random)
        self._reach(random)
        self._differentiate(random)
        if self.step == self.last_step:
            self._event(EventKind.RUN_FINISHED, int(StopReason.NO_SOURCES), -1)
        return self._state()

    def _event(self, kind: EventKind, subject: object, other: object) -> None:
        self.tables["events"].append(step=self.step, kind=kind, subject=subject, object=other)

    def _place(self, random: np.random.Generator) -> None:
        n_new = int(random.integers(0, self.rates["sources"] + 1))
        if not n_new:
            return
        material = random.random((n_new, self.dimensions))
        rows = self.tables["sources"].append(
            birth=self.step, cause=self.cause, position=self._moved(material), material=material
        )
        self._event(EventKind.SOURCE_PLACED, np.arange(rows.start, rows.stop), -1)

    def _extend(self, random: np.random.Generator) -> None:
        n_new, n_old = self.rates["nodes"], self.tables["nodes"].n_rows
        n_sources = self.tables["sources"].n_rows
        parents = random.integers(0, n_old, n_new)
        material = random.random((n_new, self.dimensions))
        rows = self.tables["nodes"].append(
            birth=self.step,
            parent=parents,
            origin=1,
            source=random.integers(-1, n_sources, n_new),
            position=self._moved(material),
            material=material,
        )
        ends = np.stack([parents, np.arange(rows.start, rows.stop)], axis=1)
        self.tables["segments"].append(nodes=ends, birth=self.step, kind=0)

    def _perceive(self, random: np.random.Generator) -> None:
        alive = np.flatnonzero(self._source_states() != SourceState.DRAINED)
        if alive.size:
            n_new, n_nodes = self.rates["perceived"], self.tables["nodes"].n_rows
            sources = np.sort(alive[random.integers(0, len(alive), n_new)])
            nodes = random.integers(0, n_nodes, n_new)
            self.tables["perceived"].append(step=self.step, source=sources, node=nodes)

    def _reach(self, random: np.random.Generator) -> None:
        states = self._source_states()
        for source in np.flatnonzero(states == SourceState.TAGGED)[:2]:
            node = int(random.integers(0, self.tables["nodes"].n_rows))
            self._change(source, SourceState.DRAINED)
            self._event(EventKind.SOURCE_REMOVED, source, node)
            if self.tables["nodes"].view("parent")[node] > 0:
                rows = self.tables["segments"].append(
                    nodes=np.array([[0, node]]), birth=self.step, kind=1
                )
                self._event(EventKind.VEIN_JOINED, rows.start, source)
        for source in np.flatnonzero(states == SourceState.ACTIVE)[:2]:
            self._change(source, SourceState.TAGGED)
            self._event(EventKind.SOURCE_TAGGED, source, self.tables["nodes"].n_rows - 1)

    def _change(self, source: int, state: SourceState) -> None:
        self.tables["states"].append(step=self.step, what=Kind.SOURCE, id=source, state=state)

    def _moved(self, material: np.ndarray) -> np.ndarray:
        return moved(material, affine(1.0 + 0.01 * self.step))

    def _differentiate(self, random: np.random.Generator) -> None:
        """Nothing more happens in the plain run."""


class ExplicitRun(SyntheticRun):
    """A blade that bends as it grows, so that no affine map moves it; with areoles and canals.

    The rows of ``perceived`` are canals, and areoles are convex hulls of nodes.
    """

    motion = Motion.EXPLICIT

    def _moved(self, material: np.ndarray) -> np.ndarray:
        x, y = (1.0 + 0.01 * self.step) * material.T
        return np.stack([x, y + 0.2 * np.sin(0.1 * self.step) * x * x], axis=1)

    def _where(self) -> dict:
        nodes, sources = (
            self._moved(self.tables[name].view("material")) for name in ("nodes", "sources")
        )
        outline = self._moved(SQUARE)
        return {
            "blade": Blade.sound([outline], nodes[:1]),
            "motion": None,
            "outline_motion": None,
            "places": Places(nodes, sources, outline),
        }

    def _differentiate(self, random: np.random.Generator) -> None:
        for _ in range(3):
            self._change_canal(random)
        chance = random.random()
        whole = self._state().areoles
        large = [k for k, ring in enumerate(whole.boundaries) if len(ring) > 3]
        if chance < 0.3:
            self._enclose(-1, random.integers(0, self.tables["nodes"].n_rows, 12))
        elif chance < 0.5 and large:
            self._split(int(whole.ids[large[0]]), whole.boundaries[large[0]])
        if self.tables["sources"].n_rows and len(whole.ids):
            self._event(EventKind.SOURCE_ENCLOSED, 0, int(whole.ids[-1]))
        if self.step == self.last_step:
            self._event(EventKind.MESOPHYLL_EVENT, -1, -1)
            self._retire(self.tables["nodes"].n_rows - 1)

    def _change_canal(self, random: np.random.Generator) -> None:
        n_canals = self.tables["perceived"].n_rows
        if not n_canals:
            return
        canal, states = int(random.integers(0, n_canals)), self.tables["states"]
        is_its = (states.view("what") == Kind.CANAL) & (states.view("id") == canal)
        before = [CanalState.GROUND, *states.view("state")[is_its].tolist()][-1]
        after = {
            CanalState.GROUND: CanalState.PRE_PATTERN,
            CanalState.PRE_PATTERN: [CanalState.INBOUND, CanalState.OUTBOUND][canal % 2],
            CanalState.INBOUND: CanalState.VEIN,
            CanalState.OUTBOUND: [CanalState.VEIN, CanalState.ARRESTED][canal % 4 // 2],
        }.get(before)
        if after is not None:
            check_transitions(Kind.CANAL, before, after)
            states.append(step=self.step, what=Kind.CANAL, id=canal, state=after)
            node = int(random.integers(0, self.tables["nodes"].n_rows))
            kinds = [EventKind.STRAND_EXTENDED, EventKind.CANAL_RETARGETED]
            self._event(kinds[node % 2], canal, node)

    def _enclose(self, parent: int, nodes: np.ndarray) -> None:
        """An areole closes around nodes, in open tissue or as a half of another one."""
        positions = self._moved(self.tables["nodes"].view("material"))
        nodes = np.unique(nodes)
        ring = nodes[ConvexHull(positions[nodes]).vertices]
        segment = self.tables["segments"].n_rows - 1
        rows = self.tables["areoles"].append(birth=self.step, parent=parent, segment=segment)
        self.tables["boundaries"].append(areole=rows.start, node=ring)
        if parent < 0:
            self._event(EventKind.AREOLE_BORN, rows.start, segment)

    def _split(self, areole: int, ring: np.ndarray) -> None:
        self._event(EventKind.AREOLE_SPLIT, areole, self.tables["segments"].n_rows - 1)
        half = len(ring) // 2
        self._enclose(areole, ring[: half + 1])
        self._enclose(areole, np.append(ring[half:], ring[0]))

    def _retire(self, node: int) -> None:
        for segment in np.flatnonzero((self.tables["segments"].view("nodes") == node).any(axis=1)):
            self._event(EventKind.SEGMENT_REFINED, int(segment), 0)
        self._event(EventKind.NODE_RETIRED, node, -1)


class StemRun(SyntheticRun):
    """A stem: points in space, of which none ever moves; primordia are sources and nodes."""

    motion = Motion.NONE
    dimensions = 3
    cause = Cause.PRIMORDIUM

    def _seeds(self) -> np.ndarray:
        angles = 2.0 * np.pi * np.arange(N_RING) / N_RING
        return np.stack([np.cos(angles), np.sin(angles), np.zeros(N_RING)], axis=1)

    def _moved(self, material: np.ndarray) -> np.ndarray:
        return material

    def _where(self) -> dict:
        return {
            "blade": None,
            "motion": None,
            "outline_motion": None,
            "base_ring": np.arange(N_RING, dtype=np.int32),
        }

    def _differentiate(self, random: np.random.Generator) -> None:
        """Now and then a primordium becomes a node of its own, far from any vein."""
        if random.random() < 0.3:
            place = random.random((1, 3)) + np.array([0.0, 0.0, 0.1 * self.step])
            n_sources = self.tables["sources"].n_rows
            self.tables["nodes"].append(
                birth=self.step,
                parent=-1,
                origin=Origin.PRIMORDIUM,
                source=n_sources - 1,
                position=place,
                material=place,
            )


class TissueRun(SyntheticRun):
    """Cells that stay where they are; carriers keep a part of what they were the step before."""

    tissue = rectangular(7, 5)
    VEINS = (30, 31)
    SOURCE = 3

    def __init__(self, last_step: int, **rates: int) -> None:
        super().__init__(last_step, **rates)
        self.blade = self.tissue.blade
        self.fields: Fields | None = None

    def restore(self, tables: Tables, step: int) -> None:
        super().restore(tables, step)
        self.fields = tables.past.fields(step)
        assert tables.past.time(step) == 0.5 * step

    def _moved(self, material: np.ndarray) -> np.ndarray:
        return material

    def _where(self) -> dict:
        if self.fields is None:
            carriers = np.ones((self.tissue.n_walls, 2))
            self.fields = self._fields(np.random.default_rng(0), carriers)
        return {
            "blade": self.blade,
            "motion": affine(1.0),
            "outline_motion": affine(1.0),
            "tissue": self.tissue,
            "fields": self.fields,
        }

    def _differentiate(self, random: np.random.Generator) -> None:
        self.fields = self._fields(random, self.fields.carriers)

    def _fields(self, random: np.random.Generator, carriers: np.ndarray) -> Fields:
        roles = np.full(self.tissue.n_cells, Role.GROUND, dtype=np.int8)
        roles[self.SOURCE], roles[list(self.VEINS)] = Role.SOURCE, Role.VEIN
        flux = random.normal(size=self.tissue.n_walls)
        first, second = (roles[self.tissue.walls] == Role.VEIN).T
        # out of no vein, and along none
        flux[first] = -np.abs(flux[first])
        flux[second] = np.abs(flux[second])
        flux[first & second] = 0.0
        return Fields(
            concentration=random.random(self.tissue.n_cells),
            flux=flux,
            carriers=0.5 * carriers + random.random((self.tissue.n_walls, 2)),
            roles=roles,
        )


def create(path: Path, kind: type[SyntheticRun] = SyntheticRun, **options: object) -> Recorder:
    is_stem = kind.dimensions == 3
    settings: dict = {
        "config_toml": TOML,
        "config": CONFIG,
        "model": "synthetic",
        "growth": "none" if is_stem else "isogonic",
        "seed": SEED,
        "blade": None if is_stem else kind(0).blade,
        "motion": kind.motion,
        "dimensions": kind.dimensions,
        "base_ring": np.arange(N_RING, dtype=np.int32) if is_stem else None,
        "tissue": getattr(kind, "tissue", None),
        "stream_names": NAMES,
        "units": {"length": "um", "segment": 4.0},
    }
    return Recorder.create(path, **(settings | options))


def record(
    path: Path,
    last_step: int,
    *,
    stop_after: int | None = None,
    watch: Callable[[int], object] = lambda step: None,
    kind: type[SyntheticRun] = SyntheticRun,
    **options: object,
) -> None:
    """Record a run, or its first ``stop_after`` steps; ``watch`` sees each observed step."""
    run, streams = kind(last_step), Streams(SEED, NAMES)
    with create(path, kind, **options) as recorder:
        for state in run.states(streams):
            recorder.observe(state, streams)
            watch(state.step)
            if state.step == stop_after:
                recorder.close(complete=False)
                return


def recorded_states(path: Path, last_step: int, kind: type[SyntheticRun]) -> list[State]:
    """Record a run, and give every state of it."""
    streams, shown = Streams(SEED, NAMES), []
    with create(path, kind) as recorder:
        for state in kind(last_step).states(streams):
            recorder.observe(state, streams)
            shown.append(state)
    return shown


def repeat(monkeypatch: pytest.MonkeyPatch, last_step: int, kind: type[SyntheticRun]) -> None:
    """Let ``verify`` repeat a synthetic run, not a model that a config describes."""

    @contextmanager
    def repeatable(timeline: Timeline) -> Iterator[tuple[SyntheticRun, Streams]]:
        yield kind(last_step), Streams(SEED, NAMES)

    def simulate(run: SyntheticRun, streams: Streams, **_: object) -> Iterator[State]:
        return run.states(streams)

    monkeypatch.setattr(experiment, "repeatable", repeatable)
    monkeypatch.setattr(experiment, "simulate", simulate)


def resume(
    path: Path,
    last_step: int,
    *,
    watch: Callable[[int], object] = lambda step: None,
    kind: type[SyntheticRun] = SyntheticRun,
) -> None:
    """Finish a run from its last committed frame."""
    run, streams = kind(last_step), Streams(SEED, NAMES)
    with Timeline(path) as timeline:
        if timeline.n_frames:
            run.restore(timeline.tables(), timeline.last_step)
            streams.restore(timeline.stream_words())
    with Recorder.resume(path) as recorder:
        for state in run.states(streams):
            recorder.observe(state, streams)
            watch(state.step)
        if run.step == last_step:
            # also a run killed after its last step, before the file was marked
            recorder.close(complete=True)


def contents(path: Path, n_frames: int | None = None) -> dict[str, bytes]:
    """Give the bytes of the first frames (all when not given) and of their rows, by name."""
    with Timeline(path) as timeline:
        n = timeline.n_frames if n_frames is None else n_frames
        found = {f"frames/{name}": rows[:n].tobytes() for name, rows in timeline.frames.items()}
        for name in timeline.n_places:
            steps = [timeline.places(name, step).tobytes() for step in range(n)]
            found[f"motion/{name}"] = b"".join(steps)
        if timeline.tissue is not None:
            found |= {name: rows.tobytes() for name, rows in arrays_of(timeline.tissue).items()}
            fields = [timeline.fields(step) for step in range(n)]
            for name in FIELD_COLUMNS:
                steps = [getattr(one, name).tobytes() for one in fields]
                found[f"fields/{name}"] = b"".join(steps)
        for name, table in timeline.tables(n - 1).tables.items():
            for column in table.columns:
                found[f"{name}/{column}"] = table.view(column).tobytes()
    return found
