"""The lessons as sources of the site. Nothing is executed: what is shown are the stored outputs.

    python lessons.py SOURCE      SOURCE is the copy of docs/ from which Sphinx builds

- A folded cell stays folded. Behind a prediction, the result and the first paragraph of the text behind it
  are one <details>; AGAIN and TEACHING are the exceptions.
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

from checkout import facts, with_address
from PIL import Image
from teach import fill_in, read_masters, write_teach

ROOT = Path(__file__).resolve().parents[2]
NOTEBOOKS = ROOT / "notebooks"
LESSONS = sorted(NOTEBOOKS.glob("[0-9]*.ipynb"))
SUFFIXES = {"jpeg": "jpg", "png": "png", "svg+xml": "svg"}
EMBEDDED = re.compile(r'src="data:image/(jpeg|png|svg\+xml);base64,([A-Za-z0-9+/=\n]+)"')
MERMAID = re.compile(r"```mermaid\n(.*?)```", re.S)
# A bar of tqdm, which nothing moves on a page; what a check says of a stub
LEFT_OUT = re.compile(r"\d%\|.*\d/\d+ \[|: not attempted yet")
IS_LIVE = "It moves when this cell is run."
# What stands for a cell that is only live: a file of _static/live, and what it shows.
DARK = ("darken", "The living room of the drive, darker than the camera sees it.")
EDGES = ("edges", "The drive, and beside it the white edges of the furniture on black.")
GRAY = ("gray", "The drive in gray.")
GRAY_BESIDE = ("gray_beside", "The drive, and beside it the same in gray.")
BRIGHT = ("bright", "The drive, and beside it white where it is bright.")
STEER = (
    "steer",
    "What the robot's camera sees, beside the map of the room with the robot's way.",
)
SIGN = (
    "../films/reads",
    "A white sign with the words KITCHEN and ROOM 204 on the wall, beside a bookshelf and a marker.",
)
BRAKES = ("../films/brakes", "Cardboard boxes and a toy car on a wooden floor, which come nearer and stay.")
STILLS = {
    "start_here-19": DARK,
    "what_is_image_processing-60": EDGES,
    "grayscale_node-29": GRAY_BESIDE,
    "grayscale_node-39": GRAY_BESIDE,
    "edge_detection_node-10": BRIGHT,
    "edge_detection_node-20": EDGES,
    "ros2_packages-39": GRAY,
    "ros2_packages-47": EDGES,
    "ros2_packages-56": GRAY,
    "drive_the_robot-10": STEER,
    "drive_the_robot-54": STEER,
    "obstacles_ahead-76": BRAKES,
    "the_errand-90": SIGN,
}
# Pages that stand beside what they describe.
PAGES = {
    "environment/drive/README.md": "about/recording.md",
    "environment/room/README.md": "about/drivable_room.md",
    "environment/class/README.md": "teach/class.md",
    "environment/ros2_ws/README.md": "robot/workspace.md",
    "CONTRIBUTING.md": "about/contributing.md",
    "CHANGELOG.md": "about/changes.md",
    ".github/SUPPORT.md": "about/support.md",
    ".github/CODE_OF_CONDUCT.md": "about/conduct.md",
    ".github/SECURITY.md": "about/security.md",
}
# Pages that name lessons as [[arrays]], and the folder of the lessons from there.
WITH_LINKS = {"index.md": "lessons", "learn/start.md": "../lessons", "robot/index.md": "../lessons"}
OPEN = """
<div class="course-open">

You are reading the lesson. To run it, type this command in the checkout, and open `{name}`
([set-up](/learn/start.md)):

```sh
environment/lab
```

</div>
"""
ANSWER = '<details class="course-reveal"><summary>Your answer first. Then open the right one.</summary>'
BACK = (
    "<style>@media print { .back { display: none; } }</style>"
    '<p class="back"><a href="learn/index.html">All lessons</a></p>'
)
REVEAL = (
    '<details class="course-reveal">'
    "<summary>Your guess first. Then show the result and what it means.</summary>"
)
# Cells that show a predicted result once more, by their first words: they are folded too.
AGAIN = (
    "painted = frame.copy()",
    "little = np.frombuffer(depth_message",
    "figure = Figure(figsize=(8, 3.6)",
    "grad_row, grad_col = sobel(step)",
    "mirrored = after_centered",
    "rows = flat.reshape(padded",
)
# Texts behind a result that do not state it, by their first words: they are not folded.
TEACHING = (
    "A mask in square brackets selects",
    "The mean of a mask is the share of its True",
    "**All pixels at once.**",
    "The field `is_bigendian` gives the order",
    "Python computes `+` before",
    "One number for the strength of the noise",
    "(`minlength=256` gives one count",
    "This is a **[correlation]",
    "`canny_stages` runs all stages",
    "Now a whole scan, in a small grid.",
    "The result is a [label image]",
    "Nine *bins* of 20 degrees",
    "Where is the palm?",
    "A contour is closed",
    "`Robot` is the course's class",
    "And where it sees nothing?",
)


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
    drawing = ROOT / "docs/_static/diagrams" / name
    if not drawing.exists():
        raise ValueError(f"the diagram {title!r} has no drawing {name}: run docs/_ext/draw_diagrams.py")
    width = Image.open(drawing).width // 2  # it is drawn for screens with two pixels per pixel
    return (
        f'<img class="course-diagram" alt="{title}. {text}" width="{width}" src="../_static/diagrams/{name}">'
    )


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
        data = output.get("data", {})
        html = "".join(data.get("text/html", ""))
        if LEFT_OUT.search("".join(data.get("text/plain", ""))):
            continue
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


def stated(text):
    """(the paragraphs of a text that state the result before it, the other ones)."""
    paragraphs = text.split("\n\n")
    if re.search(r"^#|\*\*Predict", paragraphs[0], re.M) or text.lstrip().startswith(TEACHING):
        return "", text
    count = 2 if paragraphs[0].endswith(":") else 1  # with the list or the formula that it announces
    return "\n\n".join(paragraphs[:count]), "\n\n".join(paragraphs[count:])


class Folds:
    """The cells of a lesson: behind a prediction, the result and the text that states it in one <details>."""

    def __init__(self, cells):
        self.cells, self._waiting, self._anchors = [], set(), []
        self._asked = self._is_open = False
        for cell in cells:
            if self._is_open and re.match(r"\([\w-]+\)=", cell["source"]):
                self._anchors.append(cell)  # no link leads into what is closed
            elif cell["cell_type"] == "code":
                self._add_code(cell)
            elif self._is_open:
                self._add_text(cell)
            else:
                self.cells.append(cell)
        self._close()

    def _close(self):
        if self._is_open:
            self.cells += [markdown("</details>"), *self._anchors]
        self._anchors, self._is_open = [], False

    def _add_code(self, cell):
        if cell["id"].startswith(("predict-", "answer-", "given-")):
            self._close()
        elif not self._is_open and (self._asked or cell["source"].startswith(AGAIN)):
            if self.cells[-1]["source"] == "</details>":
                self.cells.pop()
            else:
                self.cells.append(markdown(REVEAL))
            self._asked, self._is_open = False, True
        self.cells.append(cell)
        if cell["id"].startswith("predict-"):
            self._waiting, self._asked = guesses_in(cell["source"]), True
        self._waiting -= set(re.findall(r"compare_guess\(\s*(\w+)", cell["source"]))

    def _add_text(self, cell):
        text = cell["source"]
        ends = asks(cell) or re.search(r"^#", text, re.M)
        before, after = stated(text) if ends or not self._waiting else (text, "")
        self.cells += [markdown(before)] if before else []
        if ends or not self._waiting:
            self._close()
        self.cells += [cell | {"source": after}] if after else []


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
    cells = Folds(cells).cells
    title, rest = cells[0]["source"].split("\n\n", 1)
    cells[:1] = [markdown(title), markdown(OPEN.format(name=path.name)), markdown(rest)]
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
    words = re.findall(r"^### (.+)$", text, re.M)
    first = {word[0].upper(): slug(word.replace(" ", "-")) for word in reversed(words) if word[0].isalpha()}
    letters = " · ".join(f"[{letter}](#{first[letter]})" for letter in sorted(first))
    text = re.sub(r"^### ", "## ", text, flags=re.M)
    text = text.replace("**Ctrl + F** finds", f"{letters}\n\n**Ctrl + F** finds", 1)
    path.write_text(site_markdown(text), "utf-8")


def write_cheat_sheet(path):
    """The cheat sheet with links: each block to its lesson, and one back to the site."""
    text = (NOTEBOOKS / "cheat_sheet.html").read_text("utf-8")
    for lesson in LESSONS:
        number = lesson.stem[:2]
        text = text.replace(
            f"lesson {number}</p>", f'<a href="lessons/{lesson.stem}.html">lesson {number}</a></p>'
        )
    path.write_text(text.replace("</h1>", "</h1>\n" + BACK, 1), "utf-8")


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
    masters = read_masters()
    write_teach(source / "teach", masters)
    about = facts()
    (source / "checkout.json").write_text(json.dumps(about), "utf-8")
    for name, folder in WITH_LINKS.items():
        text = with_address((source / name).read_text("utf-8"), about["course_address"])
        (source / name).write_text(fill_in(text, masters, folder), "utf-8")
    write_lessons(source / "lessons", Figures(source / "_static" / "figures"))
    write_table(source / "lessons" / "table.md")
    write_routes(source / "lessons" / "routes.md")
    write_glossary(source / "lessons" / "glossary.md")
    for original, page in PAGES.items():
        shutil.copy(ROOT / original, source / page)
    (source / "extra").mkdir()
    write_cheat_sheet(source / "extra" / "cheat_sheet.html")
    shutil.copy(ROOT / "environment" / "lesson.webp", source / "_static")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
