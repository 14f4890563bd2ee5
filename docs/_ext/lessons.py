"""The lessons as sources of the site. Nothing is executed: what is shown are the stored outputs.

    python lessons.py SOURCE      SOURCE is the copy of docs/ from which Sphinx builds

- A folded cell stays folded. Behind a prediction, the result and the text that states it are one <details>.
- A question from an earlier lesson shows its right answer in a <details>, in place of the cell that asks.
- An exercise shows its task, its stub and the call of its check.
- Images become files. A cell that is only live shows a still image.
"""

import base64
import hashlib
import json
import re
import shutil
import sys
from pathlib import Path

from teach import write_teach

ROOT = Path(__file__).resolve().parents[2]
NOTEBOOKS = ROOT / "notebooks"
LESSONS = sorted(NOTEBOOKS.glob("[0-9]*.ipynb"))
SUFFIXES = {"jpeg": "jpg", "png": "png", "svg+xml": "svg"}
EMBEDDED = re.compile(r'src="data:image/(jpeg|png|svg\+xml);base64,([A-Za-z0-9+/=\n]+)"')
MERMAID = re.compile(r"```mermaid\n(.*?)```", re.S)
IS_LIVE = "It moves when this cell is run."
# What stands for a cell that is only live: a file of _static/live, and what it shows.
DARK = ("darken", "The living room of the drive, darker than the camera sees it.")
EDGES = ("edges", "The drive, and beside it the white edges of the furniture on black.")
GRAY = ("gray", "The drive in gray.")
STEER = (
    "steer",
    "What the robot's camera sees, beside the map of the room with the robot's way.",
)
STILLS = {
    "start_here-18": DARK,
    "what_is_image_processing-56": EDGES,
    "images_as_messages-103": ("channels", "The drive with red and blue contours beside the things."),
    "grayscale_node-45": GRAY,
    "grayscale_node-61": GRAY,
    "edge_detection_node-19": EDGES,
    "edge_detection_node-44": EDGES,
    "ros2_packages-16": GRAY,
    "ros2_packages-52": GRAY,
    "ros2_packages-69": EDGES,
    "ros2_packages-79": GRAY,
    "drive_the_robot-10": STEER,
    "drive_the_robot-57": STEER,
}
# Pages that stand beside what they describe.
PAGES = {
    "environment/drive/README.md": "about/recording.md",
    "environment/room/README.md": "about/drivable_room.md",
    "environment/class/README.md": "teach/class.md",
    "environment/ros2_ws/README.md": "robot/workspace.md",
    "CONTRIBUTING.md": "about/contributing.md",
    "CHANGELOG.md": "about/changes.md",
}
OPEN = """
<details class="course-open"><summary>Open in JupyterLab</summary>

In the checkout, run this command, and open `{name}` there:

```sh
environment/lab
```

</details>
"""
ANSWER = '<details class="course-reveal"><summary>Your answer first. Then open the right one.</summary>'
REVEAL = '<details class="course-reveal"><summary>Your guess first. Then open the result.</summary>'


def slug(text):
    """The anchor that MyST gives to a heading."""
    return re.sub(r"[^\w-]", "", text.lower())


def guesses_in(source):
    """The names of the guesses that a cell asks for."""
    return set(re.findall(r"^(\w+)\s*=\s*None", source, re.M))


def markdown(source, **more):
    return {"cell_type": "markdown", "metadata": {}, "source": source, **more}


class Figures:
    """The folder to which the images of the lessons are written, each once."""

    def __init__(self, folder):
        self.folder = folder
        folder.mkdir(parents=True, exist_ok=True)

    def extract(self, html):
        """HTML whose images are files."""
        return EMBEDDED.sub(self._write, html)

    def _write(self, match):
        data = base64.b64decode(match[2])
        name = f"{hashlib.sha256(data).hexdigest()[:16]}.{SUFFIXES[match[1]]}"
        (self.folder / name).write_bytes(data)
        return f'loading="lazy" src="../_static/figures/{name}"'


def links_to_cells():
    """The ids of the cells to which a link of some lesson leads."""
    text = "".join(path.read_text("utf-8") for path in LESSONS)
    return set(re.findall(r"\.ipynb#cell-id=([\w-]+)\)", text))


def diagram_file(source):
    """The name of the drawing of a Mermaid diagram."""
    return f"{hashlib.sha256(source.encode()).hexdigest()[:16]}.webp"


def diagram(match):
    """The stored drawing of a Mermaid diagram, with its description."""
    title = re.search(r"accTitle: (.*)", match[1])[1]
    text = re.search(r"accDescr: (.*)", match[1])[1]
    name = diagram_file(match[1])
    if not (ROOT / "docs/_static/diagrams" / name).exists():
        raise ValueError(f"the diagram {title!r} has no drawing {name}: run docs/_ext/draw_diagrams.py")
    return f'<img class="course-diagram" alt="{title}. {text}" src="../_static/diagrams/{name}">'


def site_markdown(source):
    """A text cell with links and diagrams of the site."""
    source = re.sub(r"\]\(glossary\.md#([^)]+)\)", lambda m: f"](glossary.md#{slug(m[1])})", source)
    source = re.sub(r"\.ipynb#cell-id=", ".ipynb#", source)
    source = re.sub(r"\[([^]]+)\]\(cheat_sheet\.html\)", r'<a href="../cheat_sheet.html">\1</a>', source)
    source = source.replace("](index.ipynb)", "](/learn/index.md)")
    return MERMAID.sub(diagram, source)


def still(cell):
    """The output that stands for a live view, with what the view says of itself."""
    name, alt = STILLS[cell["id"]]
    said = re.search(
        r"Live view: (.*?) " + re.escape(IS_LIVE), json.dumps(cell["outputs"], ensure_ascii=False)
    )
    caption = (
        f"{said[1] if said else ''} A still image: in JupyterLab it moves when you run this cell.".strip()
    )
    html = (
        f'<figure><img alt="{alt}" loading="lazy" src="../_static/live/{name}.webp">'
        f"<figcaption>{caption}</figcaption></figure>"
    )
    return {"output_type": "display_data", "metadata": {}, "data": {"text/html": html}}


def site_outputs(cell, figures):
    """The outputs of a code cell as the site shows them."""
    outputs = [still(cell)] if cell["id"] in STILLS else []
    for output in cell["outputs"]:
        html = "".join(output.get("data", {}).get("text/html", ""))
        if IS_LIVE in html:
            if cell["id"] not in STILLS:
                raise ValueError(f"the live cell {cell['id']} has no still image: add it to STILLS")
            continue
        if html:
            html = html.replace("No guess yet. The result is", "The result is")
            html = html.replace('alt="continued"', 'alt=""')  # the text of the first image speaks for all
            html = html.replace("--jp-content-font-color2", "--course-soft")
            output["data"] = {"text/html": figures.extract(html)}
        outputs.append(output)
    return outputs


def site_code(cell, figures):
    """A code cell with the tags by which MyST-NB folds it and the style sheet marks it."""
    source, old = "".join(cell["source"]), cell["metadata"]
    kind = cell["id"].partition("-")[0]
    tags = [f"course-{kind}"] if kind in ("predict", "answer", "check") else []
    metadata = {}
    if old.get("jupyter", {}).get("source_hidden"):
        title = source.splitlines()[0].lstrip("# ")[:70]
        tags.append("hide-input")
        metadata["mystnb"] = {"code_prompt_show": title, "code_prompt_hide": title}
    outputs = [] if kind == "check" else site_outputs(cell, figures)
    return cell | {"metadata": metadata | {"tags": tags}, "outputs": outputs}


def right_answer(cell):
    """The right answer to the question of a cell, and the reason, in a <details>."""
    lesson, name = re.search(r'ask\("(\w+)/([\w-]+)"', cell["source"]).groups()
    question = json.loads((NOTEBOOKS / "texts" / f"{lesson}.json").read_text("utf-8"))[name]
    answer = str(question["answer"])
    return markdown(f"{ANSWER}\n\n**{answer}** · {question['replies'][answer]}\n\n</details>", id=cell["id"])


def asks(cell):
    """Whether a text cell asks for a prediction."""
    return cell["cell_type"] == "markdown" and "**Predict" in cell["source"]


def ends_reveal(cell):
    """Whether what is folded behind a prediction ends before this cell."""
    if cell["cell_type"] == "code":
        return cell["id"].startswith(("predict-", "answer-", "given-"))
    return bool(re.search(r"^#", cell["source"], re.M))


def split_at(cell, pattern):
    """A text cell in two: the paragraphs before the first one with the pattern, and the rest."""
    paragraphs = cell["source"].split("\n\n")
    first = next((k for k, text in enumerate(paragraphs) if re.search(pattern, text)), len(paragraphs))
    before, after = "\n\n".join(paragraphs[:first]), "\n\n".join(paragraphs[first:])
    return before, cell | {"source": after}


def fold_results(cells):
    """The cells, with the result behind each prediction and the text that states it in one <details>."""
    folded, waiting, is_open = [], set(), False
    for cell in cells:
        if is_open and (ends_reveal(cell) or asks(cell)):
            if cell["cell_type"] == "markdown":
                before, cell = split_at(cell, r"^#|\*\*Predict")
                folded += [markdown(before)] if before else []
            folded.append(markdown("</details>"))
            is_open = False
        folded.append(cell)
        if cell["cell_type"] == "code" and cell["id"].startswith("predict-"):
            waiting |= guesses_in(cell["source"])
            folded.append(markdown(REVEAL))
            is_open = True
        elif is_open:
            if cell["cell_type"] == "code":
                waiting -= set(re.findall(r"compare_guess\(\s*(\w+)", cell["source"]))
            elif not waiting:
                folded.append(markdown("</details>"))
                is_open = False
    return [*folded, markdown("</details>")] if is_open else folded


def site_lesson(path, figures, targets):
    """The notebook of a lesson as the site shows it."""
    notebook = json.loads(path.read_text("utf-8"))
    cells = []
    for cell in notebook["cells"]:
        cell["source"] = "".join(cell["source"])
        if cell["cell_type"] == "markdown":
            cell["source"] = site_markdown(cell["source"])
        else:
            is_question = cell["id"].startswith("ask-")
            cell = right_answer(cell) if is_question else site_code(cell, figures)
        if cell.get("id") in targets:
            cells.append(markdown(f"({cell['id']})=\n<span></span>"))
        cells.append(cell)
    cells = fold_results(cells)
    cells.insert(1, markdown(OPEN.format(name=path.name)))
    for number, cell in enumerate(cells):
        cell["id"] = f"cell-{number}"
    return notebook | {"cells": cells}


def write_lessons(folder, figures):
    """The notebooks of all lessons, and the page that has them in its order."""
    folder.mkdir()
    targets = links_to_cells()
    for path in LESSONS:
        notebook = site_lesson(path, figures, targets)
        (folder / path.name).write_text(json.dumps(notebook), "utf-8")
    order = "\n".join(path.stem for path in LESSONS)
    page = f"# Lessons\n\n```{{include}} table.md\n```\n\n```{{toctree}}\n:hidden:\n\n{order}\n```\n"
    (folder / "index.md").write_text(page, "utf-8")


def write_glossary(path):
    text = (NOTEBOOKS / "glossary.md").read_text("utf-8")
    text = re.sub(r"^### ", "## ", text, flags=re.M)
    path.write_text(site_markdown(text), "utf-8")


def write_table(path):
    """The table of the lessons, from README, with links."""
    rows = "\n".join(re.findall(r"^\|.*\|$", (ROOT / "README.md").read_text("utf-8"), re.M))
    for lesson in LESSONS:
        number = lesson.stem[:2]
        rows = re.sub(
            rf"^\| {number} \| ([^|]+) \|", rf"| {number} | [\1](/lessons/{lesson.name}) |", rows, flags=re.M
        )
    path.write_text(rows + "\n", "utf-8")


def write_routes(path):
    """The routes with their hours, from the index of the lessons."""
    index = json.loads((NOTEBOOKS / "index.ipynb").read_text("utf-8"))
    text = "\n\n".join("".join(cell["source"]) for cell in index["cells"])
    routes = "\n".join(re.findall(r"^- \*\*.*\(about \d+ hours\).*$", text, re.M))
    path.write_text(re.sub(r"\]\((\w+\.ipynb)\)", r"](/lessons/\1)", routes), "utf-8")


def main(source):
    write_teach(source / "teach")
    write_lessons(source / "lessons", Figures(source / "_static" / "figures"))
    write_table(source / "lessons" / "table.md")
    write_routes(source / "lessons" / "routes.md")
    write_glossary(source / "lessons" / "glossary.md")
    for original, page in PAGES.items():
        shutil.copy(ROOT / original, source / page)
    (source / "extra").mkdir()
    shutil.copy(NOTEBOOKS / "cheat_sheet.html", source / "extra")
    shutil.copy(ROOT / "environment" / "lesson.jpg", source / "_static")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
