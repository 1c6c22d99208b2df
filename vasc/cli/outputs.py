"""Names of files that a verb is to write, refused before its work begins."""

import os
from pathlib import Path


def check_outputs(config: str, output: Path, figure: Path | None, *, force: bool) -> None:
    """Refuse files that are one, and a picture that cannot be written.

    Raises
    ------
    OutputError
        If two of the files are one, or the picture exists and ``force`` is not
        set, its folder does not exist, or it is of no known kind.
    """
    from vasc.errors import OutputError

    named = [("config", Path(config)), ("timeline", output)]
    if figure is not None:
        check_folder(figure)
        named.append(("picture", figure))
    for index, (kind, path) in enumerate(named[1:], start=1):
        for other_kind, other in named[:index]:
            if path.absolute() == other.absolute() or (path.exists() and _is_same(path, other)):
                raise OutputError(f"{path}: cannot be {other_kind} and {kind} at once")
    if figure is not None:
        check_picture(figure, force=force)


def check_picture(figure: Path, *, force: bool, also: tuple[str, ...] = ()) -> None:
    """Refuse a picture that cannot be written, or is none by its suffix.

    Parameters
    ----------
    figure : Path
        The picture to be.
    force : bool
        Replace one that exists.
    also : tuple of str
        Suffixes of what else may be written under that name.

    Raises
    ------
    OutputError
        If it cannot be written.
    """
    from vasc.render.saving import PICTURE_SUFFIXES, checked_output

    check_file(figure, force=force)
    checked_output(figure, (*PICTURE_SUFFIXES, *also))


def check_file(path: Path, *, force: bool) -> None:
    """Refuse a file that exists and is not to be replaced, or whose folder does not exist.

    Raises
    ------
    OutputError
        If it cannot be written.
    """
    from vasc.errors import OutputError
    from vasc.whole_files import refuse_special

    check_folder(path)
    refuse_special(path)
    if path.is_dir():
        raise OutputError(f"{path}: is a folder")
    if path.exists() and not force:
        raise OutputError(f"{path}: exists already; use --force to replace it")


def check_not_needed(
    run: Path, output: Path, hint: str = "; choose another name with --output"
) -> None:
    """Refuse to write over a file that the config of a recorded run refers to.

    Raises
    ------
    OutputError
        If it is one of these, by its name or its content.
    TimelineError
        If the run is no timeline.
    """
    from vasc.config.attachments import refuse_recorded
    from vasc.timeline import Timeline

    if output.is_file():
        with Timeline(run) as timeline:
            refuse_recorded(timeline.config, output, hint)


def check_folder(path: Path) -> None:
    """Refuse a file whose folder does not exist, or into which nothing can be written.

    Raises
    ------
    OutputError
        If no file of that name can be made there.
    """
    from vasc.errors import OutputError

    if not path.parent.is_dir():
        raise OutputError(f"{path}: the folder {str(path.parent)!r} does not exist")
    if not os.access(path.parent, os.W_OK | os.X_OK):
        raise OutputError(f"{path}: the folder {str(path.parent)!r} cannot be written to")
    try:
        path.exists()
    except (OSError, ValueError) as error:
        why = getattr(error, "strerror", None) or error
        raise OutputError(f"{str(path)[:80]!r}: is not the name of a file: {why}") from error


def _is_same(path: Path, other: Path) -> bool:
    """Tell whether two names lead to one file."""
    return other.exists() and path.samefile(other)
