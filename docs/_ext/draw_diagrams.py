"""Draws the Mermaid diagrams of the lessons with JupyterLab, into docs/_static/diagrams.

    .venv/bin/python docs/_ext/draw_diagrams.py      needs environment/setup test, and Debian's chromium

Run it when the build says that a diagram has no drawing. Drawings that nothing uses are deleted.
"""

import io
import sys
import tempfile
from pathlib import Path

import nbformat
from lessons import LESSONS, MERMAID, ROOT, diagram_file
from PIL import Image

sys.path.insert(0, str(ROOT / "tests/browser"))
from jupyter_page import NotebookPage, running_chromium, running_lab

DIAGRAMS = ROOT / "docs/_static/diagrams"
KERNEL = {"name": "python3", "display_name": "Python 3", "language": "python"}


def diagrams():
    """The Mermaid sources of all lessons."""
    for path in LESSONS:
        for cell in nbformat.read(path, 4).cells:
            if cell.cell_type == "markdown":
                yield from MERMAID.findall(cell.source)


def main():
    sources = list(diagrams())
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch) / "lessons"
        folder.mkdir()
        cells = [nbformat.v4.new_markdown_cell(f"```mermaid\n{source}```") for source in sources]
        notebook = nbformat.v4.new_notebook(cells=cells, metadata={"kernelspec": KERNEL})
        nbformat.write(notebook, folder / "diagrams.ipynb")
        with running_lab(folder, Path(scratch)) as address, running_chromium() as browser:
            sharp = browser.new_context(device_scale_factor=2)
            page = NotebookPage(sharp, address, "diagrams.ipynb", height=2000)
            images = page.page.locator("img.jp-RenderedMermaid-image, .jp-RenderedMermaid img")
            page.wait_until(lambda: images.count() == len(sources))
            drawn = [images.nth(k).screenshot() for k in range(len(sources))]
            page.close()
    for old in DIAGRAMS.glob("*.webp"):
        old.unlink()
    for source, png in zip(sources, drawn, strict=True):
        Image.open(io.BytesIO(png)).save(DIAGRAMS / diagram_file(source), lossless=True)


if __name__ == "__main__":
    main()
