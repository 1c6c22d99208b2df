"""How the words of a verb are read: an option that holds one value is given once."""

from typing import Any

import typer.core


class Verb(typer.core.TyperCommand):
    """A verb that refuses to drop one of two values of an option."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Read the words of a command line.

        Raises
        ------
        BadParameter
            If an option that takes one value is given twice.
        """
        _, _, order = self.make_parser(ctx).parse_args(args=list(args))
        for option in order:
            takes_more = getattr(option, "multiple", False) or getattr(option, "is_flag", False)
            n_given = order.count(option)
            if option.param_type_name == "option" and not takes_more and n_given > 1:
                name = max(option.opts, key=len)
                raise typer.BadParameter(f"{name} is given {n_given} times; give it once", ctx=ctx)
        return super().parse_args(ctx, args)
