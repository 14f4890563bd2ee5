"""tests/weight.py, by which the lint step measures the package."""

import pytest
import weight

MODULE = '''"""A module
of two lines."""

import os  # a comment beside code counts as code


class Box:
    """One line."""

    size = 3

    def volume(self, unit="m"):
        """A docstring."""
        # why
        if self.size > 0 and unit:

            return [n for n in range(self.size) if n]
        return None


async def outer(flag):
    def inner():
        return 1 if flag else 2

    try:
        match flag:
            case 1 | 2:
                return inner()
    except ValueError:
        assert flag
    for _ in ():
        while flag or not inner:
            pass
'''


@pytest.fixture
def checkout(tmp_path):
    for name in ("cli.py", "messages/image.py", "classroom/__init__.py", "classroom/exercises/check.py"):
        path = tmp_path / "imgproc_course" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(MODULE if path.name == "image.py" else "NAME = 1\n\n", encoding="utf-8")
    return tmp_path


def test_counts(checkout):
    raw, code, lengths, complexities = weight.weigh(checkout)
    assert raw == {"messages": 33, "(modules)": 2, "classroom": 2, "classroom/exercises": 2}
    assert code == {"messages": 19, "(modules)": 1, "classroom": 1, "classroom/exercises": 1}
    assert lengths == [1, 5, 12]
    assert complexities == {
        "messages/image.py:12 volume": 5,
        "messages/image.py:21 outer": 7,
        "messages/image.py:22 inner": 2,
    }


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("raw lines", 39, None),
        ("raw lines", 38, "above the budget: raw lines 39, at most 38"),
        ("code lines", 21, "above the budget: code lines 22, at most 21"),
        ("worst complexity", 6, "above the budget: worst complexity 7, at most 6"),
    ],
)
def test_budget(checkout, monkeypatch, capsys, name, value, message):
    monkeypatch.setitem(weight.BUDGET, name, value)
    assert weight.main(checkout) == message
    assert (
        "complexity 7, at most 6: imgproc_course/messages/image.py:21 outer" in capsys.readouterr().out
    ) == (name == "worst complexity")
