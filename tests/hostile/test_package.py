"""What the package may not do at all: run data as code, start shells, reach for the network."""

import ast
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
MODULES = {
    path.relative_to(ROOT).as_posix(): ast.parse(path.read_text())
    for path in sorted((ROOT / "vasc").rglob("*.py"))
}

LOADERS = {
    "pickle",
    "cPickle",
    "dill",
    "cloudpickle",
    "joblib",
    "marshal",
    "shelve",
    "yaml",
    "jsonpickle",
}
"""Modules that make code of data."""

NETWORK = {"socket", "ssl", "http", "urllib", "ftplib", "smtplib", "requests", "httpx", "aiohttp"}
"""Modules that reach for other machines."""

CLUSTER = {"distributed", "dask", "dask_jobqueue"}
"""Modules that do so for the one verb that is asked to, ``vasc sweep --scheduler``."""

CALLS = {"eval", "exec", "compile", "__import__", "os.system", "os.popen", "np.load", "numpy.load"}
"""Calls that run or load code; a file of numpy may hold pickles."""

PROCESSES = {"vasc/sweeps/local.py"}
"""Modules that may start processes."""


def dotted(node):
    """Give ``a.b.c`` for a chain of attributes, empty for anything else."""
    names = []
    while isinstance(node, ast.Attribute):
        names.append(node.attr)
        node = node.value
    return ".".join([node.id, *reversed(names)]) if isinstance(node, ast.Name) else ""


def imports(tree):
    """Give the first part of the name of every module that is imported anywhere."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (name.name.partition(".")[0] for name in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            yield node.module.partition(".")[0]


def calls(tree):
    """Give every call with the dotted name of what is called."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Call):
            yield dotted(node.func), node


def test_no_data_become_code():
    found = [
        (path, name) for path, tree in MODULES.items() for name in imports(tree) if name in LOADERS
    ]
    found += [
        (path, name) for path, tree in MODULES.items() for name, _ in calls(tree) if name in CALLS
    ]
    # numpy and h5py unpickle where they are allowed to
    found += [
        (path, word.arg)
        for path, tree in MODULES.items()
        for _, call in calls(tree)
        for word in call.keywords
        if word.arg == "allow_pickle"
    ]
    assert found == []


def test_no_shell_is_started_and_processes_by_few():
    starts = {path for path, tree in MODULES.items() if "subprocess" in set(imports(tree))}
    assert starts == PROCESSES
    shells = [
        path
        for path, tree in MODULES.items()
        for name, call in calls(tree)
        if name.startswith(("os.exec", "os.spawn"))
        or any(word.arg == "shell" for word in call.keywords)
    ]
    assert shells == []


def test_only_sweeps_on_a_cluster_know_the_network():
    found = {
        (path, name)
        for path, tree in MODULES.items()
        for name in imports(tree)
        if name in NETWORK | CLUSTER
    }
    assert {path for path, name in found} <= {"vasc/sweeps/cluster.py"}
    assert {name for path, name in found} <= CLUSTER


WITHOUT_SOCKETS = """
import sys

def refuse(event, arguments):
    if event.startswith("socket.") or event in ("urllib.Request", "http.client.connect"):
        sys.exit(f"{event}: {arguments}")

sys.addaudithook(refuse)
from vasc.cli import main
sys.exit(main(sys.argv[1:]))
"""


def test_a_run_and_all_that_reads_it_reach_for_nothing(tmp_path):
    config = (
        'kind = "closed"\n[domain]\nshape = "ovate"\nlength = 9.0\n[growth]\nkind = "none"\n'
        '[placement]\nkind = "given"\npoints = [[0.0, 6.0]]\n[arrival]\nkill_distance = 1.0\n'
    )
    (tmp_path / "leaf.toml").write_text(config)
    run = tmp_path / "leaf.h5"
    for arguments in (
        ["run", tmp_path / "leaf.toml", "-o", run, "-q"],
        ["stats", run],
        ["show", run, "--check"],
    ):
        command = [sys.executable, "-c", WITHOUT_SOCKETS, *arguments]
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
        assert (done.returncode, done.stderr) == (0, "")
    assert (tmp_path / "leaf.png").is_file()
    # urllib3, which comes with rocrate, tries a socket of this machine when it is imported
    inner = WITHOUT_SOCKETS.replace('"socket."', '("socket.connect", "socket.getaddrinfo")')
    command = [sys.executable, "-c", inner, "export", run, "-o", tmp_path / "leaf.crate"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
