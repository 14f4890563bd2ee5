"""A plugin of pytest beside nbval: writes the outputs that nbval gets from the kernel into a JSON file.

nbval keeps its own copy with all text of a cell merged, and compares no images.
"""

import json
from pathlib import Path

import pytest
from nbformat.v4 import output_from_msg

OUTPUTS = pytest.StashKey[dict]()
TYPES = ("stream", "display_data", "execute_result", "error")


def pytest_addoption(parser):
    parser.addoption("--outputs", type=Path, help="the file: {path of a notebook: {cell id: outputs}}")


def pytest_configure(config):
    config.stash[OUTPUTS] = {}


@pytest.hookimpl(wrapper=True)
def pytest_runtest_call(item):
    messages, notebook = [], item.parent

    def receive(*arguments, **options):
        messages.append(type(notebook).get_kernel_message(notebook, *arguments, **options))
        return messages[-1]

    notebook.get_kernel_message = receive
    yield
    cell_id = messages[-1]["parent_header"]["msg_id"]  # the last one says that the cell has finished
    outputs = item.config.stash[OUTPUTS].setdefault(str(notebook.path), {})
    outputs[item.cell.id] = [
        output_from_msg(message)
        for message in messages
        if message["msg_type"] in TYPES and message["parent_header"].get("msg_id") == cell_id
    ]


def pytest_sessionfinish(session):
    session.config.option.outputs.write_text(json.dumps(session.config.stash[OUTPUTS]))
