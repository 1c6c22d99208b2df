"""The tutorial notebook runs from top to bottom, and objects show themselves in one."""

import json
import os
import re
from pathlib import Path

import nbformat
import numpy as np
import pytest
from nbclient import NotebookClient
from timeline.synthetic import ExplicitRun, StemRun, SyntheticRun, create, record

from vasc.network import VeinNetwork
from vasc.timeline import Timeline

ROOT = Path(__file__).resolve().parent.parent
NOTEBOOK = ROOT / "docs" / "tutorial.ipynb"
PICTURE = re.compile(
    r'<img alt="veins" style="width:(\d+)px;max-width:100%;height:auto"'
    r' src="data:image/png;base64,[\w+/=]{500,}">'
)


@pytest.fixture(scope="module")
def executed(tmp_path_factory):
    """Run the notebook in a folder of its own."""
    folder = tmp_path_factory.mktemp("notebook")
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    environment = os.environ | {"PYTHONPATH": str(ROOT), "TMPDIR": str(folder)}
    client = NotebookClient(
        notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": str(folder)}}
    )
    # the kernel is a program of its own: warnings of its libraries are not ours
    client.execute(env=environment)
    return notebook


@pytest.mark.filterwarnings("ignore")
def test_the_notebook_runs_and_shows_what_it_says(executed):
    cells = [cell for cell in executed.cells if cell.cell_type == "code"]
    assert [cell for cell in cells if cell.execution_count is None] == []
    outputs = [output for cell in cells for output in cell.outputs]
    assert [o for o in outputs if o.output_type == "error"] == []
    shown = [output.data for output in outputs if "data" in output]
    # the timeline and a frame draw themselves; three pictures are shown from files
    assert sum(bool(PICTURE.search(data.get("text/html", ""))) for data in shown) == 2
    assert sum("image/png" in data for data in shown) == 3
    assert any("SourceFate(source=" in data["text/plain"] for data in shown)


def test_the_notebook_is_stored_without_results():
    notebook = json.loads(NOTEBOOK.read_text())
    assert all(not cell.get("outputs") for cell in notebook["cells"])


@pytest.mark.parametrize("kind", [SyntheticRun, ExplicitRun, StemRun])
def test_a_run_shows_itself_at_any_step(kind, tmp_path):
    record(tmp_path / "run.h5", 20, kind=kind)
    timeline = Timeline(tmp_path / "run.h5")
    for shown in (timeline, timeline.frame(0), timeline.frame(7), timeline.frame(7).network):
        assert PICTURE.search(shown._repr_html_()) or shown._repr_html_().count("<tr>") > 2
    text = timeline._repr_html_()
    # no wider than a third of a page, beside the facts
    assert int(PICTURE.search(text)[1]) <= 180
    assert "<th>nodes</th>" in text
    assert "<th>model</th><td>synthetic</td>" in text
    fresh = timeline.frame(5)
    timeline.close()
    # what can be known of a closed file is shown, without a picture
    assert "<th>seed</th>" in timeline._repr_html_()
    assert "Frame of step 5" in fresh._repr_html_()


def test_odd_states_show_what_they_have(tmp_path):
    create(tmp_path / "empty.h5").close(complete=False)
    with Timeline(tmp_path / "empty.h5") as timeline:
        assert "<th>last step</th><td>-1</td>" in timeline._repr_html_()
    nothing = np.empty(0, dtype=np.int32)
    places = np.full((2, 2), np.nan)
    for points in (np.empty((0, 2)), np.zeros((1, 2)), places, np.zeros((3, 2)), np.zeros((0, 3))):
        ids = np.zeros(len(points), dtype=np.int32)
        codes = ids.astype(np.int8)
        network = VeinNetwork(
            points, ids, ids, codes, ids, nothing.reshape(0, 2), nothing, nothing, codes[:0]
        )
        text = network._repr_html_()
        assert f"<th>nodes</th><td>{len(points)}</td>" in text


def test_names_in_a_card_are_escaped(tmp_path):
    path = tmp_path / "a<b>&c.h5"
    record(path, 3)
    with Timeline(path) as timeline:
        assert "Timeline a&lt;b&gt;&amp;c.h5" in timeline._repr_html_()
