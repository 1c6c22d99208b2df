"""What the pages show works as they show it."""

import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from vasc.timeline import Timeline

ROOT = Path(__file__).resolve().parent.parent
PROGRAM = [sys.executable, "-c", "import sys; from vasc.cli import main; sys.exit(main())"]


def blocks(page, language):
    """Give the code blocks of a page in one language."""
    text = (ROOT / "docs" / page).read_text()
    return re.findall(rf"^```{language}\n(.*?)^```$", text, flags=re.MULTILINE | re.DOTALL)


def named_blocks(page):
    """Give the code blocks that begin with the name of a file, by that name."""
    found = [block for language in ("python", "toml") for block in blocks(page, language)]
    pairs = [re.match(r"# (\S+\.(?:py|toml))\n", block) for block in found]
    return {match[1]: block for match, block in zip(pairs, found, strict=True) if match}


def vasc(folder, *arguments):
    """Run the program in a folder where packages are found too."""
    return subprocess.run(
        [*PROGRAM, *arguments],
        cwd=folder,
        env=os.environ | {"PYTHONPATH": os.pathsep.join([str(folder), str(ROOT)])},
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.fixture(scope="module")
def extended(tmp_path_factory):
    """Install the package of the page on extending, as pip would."""
    folder = tmp_path_factory.mktemp("extended")
    for name, block in named_blocks("extending.md").items():
        path = folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(block)
    (project,) = (block for block in blocks("extending.md", "toml") if "[project]" in block)
    described = tomllib.loads(project)["project"]
    name, version = described["name"], described["version"]
    record = folder / f"slow_leaves-{version}.dist-info"
    record.mkdir()
    (record / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: {version}\n")
    lines = []
    for group, points in described["entry-points"].items():
        lines += [f"[{group}]", *(f"{name} = {target}" for name, target in points.items())]
    (record / "entry_points.txt").write_text("\n".join(lines) + "\n")
    return folder


def test_a_model_of_your_own_runs_and_verifies(extended):
    run = vasc(extended, "run", "slow.toml", "-o", "slow.h5", "--no-figure", "--quiet")
    assert run.returncode == 0, run.stderr
    with Timeline(extended / "slow.h5") as timeline:
        assert timeline.model == "slow-open"
        assert timeline.growth == "slowing"
        assert timeline.is_complete
        frame = timeline.frame()
        assert frame.network.n_nodes > 100
        # the growth of the page: a thousandth of the final length may be missing
        assert 120.0 * 0.999 <= frame.blade.length < 120.0
        lengths = [timeline.frame(step).blade.length for step in (0, 1, 2)]
    assert lengths == pytest.approx([40.0, 41.6, 43.168])
    verified = vasc(extended, "verify", "slow.h5")
    assert verified.returncode == 0, verified.stdout + verified.stderr


def test_packages_that_pages_show_have_what_pip_asks_for():
    pages = [*(ROOT / "docs").rglob("*.md"), ROOT / "README.md", ROOT / "CONTRIBUTING.md"]
    projects = {
        page.name: tomllib.loads(block)["project"]
        for page in pages
        for block in blocks(page, "toml")
        if "[project]" in block
    }
    assert "extending.md" in projects
    for page, project in projects.items():
        given = {"name", "version"} & project.keys()
        assert given == {"name", "version"}, page


def test_a_model_of_your_own_is_checked_like_ours(extended):
    text = (extended / "slow.toml").read_text()
    (extended / "bad.toml").write_text(text.replace("share = 0.02", "share = 2.0"))
    refused = vasc(extended, "run", "bad.toml", "-o", "bad.h5")
    assert refused.returncode == 2
    assert "growth.share" in refused.stderr
    assert not (extended / "bad.h5").exists()


@pytest.fixture(scope="module")
def tutorial(tmp_path_factory):
    """Run the experiment of the tutorial as section 4 does."""
    folder = tmp_path_factory.mktemp("tutorial")
    (config,) = (block for block in blocks("tutorial.md", "toml") if block.startswith("kind"))
    (folder / "my-leaf.toml").write_text(config)
    (asked,) = (block for block in blocks("tutorial.md", "sh") if "far.h5 --set" in block)
    for command in re.findall(r"^vasc (run .*)$", asked, flags=re.MULTILINE):
        run = vasc(folder, *command.split(), "--no-figure", "--quiet")
        assert run.returncode == 0, run.stderr
    return folder


def test_the_tutorial_finds_loops_with_a_small_kill_distance_alone(tutorial):
    cycles = {}
    for name in ("near", "far"):
        with Timeline(tutorial / f"{name}.h5") as timeline:
            network = timeline.frame().network
            cycles[name] = network.n_segments - network.n_nodes + 1
    assert cycles["near"] > 20
    assert cycles["far"] < cycles["near"] / 10


def test_the_python_of_the_tutorial_reads_the_run(tutorial):
    (program,) = blocks("tutorial.md", "python")
    (tutorial / "read.py").write_text(program)
    read = subprocess.run(
        [sys.executable, "read.py"],
        cwd=tutorial,
        env=os.environ | {"PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert read.returncode == 0, read.stderr
    assert re.search(r"^0 1 0 0\.0$", read.stdout, flags=re.MULTILINE)
    assert "source 0 lived from step" in read.stdout


def test_the_python_of_the_page_on_lineage_reads_the_run(tutorial):
    program = "".join(blocks("lineage.md", "python"))
    program = program.replace("poplar-leaf.h5", "near.h5")
    (tutorial / "lineage.py").write_text(
        program + "print(len(fates), len(births), loop, births.order.min())\n"
    )
    read = subprocess.run(
        [sys.executable, "lineage.py"],
        cwd=tutorial,
        env=os.environ | {"PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert read.returncode == 0, read.stderr
    assert re.match(r"\d+ \d+ VeinLoop\(node=1000, .*\) 1$", read.stdout)


@pytest.mark.slow
def test_every_command_of_the_tutorial_runs(tmp_path):
    (config,) = (block for block in blocks("tutorial.md", "toml") if block.startswith("kind"))
    (tmp_path / "my-leaf.toml").write_text(config)
    text = "".join(blocks("tutorial.md", "sh"))
    commands = re.findall(r"(?:^|&& )vasc ([^#\n]+)", text, flags=re.MULTILINE)
    assert len(commands) > 15
    for command in commands:
        done = vasc(tmp_path, *command.split())
        assert done.returncode == 0, f"{command}: {done.stderr}"


def test_the_tutorial_names_what_there_is():
    pages = ("docs/tutorial.md", "docs/commands.md", "README.md")
    text = "".join((ROOT / page).read_text() for page in pages)
    copied = re.findall(r"^vasc configs --copy (\S+)", text, flags=re.MULTILINE)
    assert copied
    names = {path.stem for path in (ROOT / "configs").glob("*.toml")}
    assert set(copied) <= names


def test_every_extra_is_on_the_page_of_commands():
    table = (ROOT / "docs" / "commands.md").read_text().partition("## Extras")[2]
    told = re.findall(r"^\| `(\w+)` \|", table, flags=re.MULTILINE)
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    assert sorted(told) == sorted(project["optional-dependencies"])


def test_pages_tell_one_way_to_install_an_extra():
    pages = [*(ROOT / "docs").rglob("*.md"), ROOT / "docs" / "tutorial.ipynb"]
    told = {page: re.findall(r"pip install .{0,2}\.\[\w+\]", page.read_text()) for page in pages}
    others = {page.name: found for page, found in told.items() if found}
    assert others == {"commands.md": ['pip install ".[video]']}


def test_every_verb_is_on_the_page_of_commands():
    text = "".join(blocks("../README.md", "sh") + blocks("commands.md", "sh"))
    verbs = set(re.findall(r"(?:^|&& )vasc ([a-z]+)", text, flags=re.MULTILINE))
    for verb in sorted(verbs):
        shown = vasc(ROOT, verb, "--help")
        assert shown.returncode == 0, f"{verb}: {shown.stderr}"
    assert verbs == {
        *("configs", "run", "resume", "show", "events", "lineage", "stats"),
        *("render", "animate", "export", "verify", "schema", "check", "validate", "sweep"),
    }
