"""``vasc schema``: the JSON schema of a config."""

from typing import Annotated

import typer

EXAMPLES = ("vasc schema closed > closed.schema.json",)


def schema(
    kind: Annotated[
        str | None, typer.Argument(metavar="[KIND]", help="A model, as closed; all if left out.")
    ] = None,
) -> None:
    """Write the JSON schema of a config, for editors."""
    from vasc.cli.printing import print_json
    from vasc.config.schema import json_schema

    print_json(json_schema(kind))
