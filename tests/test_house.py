"""What keeps the house in order: rooms, names, randomness, packaging and promises."""

import ast
import re
import subprocess
import sys
import tarfile
import tomllib
import zipfile
from importlib.metadata import packages_distributions
from pathlib import Path

import pytest

import vasc
from vasc.config.attachments import missing_files
from vasc.config.bundled import bundled_configs
from vasc.config.reading import parse, read_text

ROOT = Path(__file__).resolve().parent.parent
LINKS = ("models", "growth", "validation")
BANNED_NAMES = {"utils", "helpers", "common", "misc", "manager", "data", "process", "tmp"}
MODULES = sorted((ROOT / "vasc").rglob("*.py"))
SITE = {ROOT / "docs" / room for room in ("_build", "api", "gallery")}
"""What Sphinx makes of the pages."""
PAGES = sorted(
    [
        *ROOT.glob("*.md"),
        *(path for path in (ROOT / "docs").rglob("*.md") if not SITE & set(path.parents)),
    ]
)
CONFIGS = sorted((ROOT / "configs").glob("*.toml"))
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())


def trees():
    """Parse every module of the package."""
    return [(path.relative_to(ROOT), ast.parse(path.read_text())) for path in MODULES]


def texts():
    """Read every file of the house that people write."""
    suffixes = {".py", ".md", ".toml", ".cff", ".json", ".csv"}
    rooms = ("vasc", "configs", "docs", "tests", "benchmarks", "paper_figures")
    paths = [path for room in rooms for path in (ROOT / room).rglob("*")]
    for path in [*paths, *ROOT.glob("*")]:
        if path.suffix in suffixes and path.is_file() and not SITE & set(path.parents):
            yield path.relative_to(ROOT), path.read_text()


def dotted(node):
    """Give ``a.b.c`` for a chain of attributes, empty for anything else."""
    names = []
    while isinstance(node, ast.Attribute):
        names.append(node.attr)
        node = node.value
    return ".".join([node.id, *reversed(names)]) if isinstance(node, ast.Name) else ""


def requirements(lines):
    """Give the names and lower bounds of requirements."""
    return dict(re.fullmatch(r"([\w-]+)(?:\[.*\])?>=([\d.]+)", line).groups() for line in lines)


@pytest.mark.parametrize("name", LINKS)
def test_the_science_is_one_relative_link_from_the_root(name):
    link = ROOT / name
    assert link.is_symlink()
    assert link.readlink() == Path("vasc") / name
    assert (link / "__init__.py").is_file()


def test_files_hold_one_idea():
    lengths = {path.relative_to(ROOT): len(path.read_text().splitlines()) for path in MODULES}
    assert {path: n for path, n in lengths.items() if n > 400} == {}


def test_functions_fit_one_screen():
    long = {}
    for path, tree in trees():
        for node in ast.walk(tree):
            if isinstance(node, ast.FunctionDef):
                has_docstring = ast.get_docstring(node) is not None
                start = node.body[1 if has_docstring and len(node.body) > 1 else 0].lineno
                n_lines = node.end_lineno - start + 1
                if n_lines > 40:
                    long[f"{path}:{node.name}"] = n_lines
    assert long == {}


def test_no_module_is_a_drawer():
    names = {part for path in MODULES for part in path.relative_to(ROOT).with_suffix("").parts}
    assert names & BANNED_NAMES == set()


def test_every_folder_of_the_package_is_a_package():
    folders = {path.parent for path in MODULES}
    assert [folder for folder in folders if not (folder / "__init__.py").is_file()] == []


def test_randomness_comes_from_streams_alone():
    found = []
    for path, tree in trees():
        for node in ast.walk(tree):
            if isinstance(node, ast.Import):
                found += [(path, name.name) for name in node.names if name.name == "random"]
            elif isinstance(node, ast.ImportFrom) and node.module in {"random", "numpy.random"}:
                found.append((path, node.module))
            elif isinstance(node, ast.Attribute) and dotted(node).startswith(
                ("np.random.", "numpy.random.")
            ):
                is_type = dotted(node) == "np.random.Generator"
                if not is_type and path != Path("vasc/streams.py"):
                    found.append((path, dotted(node)))
    assert found == []


def test_nothing_is_printed_outside_the_command_line():
    found = [
        (path, node.lineno)
        for path, tree in trees()
        for node in ast.walk(tree)
        if isinstance(node, ast.Call)
        and dotted(node.func) in {"print", "sys.stdout.write", "sys.stderr.write"}
        and path.parts[:2] != ("vasc", "cli")
    ]
    assert found == []


def test_no_text_knows_the_machine_it_was_written_on():
    # in two pieces, so that this line does not find itself
    path_of_one_machine = re.compile("/(?:work|root|tmp|home)" + "/[A-Za-z]")
    found = [path for path, text in texts() if path_of_one_machine.search(text)]
    assert found == []


def test_nothing_is_left_unfinished():
    marks = re.compile(r"\b(?:TO" + r"DO|FIX" + r"ME|X" + r"XX)\b")
    assert [path for path, text in texts() if marks.search(text)] == []


def test_no_test_is_skipped():
    marks = re.compile(r"pytest\.sk" + r"ip\(|mark\.sk" + r"ip|mark\.xf" + "ail")
    tests = [(path, text) for path, text in texts() if path.parts[0] == "tests"]
    assert [path for path, text in tests if marks.search(text)] == []


def test_importing_vasc_loads_nothing_heavy():
    program = "import sys, vasc; print(*sorted({name.partition('.')[0] for name in sys.modules}))"
    loaded = subprocess.run(
        [sys.executable, "-c", program], cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout.split()
    assert "vasc" in loaded
    heavy = {"dask", "h5py", "matplotlib", "numba", "pandas", "scipy", "shapely"}
    assert heavy.intersection(loaded) == set()


def test_every_import_is_a_declared_dependency():
    project = PROJECT["project"]
    extras = [line for lines in project["optional-dependencies"].values() for line in lines]
    declared = {
        re.match(r"[\w-]+", line)[0].lower() for line in [*project["dependencies"], *extras]
    }
    distributions = packages_distributions()
    missing = set()
    for path, tree in trees():
        names = set()
        for node in ast.walk(tree):
            if isinstance(node, ast.Import):
                names |= {name.name for name in node.names}
            elif isinstance(node, ast.ImportFrom):
                names.add(node.module)
        for top in {name.partition(".")[0] for name in names} - {"vasc"}:
            if top in sys.stdlib_module_names:
                continue
            # names of distributions are the same with ".", "_" and "-"
            owners = {
                re.sub("[-_.]+", "-", owner.lower()) for owner in distributions.get(top, [top])
            }
            if not owners & declared:
                missing.add((str(path), top))
    assert missing == set()


def test_every_dependency_has_a_bound_and_a_reason():
    project = PROJECT["project"]
    extras = project["optional-dependencies"].items()
    bounds = requirements(project["dependencies"])
    for _, lines in extras:
        bounds |= requirements(line for line in lines if not line.startswith("vasc["))
    page = (ROOT / "docs" / "dependencies.md").read_text()
    rows = dict(re.findall(r"^\| ([\w-]+) \| ([\d.]+) \|", page, flags=re.MULTILINE))
    assert rows == bounds


def test_the_readme_has_exactly_two_commands_that_install():
    commands = re.findall(
        r"^python -m pip .*$", (ROOT / "README.md").read_text(), flags=re.MULTILINE
    )
    assert commands == [
        "python -m pip install . && vasc run poplar-leaf",
        'python -m pip install ".[test]" && python -m pytest',
    ]


def test_ci_runs_the_test_command_of_the_readme():
    script = (ROOT / ".ci" / "run").read_text()
    (line,) = re.findall(r"^command=.*$", script, flags=re.MULTILINE)
    command = subprocess.run(
        ["bash", "-c", f'{line}; printf %s "$command"'],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    ).stdout
    assert command == 'python -m pip install ".[test]" && python -m pytest'
    assert '\ncheck "$command"\n' in script
    # no other way in: pytest stands in the line above, and in that of readers too large for all
    readers = re.findall(r"^check '(.* && python -m pytest .*)'$", script, flags=re.MULTILINE)
    assert script.count("pytest") == 1 + len(readers) == 2
    assert '".[readers]"' in readers[0]
    assert f"| `{readers[0]}` |" in (ROOT / "CONTRIBUTING.md").read_text()


def test_ci_builds_the_site_as_the_page_for_contributors_says():
    script = (ROOT / ".ci" / "run").read_text()
    (command,) = re.findall(r"&& (python -m sphinx .*)'$", script, flags=re.MULTILINE)
    assert "-W --keep-going" in command
    assert f"| `{command}` |" in (ROOT / "CONTRIBUTING.md").read_text()


def test_versions_agree():
    citation = (ROOT / "CITATION.cff").read_text()
    assert f"\nversion: {vasc.__version__}\n" in citation
    headings = re.findall(r"^## (\S+)", (ROOT / "CHANGELOG.md").read_text(), flags=re.MULTILINE)
    assert headings[0] == vasc.__version__


def test_the_citation_is_in_the_citation_file_format():
    text = (ROOT / "CITATION.cff").read_text()
    keys = re.findall(r"^([a-z-]+):", text, flags=re.MULTILINE)
    assert len(keys) == len(set(keys))
    # what the format asks for, and what vasc may say: it has no address, and no release yet
    required = {"cff-version", "message", "title", "authors"}
    assert required <= set(keys)
    assert set(keys) <= required | {"type", "version", "license", "keywords", "references"}
    assert text.startswith("cff-version: 1.2.0\n")
    assert f"\nlicense: {PROJECT['project']['license']}\n" in text
    assert "(unreleased)" in (ROOT / "CHANGELOG.md").read_text()
    works = re.split(r"^  - (?=type:)", text, flags=re.MULTILINE)[1:]
    assert works
    for work in works:
        assert re.match(r"type: (?:article|book|conference-paper|report|software|thesis)\n", work)
        for key in ("title", "authors", "year"):
            assert re.search(rf"^    {key}:", work, flags=re.MULTILINE), work


@pytest.mark.parametrize("page", PAGES, ids=lambda path: path.name)
def test_links_between_pages_lead_somewhere(page):
    targets = re.findall(r"\]\(([^)#\s]+)(?:#[^)]*)?\)", page.read_text())
    broken = [
        target for target in targets if "://" not in target and not (page.parent / target).exists()
    ]
    assert broken == []


@pytest.mark.parametrize("page", PAGES, ids=lambda path: path.name)
def test_tests_that_pages_name_are_there(page):
    named = re.findall(r"`(tests/[\w/.-]+)`", page.read_text())
    assert [name for name in named if not (ROOT / name).exists()] == []


@pytest.mark.parametrize("page", PAGES, ids=lambda path: path.name)
def test_links_are_followed_in_the_repository_as_on_the_site(page):
    # a role of Sphinx is plain text where pages are read as Markdown
    assert re.findall(r"\{(?:doc|ref|any)\}`[^`]*`", page.read_text()) == []


def test_every_page_is_in_the_index():
    docs = ROOT / "docs"
    missing = set()
    for page in set(PAGES) & set(docs.rglob("*.md")) - {docs / "index.md"}:
        included = re.match(r"```{include} (\S+)\n", page.read_text())
        names = {included[1] if included else page.relative_to(docs).as_posix()}
        indexes = [docs / "index.md"]
        if page.parent != docs and page.name != "index.md":
            names.add(page.name)
            indexes.append(page.parent / "index.md")
        if not any(f"({name})" in index.read_text() for name in names for index in indexes):
            missing.add(page.relative_to(docs).as_posix())
    assert missing == set()


def test_every_bundled_config_is_listed():
    listed = bundled_configs()
    assert [config.name for config in listed] == [path.stem for path in CONFIGS]
    assert "poplar-leaf" in [config.name for config in listed]
    assert [config.name for config in listed if not config.title] == []


@pytest.mark.parametrize("path", CONFIGS, ids=lambda path: path.stem)
def test_a_bundled_config_names_its_source_and_has_its_files(path):
    tables = parse(read_text(path), path.name)
    assert tables.get("reference")
    assert missing_files(tables, path.parent) == []


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    """Build the wheel and give the names of its files."""
    folder = tmp_path_factory.mktemp("wheel")
    command = [sys.executable, "-m", "pip", "wheel", str(ROOT), "--no-deps", "--wheel-dir", folder]
    options = ["--no-build-isolation", "--disable-pip-version-check", "--quiet"]
    subprocess.run([*command, *options], check=True, capture_output=True)
    (path,) = folder.glob("*.whl")
    with zipfile.ZipFile(path) as archive:
        return {name for name in archive.namelist() if ".dist-info/" not in name}


def files_below(folder):
    """Give the files below a folder of the checkout, but for what Python leaves there."""
    return {
        path.relative_to(folder).as_posix()
        for path in folder.rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }


def test_the_wheel_holds_the_package_the_configs_and_the_real_leaf_once(wheel):
    package = {f"vasc/{name}" for name in files_below(ROOT / "vasc")}
    configs = {f"vasc/_configs/{name}" for name in files_below(ROOT / "configs")}
    leaf = {f"vasc/_dalbergia/{name}" for name in files_below(ROOT / "tests/data/dalbergia")}
    assert wheel == package | configs | leaf | {"vasc/CITATION.cff"}
    assert "vasc/_configs/poplar-leaf.toml" in wheel
    assert "vasc/py.typed" in wheel
    assert "vasc/timeline/provenance.schema.json" in wheel


def test_the_source_archive_builds_and_holds_no_target_of_a_link_twice(tmp_path):
    command = [sys.executable, "-m", "hatchling", "build", "--target", "sdist"]
    subprocess.run(
        [*command, "--directory", str(tmp_path)], cwd=ROOT, check=True, capture_output=True
    )
    (path,) = tmp_path.glob("*.tar.gz")
    with tarfile.open(path) as archive:
        names = {Path(*Path(name).parts[1:]).as_posix() for name in archive.getnames()}
    assert {f"vasc/{name}" for name in files_below(ROOT / "vasc")} <= names
    assert {f"configs/{name}" for name in files_below(ROOT / "configs")} <= names
    assert {"README.md", "LICENSE", "pyproject.toml", "tests/test_house.py"} <= names
    assert not {name for name in names if name.startswith(tuple(f"{link}/" for link in LINKS))}
