"""The values of a recorded config that were set outside of its file, and its title with them."""

from collections.abc import Iterable

MARK = "# set outside the file: "
"""What a line of a recorded config begins with that names such a value."""

OF_NO_MATTER = ("seed", "title", "reference")
"""Keys after which a title says what it said."""


def heading(assignments: Iterable[str]) -> str:
    """Give the lines that head a config whose values were set, from assignments of one line."""
    return "".join(f"{MARK}{assignment}\n" for assignment in assignments)


def changes_of(config_toml: str) -> list[str]:
    """Give the values set outside of the file, as assignments.

    Parameters
    ----------
    config_toml : str
        A recorded config as TOML.

    Examples
    --------
    >>> changes_of(heading(['kind = "open"', "seed = 2"]) + 'kind = "open"')
    ['kind = "open"', 'seed = 2']
    """
    found = []
    for line in config_toml.splitlines():
        if not line.startswith(MARK):
            break
        found.append(line.removeprefix(MARK))
    return found


def title_with_changes(title: str, config_toml: str) -> str:
    """Give the title of a run, with the values that its config did not have when it was titled.

    Parameters
    ----------
    title : str
        The title in the config.
    config_toml : str
        The recorded config as TOML.

    Examples
    --------
    >>> title_with_changes("A poplar leaf", heading(['kind = "open"', "seed = 2"]))
    'A poplar leaf, with kind = "open"'
    >>> title_with_changes("Mine", heading(['kind = "open"', 'title = "Mine"']))
    'Mine'
    """
    changes = {change.partition(" = ")[0]: change for change in changes_of(config_toml)}
    if not title or "title" in changes:
        return title
    told = [change for key, change in changes.items() if key not in OF_NO_MATTER]
    return f"{title}, with {', '.join(told)}" if told else title
