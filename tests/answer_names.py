"""Run the source of an answer as a page is run: in a namespace, statement by statement."""

import ast
import sys
import types
from types import SimpleNamespace

from nbclassroom.exercises.cell_syntax import program_lines, top_level
from nbclassroom.exercises.page import page_of
from nbclassroom.exercises.page_run import Missing, PageRun


def names_of_answer(exercise, source):
    """(the namespace after an answer to an exercise has run, its first error as text or "")."""
    module = types.ModuleType(exercise.id)
    sys.modules[exercise.id] = module  # dataclasses and pickle look up the module of a class there
    names = vars(module)
    names |= exercise.namespace()
    page = page_of({exercise.id: source}, SimpleNamespace(exercises=[exercise]))
    for number, cell in enumerate(page["cells"]):  # here ROS may be real, which grading's double is not
        for place, statement in enumerate(top_level(cell["source"])):
            page["left_out"] += [[number, place]] * bool(program_lines(ast.unparse(statement)))
    run = PageRun(page, names)
    run.run_to(len(page["cells"]))
    for name in [name for name, value in names.items() if type(value) is Missing]:
        del names[name]
    return names, next((f"{name}: {text}" for _, name, text in run.errors), "")
