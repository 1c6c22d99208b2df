"""The documentation as a site: ``python -m sphinx -q -W --keep-going docs docs/_build``."""

import os
import re
import sys
from pathlib import Path

from sphinx.application import Sphinx

import vasc

DOCS = Path(__file__).parent
sys.path.insert(0, str(DOCS / "_extensions"))

project = "vasc"
author = "The vasc developers"
copyright = f"2026, {author}"
release = version = vasc.__version__

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.napoleon",
    "sphinx_gallery.gen_gallery",
    "mathml",
    "parameter_tables",
]
exclude_patterns = ["_build", "_extensions", "_templates", "examples"]
templates_path = ["_templates"]

html_theme = "pydata_sphinx_theme"
html_title = f"vasc {release}"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_show_sourcelink = False
html_theme_options = {
    "logo": {"text": "vasc"},
    "navbar_align": "left",
    "header_links_before_dropdown": 7,
    "show_prev_next": False,
    "secondary_sidebar_items": ["page-toc"],
}
html_sidebars = {"changelog": [], "contributing": [], "citation": []}
html_math_renderer = "mathml"

myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4
myst_links_external_new_tab = False

autosummary_generate = True
toc_object_entries_show_parents = "hide"
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_default_options = {"members": True, "exclude-members": "model_config"}
napoleon_google_docstring = False
napoleon_use_rtype = False

# Diagrams take a second each; leaves and stems up to minutes, and run only when asked for.
QUICK = r"fig_(3_[2345]|4_1[0123]|5_[2369]|6_2)\.py"
ALL = r"fig_.*\.py"
sphinx_gallery_conf = {
    "examples_dirs": ["../paper_figures/runions_2008", "../paper_figures/canalization"],
    "gallery_dirs": ["gallery/runions_2008", "gallery/canalization"],
    "filename_pattern": ALL if os.environ.get("VASC_GALLERY") == "all" else QUICK,
    "ignore_pattern": r"^(?!(.*[\\/])?fig_\w+\.py$)",
    "within_subsection_order": "figure_gallery.by_number",
    "reset_argv": "figure_gallery.output_option",
    "image_scrapers": ("figure_gallery.saved_figure",),
    "copyfile_regex": "",
    "default_thumb_file": str(DOCS / "images" / "not-drawn.png"),
    "download_all_examples": False,
    "min_reported_time": 10_000,
    "show_memory": False,
    "show_signature": False,
    "write_computation_times": False,
    "notebook_extensions": set(),
    "backreferences_dir": None,
}

# Pages that stand outside of this folder, and where they are on the site.
MOVED = {
    "../README.md": "index.md",
    "../CHANGELOG.md": "changelog.md",
    "../CONTRIBUTING.md": "contributing.md",
    "../CITATION.cff": "citation.md",
    "../paper_figures/README.md": "gallery.md",
}


def lead_to_the_site(app: Sphinx, page: str, source: list[str]) -> None:
    """Let links that leave this folder in the repository stay on the site."""
    up = "../" * page.count("/")
    for there, here in MOVED.items():
        source[0] = source[0].replace(f"]({up}{there})", f"]({up}{here})")
    figures = rf"\]\({re.escape(up)}\.\./paper_figures/(\w+/fig_\w+)\.py\)"
    source[0] = re.sub(figures, rf"]({up}gallery/\1.rst)", source[0])


def setup(app: Sphinx) -> None:
    """Tell Sphinx what this site does of its own."""
    app.connect("source-read", lead_to_the_site)
