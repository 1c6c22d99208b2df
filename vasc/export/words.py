"""How texts are put together: lines, comments, numbers."""

from collections.abc import Iterable


def plain(text: str) -> str:
    r"""Give a text on one line, without what no file of text may hold.

    Examples
    --------
    >>> plain("a\nleaf\x01")
    'a leaf'
    """
    return " ".join("".join(each if each.isprintable() else " " for each in text).split())


def as_bytes(lines: Iterable[str]) -> bytes:
    """Give lines as the bytes of a text file in UTF-8."""
    return ("\n".join(lines) + "\n").encode()


def comment(lines: Iterable[str], mark: str = "#") -> list[str]:
    """Give lines as comments of a text file."""
    return [f"{mark} {line}" for line in lines]


def xml_comment(lines: Iterable[str]) -> str:
    """Give lines as one comment of an XML file, in which two hyphens must not meet.

    Examples
    --------
    >>> xml_comment(["a --leaf--"])
    '<!-- a - -leaf- - -->'
    """
    text = "\n     ".join(lines)
    while "--" in text:
        text = text.replace("--", "- -")
    return f"<!-- {text} -->"
