"""Masters read as percent scripts."""

import pytest
from nbclassroom.exercises.percent_script import MasterError, read_script


@pytest.fixture
def write_script(tmp_path):
    """Writes a percent script, and returns its path."""

    def write(text):
        path = tmp_path / "70_script.py"
        path.write_text(text, encoding="utf-8")
        return path

    return write


def test_headers_take_json_values(write_script):
    header = '# %% role="case" title="a \\"b\\" = c" points=3 tags=["x", "y"] tolerance=0.5'
    script = read_script(write_script(f"{header}\nx = 1\n\n# %%\ny = 2\n"))
    case, plain = script.cells
    assert case.options == {"title": 'a "b" = c', "points": 3, "tags": ["x", "y"], "tolerance": 0.5}
    assert (case.kind, case.role, case.source, case.line) == ("code", "case", "x = 1", 1)
    assert (plain.role, plain.source, plain.line) == ("", "y = 2", 0)


def test_front_matter_and_lines(write_script):
    text = "# ---\n# jupyter:\n#   imgproc_course:\n#     title: Doubling\n# ---\n\nimport os\n"
    text += '\n# %% role="given"\nTEXT = """\n# %% role="case"\n"""\n\n# %% [markdown]\n# Words.\n'
    text += '\n# %% role="check"\nx = 1\n'
    script = read_script(write_script(text))
    assert script.front_matter == {"title": "Doubling"}
    assert [cell.kind for cell in script.cells] == ["code", "code", "markdown", "code"]
    _, given, _, check = script.cells
    assert (given.line, check.line) == (9, 17)
    assert given.source == 'TEXT = """\n# %% role="case"\n"""'


@pytest.mark.parametrize(
    ("header", "message"),
    [
        ('role="cases"', "line 3: role='cases', expected one of given, exercise"),
        ('[markdown] role="given"', "line 3: a given cell is a markdown cell; a role needs a code cell"),
        ('role="case" title', "line 3: title has no value"),
        ('tags=["a"', "line 3: cannot read the header 'tags=[\"a\"'; write each value as JSON"),
    ],
)
def test_a_header_that_cannot_be_read_is_named(write_script, header, message):
    with pytest.raises(MasterError) as error:
        read_script(write_script(f"# %%\n\n# %% {header}\nx = 1\n"))
    assert str(error.value).startswith(f"70_script.py, {message}")
