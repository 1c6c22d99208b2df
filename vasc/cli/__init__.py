"""The command line: one file a verb."""

import sys
from collections.abc import Sequence

__all__ = ["main"]


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the program, also if it is interrupted before it is loaded.

    Parameters
    ----------
    arguments : sequence of str, optional
        What follows the program's name; those of the process when not given.

    Returns
    -------
    int
        The exit code.
    """
    try:
        from vasc.cli.program import main as program
    except KeyboardInterrupt:
        # nothing of the program is there yet that could say so
        sys.stderr.write("interrupted\n")
        return 130
    return program(arguments)
