"""The node of the lesson "Reading text", as a program of its own: what the lesson defines, and no more.

    python tests/ros/text_reader.py SECONDS     ends after so many seconds of the robot's stamps

It sees published topics alone: image and odometry. At its end it prints how often it looked.
"""

import sys

import rapidocr
from lesson_nodes import lesson_definitions, looked_for, spin


def reading_text():
    one_thread = {f"EngineConfig.onnxruntime.{kind}_op_num_threads": 1 for kind in ("intra", "inter")}
    reader = rapidocr.RapidOCR(params={"Global.log_level": "error", **one_thread})
    return lesson_definitions("reading_text", reader=reader)


if __name__ == "__main__":
    lesson = reading_text()
    spin(
        lambda: lesson["TextNode"](lesson["read_text"]),
        looked_for(float(sys.argv[1])),
        lambda node: node.looks,
    )
