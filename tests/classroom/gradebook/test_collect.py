"""Which files are collected from folders and zips, who owns them, and which files are refused."""

import contextlib
import json
import os
import zipfile
from datetime import datetime

import pytest
from submissions import make_zip, write

from imgproc_course.classroom.gradebook import archives
from imgproc_course.classroom.gradebook.archives import CollectError
from imgproc_course.classroom.gradebook.collect import collect
from imgproc_course.classroom.gradebook.senders import Certainty

LESSONS = ("light", "sound")


@pytest.fixture
def files_by_source():
    """Collects a folder; what it returns can be read until the end of the test."""
    with contextlib.ExitStack() as stack:

        def collected(path):
            collection = stack.enter_context(collect(path, LESSONS))
            return {file.source: file for file in collection.files}

        yield collected


@pytest.mark.parametrize(
    ("name", "learner", "id", "platform", "late"),
    [
        ("ada.ipynb", "ada", "", "", False),
        ("student (2).ipynb", "student (2)", "", "", False),
        ("20_light_student-2.ipynb", "student-2", "", "", False),
        ("ada_20_light (2).ipynb", "ada", "", "", False),
        ("20_light_ada.ipynb", "ada", "", "", False),
        ("ada highlight-1.ipynb", "ada highlight-1", "", "", False),
        ("light/ada.ipynb", "ada", "", "", False),
        ("03_unknown/ada.ipynb", "ada", "", "", False),
        ("ada/deep/er/x.ipynb", "ada", "", "", False),
        ("20_light/ada/x.ipynb", "ada", "", "", False),
        ("Ada Lovelace_12345_assignsubmission_file_/x.ipynb", "Ada Lovelace", "12345", "moodle", False),
        ("Ada Lovelace_12345_assignsubmission_file_20_light.ipynb", "Ada Lovelace", "12345", "moodle", False),
        ("lovelaceada_LATE_123_456_20_light-2.ipynb", "lovelaceada", "123", "canvas", True),
        ("ada/bob_1_2_20_light.ipynb", "ada", "", "", False),
        ("ada/Bob_1_assignsubmission_file_/x.ipynb", "ada", "", "", False),
    ],
)
def test_the_owner_of_a_file(files_by_source, submissions, name, learner, id, platform, late):
    write(submissions / name, b"{}")
    (file,) = files_by_source(submissions).values()
    assert (file.learner, file.platform_id, file.platform, file.late) == (learner, id, platform, late)
    assert file.source == name
    assert file.submitted_at == datetime(2026, 11, 30, 12, 0)
    assert file.read() == b"{}"


@pytest.mark.parametrize(
    ("zip_name", "inner", "learner", "month"),
    [
        ("carol.zip", "20_light.ipynb", "carol", 12),  # her own zip: its dates are hers to write
        ("all.zip", "handed-in/ada/20_light.ipynb", "all", 12),
        ("carol_20_light.zip", "20_light.ipynb", "carol", 12),
        ("light/moodle.zip", "Ada Lovelace_12345_assignsubmission_file_/x.ipynb", "Ada Lovelace", 11),
        ("canvas.zip", "lovelaceada_LATE_123_456_x.ipynb", "lovelaceada", 11),
        ("carol/work.zip", "bob_1_2_x.ipynb", "carol", 12),
        ("carol_1_2_work.zip", "bob/x.ipynb", "carol", 12),
    ],
)
def test_the_owner_and_the_time_of_a_file_in_a_zip(
    files_by_source, submissions, zip_name, inner, learner, month
):
    path = submissions / zip_name
    path.parent.mkdir(exist_ok=True)
    make_zip(path, [(inner, b"{}")])
    (file,) = files_by_source(submissions).values()
    assert file.learner == learner
    assert file.source == f"{zip_name}/{inner}"
    assert file.read() == b"{}"
    assert file.submitted_at.month == month


def test_a_zip_alone_is_a_folder_of_submissions(tmp_path):
    path = make_zip(tmp_path / "all.zip", [("ada.ipynb", b"1"), ("bob.ipynb", b"2"), ("note.txt", b"3")])
    with collect(path, LESSONS) as collection:
        assert [(file.learner, file.read()) for file in collection.files] == [("ada", b"1"), ("bob", b"2")]
        assert collection.ignored == ["all.zip/note.txt"]


@pytest.mark.parametrize("is_zip", [False, True])
def test_the_numbers_of_a_class_list_make_no_lessons(files_by_source, submissions, tmp_path, is_zip):
    names = ["01_ada/20_light.ipynb", "01_ada/sound-1.ipynb", "02_bob/20_light.ipynb", "03_eve/my (2).ipynb"]
    names.append("20_light/dan.ipynb")
    for name in names:
        write(submissions / name, b"{}")
    if is_zip:
        make_zip(tmp_path / "all.zip", [(name, b"{}") for name in names])
    files = files_by_source(tmp_path / "all.zip" if is_zip else submissions).values()
    assert [file.learner for file in files] == ["01_ada", "01_ada", "02_bob", "03_eve", "dan"]
    assert [file.certainty for file in files] == [Certainty.OWN] * 4 + [Certainty.CHOSEN]


def test_a_folder_of_a_lesson_without_a_key_holds_learners(files_by_source, submissions):
    for name in ("03_unknown/ada.ipynb", "03_unknown/bob.ipynb", "03_unknown/20_light.ipynb"):
        write(submissions / name, b"{}")
    assert [file.learner for file in files_by_source(submissions).values()] == ["20_light", "ada", "bob"]


def test_links_and_devices_are_reported_and_not_followed(files_by_source, submissions, tmp_path):
    secret = write(tmp_path / "secret.ipynb", b"secret")
    (submissions / "ada").mkdir()
    (submissions / "ada" / "link.ipynb").symlink_to(secret)
    (submissions / "ada" / "folder").symlink_to(tmp_path)
    os.mkfifo(submissions / "ada" / "pipe.ipynb")
    reasons = {source: file.reason for source, file in files_by_source(submissions).items()}
    assert "links are not followed" in reasons["ada/link.ipynb"]
    assert "not a regular file" in reasons["ada/pipe.ipynb"]
    assert len(reasons) == 2
    for file in files_by_source(submissions).values():
        with pytest.raises(CollectError):
            file.read()


def test_hard_links_are_read(files_by_source, submissions, tmp_path):
    """As `cp -al` and `rsync --link-dest` make them, or a learner with one file under two names."""
    outside = write(tmp_path / "backup.ipynb", b"{}")
    (submissions / "ada").mkdir()
    for name in ("20_light.ipynb", "copy.ipynb"):
        (submissions / "ada" / name).hardlink_to(outside)
    with collect(submissions, ("light",)) as collection:
        assert [file.read() for file in collection.files] == [b"{}", b"{}"]
        assert collection.findings == []


def test_a_link_to_a_neighbours_file_is_reported_for_the_one_who_came_later(submissions):
    ada = write(submissions / "zoe" / "20_light.ipynb", b"{}")
    os.utime(ada.parent, (10**9, 10**9))
    (submissions / "eve").mkdir()
    (submissions / "eve" / "20_light.ipynb").hardlink_to(ada)
    with collect(submissions, ("light",)) as collection:
        assert [file.read() for file in collection.files] == [b"{}", b"{}"]
        (finding,) = collection.findings
    assert (finding.kind, finding.learner, finding.file) == ("sender", "eve", "eve/20_light.ipynb")
    assert "the same file as zoe/20_light.ipynb (a hard link) of zoe; both are graded" in finding.text


@pytest.mark.parametrize(
    ("name", "learner"),
    [
        ("ada/20_light.ipynb.txt", "ada"),
        ("ada/20_light.IPYNB.json", "ada"),
        ("light/ada.ipynb.json", "ada"),
        ("20_light.ipynb.txt", "20_light"),
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
    with pytest.raises(CollectError, match="cannot be read"):
        file.read()
    path.unlink()
    write(submissions / "other", b"")  # so that the inode is not given out again
    write(path, b"another")
    with pytest.raises(CollectError, match="replaced by another file"):
        file.read()


def test_a_huge_file_is_not_read(files_by_source, submissions):
    path = submissions / "ada.ipynb"
    with path.open("wb") as file:
        file.truncate(200_000_000)
    (file,) = files_by_source(submissions).values()
    assert "200 MB" in file.reason and "clear its outputs" in file.reason


def test_a_zip_bomb_is_not_unpacked(files_by_source, submissions):
    make_zip(submissions / "ada_1_2_x.zip", [("bomb.ipynb", b"0" * 20_000_000), ("good.ipynb", b"{}")])
    by_name = files_by_source(submissions)
    assert "200 times" in by_name["ada_1_2_x.zip/bomb.ipynb"].reason
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
    with pytest.raises(CollectError, match=r"unpacked|MB"):
        file.read()


def test_a_file_larger_than_its_zip_says_is_read_up_to_the_limit(submissions, monkeypatch):
    make_zip(submissions / "ada_1_2_x.zip", [("a.ipynb", os.urandom(5_000_000))])
    with collect(submissions, LESSONS) as collection:
        monkeypatch.setattr(archives, "LARGEST", 4_999_999)
        with pytest.raises(CollectError, match="it has 5 MB, at most 4 are read"):
            collection.files[0].read()


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("../../x.ipynb", "leads out of the zip"),
        ("/etc/x.ipynb", "leads out of the zip"),
        ("..\\x.ipynb", "leads out of the zip"),
        ("inner.zip", "a zip in a zip"),
    ],
)
def test_names_in_a_zip(files_by_source, submissions, name, reason):
    make_zip(submissions / "ada_1_2_x.zip", [(name, b"{}")])
    (file,) = files_by_source(submissions).values()
    assert reason in file.reason
    assert file.learner == "ada"


def test_a_link_in_a_zip(files_by_source, submissions):
    info = zipfile.ZipInfo("x.ipynb")
    info.external_attr = 0o120777 << 16
    with zipfile.ZipFile(submissions / "ada_1_2_x.zip", "w") as archive:
        archive.writestr(info, "/etc/passwd")
    (file,) = files_by_source(submissions).values()
    assert "a link" in file.reason


def test_a_zip_of_too_many_files(files_by_source, submissions, monkeypatch):
    make_zip(submissions / "ada_1_2_x.zip", [(f"{number}.ipynb", b"{}") for number in range(30)])
    monkeypatch.setattr(archives, "MOST_MEMBERS", 29)
    (file,) = files_by_source(submissions).values()
    assert "30 files" in file.reason


def test_a_broken_zip_is_one_file_with_a_reason(files_by_source, submissions):
    write(submissions / "ada_1_2_x.zip", b"PK\x03\x04 no zip")
    write(submissions / "bob.ipynb", b"{}")
    by_name = files_by_source(submissions)
    assert "zip cannot be read" in by_name["ada_1_2_x.zip"].reason
    assert by_name["bob.ipynb"].reason == ""


def test_files_beside_a_notebook_are_listed_and_ignored(submissions):
    write(submissions / "ada" / "x.ipynb", b"{}")
    for name in ("conftest.py", "pytest.ini", "numpy.py", "sitecustomize.py", "x.pth"):
        write(submissions / "ada" / name, b"raise SystemExit")
    write(submissions / "ada" / ".ipynb_checkpoints" / "x-checkpoint.ipynb", b"{}")
    with collect(submissions, LESSONS) as collection:
        assert [file.source for file in collection.files] == ["ada/x.ipynb"]
        assert len(collection.ignored) == 5


def test_control_characters_in_names_become_visible(files_by_source, submissions):
    name = "=cmd|' ,\u202eadA\n<b>-p x::[1]"
    write(submissions / name / "x.ipynb", b"{}")
    write(submissions / os.fsdecode(b"\xff\xfe") / "x.ipynb", b"{}")
    learners = {file.learner for file in files_by_source(submissions).values()}
    assert learners == {"=cmd|' ,\\u202eadA\\n<b>-p x::[1]", "\\udcff\\udcfe"}
    json.dumps(sorted(learners)).encode("utf-8")


def test_folders_that_are_too_deep_are_ignored(submissions):
    path = submissions / "ada"
    for _ in range(40):
        path = path / "d"
    write(path / "x.ipynb", b"{}")
    write(submissions / "bob.ipynb", b"{}")
    with collect(submissions, LESSONS) as collection:
        assert [file.learner for file in collection.files] == ["bob"]
        assert any("folders deep" in finding.text for finding in collection.findings)


def test_no_submissions_is_an_error(submissions):
    with pytest.raises(CollectError, match="no notebooks"):
        collect(submissions)
    with pytest.raises(CollectError, match="does not exist"):
        collect(submissions / "nowhere")


def test_a_hidden_folder_is_listed(submissions):
    write(submissions / "ada" / "20_light.ipynb", b"{}")
    write(submissions / ".eve" / "20_light.ipynb", b"{}")
    with collect(submissions, LESSONS) as collection:
        assert [file.learner for file in collection.files] == ["ada"]
        assert collection.ignored == [".eve/"]
        assert [(finding.learner, finding.text) for finding in collection.findings] == [
            (".eve", "no notebook and no zip")
        ]
