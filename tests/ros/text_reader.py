"""The node of the lesson "Reading text", as a program of its own: what the lesson defines, and no more.

    python tests/ros/text_reader.py SECONDS     ends after so many seconds of the robot's stamps

It sees published topics alone: image and odometry. At its end it prints how often it looked.
"""

import ast
import sys

import rapidocr
from lesson_nodes import MASTERS, lesson_definitions, looked_for, spin

from imgproc_course.authoring.masters import read_master


def reading_text():
    one_thread = {f"EngineConfig.onnxruntime.{kind}_op_num_threads": 1 for kind in ("intra", "inter")}
    reader = rapidocr.RapidOCR(params={"Global.log_level": "error", **one_thread})
    return lesson_definitions("reading_text", reader=reader)


def lesson_with_data():
    """The lesson's functions and what its cells compute for them: signs, templates, network."""
    names, cells = reading_text(), read_master(next(MASTERS.glob("*_reading_text.py"))).cells
    needed = {"recording", "info", "camera", "right_m", "points", "signs", "LETTERS", "templates"}
    needed |= {"model", "options", "network", "listed", "all_characters", "network_errors"}
    for cell in cells:
        if cell.kind != "code" or cell.role not in ("", "given"):
            continue
        for node in ast.parse(cell.source).body:
            targets = node.targets if isinstance(node, ast.Assign) else []
            stored = {name.id for t in targets for name in ast.walk(t) if isinstance(name, ast.Name)}
            attribute = any(isinstance(target, ast.Attribute) for target in targets)
            if stored & needed and (not attribute or "options" in stored):
                exec(compile(ast.Module([node], []), cell.id, "exec"), names)
    return names


if __name__ == "__main__":
    lesson = reading_text()
    spin(
        lambda: lesson["TextNode"](lesson["read_text"]),
        looked_for(float(sys.argv[1])),
        lambda node: node.looks,
    )
