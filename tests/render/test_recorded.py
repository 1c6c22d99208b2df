"""Pictures and numbers of a real run, from its file and from its states."""

import pytest

from vasc.analysis import murray_radii, statistics
from vasc.analysis.ancestry import descent
from vasc.analysis.widths import pipes
from vasc.errors import TimelineError
from vasc.models import MODELS
from vasc.render import Film, animate, render
from vasc.simulation import simulate
from vasc.streams import Streams
from vasc.timeline import Recorder, Timeline


def leaf(kind, growth, refinement):
    return MODELS[kind].model_validate(
        {
            "kind": kind,
            "domain": {"shape": "ovate", "length": 20.0},
            "growth": {"kind": growth, "final_length": 90.0, "length_per_step": 1.0},
            "placement": {
                "kind": "darts",
                "density": 0.002,
                "birth_distance_sources": 6.0,
                "birth_distance_veins": 6.0,
            },
            "arrival": {"kill_distance": 1.0 if kind == "closed" else 3.0},
            "refinement": {"kind": refinement},
        }
    )


@pytest.fixture(scope="module", params=[("open", "marginal"), ("closed", "isogonic")])
def recorded(request, tmp_path_factory):
    kind, growth = request.param
    model = leaf(kind, growth, "subdivision" if growth == "isogonic" else "none").model()
    streams = Streams(1)
    state = model.initial_state(streams)
    path = tmp_path_factory.mktemp("runs") / f"{kind}.h5"
    with Recorder.create(
        path,
        config_toml="",
        config={"widths": {"exponent": 3.0}},
        model=kind,
        growth=growth,
        seed=1,
        blade=state.blade,
        stream_names=streams.names,
        units={"length": "um", "segment": 4.0},
    ) as recorder:
        recorder.observe(state, streams)
        for after in simulate(model, streams, state=state, observers=[recorder]):
            state = after
    return path, state


def test_the_file_gives_the_numbers_of_the_state(recorded):
    path, state = recorded
    with Timeline(path) as timeline:
        assert statistics(timeline.frame()) == statistics(state)
        assert statistics(timeline.frame(), timeline.units)["length_unit"] == "um"
        assert (murray_radii(timeline.frame().network) == murray_radii(state.network)).all()


def test_loops_are_what_the_model_makes(recorded):
    path, state = recorded
    found = statistics(state)
    assert found["components"] == 1
    assert (found["cycles"] > 0) == (path.stem == "closed")
    assert found["areoles"] == found["cycles"], "nothing crosses"


def test_the_seed_serves_all_tips(recorded):
    network = recorded[1].network
    directions = descent(network)
    served = pipes(network).nodes
    assert served[0] == pytest.approx((directions.n_children == 0).sum())
    assert (directions.n_parents == 0).sum() == 1


def test_a_picture_and_a_film_are_made_from_the_file(recorded, tmp_path):
    path, _ = recorded
    picture = render(path, tmp_path / "leaf.png", color="age", sources=True)
    assert picture.stat().st_size > 10_000
    assert picture.read_bytes() == render(path, picture, color="age", sources=True).read_bytes()
    film = animate(path, tmp_path / "leaf.gif", film=Film(n_pictures=3, pixels=150))
    assert film.stat().st_size > 1_000


def test_steps_that_were_not_recorded_are_refused(recorded, tmp_path):
    with pytest.raises(TimelineError, match="step 100000"):
        render(recorded[0], tmp_path / "leaf.png", step=100_000)
    assert list(tmp_path.iterdir()) == []


def test_a_file_that_is_no_timeline_is_refused(tmp_path):
    (tmp_path / "text.h5").write_text("no timeline")
    with pytest.raises(TimelineError, match=r"text\.h5"):
        render(tmp_path / "text.h5", tmp_path / "leaf.png")
