"""``vasc stats`` of real leaves, and ``vasc compare``."""

import json
import shutil
from pathlib import Path

import pytest
from reference.stem_run import STEM

from vasc.cli import main

DALBERGIA = str(Path(__file__).parent.parent / "data" / "dalbergia" / "dalbergia.csv")


def output(arguments, capsys, code=0):
    assert main(arguments) == code
    said = capsys.readouterr()
    assert said.err == ""
    return said.out


def complaint(arguments, capsys):
    assert main(arguments) == 2
    said = capsys.readouterr()
    assert said.out == ""
    return said.err


@pytest.fixture(scope="module")
def leaf(recorded):
    return str(recorded / "leaf.h5")


@pytest.fixture(scope="module")
def other(recorded):
    """The same leaf from another seed."""
    path = recorded / "other.h5"
    arguments = ["run", str(recorded / "leaf.toml"), "-o", str(path), "--seed", "4"]
    assert main([*arguments, "--no-figure", "--quiet"]) == 0
    return str(path)


class TestStats:
    def test_of_a_real_leaf(self, capsys):
        found = json.loads(output(["stats", DALBERGIA, "--json"], capsys))
        assert (found["nodes"], found["length_unit"], found["step"]) == (16474, "px", None)
        said = output(["stats", DALBERGIA], capsys)
        assert "mst_ratio" in said
        assert "vein order" in said

    def test_of_a_run_scale_with_its_units(self, leaf, capsys):
        found = json.loads(output(["stats", leaf, "--json"], capsys))
        assert found["length_unit"] == "um"
        total = sum(order["length"] for order in found["orders"].values())
        assert total == pytest.approx(found["vein_length"])
        # the finest veins are as wide as the config says: half a D, 2 um
        finest = min(order["width_mean"] for order in found["orders"].values())
        assert 2.0 <= finest < 3.0

    def test_shuffles_are_of_the_seed_given(self, leaf, capsys):
        found = [output(["stats", leaf, "--json", "--seed", seed], capsys) for seed in "112"]
        assert found[0] == found[1] != found[2]

    def test_mistakes_in_one_line(self, tmp_path, capsys):
        said = complaint(["stats", DALBERGIA, "--step", "3"], capsys)
        assert "a real network has no steps" in said
        said = complaint(["stats", str(tmp_path / "none.csv")], capsys)
        assert "there is no none_nodes.csv" in said
        (tmp_path / "a_nodes.csv").write_text("id,x,y\n1,0,zero\n")
        (tmp_path / "a_edges.csv").write_text("u,v\n")
        said = complaint(["stats", str(tmp_path / "a.csv")], capsys)
        assert said.startswith("a_nodes.csv, row 2: y is 'zero'; it must be a number between")
        assert said.count("\n") == 1


class TestCompare:
    def test_a_run_and_a_real_leaf(self, leaf, capsys):
        found = json.loads(output(["compare", leaf, DALBERGIA, "--json"], capsys))
        assert found["runs"] is None
        run, real = found["statistics"]
        assert run == json.loads(output(["stats", leaf, "--json"], capsys))
        assert real == json.loads(output(["stats", DALBERGIA, "--json"], capsys))
        said = output(["compare", leaf, DALBERGIA], capsys).splitlines()[1:]
        lines = {line.split()[0]: line.split()[1:] for line in said if line}
        # um and px: no ratio of lengths
        assert lines["vein_length"][-3] == "-"
        ratio = real["mst_ratio"] / run["mst_ratio"]
        assert float(lines["mst_ratio"][-3]) == pytest.approx(ratio, abs=5e-4)
        assert "orders.1.length" in lines
        # whichever side has more of them, orders and streams are with their kin
        for kin in ("orders.", "strahler_streams."):
            places = [k for k, name in enumerate(lines) if name.startswith(kin)]
            numbers = [int(name.split(".")[1]) for name in lines if name.startswith(kin)]
            assert places == list(range(places[0], places[0] + len(places)))
            assert numbers == sorted(numbers)
        assert len(run["strahler_streams"]) != len(real["strahler_streams"])
        counts = [f"{side['murray_junctions']:,}" for side in (run, real)]
        assert lines["murray_exponent_median"][-2:] == counts
        # the blade of the run, and of the leaf what its veins enclose
        assert found["on_different_areas"][0] == "vein_density"
        assert lines["density_x_sqrt_areole"][-3] == "-"
        key = "enclosed_density_x_sqrt_areole"
        assert float(lines[key][-3]) == pytest.approx(real[key] / run[key], abs=5e-4)
        assert lines["blade_area"][:3] == ["um^2", "|", "px^2"]
        assert lines["areole_area_cv"][-2:] == [str(run["areoles"]), "6,398"]
        assert lines["mst_ratio"][0] == lines["mst_ratio"][-1] == "-"

    def test_two_runs_and_where_they_part(self, leaf, other, capsys):
        found = json.loads(output(["compare", leaf, other, "--json"], capsys))
        counts = found["runs"]["events"]
        assert counts["run_finished"] == [1, 1]
        assert counts["source_placed"][0] != counts["source_placed"][1]
        assert found["runs"]["first_difference"]["step"] == 1
        parting = found["runs"]["first_event"]
        assert parting["a"] != parting["b"]
        assert parting["a"]["kind"] == parting["b"]["kind"] == "source_placed"
        said = output(["compare", leaf, other], capsys)
        assert "first difference: step 1, " in said
        assert "first event that differs: 2 source_placed 0 -1 | 1 source_placed 0 -1" in said

    def test_a_run_and_itself(self, leaf, recorded, capsys):
        copy = str(recorded / "copy.h5")
        shutil.copy(leaf, copy)
        found = json.loads(output(["compare", leaf, copy, "--json"], capsys))
        assert found["runs"]["first_difference"] is found["runs"]["first_event"] is None
        assert found["statistics"][0] == found["statistics"][1]
        assert found["on_different_areas"] == []
        assert "the two runs are the same, bit for bit" in output(["compare", leaf, copy], capsys)

    def test_a_run_that_was_stopped_parts_where_it_ends(self, leaf, recorded, capsys):
        short = str(recorded / "short.h5")
        arguments = ["run", str(recorded / "leaf.toml"), "-o", short, "--steps", "10"]
        assert main([*arguments, "--no-figure", "--quiet"]) == 0
        capsys.readouterr()
        found = json.loads(output(["compare", leaf, short, "--json", "--step", "10"], capsys))
        assert found["statistics"][0] == found["statistics"][1]
        assert found["runs"]["first_difference"]["step"] == 11
        assert found["runs"]["first_event"]["b"] is None

    def test_a_step_that_is_not_there(self, leaf, capsys):
        assert "step 9999 is not recorded" in complaint(
            ["compare", leaf, DALBERGIA, "--step", "9999"], capsys
        )

    def test_two_stems(self, here, capsys):
        (here / "stem.toml").write_text(STEM)
        for name in "ab":
            assert main(["run", "stem.toml", "-o", f"{name}.h5", "--no-figure", "-q"]) == 0
        capsys.readouterr()
        found = json.loads(output(["compare", "a.h5", "b.h5", "--json"], capsys))
        stem, again = found["statistics"]
        assert stem == again
        assert stem["vein_length"] > 0.0
        assert stem["areoles"] is stem["orders"] is stem["blade_area"] is None
        assert found["runs"]["first_difference"] is None
        assert "the same, bit for bit" in output(["compare", "a.h5", "b.h5"], capsys)
