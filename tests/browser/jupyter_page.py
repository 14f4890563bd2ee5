"""Our own JupyterLab on loopback, and a notebook open in Chromium, used as a learner uses it."""

import json
import os
import re
import shutil
import socket
import subprocess
import sys
import time
import urllib.error
import urllib.request
from contextlib import contextmanager
from pathlib import Path

import nbformat
from playwright.sync_api import TimeoutError as PlaywrightTimeoutError
from playwright.sync_api import sync_playwright

sys.path.append(str(Path(__file__).parents[1]))
from accessibility import violations

ROOT = Path(__file__).parents[2]
SCREENSHOTS = ROOT / "screenshots"
TOKEN = "loopback"
CHROMIUM_OPTIONS = [
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]
# Counts the images that the browser has decoded (not the messages that it received), and their changes.
COUNT_IMAGES = """async ([selector, seconds, number]) => {
    const image = document.querySelectorAll(selector)[number];
    const canvas = new OffscreenCanvas(32, 18);
    const context = canvas.getContext("2d", {willReadFrequently: true});
    let loads = 0, changes = 0, lastPixels = "";
    const countImage = () => {
        loads += 1;
        context.drawImage(image, 0, 0, 32, 18);
        const pixels = context.getImageData(0, 0, 32, 18).data.join();
        changes += pixels !== lastPixels;
        lastPixels = pixels;
    };
    image.addEventListener("load", countImage);
    const start = performance.now();
    await new Promise(resolve => setTimeout(resolve, 1000 * seconds));
    image.removeEventListener("load", countImage);
    const elapsed = (performance.now() - start) / 1000;
    return {loads: loads / elapsed, changes: changes / elapsed};
}"""
# Collects in window.latencies the milliseconds from a key press to the next decoded image.
WATCH_LATENCY = """selector => {
    window.latencies = [];
    let pressTime = null;
    const notePress = () => { if (pressTime === null) pressTime = performance.now(); };
    document.addEventListener("keydown", notePress, true);
    document.querySelector(selector).addEventListener("load", () => {
        if (pressTime !== null) window.latencies.push(performance.now() - pressTime);
        pressTime = null;
    });
}"""
# Whether a JupyterLab that is loading is ready for OPEN_NOTEBOOK.
READY = """() => {
    const app = window.jupyterapp;
    return app?.commands.hasCommand("docmanager:open") && app.docRegistry.getWidgetFactory("Notebook");
}"""
# Opens a notebook in a running JupyterLab, and closes what was open.
OPEN_NOTEBOOK = """async name => {
    const app = window.jupyterapp;
    await app.restored;
    for (const widget of [...app.shell.widgets("main")]) widget.dispose();
    const widget = await app.commands.execute("docmanager:open", {path: name});
    await widget.context.ready;
    await widget.sessionContext.ready;
}"""
# Sets window.hasRun when the next command that runs cells has run them all, or has stopped at an error.
WATCH_RUN = """() => {
    window.hasRun = false;
    const {commandExecuted} = window.jupyterapp.commands;
    const watch = (_, {id, result}) => {
        if (!/^(notebook|runmenu):run/.test(id)) return;
        commandExecuted.disconnect(watch);
        result.finally(() => { window.hasRun = true; });
    };
    commandExecuted.connect(watch);
}"""
# The code cells as JupyterLab holds them, drawn or not: execution count, and texts of errors and stderr.
CODE_CELLS = """path => {
    const widgets = [...window.jupyterapp.shell.widgets("main")];
    const {content} = widgets.find(widget => widget.context?.path === path);
    return content.widgets.map(cell => cell.model).filter(model => model.type === "code").map(model => ({
        count: model.executionCount,
        errors: model.outputs.toJSON().filter(output => output.traceback || output.name === "stderr")
            .map(output => (output.traceback ?? [output.text]).flat().join("\\n")),
    }));
}"""
# Shows stored outputs as if the cells had been run here: JupyterLab shows HTML of others without its styles.
TRUST = """path => {
    const widgets = [...window.jupyterapp.shell.widgets("main")];
    const {content} = widgets.find(widget => widget.context?.path === path);
    for (const cell of content.widgets) cell.model.trusted = true;
}"""
# Selects code cells by their numbers, for the command that runs the selected cells; drops what they show.
SELECT = """([path, numbers]) => {
    const widgets = [...window.jupyterapp.shell.widgets("main")];
    const {content} = widgets.find(widget => widget.context?.path === path);
    const cells = content.widgets.filter(cell => cell.model.type === "code");
    content.deselectAll();
    content.activeCellIndex = content.widgets.indexOf(cells[numbers[0]]);
    for (const number of numbers) {
        cells[number].model.clearExecution();
        content.select(cells[number]);
    }
}"""
CLOSE_ALL = (
    """() => { for (const widget of [...window.jupyterapp.shell.widgets("main")]) widget.dispose(); }"""
)
VIEW = "img.widget-image"
ANSI_CODE = re.compile(r"\x1b\[[\d;]*m")
TRACEBACK = re.compile(r"Traceback \(most recent call last\)|Cell In\[\d+\], line \d+")


def write_notebook(path, cells):
    """Writes a notebook of code cells without outputs."""
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell) for cell in cells])
    notebook.metadata["kernelspec"] = {"name": "python3", "display_name": "Python 3", "language": "python"}
    nbformat.write(notebook, path)
    return path


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def _command(folder, port):
    return [
        ROOT / "environment/lab",
        "--no-browser",
        f"--port={port}",
        f"--ServerApp.root_dir={folder}",
        f"--IdentityProvider.token={TOKEN}",
        "--expose-app-in-browser",  # for OPEN_NOTEBOOK
    ]


@contextmanager
def running_lab(folder, scratch):
    """JupyterLab as `environment/lab` starts it, serving `folder`; yields its address.

    Parameters
    ----------
    folder : Path of the notebooks
    scratch : Path for settings, workspaces and history, to keep the user's own unchanged
    """
    port = free_port()
    settings = scratch / "jupyterlab_settings_dir/@jupyterlab/apputils-extension"
    settings.mkdir(parents=True)
    (settings / "notification.jupyterlab-settings").write_text('{"fetchNews": "false"}')
    variables = ("JUPYTER_CONFIG_DIR", "JUPYTERLAB_SETTINGS_DIR", "JUPYTERLAB_WORKSPACES_DIR", "IPYTHONDIR")
    environment = os.environ | {name: str(scratch / name.lower()) for name in variables}
    # The kernel must not inherit the matplotlib backend of the tests.
    environment.pop("MPLBACKEND", None)
    log = (scratch / "lab.log").open("w+")
    server = subprocess.Popen(
        _command(folder, port),
        stdout=log,
        stderr=subprocess.STDOUT,
        env=environment,
        cwd=ROOT,
        start_new_session=True,
    )
    try:
        address = f"http://127.0.0.1:{port}"
        _wait_for(address, server, log.name)
        yield address
    finally:
        server.terminate()
        try:
            server.wait(60)
        except subprocess.TimeoutExpired:
            server.kill()
            server.wait()
        log.close()


def _wait_for(address, server, log):
    for _ in range(600):
        if server.poll() is not None:
            raise RuntimeError(f"JupyterLab ended at once:\n{Path(log).read_text()[-3000:]}")
        try:
            with urllib.request.urlopen(f"{address}/api/status?token={TOKEN}", timeout=5):
                return
        except (urllib.error.URLError, ConnectionError, TimeoutError):
            time.sleep(0.1)
    raise RuntimeError(f"JupyterLab did not reply within a minute:\n{Path(log).read_text()[-3000:]}")


@contextmanager
def running_chromium():
    """Debian's Chromium, headless."""
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=CHROMIUM_OPTIONS)
        try:
            yield browser
        finally:
            browser.close()


def open_tab(browser, address):
    """A tab with JupyterLab, for one notebook after another: JupyterLab takes seconds to load."""
    page = browser.new_page(viewport={"width": 1400, "height": 1000})
    page.goto(f"{address}/lab/workspaces/tests?reset&token={TOKEN}")
    page.wait_for_function(READY)
    return page


class NotebookPage:
    """One notebook in its own tab, or in a `tab` from `open_tab`."""

    def __init__(self, browser, address, name, *, height=1000, tab=None):
        self.page = tab or browser.new_page()
        self.page.set_viewport_size({"width": 1400, "height": height})
        self.page.set_default_timeout(60_000)
        self._address, self._name, self._is_shared = address, name, tab is not None
        self._closed = False
        if tab:
            tab.evaluate(OPEN_NOTEBOOK, name)
        else:
            workspace = re.sub(r"\W", "-", name)
            self.page.goto(f"{address}/lab/workspaces/{workspace}/tree/{name}?reset&token={TOKEN}")
        self.page.wait_for_selector(".jp-Notebook .jp-Cell")
        self.page.locator(".jp-StatusBar-Left", has_text="| Idle").wait_for()

    def close(self):
        """Closes the tab, or the notebook in it, and shuts down its kernel."""
        if self._closed:
            return
        self._closed = True
        if self._is_shared:
            self.page.evaluate(CLOSE_ALL)
        else:
            self.page.close()
        for session in json.load(self._request("GET", "sessions")):
            if session["path"] == self._name:
                self._request("DELETE", f"sessions/{session['id']}").close()

    def _request(self, method, resource):
        url = f"{self._address}/api/{resource}?token={TOKEN}"
        return urllib.request.urlopen(urllib.request.Request(url, method=method), timeout=60)

    def run_all(self, timeout=240):
        """Runs all cells from the menu, and waits until they have run."""
        self.page.evaluate(WATCH_RUN)
        self.page.get_by_role("menuitem", name="Run", exact=True).click()
        self.page.get_by_role("menuitem", name="Run All Cells", exact=True).click()
        self._wait_until_run(timeout)

    def run_cells(self, numbers, timeout=240):
        """Runs the code cells of these numbers, as if they were selected, and waits until they have run."""
        self.page.evaluate(SELECT, [self._name, numbers])
        self.page.evaluate(WATCH_RUN)
        self.page.evaluate("() => { window.jupyterapp.commands.execute('notebook:run-cell'); }")
        self._wait_until_run(timeout)

    def trust(self):
        """Shows the stored outputs as if the cells had been run here."""
        self.page.evaluate(TRUST, self._name)

    def run_cell(self, number, timeout=60):
        """Runs one code cell with Ctrl-Enter."""
        self.page.locator(".jp-CodeCell .cm-content").nth(number).click()
        self.page.evaluate(WATCH_RUN)
        self.page.keyboard.press("Control+Enter")
        self._wait_until_run(timeout)

    def _wait_until_run(self, timeout):
        try:
            self.page.wait_for_function("window.hasRun", timeout=1000 * timeout)
        except PlaywrightTimeoutError:
            self.screenshot("not_finished")
            raise TimeoutError(f"cells still running after {timeout} s: {self.prompts()}") from None

    def _code_cells(self):
        return self.page.evaluate(CODE_CELLS, self._name)

    def prompts(self):
        """The prompts of the code cells; a folded cell has none."""
        prompts = self.page.locator(".jp-CodeCell .jp-InputPrompt:not(.jp-Placeholder-prompt)")
        return prompts.all_text_contents()

    def wait_until(self, condition, timeout=60):
        """Waits until a function returns true."""
        deadline = time.monotonic() + timeout
        while not condition():
            if time.monotonic() > deadline:
                self.screenshot("not_reached")
                raise TimeoutError(f"not reached within {timeout} s; see screenshots/not_reached.png")
            self.page.wait_for_timeout(50)

    def wait_for_image(self, selector=VIEW):
        """Waits until the page shows the first live image."""
        self.page.wait_for_function(
            "selector => document.querySelector(selector)?.naturalWidth > 0", arg=selector
        )

    def set_theme(self, name):
        """Switches JupyterLab to its "Light" or "Dark" theme."""
        theme = f"JupyterLab {name}"
        self.page.evaluate(
            "theme => window.jupyterapp.commands.execute('apputils:change-theme', {theme})", theme
        )
        self.page.wait_for_function("theme => document.body.dataset.jpThemeName === theme", arg=theme)

    def violations(self, *, only_colors=False):
        """What axe-core finds in texts and outputs; JupyterLab's own elements are not the course's."""
        return violations(self.page, ".jp-RenderedMarkdown, .jp-OutputArea-output", only_colors=only_colors)

    def outputs(self, number):
        """Text of each output of one code cell."""
        return (
            self.page.locator(".jp-CodeCell").nth(number).locator(".jp-RenderedText pre").all_text_contents()
        )

    def distance_from_top(self, selector):
        """CSS pixels from the first cell down to an element; scrolling does not change it."""
        first_cell, element = (self.page.locator(css).first.bounding_box() for css in (".jp-Cell", selector))
        return element["y"] - first_cell["y"]

    def errors(self):
        """Text of every traceback in the notebook, of cells and in widgets."""
        mimes = ("application/vnd.jupyter.stderr", "application/vnd.jupyter.error")
        in_widgets = ", ".join(f'.jupyter-widgets [data-mime-type="{mime}"]' for mime in mimes)
        texts = [ANSI_CODE.sub("", text) for cell in self._code_cells() for text in cell["errors"]]
        texts += self.page.locator(in_widgets).all_text_contents()
        return [text for text in texts if TRACEBACK.search(text)]

    def not_run(self):
        """Numbers of the code cells that have not finished."""
        return [k for k, cell in enumerate(self._code_cells()) if cell["count"] is None]

    def images_per_second(self, seconds=3.0, selector=VIEW, number=0):
        """Images that the browser decodes per second: {"loads": all, "changes": different from the last}."""
        return self.page.evaluate(COUNT_IMAGES, [selector, seconds, number])

    def press_on_slider(self, key, number=0):
        """Presses a key on the handle of a slider, as a learner without a mouse does."""
        self.page.locator(".noUi-handle").nth(number).focus()
        self.page.keyboard.press(key)

    def press_button(self, name):
        # By its text: a font icon adds a character to a button's accessible name.
        self.page.locator("button.jupyter-button", has_text=name).click()

    def readout(self, number=0):
        return self.page.locator(".widget-readout").nth(number).inner_text()

    def slider_latencies(self, presses=30, number=0, selector=VIEW):
        """Milliseconds from key to image, for each key press; the slider moves right and left in turn.

        Each step must change the image: an unchanged image is not sent.
        """
        self.page.evaluate(WATCH_LATENCY, selector)
        for k in range(presses):
            self.press_on_slider("ArrowLeft" if k % 2 else "ArrowRight", number)
            self.page.wait_for_function("count => window.latencies.length > count", arg=k)
        return self.page.evaluate("window.latencies")

    def screenshot(self, name, selector=None):
        """Saves an image of the tab, with the first element that `selector` selects in the middle."""
        if selector:
            self.page.locator(selector).first.evaluate("node => node.scrollIntoView({block: 'center'})")
        SCREENSHOTS.mkdir(exist_ok=True)
        path = SCREENSHOTS / f"{name}.png"
        self.page.screenshot(path=path)
        return path
