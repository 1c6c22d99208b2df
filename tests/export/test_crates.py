"""A crate holds the run and all that belongs to it, is read by others, and is the same twice."""

import gzip
import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from vasc.cli import main
from vasc.config import load
from vasc.crates import export_crate, is_crate
from vasc.crates.citation import WORKS, citation_file
from vasc.errors import OutputError, TimelineError, VascError
from vasc.experiment import run, verify
from vasc.export.tables import DESCRIPTION, TABLES
from vasc.timeline import Timeline

rocrate = pytest.importorskip("rocrate.rocrate")

TIMELINES = Path(__file__).resolve().parents[1] / "data" / "timelines" / "1.0"
BLADE = "my blade \u00e9+(1).csv"
LICENSE = "https://spdx.org/licenses/CC-BY-4.0"


def files_of(folder):
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in folder.rglob("*")
        if path.is_file()
    }


def graph_of(folder):
    text = (folder / "ro-crate-metadata.json").read_text(encoding="utf-8")
    return {entity["@id"]: entity for entity in json.loads(text)["@graph"]}


def references(value):
    """Give the ids that a value of JSON-LD refers to."""
    if isinstance(value, list):
        return [name for each in value for name in references(each)]
    return [value["@id"]] if isinstance(value, dict) and set(value) == {"@id"} else []


@pytest.fixture(scope="module")
def crate(runs, tmp_path_factory):
    """Give the crate of a small leaf."""
    output = tmp_path_factory.mktemp("crates") / "open.crate"
    return export_crate(runs.open, output, authors=["A. Botanist", "B. C."], license=LICENSE)


def test_a_crate_holds_the_run_and_all_that_belongs_to_it(runs, crate):
    with Timeline(runs.open) as timeline:
        last, toml = timeline.last_step, timeline.config_toml
    files = files_of(crate)
    tables = {f"tables/{name}.csv" for name in TABLES} | {f"tables/{DESCRIPTION}"}
    figures = {f"figures/step-{last}.png", f"figures/step-{last}.svg"}
    others = {"run.h5", "config/config.toml", "CITATION.cff", "ro-crate-metadata.json"}
    assert set(files) == tables | figures | others
    assert files["run.h5"] == runs.open.read_bytes()
    assert files["config/config.toml"].decode() == toml
    assert files["CITATION.cff"] == citation_file().read_bytes()
    assert verify(crate / "run.h5") == []


def test_rocrate_reads_what_was_written(crate):
    read = rocrate.ROCrate(crate)
    assert read.root_dataset["name"] == "A leaf -- for <export> & co"
    assert [person["name"] for person in read.root_dataset["author"]] == ["A. Botanist", "B. C."]
    assert read.root_dataset["license"].id == LICENSE
    parts = {part.id for part in read.root_dataset["hasPart"]}
    assert parts == set(files_of(crate)) - {"ro-crate-metadata.json"}
    action = read.get("#session-0")
    assert action["instrument"]["name"] == "vasc"
    assert (action["object"].id, action["result"].id) == ("config/config.toml", "run.h5")


def test_the_description_is_what_ro_crate_1_1_asks_for(crate):
    text = (crate / "ro-crate-metadata.json").read_text(encoding="utf-8")
    assert json.loads(text)["@context"] == "https://w3id.org/ro/crate/1.1/context"
    graph = graph_of(crate)
    assert len(graph) == len(json.loads(text)["@graph"])
    descriptor, root = graph["ro-crate-metadata.json"], graph["./"]
    assert descriptor["conformsTo"] == {"@id": "https://w3id.org/ro/crate/1.1"}
    assert descriptor["about"] == {"@id": "./"}
    assert {"name", "description", "datePublished", "license"} <= set(root)
    for entity in graph.values():
        assert entity["@type"]
        for value in entity.values():
            for name in references(value):
                assert name in graph or name == "https://w3id.org/ro/crate/1.1"
    for name, content in files_of(crate).items():
        if name != "ro-crate-metadata.json":
            assert graph[name]["contentSize"] == str(len(content))


def test_software_and_times_are_those_recorded(runs, crate):
    with Timeline(runs.open) as timeline:
        (session,) = timeline.provenance
    graph = graph_of(crate)
    programs = {
        entity["name"]: entity["softwareVersion"]
        for entity in graph.values()
        if entity["@type"] == "SoftwareApplication"
    }
    assert programs == session["software"]
    assert graph["./"]["datePublished"] == session["ended"]
    action = graph["#session-0"]
    assert (action["startTime"], action["endTime"]) == (session["started"], session["ended"])
    assert action["actionStatus"] == "http://schema.org/CompletedActionStatus"


@pytest.mark.parametrize("kind", ["open", "stem"])
def test_two_crates_of_a_run_are_the_same_bytes(runs, kind, tmp_path):
    crates = []
    for name in ("a", "b"):
        # in a process of its own: what rocrate makes up by chance or clock would differ
        path = tmp_path / f"{name}.crate"
        command = [sys.executable, "-m", "vasc", "export", getattr(runs, kind), "-o", path]
        subprocess.run(command, check=True, capture_output=True)
        crates.append(files_of(path))
    assert crates[0] == crates[1]


def test_files_of_a_config_go_with_it_and_the_config_runs(runs, tmp_path):
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / BLADE).write_text("x,y\n0,0\n6,4\n5,14\n0,20\n-5,14\n-6,4\n")
    (tmp_path / "in" / "leaf.toml").write_text(
        f'kind = "open"\n[domain]\nfile = "{BLADE}"\nlength = 20.0\n[growth]\nkind = "none"\n'
        '[placement]\nkind = "given"\npoints = [[0.0, 9.0]]\n[arrival]\nkill_distance = 2.0\n'
    )
    run(load(str(tmp_path / "in" / "leaf.toml")), tmp_path / "leaf.h5")
    crate = export_crate(tmp_path / "leaf.h5", tmp_path / "leaf.crate")
    blade = (tmp_path / "in" / BLADE).read_bytes()
    assert (crate / "config" / BLADE).read_bytes() == blade
    summary = run(load(str(crate / "config" / "config.toml")), tmp_path / "again.h5")
    with Timeline(tmp_path / "leaf.h5") as first:
        assert summary.nodes == first.n_rows("nodes")
    export_crate(tmp_path / "leaf.h5", crate, force=True)


def test_a_file_of_a_config_does_not_leave_the_crate(tmp_path):
    from vasc.crates.writing import _place

    outward = ["../a.csv", "..", "a/../../b", str(tmp_path / "c"), "config.toml", "a\0b", ".x"]
    outward += ["", "a" * 300, "\x1b[2J", r"..\a", "files/b.csv"]
    places = [_place(name, number) for number, name in enumerate(outward)]
    assert len(set(places)) == len(outward)
    for place in places:
        assert re.fullmatch(r"config/files/\d+-[\w.+-]{0,100}", place)
    assert _place(BLADE, 3) == f"config/{BLADE}"


def test_without_author_and_licence_the_crate_says_so(runs, tmp_path):
    graph = graph_of(export_crate(runs.open, tmp_path / "crate", 3))
    assert graph["./"]["license"].startswith("no licence given")
    assert "author" not in graph["./"]
    assert "agent" not in graph["#session-0"]
    assert "figures/step-3.png" in graph


def test_a_crate_is_replaced_when_forced_and_an_older_crate_alone(runs, tmp_path):
    crate = export_crate(runs.open, tmp_path / "a.crate", 3)
    with pytest.raises(OutputError, match="the folder exists already; use --force"):
        export_crate(runs.open, crate)
    export_crate(runs.open, crate, 4, force=True)
    assert "figures/step-4.png" in files_of(crate)
    assert "figures/step-3.png" not in files_of(crate)
    (crate / "tables" / "mine.txt").write_text("mine")
    before = files_of(crate)
    with pytest.raises(OutputError, match=r"holds 'tables/mine.txt', which is no part"):
        export_crate(runs.open, crate, force=True)
    assert files_of(crate) == before


def test_a_folder_of_another_is_never_replaced(runs, tmp_path):
    (tmp_path / "my-crate").mkdir()
    (tmp_path / "my-crate" / "run.h5").write_text("mine")
    with pytest.raises(OutputError, match=r"holds 'run.h5'"):
        export_crate(runs.open, tmp_path / "my-crate", force=True)


ODD = {"session": 0, "software": ["vasc"], "outcome": 3, "started": {"a": "\x1b[2J"}, "kind": None}
WORDS = {"session": 1, "software": {"a b/../c\n": {"x": 1}, "vasc": None}, "ended": "\x00"}


def test_odd_words_of_a_timeline_are_words(runs, tmp_path, monkeypatch):
    monkeypatch.setattr(Timeline, "provenance", [ODD, WORDS])
    graph = graph_of(export_crate(runs.open, tmp_path / "a.crate"))
    text = json.dumps(graph)
    assert "\\u001b" not in text
    assert "\\u0000" not in text
    assert {"#session-0", "#session-1", "#vasc-None"} <= set(graph)


@pytest.mark.parametrize("files", [["a.csv"], {"a.csv": 3}, {"a.csv": "no base64!"}])
def test_damaged_files_of_a_config_are_refused(runs, files, tmp_path, monkeypatch):
    with Timeline(runs.open) as timeline:
        config = timeline.config
    monkeypatch.setattr(Timeline, "config", config | {"files": files})
    with pytest.raises(TimelineError, match=r"the files of the config|the recorded file 'a.csv'"):
        export_crate(runs.open, tmp_path / "a.crate")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ["explicit", "tissue", "interrupted"])
def test_runs_of_every_kind_become_crates_that_are_read(name, tmp_path):
    path = tmp_path / f"{name}.h5"
    path.write_bytes(gzip.decompress((TIMELINES / f"{name}.h5.gz").read_bytes()))
    crate = export_crate(path, tmp_path / "a.crate")
    parts = {part.id for part in rocrate.ROCrate(crate).root_dataset["hasPart"]}
    assert parts == set(files_of(crate)) - {"ro-crate-metadata.json"}
    assert ("config/stretch.csv" in parts) == (name == "explicit")


def test_what_goes_wrong_leaves_nothing(runs, tmp_path, monkeypatch):
    def fail(*_, **__):
        raise OSError("no space")

    monkeypatch.setattr("vasc.crates.writing.render", fail)
    with pytest.raises(OutputError, match="no space"):
        export_crate(runs.open, tmp_path / "a.crate")
    with pytest.raises(TimelineError):
        export_crate(citation_file(), tmp_path / "b.crate")
    assert list(tmp_path.iterdir()) == []


def test_a_run_that_grows_while_it_is_copied_is_refused(runs, tmp_path, monkeypatch):
    run_file = tmp_path / "a.h5"
    shutil.copy(runs.open, run_file)

    def copy_of_another(_, target):
        target.write_bytes(runs.stem.read_bytes())

    monkeypatch.setattr("vasc.crates.writing.shutil.copyfile", copy_of_another)
    with pytest.raises(TimelineError, match="is being written"):
        export_crate(run_file, tmp_path / "a.crate")
    assert not (tmp_path / "a.crate").exists()


def test_works_to_cite_are_those_of_the_citation_file():
    text = citation_file().read_text(encoding="utf-8")
    for work in WORKS.values():
        assert f"title: {work['name']}\n" in text
        assert f"year: {work['datePublished']}\n" in text


def test_the_command_line_writes_a_crate_and_tells_what_it_does_not_take(runs, tmp_path, capsys):
    output = tmp_path / "leaf.crate"
    assert main(["export", str(runs.stem), "-o", f"{output}/", "--author", "A", "--json"]) == 0
    assert json.loads(capsys.readouterr().out) == {"files": [str(output)]}
    assert is_crate(output)
    assert main(["export", str(runs.open), "-o", str(tmp_path / "b.crate"), "--every", "2"]) == 2
    assert "are not for a crate" in capsys.readouterr().err
    assert main(["export", str(runs.open), "-o", str(tmp_path / "b.svg"), "--author", "A"]) == 2
    assert "--author and --license are for a crate" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ({"authors": ["A. Botanist", " "]}, "author ' ': must be a name"),
        ({"authors": ["\x1b"]}, "must be a name"),
        ({"license": "not a url"}, "license 'not a url': must be the address of its text"),
        ({"license": "https://"}, "must be the address"),
        ({"license": "\x1b[2J a licence"}, "must be the address"),
        ({"license": "x" * 5000}, "x ... xxxxxxxxxx': must be the address"),
        ({"step": 9999}, "open.h5: step 9999 is not recorded; steps 0 to"),
    ],
)
def test_what_a_crate_cannot_say_is_refused_before_it_is_made(runs, tmp_path, words, said):
    with pytest.raises(VascError) as caught:
        export_crate(runs.open, tmp_path / "a.crate", **words)
    assert said in str(caught.value)
    assert list(tmp_path.iterdir()) == []


def test_a_run_that_is_not_there_is_named(tmp_path):
    with pytest.raises(TimelineError, match=r"missing\.h5: no such file"):
        export_crate(tmp_path / "missing.h5", tmp_path / "a.crate")
