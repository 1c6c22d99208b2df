"""The program: its verbs, and how it ends."""

import sys
from collections.abc import Sequence
from typing import Annotated

import typer

from vasc.cli import (
    animate,
    check,
    compare,
    configs,
    events,
    export,
    lineage,
    render,
    resume,
    run,
    schema,
    show,
    stats,
    sweep,
    validate,
    verify,
)
from vasc.cli.commands import Verb
from vasc.cli.failures import end_of, interruptible, provide_outputs, without_lines_of_code
from vasc.cli.start import rare_collections

# the order of a first day with vasc
VERBS = (
    configs,
    run,
    resume,
    show,
    events,
    lineage,
    stats,
    compare,
    render,
    animate,
    export,
    verify,
    sweep,
    validate,
    schema,
)

# verbs with verbs of their own: module, names of its functions, and their examples
GROUPS = (
    (
        check,
        {
            "sequence": check.SEQUENCE_EXAMPLES,
            "connectivity": check.CONNECTIVITY_EXAMPLES,
            "strand": check.STRAND_EXAMPLES,
        },
    ),
)

DEBUG = "--debug"


def examples(lines: Sequence[str]) -> str:
    """Lay out examples below the help of a verb; the mark keeps the lines apart."""
    return "\n".join(["\b", "Example:" if len(lines) == 1 else "Examples:", *lines])


# plain help: rich takes longer to load than all else that a verb's help needs
app = typer.Typer(
    name="vasc",
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
)


def _help_alone(context: typer.Context) -> None:
    """Show the help of a group that is given without a verb."""
    if context.invoked_subcommand is None:
        typer.echo(context.get_help())


for _module in VERBS:
    _name = _module.__name__.rpartition(".")[2]
    _verb = interruptible(getattr(_module, _name))
    app.command(_name, cls=Verb, epilog=examples(_module.EXAMPLES))(_verb)
for _group, _verbs in GROUPS:
    _below = typer.Typer(rich_markup_mode=None)
    _below.callback(invoke_without_command=True)(_help_alone)
    for _name, _lines in _verbs.items():
        _verb = interruptible(getattr(_group, _name))
        _below.command(_name, cls=Verb, epilog=examples(_lines))(_verb)
    app.add_typer(
        _below,
        name=_group.__name__.rpartition(".")[2],
        help="Hold a run against what is expected of it.",
        epilog=examples(_group.EXAMPLES),
    )


@app.callback(invoke_without_command=True, epilog=examples(["vasc run poplar-leaf"]))
def _program(
    context: typer.Context,
    version: Annotated[bool, typer.Option("--version", help="Show the version and exit.")] = False,
    debug: Annotated[
        bool, typer.Option(DEBUG, help="Show the traceback of an error; may stand anywhere.")
    ] = False,
) -> None:
    """Grow the veins of leaves, record every step, and draw them.

    Exit codes: 0 fine, 1 a check failed, 2 bad input, 3 a failed run, 130 interrupted.
    """
    if version:
        import vasc

        typer.echo(f"vasc {vasc.__version__}")
    elif context.invoked_subcommand is None:
        typer.echo(context.get_help())


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the program.

    No error leaves it as a traceback, unless ``--debug`` asks for one.

    Parameters
    ----------
    arguments : sequence of str, optional
        What follows the program's name; those of the process when not given.

    Returns
    -------
    int
        The exit code.
    """
    arguments = list(sys.argv[1:] if arguments is None else arguments)
    own = arguments[: arguments.index("--")] if "--" in arguments else arguments
    rest = arguments[len(own) :]
    provide_outputs()
    try:
        with rare_collections(), without_lines_of_code():
            code = app(
                [word for word in own if word != DEBUG] + rest,
                prog_name="vasc",
                standalone_mode=False,
            )
        sys.stdout.flush()
    except SystemExit as error:
        # the library that reads the command line makes this of some errors
        cause = error.__context__ or error
        return end_of(cause, with_traceback=DEBUG in own, arguments=own)
    except BaseException as error:
        return end_of(error, with_traceback=DEBUG in own, arguments=own)
    return code if isinstance(code, int) else 0
