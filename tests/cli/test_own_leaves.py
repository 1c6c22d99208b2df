"""``vasc validate leaf FILE...``: leaves of the user held against the checks of leaves."""

import json
from pathlib import Path

from reference.drawn_networks import binary_tree, honeycomb
from reference.stem_run import STEM

from vasc.cli import main
from vasc.validation.vein_statistics import (
    check_leaf,
    dalbergia,
    sample_of_run,
    validate_leaves,
)

OPEN = 'kind = "open"\n'


def written(net, folder, name):
    """Write a network without widths as tables."""
    nodes = [f"{row},{x!r},{y!r}" for row, (x, y) in enumerate(net.positions.tolist())]
    edges = [f"{a},{b}" for a, b in net.segments.tolist()]
    (folder / f"{name}_nodes.csv").write_text("\n".join(["id,x,y", *nodes]) + "\n")
    (folder / f"{name}_edges.csv").write_text("\n".join(["u,v", *edges]) + "\n")
    return folder / f"{name}.csv"


def keys(checks, leaf):
    return {check.asked.key for check in checks if check.leaf == leaf}


def test_a_run_is_judged_as_the_bundled_ones_are(recorded):
    report = validate_leaves([recorded / "leaf.h5"])
    expected = check_leaf(sample_of_run("leaf", "closed", recorded / "leaf.h5"))
    found = {check.asked.key: check.value for check in report.checks if check.leaf == "leaf"}
    # the blade grows from 20 to 60 D, so that its densities are watched, too
    growing = {"minor_change", "major_exponent"}
    assert found.keys() == {check.asked.key for check in expected} | growing
    assert {check.asked.key: check.value for check in expected} == {
        key: value for key, value in found.items() if key not in growing
    }
    # the control passes all of it, and check 17 is of the measuring
    control = [check for check in report.checks if check.leaf == "Dalbergia"]
    assert all(check.passed for check in control)
    assert len(control) == len(check_leaf(dalbergia()))


def test_a_network_without_widths_is_not_judged_by_them(tmp_path):
    report = validate_leaves([written(honeycomb(12, 12), tmp_path, "hexagons")])
    found = keys(report.checks, "hexagons")
    assert {"corners_mean", "mst_closed", "density_x_sqrt_areole"} <= found
    assert not found & {"force_residual", "angle_off", "hierarchy", "minor_change"}
    # a network of the user that fails is no wrong check
    suite = report.as_suite()
    assert any(not check["pass"] for check in suite["checks"])
    assert suite["control_failures"] == []


def test_open_venation_is_judged_as_a_tree(recorded, tmp_path):
    config = (recorded / "leaf.toml").read_text().replace('kind = "closed"\n', OPEN, 1)
    (tmp_path / "tree.toml").write_text(config)
    run = str(tmp_path / "tree.h5")
    assert main(["run", str(tmp_path / "tree.toml"), "-o", run, "--no-figure", "-q"]) == 0
    report = validate_leaves([Path(run)])
    assert keys(report.checks, "tree") == {"mst_open", "murray"}
    assert all(check.passed for check in report.checks if check.leaf == "tree")
    assert len(report.exponents) > 10
    assert abs(report.exponents).max() < 1e-6


def test_the_command_writes_what_python_finds_and_draws_it(recorded, tmp_path, capsys):
    leaf, hexagons = recorded / "leaf.h5", written(honeycomb(9, 9), tmp_path, "hexagons")
    arguments = ["validate", "leaf", str(leaf), str(hexagons)]
    # hexagons are too regular for a leaf
    assert main([*arguments, "--json", "-o", str(tmp_path / "leaves.png")]) == 1
    (suite,) = json.loads(capsys.readouterr().out)["suites"]
    assert suite["checks"] == validate_leaves([leaf, hexagons]).as_suite()["checks"]
    assert (tmp_path / "leaves.png").stat().st_size > 10_000
    assert main(arguments) == 1
    said = capsys.readouterr().out
    assert "hexagons" in said
    assert "that check is wrong" not in said


def test_two_files_of_one_name_are_told_apart(tmp_path):
    paths = []
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
        paths.append(written(honeycomb(6, 6), tmp_path / name, "leaf"))
    report = validate_leaves(paths)
    assert [sample.name for sample in report.samples] == [*map(str, paths), "Dalbergia"]


def test_what_cannot_be_judged_is_told_in_one_line(recorded, tmp_path, capsys):
    leaf = str(recorded / "leaf.h5")
    tree = str(written(binary_tree(4), tmp_path, "tree"))
    (tmp_path / "stem.toml").write_text(STEM)
    stem = str(tmp_path / "stem.h5")
    assert main(["run", str(tmp_path / "stem.toml"), "-o", stem, "--no-figure", "-q"]) == 0
    capsys.readouterr()
    for arguments, part in (
        (["growth", leaf], "only the suite leaf judges files"),
        (["leaf", leaf, leaf], "is given twice"),
        (["leaf", tree], "its veins enclose no areole"),
        (["leaf", stem], "is a stem"),
        (["leaf", str(tmp_path / "none.h5")], "no such file"),
    ):
        assert main(["validate", *arguments]) == 2
        said = [line for line in capsys.readouterr().err.splitlines() if "running" not in line]
        assert len(said) == 1
        assert part in said[0]


def test_what_a_leaf_has_no_number_for_is_open(recorded, tmp_path, capsys):
    """The small leaf has no minor veins in the end, and few junctions."""
    leaf, picture = str(recorded / "leaf.h5"), tmp_path / "leaves.png"
    assert main(["validate", "leaf", leaf, "-o", str(picture)]) == 1
    said = capsys.readouterr().out
    assert picture.stat().st_size > 10_000
    row = next(line for line in said.splitlines() if line.startswith("15") and "minor" in line)
    assert row.split()[-6:] == ["leaf", "open", "-", "0", "to", "0.2"]
    checks = [one for one in validate_leaves([Path(leaf)]).checks if one.leaf == "leaf"]
    verdicts = [one.passed for one in checks]
    n_failed, n_open = verdicts.count(False), verdicts.count(None)
    assert n_open
    assert f"\nleaf: {verdicts.count(True)} of {len(checks)} checks pass, " in said
    assert f"{n_failed} fail, {n_open} cannot be decided\n" in said
    # the control is counted by itself
    assert "\nDalbergia, the control: 13 of 13 checks pass\n" in said
