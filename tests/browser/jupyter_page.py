"""A JupyterLab of our own on loopback, and a notebook open in Chromium, used as a learner uses it."""

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
from playwright.sync_api import sync_playwright

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
# Counts pictures that the browser has decoded, not messages that reached it; and of these, those that differ.
COUNT_PICTURES = """async ([selector, seconds, number]) => {
    const image = document.querySelectorAll(selector)[number];
    const canvas = new OffscreenCanvas(32, 18);
    const context = canvas.getContext("2d", {willReadFrequently: true});
    let loads = 0, changes = 0, before = "";
    const look = () => {
        loads += 1;
        context.drawImage(image, 0, 0, 32, 18);
        const now = context.getImageData(0, 0, 32, 18).data.join();
        changes += now !== before;
        before = now;
    };
    image.addEventListener("load", look);
    const start = performance.now();
    await new Promise(done => setTimeout(done, 1000 * seconds));
    image.removeEventListener("load", look);
    const taken = (performance.now() - start) / 1000;
    return {loads: loads / taken, changes: changes / taken};
}"""
# Milliseconds from a key or pointer event to the next decoded picture, gathered in window.latencies.
WATCH_LATENCY = """selector => {
    window.latencies = [];
    let moved = null;
    const note = () => { if (moved === null) moved = performance.now(); };
    document.addEventListener("keydown", note, true);
    document.querySelector(selector).addEventListener("load", () => {
        if (moved !== null) window.latencies.push(performance.now() - moved);
        moved = null;
    });
}"""
# Whether a JupyterLab that loads can do what OPEN_NOTEBOOK asks for.
READY = """() => {
    const app = window.jupyterapp;
    return app?.commands.hasCommand("docmanager:open") && app.docRegistry.getWidgetFactory("Notebook");
}"""
# Opens a notebook in a JupyterLab that runs already, in place of what was open.
OPEN_NOTEBOOK = """async name => {
    const app = window.jupyterapp;
    await app.restored;
    for (const widget of [...app.shell.widgets("main")]) widget.dispose();
    const widget = await app.commands.execute("docmanager:open", {path: name});
    await widget.context.ready;
    await widget.sessionContext.ready;
}"""
CLOSE_ALL = (
    """() => { for (const widget of [...window.jupyterapp.shell.widgets("main")]) widget.dispose(); }"""
)
VIEW = "img.widget-image"
TRACEBACK = re.compile(r"Traceback \(most recent call last\)|Cell In\[\d+\], line \d+")


def write_notebook(path, cells):
    """A notebook of code cells; their outputs are still to come."""
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell) for cell in cells])
    notebook.metadata["kernelspec"] = {"name": "python3", "display_name": "Python 3", "language": "python"}
    nbformat.write(notebook, path)
    return path


def _free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def _command(folder, port):
    options = [
        "--no-browser",
        f"--port={port}",
        f"--ServerApp.root_dir={folder}",
        f"--IdentityProvider.token={TOKEN}",
        "--expose-app-in-browser",  # for OPEN_NOTEBOOK
    ]
    if list((ROOT / "notebooks").glob("*.ipynb")):
        return [ROOT / "environment/lab", *options]
    # Before the lessons are built environment/lab has none to open; this is what it comes to.
    run = "import sys; from imgproc_course.lab import run; run(sys.argv[1], sys.argv[2:])"
    return [sys.executable, "-c", run, folder, *options]


@contextmanager
def running_lab(folder, scratch):
    """JupyterLab as `environment/lab` starts it, serving `folder`; yields its address.

    Parameters
    ----------
    folder : Path, whose notebooks are opened
    scratch : Path, for the settings, workspaces and history that would otherwise be the user's
    """
    port = _free_port()
    settings = scratch / "jupyterlab_settings_dir/@jupyterlab/apputils-extension"
    settings.mkdir(parents=True)
    (settings / "notification.jupyterlab-settings").write_text('{"fetchNews": "false"}')
    places = ("JUPYTER_CONFIG_DIR", "JUPYTERLAB_SETTINGS_DIR", "JUPYTERLAB_WORKSPACES_DIR", "IPYTHONDIR")
    environment = os.environ | {name: str(scratch / name.lower()) for name in places}
    # The kernel must not take the tests' drawing backend for the learner's.
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
            server.wait(20)
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
    raise RuntimeError(f"JupyterLab did not answer within a minute:\n{Path(log).read_text()[-3000:]}")


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
    """A tab with JupyterLab in it, for one notebook after another: to load JupyterLab takes seconds."""
    page = browser.new_page(viewport={"width": 1400, "height": 1000})
    page.goto(f"{address}/lab/workspaces/tests?reset&token={TOKEN}")
    page.wait_for_function(READY)
    return page


class NotebookPage:
    """One notebook in one tab: in a tab of its own, or in a `tab` from `open_tab`."""

    def __init__(self, browser, address, name, *, height=1000, tab=None):
        self.page = tab or browser.new_page()
        self.page.set_viewport_size({"width": 1400, "height": height})
        self.page.set_default_timeout(60_000)
        self._address, self._name, self._shares = address, name, tab is not None
        self._closed = False
        if tab:
            tab.evaluate(OPEN_NOTEBOOK, name)
        else:
            workspace = re.sub(r"\W", "-", name)
            self.page.goto(f"{address}/lab/workspaces/{workspace}/tree/{name}?reset&token={TOKEN}")
        self.page.wait_for_selector(".jp-Notebook .jp-Cell")
        self.page.locator(".jp-StatusBar-Left", has_text="| Idle").wait_for()

    def close(self):
        """Closes the tab, or the notebook in it, and ends the kernel that would go on without it."""
        if self._closed:
            return
        self._closed = True
        if self._shares:
            self.page.evaluate(CLOSE_ALL)
        else:
            self.page.close()
        for session in json.load(self._ask("GET", "sessions")):
            if session["path"] == self._name:
                self._ask("DELETE", f"sessions/{session['id']}").close()

    def _ask(self, method, what):
        url = f"{self._address}/api/{what}?token={TOKEN}"
        return urllib.request.urlopen(urllib.request.Request(url, method=method), timeout=30)

    def run_all(self, timeout=240):
        """Runs every cell from the menu, and waits until none is waiting to run."""
        self.page.get_by_role("menuitem", name="Run", exact=True).click()
        self.page.get_by_role("menuitem", name="Run All Cells", exact=True).click()
        self.wait_until_run(timeout)

    def run_cell(self, number, timeout=60):
        """Runs one code cell, again perhaps, with Ctrl-Enter."""
        self.page.locator(".jp-CodeCell .cm-content").nth(number).click()
        self.page.keyboard.press("Control+Enter")
        self.wait_until_run(timeout)

    def wait_until_run(self, timeout):
        """Until no cell has an asterisk: every one has its number, save those after an error."""
        deadline = time.monotonic() + timeout
        self.page.wait_for_timeout(300)
        while "[*]:" in self.prompts() or not any(re.search(r"\d", prompt) for prompt in self.prompts()):
            if time.monotonic() > deadline:
                self.screenshot("not_finished")
                raise TimeoutError(f"cells still running after {timeout} s: {self.prompts()}")
            self.page.wait_for_timeout(100)

    def prompts(self):
        return self.page.locator(".jp-CodeCell .jp-InputPrompt").all_text_contents()

    def wait_until(self, condition, timeout=30):
        """Waits for a condition that is looked up from here, on the page or on the disk."""
        deadline = time.monotonic() + timeout
        while not condition():
            if time.monotonic() > deadline:
                self.screenshot("not_reached")
                raise TimeoutError(f"not reached within {timeout} s; see screenshots/not_reached.png")
            self.page.wait_for_timeout(50)

    def wait_for_picture(self, selector=VIEW):
        """Until the first live picture stands on the page."""
        self.page.wait_for_function(
            "selector => document.querySelector(selector)?.naturalWidth > 0", arg=selector
        )

    def outputs(self, number):
        """Text of each output of one code cell."""
        return (
            self.page.locator(".jp-CodeCell").nth(number).locator(".jp-RenderedText pre").all_text_contents()
        )

    def place_of(self, selector):
        """Rows of the page from the first cell down to an element, however the page is scrolled."""
        tops = [self.page.locator(one).first.bounding_box()["y"] for one in (".jp-Cell", selector)]
        return tops[1] - tops[0]

    def errors(self):
        """Text of every traceback in the notebook, also where the page is not scrolled to."""
        mimes = ("application/vnd.jupyter.stderr", "application/vnd.jupyter.error")
        places = ", ".join(f'.jp-OutputArea-output[data-mime-type="{mime}"]' for mime in mimes)
        return [text for text in self.page.locator(places).all_text_contents() if TRACEBACK.search(text)]

    def not_run(self):
        """Numbers of the code cells that did not run to their end."""
        return [k for k, prompt in enumerate(self.prompts()) if not re.search(r"\d", prompt)]

    def pictures_per_second(self, seconds=3.0, selector=VIEW, number=0):
        """What the browser decodes of a picture, a second: {"loads": all, "changes": other than before}."""
        return self.page.evaluate(COUNT_PICTURES, [selector, seconds, number])

    def press_on_slider(self, key, number=0):
        """Gives a key to the handle of a slider, as who uses no mouse does."""
        self.page.locator(".noUi-handle").nth(number).focus()
        self.page.keyboard.press(key)

    def press_button(self, name):
        # By its words: an icon of a font puts a sign of its own into a button's name.
        self.page.locator("button.jupyter-button", has_text=name).click()

    def readout(self, number=0):
        return self.page.locator(".widget-readout").nth(number).inner_text()

    def slider_latencies(self, presses=30, number=0, selector=VIEW):
        """Milliseconds from key to picture, one for each press on a slider, to and fro.

        Each step must change the picture: one that does not is never sent.
        """
        self.page.evaluate(WATCH_LATENCY, selector)
        for k in range(presses):
            self.press_on_slider("ArrowLeft" if k % 2 else "ArrowRight", number)
            self.page.wait_for_function("count => window.latencies.length > count", arg=k)
        return self.page.evaluate("window.latencies")

    def screenshot(self, name, of=None):
        """Keeps what the tab shows, with the first element that `of` selects in its middle."""
        if of:
            self.page.locator(of).first.evaluate("one => one.scrollIntoView({block: 'center'})")
        SCREENSHOTS.mkdir(exist_ok=True)
        path = SCREENSHOTS / f"{name}.png"
        self.page.screenshot(path=path)
        return path
