"""The public names of the packages that a robot's own code and lessons import carry types."""

import importlib
import inspect

import pytest

PACKAGES = ["messages", "imaging", "geometry", "recording", "simulation", "ros", "display"]
OURS = ("imgproc_course.", "nbclassroom.")
PACKAGES = [*(f"imgproc_course.{name}" for name in PACKAGES), "nbclassroom.exercises"]


def functions_of(name, value):
    """(name, function) of a public function, or of each public method of a public class."""
    if inspect.isfunction(value):
        yield name, value
    elif inspect.isclass(value):
        for attribute, member in vars(value).items():
            member = inspect.unwrap(getattr(member, "fget", None) or getattr(member, "__func__", member))
            written_here = inspect.isfunction(member) and member.__module__.startswith(OURS)
            if written_here and (attribute == "__init__" or not attribute.startswith("_")):
                yield f"{name}.{attribute}", member


def without_types(name, function):
    """What of a function has no annotation: its parameters (without self) and what it returns."""
    signature = inspect.signature(function)
    empty = inspect.Signature.empty
    for parameter in signature.parameters.values():
        if parameter.annotation is empty and parameter.name not in {"self", "cls"}:
            yield f"{name}: {parameter.name}"
    if signature.return_annotation is empty and not name.endswith(".__init__"):
        yield f"{name}: returned value"


@pytest.mark.parametrize("package", PACKAGES)
def test_public_names_have_types(package):
    module = importlib.import_module(package)
    values = [(name, getattr(module, name)) for name in module.__all__]
    functions = [pair for name, value in values for pair in functions_of(name, value)]
    missing = [line for pair in functions for line in without_types(*pair)]
    assert not missing, "\n".join(["without a type:", *missing])
