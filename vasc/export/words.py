"""How texts are put together: lines, comments, numbers."""

from collections.abc import Iterable


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
