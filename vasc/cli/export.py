"""``vasc export``: a recorded run for other programs, or a tissue cut from it."""

from pathlib import Path
from typing import Annotated

import typer

from vasc.cli.options import AsJson, Force, Output, RunFile, Step

EXAMPLES = (
    "vasc export poplar-leaf.h5 -o leaf.svg",
    "vasc export poplar-leaf.h5 -o young.geojson --step 100",
    "vasc export poplar-leaf.h5 -o tables.csv",
    "vasc export poplar-leaf.h5 -o growth.pvd --every 20",
    "vasc export sweetgum-leaf.h5 -o leaf.swc",
    "vasc export stem-golden-5-8.h5 -o stem.glb",
    "vasc export poplar-leaf.h5 -o tissue.toml --step 60 --cell 2",
    "vasc export poplar-leaf.h5 -o poplar.crate --author 'A. Botanist'",
)


def export(
    path: RunFile,
    output: Output,
    step: Step = -1,
    every: Annotated[
        int | None,
        typer.Option("--every", min=1, help="Of a series (pvd): every so many steps."),
    ] = None,
    spanning_tree: Annotated[
        bool,
        typer.Option("--spanning-tree", help="Of swc and mtg: leave out where veins joined."),
    ] = False,
    cell: Annotated[
        float | None,
        typer.Option("--cell", metavar="D", help="Width of a cell of a tissue in D; by default 2."),
    ] = None,
    authors: Annotated[
        list[str] | None,
        typer.Option("--author", metavar="NAME", help="Of a crate: who made the run; repeat."),
    ] = None,
    license: Annotated[
        str | None,
        typer.Option("--license", metavar="URL", help="Of a crate: the licence of the run."),
    ] = None,
    force: Force = False,
    as_json: AsJson = False,
) -> None:
    """Write a run for other programs; the suffix of FILE says as what.

    graphml: graph of nodes and segments. geojson, wkt: outline and veins as shapes. svg: drawing,
    veins of true width, a layer an order. csv: folder of tables. vtp, pvd: VTK PolyData, one step
    or a series for ParaView. swc, mtg: trees, of runs whose veins do not join. ply, obj, glb, gltf:
    solid model of the veins of a leaf or stem. toml: outline, veins and live sources of a leaf as
    the config of a tissue, for `vasc run`. A name that ends in crate, as leaf.crate or crate/: a
    folder with the run, its config, pictures and tables of a step, software and citation, as a
    Research Object Crate.

    Lengths are in D, or in the unit that the config gives; of a tissue, in widths of a cell.
    """
    from vasc import export as exports
    from vasc.cli.outputs import check_file, check_folder
    from vasc.crates import export_crate, is_crate
    from vasc.errors import OutputError

    if is_crate(output):
        _refuse_all_but_step(output, every, cell, spanning_tree=spanning_tree)
        file = export_crate(path, output, step, authors=authors or (), license=license, force=force)
        _tell(file, as_json=as_json)
        return
    if authors or license is not None:
        raise OutputError(f"{output}: --author and --license are for a crate")
    is_tissue = output.suffix.lower() == exports.TISSUE_SUFFIX
    if cell is not None and not is_tissue:
        raise OutputError(f"{output}: --cell is for a tissue, {exports.TISSUE_SUFFIX}")
    if is_tissue and (every is not None or spanning_tree):
        raise OutputError(f"{output}: --every and --spanning-tree are not for a tissue")
    if is_tissue:
        check_file(output, force=force)
        width = exports.CELL if cell is None else cell
        file = exports.export_tissue(path, output, step, cell=width)
        warn_without_sources(file)
    else:
        check_folder(output)
        file = exports.export(
            path, output, step, force=force, every=every, spanning_tree=spanning_tree
        )
    _tell(file, as_json=as_json)


def _refuse_all_but_step(
    output: Path, every: int | None, cell: float | None, *, spanning_tree: bool
) -> None:
    """Refuse options that a crate does not have."""
    from vasc.errors import OutputError

    if every is not None or cell is not None or spanning_tree:
        raise OutputError(f"{output}: --every, --cell and --spanning-tree are not for a crate")


def _tell(file: Path, *, as_json: bool) -> None:
    """Say what was written."""
    from vasc.cli.printing import print_json

    if as_json:
        print_json({"files": [str(file)]})
    else:
        typer.echo(f"written: {file}")


def warn_without_sources(config: Path) -> None:
    """Warn of a tissue in which no canal will form."""
    import tomllib

    from vasc.cli.failures import complain

    if not tomllib.loads(config.read_text(encoding="utf-8"))["placement"]["points"]:
        complain(
            f"warning: {config}: no live source of that step has a ground cell of its own, so"
            " that no canal will form; choose a step at which sources live (--step), or give"
            " placement.points"
        )
