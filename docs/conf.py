"""Sphinx's settings of the course's site; environment/site builds it."""

import json
import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE / "_ext"))

project = "Image processing in ROS 2"
author = "The imgproc-course contributors"
language = "en"
smartquotes = False  # what stands between quotes is typed by learners

extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx.ext.githubpages", "docstrings", "mathml"]
exclude_patterns = ["_static", "extra", "README.md", "lessons/table.md", "lessons/routes.md"]
templates_path = ["_templates"]

nb_execution_mode = "off"
nb_ipywidgets_js = {}  # otherwise every page asks a server for the widgets' JavaScript
nb_merge_streams = True
myst_enable_extensions = ["dollarmath", "colon_fence", "deflist"]
myst_heading_anchors = 3
html_math_renderer = "mathml"

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_preserve_defaults = True
python_use_unqualified_type_names = True
add_module_names = False

html_theme = "furo"
html_title = project
html_static_path = ["_static"]
html_extra_path = ["extra", "404.html"]
html_favicon = "_static/favicon.svg"
html_js_files = ["printing.js"]
html_context = json.loads((HERE / "checkout.json").read_text("utf-8"))  # written by _ext/lessons.py
html_css_files = ["course.css"]
html_search_scorer = str(HERE / "_static/ranking.js")
html_copy_source = False
html_show_sourcelink = False
html_show_copyright = False
html_show_sphinx = False
pygments_style = "a11y-high-contrast-light"
pygments_dark_style = "a11y-high-contrast-dark"


def accessible(app, exception):
    """Mends what MyST-NB and Furo leave unnamed or out of reach of the keyboard."""
    if exception or app.builder.name != "html":
        return
    for page in Path(app.outdir).rglob("*.html"):
        text = page.read_text("utf-8")
        text = text.replace(' aria-label="Toggle hidden content"', "")  # a summary has its text as name
        text = re.sub(r"<pre(?=[ >])(?![^>]*tabindex)", '<pre tabindex="0"', text)
        text = re.sub(r'<div class="table-wrapper', '<div tabindex="0" class="table-wrapper', text)
        text = text.replace(
            '<aside class="sidebar-drawer">', '<aside class="sidebar-drawer" aria-label="Site">'
        )
        text = text.replace('<aside class="toc-drawer', '<aside aria-label="This page" class="toc-drawer')
        text = text.replace('<div id="search-results">', '<h1>Search</h1>\n<div id="search-results">')
        page.write_text(text, "utf-8")


def setup(app):
    app.connect("build-finished", accessible)
