"""`imgproc-course build`, as a teacher calls it."""

import pytest
from click.testing import CliRunner
from nbclassroom.cli import main


@pytest.fixture
def call(tmp_path):
    def run(path, *options):
        folders = {"--masters": path.parent, "--out": tmp_path / "out", "--solved": tmp_path / "twins"}
        words = [str(word) for option in folders.items() for word in option]
        return CliRunner().invoke(main, ["build", *words, *options])

    return run


def test_build_then_check_agree(write_master, call, tmp_path):
    path = write_master()
    result = call(path)
    assert result.exit_code == 0 and result.stdout.endswith(f"Lessons built into {tmp_path / 'out'}: 1.\n")
    assert (tmp_path / "twins" / "90_template.ipynb").is_file()
    result = call(path, "--check", "90")
    assert result.exit_code == 0 and "Lessons equal to their masters: 1." in result.stdout
    write_master(("Write `double`", "Please write `double`"))
    result = call(path, "--check")
    assert result.exit_code == 1
    assert "90_template.ipynb: cell template-4: its source differs from the master" in result.stderr


def test_a_master_that_cannot_be_built_is_reported_in_one_line(write_master, call):
    result = call(write_master(("title: Doubling", "title: ''")))
    assert result.exit_code == 1
    assert result.stderr.startswith("90_template.py: the front matter needs")
    result = call(write_master(), "77")
    assert result.exit_code == 1 and "Error: '77' names no lesson" in result.stderr
