"""What to cite for a run, and the file that says so."""

from pathlib import Path
from typing import Any

_PACKAGE = Path(__file__).resolve().parent.parent

LICENSE = "https://spdx.org/licenses/MIT"
"""The licence of vasc itself; that of a run is its author's choice."""

WORKS: dict[str, dict[str, Any]] = {
    "#runions-2008": {
        "@type": "Thesis",
        "name": "Modeling biological patterns using the space colonization algorithm",
        "author": {"@id": "#adam-runions"},
        "datePublished": "2008",
        "inSupportOf": "MSc, University of Calgary",
    },
    "#runions-2005": {
        "@type": "ScholarlyArticle",
        "name": "Modeling and visualization of leaf venation patterns",
        "author": {"@id": "#adam-runions"},
        "datePublished": "2005",
        "isPartOf": "ACM Transactions on Graphics 24 (3), pp. 702-711",
    },
}
"""The works whose model vasc is, as in ``CITATION.cff``, as entities of a crate."""

FIRST_AUTHOR = {"@type": "Person", "name": "Adam Runions"}
"""Their first author."""


def citation_file() -> Path:
    """Give ``CITATION.cff``, of the package or of a source checkout."""
    packaged = _PACKAGE / "CITATION.cff"
    return packaged if packaged.is_file() else _PACKAGE.parent / "CITATION.cff"
