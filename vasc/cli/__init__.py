"""The command line: one file a verb."""

from vasc.cli.program import main

__all__ = ["main"]
