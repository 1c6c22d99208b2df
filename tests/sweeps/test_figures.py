"""The table and the figure of a sweep: made from its results alone, at any time."""

import csv
import io
import json
import math
import shutil

import numpy as np
import pytest
from PIL import Image
from scipy import stats

from vasc.sweeps import SweepFolder, write_table
from vasc.sweeps.curves import draw_curves, intervals
from vasc.sweeps.picture import draw_sweep
from vasc.sweeps.plan import PlannedRun
from vasc.sweeps.work import result_of
from vasc.whole_files import write_whole

MEASURES = ["stats.areoles", "check.connectivity.pair", "summary.complete", "summary.stop_reason"]


def folder_of(path, axes, measures=MEASURES, figure="curves", random=None):
    """Make the folder of a sweep that was never run, with three results."""
    key = next(iter(axes or random))
    runs = [PlannedRun(n, {key: value}, 1, 1, n) for n, value in enumerate((1.0, 2.0, 4.0, 8.0), 1)]
    sweep = {"title": "A title", "axes": axes, "random": random or {}, "measures": measures}
    folder = SweepFolder(path / "out")
    described = [run.as_json() for run in runs]
    folder.begin({"name": "one", "sweep": sweep | {"figure": figure}, "runs": described})
    values = [[1, [2, 3], True, 'a "b", c'], [0.1, [3], False, None], [None, None, None, None]]
    for number, row in enumerate(values, 1):
        problems = ["it, broke"] if number == 3 else []
        found = dict(zip(MEASURES, row, strict=True))
        folder.write_result(result_of(number, found, problems))
    return folder


def test_the_table_is_tidy(tmp_path):
    path = write_table(folder_of(tmp_path, {"a.b": [1.0, 2.0, 4.0, 8.0]}))
    rows = list(csv.reader(io.StringIO(path.read_text())))
    assert rows == [
        ["run", "a.b", "replicate", "seed", "status", "error", *MEASURES],
        ["1", "1.0", "1", "1", "done", "", "1", "2 3", "true", 'a "b", c'],
        ["2", "2.0", "1", "2", "done", "", "0.1", "3", "false", ""],
        ["3", "4.0", "1", "3", "failed", "it, broke", "", "", "", ""],
        ["4", "8.0", "1", "4", "missing", "", "", "", "", ""],
    ]


def test_the_table_is_made_again_from_the_results(tmp_path, short):
    shutil.copytree(short, tmp_path / "out")
    (tmp_path / "out" / "results.csv").unlink()
    made = write_table(SweepFolder(tmp_path / "out"))
    assert made.read_bytes() == (short / "results.csv").read_bytes()


def test_intervals_hold_the_mean_as_student_has_it():
    values = [3.0, 4.0, 8.0, 9.0, 2.5]
    (point,) = intervals([(1.0, value) for value in values])
    low, high = stats.t.interval(
        0.95, len(values) - 1, loc=np.mean(values), scale=stats.sem(values)
    )
    assert (point.mean - point.half, point.mean + point.half) == pytest.approx((low, high))
    assert intervals([(2.0, 5.0)])[0].half == 0.0
    assert not math.isnan(intervals([(2.0, 5.0), (2.0, 5.0)])[0].half)


def test_a_panel_is_drawn_for_every_measure_that_is_a_number(tmp_path):
    folder = folder_of(tmp_path, {"a.b": [1.0, 2.0, 4.0, 8.0]})
    figure = draw_curves(folder)
    labels = [panel.get_ylabel() for panel in figure.axes if panel.get_ylabel()]
    assert labels == MEASURES[:3]
    (line, *_) = figure.axes[1].containers[0].lines
    assert line.get_xydata().tolist() == [[1.0, 3.0], [2.0, 3.0]]
    assert figure.axes[2].containers[0].lines[0].get_ydata().tolist() == [1.0, 0.0]


def test_values_that_are_no_numbers_stand_in_their_order(tmp_path):
    folder = folder_of(tmp_path, {"growth.kind": ["none", "marginal"]})
    described = folder.description()
    runs = [
        run | {"values": {"growth.kind": kind}}
        for run, kind in zip(described["runs"], ["none", "marginal"] * 2, strict=True)
    ]
    write_whole(folder.path / "sweep.json", json.dumps(described | {"runs": runs}))
    figure = draw_curves(folder)
    ticks = [text.get_text() for text in figure.axes[0].get_xticklabels()]
    assert ticks == ["none", "marginal"]


def test_draws_are_points(tmp_path):
    span = {"a.b": {"from": 1.0, "to": 8.0, "scale": "log"}}
    figure = draw_curves(folder_of(tmp_path, {}, random=span))
    assert figure.axes[0].get_xscale() == "log"
    assert figure.axes[0].containers == []


def test_without_numbers_there_is_no_figure(tmp_path):
    folder = folder_of(tmp_path, {"a.b": [1.0]}, measures=["summary.stop_reason"])
    assert "no measure is a number" in draw_sweep(folder, tmp_path / "figure.png")
    assert not (tmp_path / "figure.png").exists()


def test_leaves_stand_in_a_grid(tmp_path, short):
    shutil.copytree(short, tmp_path / "out")
    folder = SweepFolder(tmp_path / "out")
    described = folder.description()
    described["sweep"] = described["sweep"] | {"figure": "pictures"}
    write_whole(folder.path / "sweep.json", json.dumps(described))
    (folder.runs / "0001.h5").unlink()
    figure = folder.path / "grid.png"
    assert draw_sweep(folder, figure) == ""
    pixels = np.asarray(Image.open(figure).convert("L")) < 100
    height, width = pixels.shape
    # columns and rows of labels left out; the run that is gone leaves its place empty
    dark = [
        [pixels[y : y + height // 2 - 40, x : x + width // 2 - 40].sum() for x in (40, width // 2)]
        for y in (40, height // 2)
    ]
    assert dark[0][0] < 300
    assert min(dark[0][1], dark[1][0], dark[1][1]) > 2000
    for path in folder.runs.glob("*.h5"):
        path.unlink()
    assert "no run has a leaf" in draw_sweep(folder, figure)
