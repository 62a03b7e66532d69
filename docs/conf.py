"""The site: Markdown by MyST, pages of the reference as `_generate` makes them from the code,
warnings are errors.

MathJax sets equations in the reader's browser, which loads it from the network; nothing else does,
and the build does not.
"""

from importlib.metadata import version as version_of

from sphinx.application import Sphinx
from sphinx.ext.napoleon import Config, GoogleDocstring

project = "planetary_twin"
author = "the planetary_twin authors"
copyright = f"{author}, Apache-2.0"
version = release = version_of("planetary_twin_py")

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.mathjax"]
exclude_patterns = ["_build", "_generate"]
nitpicky = False  # of types in signatures: links are checked in any case

myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4

autodoc_typehints = "description"
autodoc_typehints_description_target = "documented"
autodoc_member_order = "bysource"
autodoc_inherit_docstrings = False

html_theme = "furo"
html_title = "planetary_twin"
html_show_sphinx = False
html_copy_source = False


def read_sections(
    app: Sphinx, what: str, name: str, about: object, options: object, lines: list[str]
) -> None:
    """Turn Args and Raises into lists, but leave a line on an attribute: it may hold a colon."""
    if what not in ("attribute", "property"):
        lines[:] = GoogleDocstring(lines, Config(), app, what, name, about, options).lines()


def setup(app: Sphinx) -> None:
    """Have docstrings read."""
    app.connect("autodoc-process-docstring", read_sections)
