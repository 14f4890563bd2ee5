"""An answer that is a node: what `check` does with a class as it does with a function."""

import numpy as np
import pytest
from nbclassroom.authoring.lesson_files import lesson_files
from nbclassroom.authoring.masters import read_master
from nbclassroom.exercises import progress
from nbclassroom.exercises.checking import check, run_cases, run_check
from nbclassroom.exercises.declaration import MasterError, read_exercises
from nbclassroom.exercises.help_steps import solution
from nbclassroom.exercises.kinds import kind_of
from nbclassroom.exercises.lesson import check_data_of
from nbclassroom.exercises.progress import digest_of
from nbclassroom.exercises.running import (
    call,
    codes_of,
    globals_of,
    source_of,
)
from readable_cell import run_cell
from template_master import write_carried_files

IMPORTS = """from array import array
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import Image
"""
STUB = f"""{IMPORTS}
class Doubler(Node):
    def __init__(self):
        raise NotImplementedError
        self.twice = 2

    def callback(self, msg):
        pass
"""
INIT = """    def __init__(self):
        super().__init__("doubler")
        self.publisher = self.create_publisher(Image, "~/double", 5)
        self.create_subscription(Image, "/camera", self.callback, qos_profile_sensor_data)
"""
CALLBACK = """    def callback(self, msg):
        wide = np.array(msg.data, np.uint16) * 2
        msg.data = array("B", np.minimum(wide, 255).astype(np.uint8).tobytes())
        self.publisher.publish(msg)
"""
RIGHT = f"{IMPORTS}\nclass Doubler(Node):\n{INIT}\n{CALLBACK}"
WRONG = RIGHT.replace("np.minimum(wide, 255)", "wide")
HINT = 'hint="Widen."'
HINTS = 'hints=("a", "b", "c"), explanation="e", another_way="w"'
NODE_PARTS = {
    "exercise": (
        f'# %% role="exercise"\nexercise("test-double", function="Doubler", subject="node", {HINT})\n'
        "SIDE = 3\n\ndef sent(rng):\n"
        "    image = rng.integers(0, 256, (2, 3), dtype=np.uint8)\n"
        '    place = {"topic": "/camera", "stamp": (1, 2), "frame_id": "camera"}\n'
        '    return {"image": image, "encoding": "mono8"} | place'
    ),
    "answer": f'# %% role="answer"\n{STUB}',
    "solution": f'# %% role="solution"\n{RIGHT}',
    "check": '# %% role="check"\ncheck("test-double", Doubler)',
    "case": '# %% role="case" title="step 1"\ndef inputs(rng):\n    return ("setup", [])',
    "second": '# %% role="case" title="step 2"\ndef inputs(rng):\n    return ("images", [sent(rng)])',
    "hidden": '# %% role="hidden" title="step 2"\ndef inputs(rng):\n    return ("images", [sent(rng)] * 2)',
    "mistake": f'# %% role="mistake" name="wraps" says="It wraps."\n{WRONG}',
    "second mistake": "",
}


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
    assert check_data_of(declared).names == ("part", "steps")


class Size:
    def __init__(self, rows, columns):
        self.rows, self.columns = rows, columns


def test_a_value_that_is_no_class_is_refused_with_its_type():
    result = call(Size(3, 4), ("setup", []), ["part", "steps"], 1, kind_of("node").run)
    assert (result.error, result.message) == (
        "TypeError",
        "expected the class of your node, got a value of type Size",
    )


def test_a_class_is_called_if_the_subject_is_a_function():
    assert call(Size, (3, 4), ["rows", "columns"], 1).value["type"] == f"{__name__}.Size"


def test_an_argument_without_a_name_is_numbered():
    result = call(lambda *lists: [values.append(3) for values in lists], ([1], [2]), ["image"], 1)
    assert result.changed == ("image", "argument 2")


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
            "exercise test-double: subject='class', expected 'drive' or 'function' or 'node' or 'package'",
        ),
        (
            {"solution": '# %% role="solution"\ndef Doubler(): ...'},
            "the solution of test-double does not define the class Doubler",
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


def answer_in(source, file="<cell>", **names):
    """The class of a source that can be read, as that of a notebook's cell."""
    return run_cell(source, {"np": np, "__name__": "__main__"} | names, file)["Doubler"]


@pytest.fixture
def checked(node_master):
    """Checks a source as `check` does in a notebook, with other cells above its cell."""
    data = check_data_of(*read_exercises(node_master()))

    def checked_source(source, *cells, **names):
        names = {"np": np, "__name__": "__main__"} | names
        for cell in cells:
            exec(cell, names)
        return run_check(data, answer_in(source, **names))

    return checked_source


def test_the_unchanged_stub_is_not_attempted(checked):
    for source in (STUB, STUB.replace("(Node):", "(Node):\n    '''Mine.'''\n")):
        result = checked(source)
        assert not result.attempted and result.points == 0
    assert repr(checked(STUB)).splitlines()[:2] == [
        "test-double: not attempted yet.",
        "Write Doubler in its cell, run that cell, then run this one. (If that cell shows an error, repair it"
        " first: Python still has the old class.)",
    ]


def test_a_stub_that_raises_nothing_is_known_by_its_code(node_master):
    silent = STUB.replace("raise NotImplementedError", 'super().__init__("n")')
    data = check_data_of(*read_exercises(node_master(answer=f'# %% role="answer"\n{silent}')))
    assert not run_check(data, answer_in(silent)).attempted
    assert run_check(data, answer_in(silent.replace('"n"', '"other"'))).attempted


def test_a_stub_line_that_was_left_in_an_answer_is_named(checked):
    result = checked(f"{RIGHT.replace(INIT, '')}\n{INIT}        raise NotImplementedError")
    assert not result.attempted
    assert result.remarks == (
        "The line with raise NotImplementedError is still there, and ends the function: delete it.",
    )
    assert checked(STUB).remarks == ()


def test_modules_that_methods_use_are_refused(checked):
    in_method = RIGHT.replace("        wide", "        import scipy\n\n        wide")
    for source in (in_method, f"import scipy\n{RIGHT.replace('* 2', '* scipy.e')}"):
        result = checked(source)
        assert list(result.refused) == ["scipy"] and not result.passed
        assert "Doubler uses scipy. Write this exercise without it: grading refuses it." in repr(result)


BASE = f"""class Base(Node):
{CALLBACK.replace("* 2", "* sum([FACTOR for _ in (1, 1)])")}"""
WITH_BASE = f"{IMPORTS}\nclass Doubler(Base):\n{INIT}"


def test_names_of_other_cells_count(checked):
    result = checked(WITH_BASE, "FACTOR = 1", f"{IMPORTS}\n{BASE}")
    assert result.passed and result.remarks == ()


def test_an_error_has_the_line_of_the_method(checked):
    result = checked(RIGHT.replace("* 2", "* self.factor"))
    error = result.results[1].failed_call.result
    assert (error.error, error.line) == (
        "AttributeError",
        "line 13: wide = np.array(msg.data, np.uint16) * self.factor",
    )
    assert "    Doubler raised AttributeError: 'Doubler' object has no attribute 'factor'" in repr(result)


def test_each_changed_method_is_a_new_try():
    attribute = RIGHT.replace("(Node):", "(Node):\n    k = 3")
    sources = (RIGHT, WRONG, RIGHT.replace('"doubler"', '"d"'), attribute)
    digests = [digest_of(answer_in(source, f"<cell {k}>")) for k, source in enumerate(sources)]
    assert len(set(digests)) == 4
    assert digest_of(answer_in(RIGHT.replace("* 2", "*  2  # twice"), "<cell 5>")) == digests[0]
    assert digest_of(class_in(RIGHT)) != digest_of(class_in(WRONG))  # their cell is not known


def test_methods_of_own_bases_belong_to_an_answer():
    foreign = type("Foreign", (), {"spin": lambda self: 3, "__module__": "rclpy.node"})
    names = {"__name__": "__main__", "Foreign": foreign}
    source = (
        "class Base:\n    def callback(self): ...\n\nclass Doubler(Base, Foreign):\n    @property\n"
        "    def name(self):\n        return 'd'\n    @staticmethod\n    def twice(p):\n        return 2 * p"
    )
    exec(source, names)
    assert sorted(codes_of(names["Doubler"])) == ["callback", "name", "twice"]
    assert globals_of(names["Doubler"]) is names
    assert codes_of(int) == {} and globals_of(int) == {}


def test_the_source_of_a_class_is_found_by_its_methods():
    own = f"class Doubler(Node):\n{INIT}"
    source = f"{IMPORTS}\n@str\nclass Base:\n    def callback(self): ...\n\n@same\n{own}\ny = 2\n"
    assert source_of(answer_in(source, same=lambda kind: kind)) == f"@same\n{own}"
    assert source_of(answer_in("class Doubler:\n    pass")) == ""


def test_an_object_is_no_answer(node_master, monkeypatch, tmp_path):
    master = read_master(node_master(exercise=NODE_PARTS["exercise"].replace(HINT, HINTS)))
    write_carried_files(master, tmp_path)
    monkeypatch.setenv("NBCLASSROOM_CHECKS", str(tmp_path / "checks"))
    monkeypatch.setattr(progress, "_of_this_process", {})  # other tests pass test-double, too
    with pytest.raises(TypeError) as error:
        check("test-double", Size(3, 4))
    assert str(error.value) == (
        "check('test-double', ...) needs your class Doubler itself, got a value of type Size; run the cell"
        " with your class first (if it shows an error, repair that), and write check('test-double', Doubler),"
        " no parentheses after the name"
    )
    closed = 'A try is check("test-double", Doubler) with a changed class that runs and does not pass yet.'
    assert closed in repr(solution("test-double"))
    assert check("test-double", answer_in(RIGHT)).passed
    assert solution("test-double").blocks[1].code == RIGHT.strip()


def test_remarks_on_the_source_of_methods(checked):
    result = checked(RIGHT.replace("        wide", "        return\n        wide"))
    assert [remark.partition(". ")[0] for remark in result.remarks] == [
        "The last lines of callback() are never run",
    ]
