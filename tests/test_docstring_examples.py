"""The examples in the docstrings of messages and imaging: each public function has one, and it is right."""

import doctest
import inspect
import sys

import numpy as np
import pytest

from imgproc_course import imaging, messages

PUBLIC = [getattr(package, name) for package in (imaging, messages) for name in package.__all__]
FUNCTIONS = [value for value in PUBLIC if inspect.isfunction(value)]


@pytest.mark.parametrize("function", FUNCTIONS, ids=lambda function: function.__name__)
def test_the_example_shows_what_the_function_returns(function):
    names = vars(sys.modules[function.__module__]) | {"np": np}
    (example,) = doctest.DocTestFinder(recurse=False).find(function, function.__name__, globs=names)
    assert example.examples, "no Examples section"
    report = []
    failed = doctest.DocTestRunner().run(example, out=report.append).failed
    assert not failed, "".join(report)
