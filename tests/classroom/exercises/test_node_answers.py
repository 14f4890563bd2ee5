"""An answer that is a node: a class that is driven, here by a double of the driver that calls methods."""

import sys
from types import SimpleNamespace

import numpy as np
import pytest

from imgproc_course.classroom.authoring.lesson_files import lesson_files
from imgproc_course.classroom.authoring.masters import read_master
from imgproc_course.classroom.autograder.make_answer_key import _check_source
from imgproc_course.classroom.exercises.check_files import read_check_file
from imgproc_course.classroom.exercises.checking import run_cases, run_check
from imgproc_course.classroom.exercises.declaration import MasterError, exercise, read_exercises
from imgproc_course.classroom.exercises.expected_results import check_data_of
from imgproc_course.classroom.exercises.running import argument_names, call

STUB = (
    "class Doubler:\n    def __init__(self):\n        raise NotImplementedError\n\n"
    "    def callback(self, pixels):\n        pass"
)
RIGHT = (
    'class Doubler:\n    def __init__(self):\n        self.name = "doubler"\n\n'
    "    def callback(self, pixels):\n        return pixels.astype(np.uint16) * 2"
)
WRONG = RIGHT.replace(".astype(np.uint16)", "")
HINT = 'hint="Widen."'
HINTS = 'hints=("a", "b", "c"), explanation="e", another_way="w"'
NODE_PARTS = {
    "exercise": (
        f'# %% role="exercise"\nexercise("test-double", function="Doubler", subject="node", {HINT})\nSIDE = 3'
    ),
    "answer": f'# %% role="answer"\n{STUB}',
    "solution": f'# %% role="solution"\n{RIGHT}',
    "check": '# %% role="check"\ncheck("test-double", Doubler)',
    "case": '# %% role="case" title="step 1"\ndef inputs(rng):\n    return ("setup", [])',
    "second": (
        '# %% role="case" title="step 2"\ndef inputs(rng):\n'
        '    return ("images", [rng.integers(128, 256, (2, 3), dtype=np.uint8)])'
    ),
    "hidden": (
        '# %% role="hidden" title="step 2"\ndef inputs(rng):\n'
        '    return ("images", list(rng.integers(128, 256, (2, 2, 3), dtype=np.uint8)))'
    ),
    "mistake": f'# %% role="mistake" name="wraps" says="It wraps."\n{WRONG}',
    "second mistake": "",
}


def drive(node_class, look, steps):
    """What the node is called, or what its callback returns for each step."""
    node = node_class()
    return {"node": node.name} if look == "setup" else {"results": [node.callback(step) for step in steps]}


@pytest.fixture(autouse=True)
def driver(monkeypatch):
    name = "imgproc_course.classroom.exercises.node_driver"
    monkeypatch.setitem(sys.modules, name, SimpleNamespace(drive=drive))


@pytest.fixture
def node_master(write_master):
    return lambda **changed: write_master(**(NODE_PARTS | changed))


def class_in(source):
    names = {"np": np}
    exec(source, names)
    return names["Doubler"]


def test_a_node_is_driven_and_its_record_compared(node_master):
    (declared,) = read_exercises(node_master())
    right, wrong = (run_cases(declared, class_in(source)) for source in (RIGHT, WRONG))
    assert [case.passed for case in right.results] == [True, True]
    assert [case.passed for case in wrong.results] == [True, False]
    assert wrong.mistake.says == "It wraps."
    assert check_data_of(declared).names == ("look", "steps")


def test_a_value_that_is_no_class_is_refused_with_its_type():
    result = call(class_in(RIGHT)(), ("setup", []), ["look", "steps"], 1, "node")
    assert (result.error, result.message) == (
        "TypeError",
        "expected the class of your node, got a value of type Doubler",
    )


def test_a_class_that_is_no_node_is_called():
    result = call(class_in(RIGHT), (), [], 1)
    assert result.value["type"] == "Doubler"


def test_the_arguments_of_a_node_have_names():
    assert argument_names(class_in(RIGHT), subject="node") == ["look", "steps"]
    assert argument_names(lambda image: image, (1, 2)) == ["image", "argument 2"]


def test_the_subject_is_in_the_files_that_a_lesson_carries(node_master, tmp_path):
    heading = NODE_PARTS["exercise"].replace(HINT, HINTS)
    files = lesson_files(read_master(node_master(exercise=heading)))
    path = tmp_path / "doubling.json"
    path.write_text(files["checks/doubling.json"])
    stored = read_check_file(path).exercise("test-double")
    assert (stored.subject, stored.names) == ("node", ("look", "steps"))
    assert run_check(stored, class_in(RIGHT)).passed and not run_check(stored, class_in(WRONG)).passed


def test_a_functions_subject_is_not_stored(write_master):
    heading = NODE_PARTS["exercise"].replace('"Doubler", subject="node"', '"double"')
    text = lesson_files(read_master(write_master(exercise=heading.replace(HINT, HINTS))))[
        "checks/doubling.json"
    ]
    assert '"function":"double"' in text and '"subject"' not in text


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        (
            {"exercise": NODE_PARTS["exercise"].replace('"node"', '"class"')},
            "exercise test-double: subject='class', expected 'function' or 'node'",
        ),
        (
            {"solution": '# %% role="solution"\ndef Doubler(): ...'},
            "the solution of test-double does not define class Doubler",
        ),
    ],
)
def test_a_wrong_subject_is_named(changed, message, node_master):
    with pytest.raises(MasterError) as error:
        check_data_of(*read_exercises(node_master(**changed)))
    assert message in str(error.value)


def test_a_nodes_stub_must_define_its_class(node_master):
    with pytest.raises(MasterError) as error:
        read_master(node_master(answer='# %% role="answer"\nDoubler = None'))
    assert 'has subject="node"; its answer cell must define class Doubler(Node)' in str(error.value)


def test_the_check_cell_of_a_key_names_the_subject(node_master, write_master):
    node, function = (_check_source(*read_exercises(write())) for write in (node_master, write_master))
    assert node.endswith('\n\nemit(Doubler, "node")') and function.endswith("\n\nemit(double)")


def test_the_subject_of_a_declaration_is_a_function_if_omitted():
    assert exercise("a-b", function="f")["subject"] == "function"
