"""Formulas as MathML, written by docutils: no JavaScript, no fonts, no network."""

from docutils import nodes
from docutils.utils.math import latex2mathml


def visit_math(translator, node):
    """A formula in a line of text."""
    translator.body.append(latex2mathml.tex2mathml(node.astext(), as_block=False))
    raise nodes.SkipNode


def visit_displaymath(translator, node):
    """A formula in a line of its own; a narrow window scrolls it."""
    formula = latex2mathml.tex2mathml(node.astext(), as_block=True)
    translator.body.append(f'<div class="math" tabindex="0">{formula}</div>\n')
    raise nodes.SkipNode


def setup(app):
    app.add_html_math_renderer(
        "mathml", inline_renderers=(visit_math, None), block_renderers=(visit_displaymath, None)
    )
    return {"parallel_read_safe": True, "parallel_write_safe": True}
