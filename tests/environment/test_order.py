"""The order of the tests and their distribution: long tests first, some folders on one worker."""

import importlib.util
from pathlib import Path
from types import SimpleNamespace

import pytest

TESTS = Path(__file__).parents[1]


@pytest.fixture(scope="module")
def conftest():
    spec = importlib.util.spec_from_file_location("conftest_of_all", TESTS / "conftest.py")
    module = importlib.util.module_from_spec(spec)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROS_DOMAIN_ID", "1")  # restores it: the module sets it
        spec.loader.exec_module(module)
    return module


def test_every_listed_folder_or_file_exists(conftest):
    for name in {*conftest.LONGEST_FIRST, *conftest.WHOLE_FOLDERS, *conftest.SINGLE_TESTS}:
        assert list((TESTS / name).rglob("test_*.py")) or (TESTS / f"{name}.py").is_file(), name


@pytest.mark.parametrize(
    ("test", "scope"),
    [
        ("tests/ros/test_camera.py::test_a[x::y]", "tests/ros/test_camera.py"),
        ("tests/test_cli.py::test_b", "tests/test_cli.py"),
        ("tests/browser/test_lessons.py::test_c[04_grayscale]", "browser"),
        ("tests/notebooks/test_lessons.py::test_d[01]", "tests/notebooks/test_lessons.py::test_d[01]"),
    ],
)
def test_the_scope_that_one_worker_runs(conftest, test, scope):
    assert conftest.scope_of(test) == scope


def test_long_tests_come_first_and_the_others_keep_their_order(conftest):
    names = ["tests/imaging/b.py::t", "tests/test_cli.py::t", "tests/ros/a.py::t", "tests/browser/a.py::t"]
    items = [SimpleNamespace(nodeid=name) for name in names]
    conftest.pytest_collection_modifyitems(SimpleNamespace(getoption=lambda name: False), items)
    assert [item.nodeid for item in items] == [names[3], names[2], names[0], names[1]]


def test_of_each_file_the_first_test_can_be_chosen(conftest):
    names = ["tests/ros/a.py::t[1]", "tests/ros/a.py::t[2]", "tests/ros/b.py::s", "tests/ros/b.py::t"]
    items, deselected = [SimpleNamespace(nodeid=name) for name in names], []
    hook = SimpleNamespace(pytest_deselected=lambda items: deselected.extend(items))
    config = SimpleNamespace(getoption=lambda name: name == "--first-of-each-file", hook=hook)
    chosen = list(items)
    conftest.pytest_collection_modifyitems(config, chosen)
    assert chosen == [items[0], items[2]] and deselected == [items[1], items[3]]
