"""A file or a folder is there whole, or as it was before."""

import pytest
from nbclassroom.exercises.atomic_write import write_file, write_folder


def names_in(folder):
    return [path.name for path in folder.iterdir()]


def test_a_file_is_written_whole_with_its_permissions(tmp_path):
    path = tmp_path / "new" / "grades.json"
    write_file(path, "ü", 0o600)
    assert path.read_bytes() == "ü".encode() and path.stat().st_mode & 0o777 == 0o600
    write_file(path, b"\x00", 0o644)
    assert path.read_bytes() == b"\x00" and path.stat().st_mode & 0o777 == 0o644
    assert names_in(path.parent) == ["grades.json"]


def test_a_full_disk_leaves_the_old_file_and_nothing_else(tmp_path, monkeypatch):
    path = tmp_path / "a.ipynb"
    path.write_text("old")

    def full(_path, _data):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("pathlib.Path.write_bytes", full)
    with pytest.raises(OSError, match="No space left"):
        write_file(path, b"new")
    assert path.read_text() == "old" and names_in(tmp_path) == ["a.ipynb"]


def test_a_folder_takes_the_place_of_another(tmp_path):
    path = tmp_path / "key"
    write_folder(path, {"key.json": "1", "02/a.ipynb": "2"}, 0o700)
    write_folder(path, {"key.json": "3"}, 0o700)
    assert [file.name for file in path.rglob("*")] == ["key.json"]
    assert (path / "key.json").read_text() == "3" and path.stat().st_mode & 0o777 == 0o700
    assert names_in(tmp_path) == ["key"]
