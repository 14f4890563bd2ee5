"""A notebook with every kind of output, executed as lessons are: nbval runs it again, and both agree."""

import os
import subprocess
import sys
import textwrap

import nbformat
from nbclient import NotebookClient

# nbval alone: other plugins, among them those of JupyterLab, take seconds to load.
NBVAL = ["-p", "nbclassroom.autograder.blocked_imports", "-p", "nbval.plugin", "--nbval"]
CELLS = [
    """
    import numpy as np
    from imgproc_course.display import draw, live_view, show, show_figure, tune

    class Drive:
        rate = 20.0
        def __len__(self):
            return 3
        def frame(self, k, encoding="bgr8"):
            return np.full((72, 128, 3), 60 * k, np.uint8)
    """,
    """
    gray = np.arange(72 * 128).reshape(72, 128).astype(np.uint8)
    images = {"gray": gray, "signed": gray.astype(np.int16) - 100, "bool": gray > 99}
    show(images, caption="A ramp, three times.")
    """,
    "show(gray[:5, :5], alt='numbers')",
    """
    figure, [axes] = draw(gray)
    axes.annotate("here", (30, 30), color="red")
    show_figure(figure, alt="a word on a ramp")
    """,
    """
    def bright(frame, level=100):
        return frame > level

    view = live_view(Drive(), bright, level=(0, 255))
    """,
    "view",
    "tuner = tune(bright, gray, level=(0, 255))",
    "tuner",
    "view.stop()",
]


def execute():
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(textwrap.dedent(c)) for c in CELLS])
    for number, cell in enumerate(notebook.cells):
        cell.id = f"cell-{number}"
    NotebookClient(notebook, kernel_name="python3", timeout=120).execute()
    return notebook


def test_nbval_runs_it_again_and_passes(tmp_path):
    notebook = execute()
    path = tmp_path / "stored.ipynb"
    nbformat.write(notebook, path)
    process = subprocess.run(
        [sys.executable, "-m", "pytest", *NBVAL, "-p", "no:cacheprovider", "-q", path],
        cwd=tmp_path,
        env={**os.environ, "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"},
        capture_output=True,
        text=True,
    )
    assert process.returncode == 0, process.stdout[-3000:]
    assert f"{len(CELLS)} passed" in process.stdout
    texts = {cell.id: output["data"]["text/plain"] for cell in notebook.cells for output in cell.outputs}
    assert texts == {
        "cell-1": "A ramp, three times.",
        "cell-2": "numbers",
        "cell-3": "a word on a ramp",
        "cell-4": "Live view: bright",
        "cell-5": "Live view: bright",
        "cell-6": "Sliders for bright: bright(frame, level=100)",
    }
