"""Configuration of the site: Markdown read by MyST, reference pages written by `_generate`.

The build and the finished site need no network. Docutils translates equations to MathML, which
browsers draw without a script. Warnings are errors.
"""

from importlib.metadata import version as version_of

from docutils import nodes
from docutils.utils.math.latex2mathml import tex2mathml
from sphinx.application import Sphinx
from sphinx.ext.napoleon import Config, GoogleDocstring
from sphinx.writers.html5 import HTML5Translator

project = "planetary_twin"
author = "the planetary_twin authors"
copyright = f"{author}, Apache-2.0"
version = release = version_of("planetary_twin_py")

extensions = ["myst_parser", "sphinx.ext.autodoc"]
exclude_patterns = ["_build", "_generate"]
nitpicky = False  # of types in signatures: links are checked in any case

myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4

autodoc_typehints = "description"
autodoc_typehints_description_target = "documented"
autodoc_default_options = {"members": True}
autodoc_member_order = "bysource"
autodoc_inherit_docstrings = False

html_theme = "furo"
html_math_renderer = "mathml"
html_title = "planetary_twin"
html_show_sphinx = False
html_copy_source = False


def read_sections(
    app: Sphinx, what: str, name: str, about: object, options: object, lines: list[str]
) -> None:
    """Turn the sections Args, Returns and Raises of a docstring into lists.

    The description of an attribute stays one line, because it may contain a colon. The text that
    Python gives to undescribed fields of a named tuple is dropped.
    """
    if what not in ("attribute", "property"):
        lines[:] = GoogleDocstring(lines, Config(), app, what, name, about, options).lines()
    elif lines and lines[0].startswith("Alias for field number"):
        lines.clear()


def inline_equation(writer: HTML5Translator, node: nodes.math) -> None:
    """Write an equation within a line as MathML."""
    writer.body.append(tex2mathml(node.astext()))
    raise nodes.SkipNode


def display_equation(writer: HTML5Translator, node: nodes.math_block) -> None:
    """Write an equation on a line of its own as MathML; it scrolls where the page is narrow."""
    equation = tex2mathml(node.astext(), as_block=True)
    writer.body.append(f'<div class="math" style="overflow-x: auto">{equation}</div>')
    raise nodes.SkipNode


def setup(app: Sphinx) -> None:
    """Connect the functions above to Sphinx."""
    app.connect("autodoc-process-docstring", read_sections)
    app.add_html_math_renderer("mathml", (inline_equation, None), (display_equation, None))
