"""Which files are collected from folders and zips, who owns them, and which files are refused."""

import contextlib
import io
import json
import os
import zipfile
from datetime import datetime

import pytest
from nbclassroom.gradebook import archives
from nbclassroom.gradebook.archives import CollectError
from nbclassroom.gradebook.collect import Collection
from submissions import make_zip, write

LESSONS = ("light", "sound")


def reason(file):
    """Why it is not read."""
    with pytest.raises(CollectError) as refused:
        file.read()
    return str(refused.value)


@pytest.fixture
def files_by_source():
    """Collects a folder; what it returns can be read until the end of the test."""
    with contextlib.ExitStack() as stack:

        def collected(path):
            collection = stack.enter_context(Collection(path, LESSONS))
            return {file.source: file for file in collection.files}

        yield collected


@pytest.mark.parametrize(
    ("name", "inner", "learner", "month"),
    [
        ("carol.zip", "20_light.ipynb", "carol", 12),  # her own zip: its dates are hers to write
        ("carol/work.zip", "bob/x.ipynb", "carol", 12),
        ("carol_1_2_work.zip", "bob/x.ipynb", "carol", 12),
        ("moodle.zip", "Ada Lovelace_12345_assignsubmission_file_/x.ipynb", "Ada Lovelace", 11),
        ("g/canvas.zip", "lovelaceada_LATE_123_456_x.ipynb", "lovelaceada", 11),
    ],
)
def test_the_learner_and_the_time_of_a_file_in_a_zip(
    files_by_source, submissions, name, inner, learner, month
):
    make_zip(submissions / name, [(inner, b"{}")])
    (file,) = files_by_source(submissions).values()
    assert (file.learner, file.source, file.read()) == (learner, f"{name}/{inner}", b"{}")
    assert file.submitted_at.month == month


def test_a_zip_alone_is_a_folder_of_submissions(tmp_path):
    path = make_zip(tmp_path / "all.zip", [("ada.ipynb", b"1"), ("bob.ipynb", b"2"), ("note.txt", b"3")])
    with Collection(path, LESSONS) as collection:
        assert [(file.learner, file.read()) for file in collection.files] == [("ada", b"1"), ("bob", b"2")]
        assert collection.ignored == ["note.txt"]
    path = make_zip(tmp_path / "class.zip", [("Ada_1_assignsubmission_file_/x.ipynb", b"1")])
    with Collection(path, LESSONS) as collection:
        assert [(file.learner, file.submitted_at.month) for file in collection.files] == [("Ada", 11)]


def _zipped(*members):
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in members:
            archive.writestr(zipfile.ZipInfo(name, (2020, 1, 1, 0, 0, 0)), data)
    return buffer.getvalue()


def test_umlauts_of_macos_are_read(files_by_source, submissions):
    """Its zips do not say that their names are UTF-8."""
    data = _zipped(("A__nne/20_light.ipynb", b"1"), ("Bo/20_light.ipynb", b"2"))
    write(submissions / "class.zip", data.replace(b"A__nne", "A\u0308nne".encode()))
    assert [file.learner for file in files_by_source(submissions).values()] == ["\u00c4nne", "Bo"]


def test_zips_in_zips_are_read(files_by_source, submissions):
    """A learner's zip in a class's zip; the dates in it are the learner's to write."""
    names = ["Ada_1_assignsubmission_file_/work.zip", "Bob_2_assignsubmission_file_/x.ipynb"]
    ada = _zipped(("20_light.ipynb", b"1"), ("more.zip", _zipped(("21_sound.ipynb", b"2"))))
    make_zip(submissions / "class.zip", [(names[0], ada), (names[1], b"3")])
    files = files_by_source(submissions)
    assert {source: (file.learner, file.read()) for source, file in files.items()} == {
        f"class.zip/{names[0]}/20_light.ipynb": ("Ada", b"1"),
        f"class.zip/{names[0]}/more.zip/21_sound.ipynb": ("Ada", b"2"),
        f"class.zip/{names[1]}": ("Bob", b"3"),
    }
    assert {file.submitted_at for file in files.values()} == {datetime(2026, 11, 30, 12)}


def test_zips_in_zips_end(files_by_source, submissions):
    data = _zipped(("20_light.ipynb", b"1"))
    for _ in range(6):
        data = _zipped(("work.zip", data))
    write(submissions / "ada.zip", data)
    (file,) = files_by_source(submissions).values()
    assert (file.learner, file.reason[:29]) == ("ada", "zips in zips are read 4 deep;")


def test_hard_links_are_read(files_by_source, submissions, tmp_path):
    """As `cp -al` and `rsync --link-dest` make them."""
    outside = write(tmp_path / "backup.ipynb", b"{}")
    (submissions / "ada").mkdir()
    (submissions / "ada" / "20_light.ipynb").hardlink_to(outside)
    (file,) = files_by_source(submissions).values()
    assert file.read() == b"{}"


@pytest.mark.parametrize(
    ("name", "learner"),
    [
        ("ada/20_light.ipynb.txt", "ada"),
        ("ada/20_light.IPYNB.json", "ada"),
        ("light/ada.ipynb.json", "ada"),
    ],
)
def test_a_notebook_that_a_browser_saved_as_text_is_read(files_by_source, submissions, name, learner):
    write(submissions / name, b"{}")
    write(submissions / "notes.txt", b"")
    write(submissions / "data.json", b"")
    ((source, file),) = files_by_source(submissions).items()
    assert (source, file.learner, file.read()) == (name, learner, b"{}")


def test_a_file_that_is_replaced_after_it_was_collected_is_not_read(files_by_source, submissions, tmp_path):
    path = write(submissions / "ada.ipynb", b"{}")
    (file,) = files_by_source(submissions).values()
    path.unlink()
    path.symlink_to(write(tmp_path / "secret.ipynb", b"secret"))
    assert "it cannot be read (Too many levels of symbolic links)" in reason(file)
    path.unlink()
    write(submissions / "other", b"")  # so that the inode is not given out again
    write(path, b"another")
    assert "replaced by another file" in reason(file)


def test_a_zip_bomb_is_not_unpacked(files_by_source, submissions):
    make_zip(submissions / "ada_1_2_x.zip", [("bomb.ipynb", b"0" * 20_000_000), ("good.ipynb", b"{}")])
    by_name = files_by_source(submissions)
    assert "200 times" in reason(by_name["ada_1_2_x.zip/bomb.ipynb"])
    assert by_name["ada_1_2_x.zip/good.ipynb"].read() == b"{}"


def test_a_zip_with_false_sizes_is_read_up_to_the_limit(files_by_source, submissions, monkeypatch):
    path = make_zip(submissions / "ada_1_2_x.zip", [("a.ipynb", os.urandom(5_000))])
    data = bytearray(path.read_bytes())
    for signature, offset in ((b"PK\x03\x04", 22), (b"PK\x01\x02", 24)):
        at = data.index(signature) + offset
        data[at : at + 4] = (100).to_bytes(4, "little")
    path.write_bytes(data)
    monkeypatch.setattr(archives, "LARGEST", 1_000)
    (file,) = files_by_source(submissions).values()
    with pytest.raises(CollectError, match=r"cannot be read|MB"):
        file.read()


def test_a_file_larger_than_its_zip_says_is_read_up_to_the_limit(submissions, monkeypatch):
    make_zip(submissions / "ada_1_2_x.zip", [("a.ipynb", os.urandom(5_000_000))])
    with Collection(submissions, LESSONS) as collection:
        monkeypatch.setattr(archives, "LARGEST", 4_999_999)
        with pytest.raises(CollectError, match="it has 5 MB, at most 4 are read"):
            collection.files[0].read()


@pytest.mark.parametrize(
    ("name", "problem"),
    [
        ("../../x.ipynb", "leads out of the zip"),
        ("/etc/x.ipynb", "leads out of the zip"),
        ("..\\x.ipynb", "leads out of the zip"),
        ("inner.zip", "the zip cannot be read (File is not a zip file)"),
    ],
)
def test_names_in_a_zip(files_by_source, submissions, name, problem):
    make_zip(submissions / "ada_1_2_x.zip", [(name, b"{}")])
    (file,) = files_by_source(submissions).values()
    assert problem in reason(file)
    assert file.learner == "ada"


def test_a_link_in_a_zip(files_by_source, submissions):
    info = zipfile.ZipInfo("x.ipynb")
    info.external_attr = 0o120777 << 16
    with zipfile.ZipFile(submissions / "ada_1_2_x.zip", "w") as archive:
        archive.writestr(info, "/etc/passwd")
    (file,) = files_by_source(submissions).values()
    assert "a link" in reason(file)


def test_a_zip_of_too_many_files(files_by_source, submissions, monkeypatch):
    make_zip(submissions / "ada_1_2_x.zip", [(f"{number}.ipynb", b"{}") for number in range(30)])
    monkeypatch.setattr(archives, "MOST_MEMBERS", 29)
    (file,) = files_by_source(submissions).values()
    assert "30 files" in reason(file)


def test_a_broken_zip_is_one_file_with_a_reason(files_by_source, submissions):
    write(submissions / "ada.zip", b"PK\x03\x04 no zip")
    write(submissions / "bob.ipynb", b"{}")
    by_name = files_by_source(submissions)
    assert "zip cannot be read" in reason(by_name["ada.zip"])
    assert by_name["bob.ipynb"].read() == b"{}"


def test_control_characters_in_names_become_visible(files_by_source, submissions):
    name = "=cmd|' ,\u202eadA\n<b>-p x::[1]"
    write(submissions / name / "x.ipynb", b"{}")
    write(submissions / os.fsdecode(b"\xff\xfe") / "x.ipynb", b"{}")
    learners = {file.learner for file in files_by_source(submissions).values()}
    assert learners == {"=cmd|' ,\\u202eadA\\n<b>-p x::[1]", "\\udcff\\udcfe"}
    json.dumps(sorted(learners)).encode("utf-8")


def test_a_hidden_folder_is_listed_unless_jupyter_made_it(submissions):
    write(submissions / "ada" / "20_light.ipynb", b"{}")
    write(submissions / "ada" / ".ipynb_checkpoints" / "20_light-checkpoint.ipynb", b"{}")
    write(submissions / ".eve" / "20_light.ipynb", b"{}")
    with Collection(submissions, LESSONS) as collection:
        assert [file.learner for file in collection.files] == ["ada"]
        assert collection.ignored == [".eve"]
