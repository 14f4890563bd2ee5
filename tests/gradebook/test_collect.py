"""What is found in folders and zips, whose it is, and what is not touched."""

import json
import os
import zipfile
from datetime import datetime

import pytest
from submissions import write

from imgproc_course.gradebook import collect as intake_module
from imgproc_course.gradebook.collect import IntakeError, take_in

LESSONS = ("20_light", "21_sound")


def found(path):
    with take_in(path, LESSONS) as intake:
        return {each.source: each for each in intake.handins}


def make_zip(path, members, when=(2026, 11, 30, 12, 0, 0)):
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in members:
            archive.writestr(zipfile.ZipInfo(name, when), data, zipfile.ZIP_DEFLATED)
    moment = datetime(2026, 12, 24, 18, 0).timestamp()
    os.utime(path, (moment, moment))
    return path


@pytest.mark.parametrize(
    ("name", "learner", "id", "platform", "late"),
    [
        ("ada.ipynb", "ada", "", "", False),
        ("student-1.ipynb", "student-1", "", "", False),
        ("student (2).ipynb", "student (2)", "", "", False),
        ("20_light_student-2.ipynb", "student-2", "", "", False),
        ("ada_20_light-1.ipynb", "ada", "", "", False),
        ("ada_20_light (2).ipynb", "ada", "", "", False),
        ("ada_20_light.ipynb", "ada", "", "", False),
        ("20_light_ada.ipynb", "ada", "", "", False),
        ("ada/20_light.ipynb", "ada", "", "", False),
        ("ada/deep/er/x.ipynb", "ada", "", "", False),
        ("20_light/ada.ipynb", "ada", "", "", False),
        ("20_light/ada/x.ipynb", "ada", "", "", False),
        ("Ada Lovelace_12345_assignsubmission_file_/x.ipynb", "Ada Lovelace", "12345", "moodle", False),
        ("Ada Lovelace_12345_assignsubmission_file/x.ipynb", "Ada Lovelace", "12345", "moodle", False),
        ("Ada Lovelace_12345_assignsubmission_file_20_light.ipynb", "Ada Lovelace", "12345", "moodle", False),
        ("lovelaceada_123_456_20_light.ipynb", "lovelaceada", "123", "canvas", False),
        ("lovelaceada_LATE_123_456_20_light-2.ipynb", "lovelaceada", "123", "canvas", True),
        ("ada/bob_1_2_20_light.ipynb", "ada", "", "", False),
        ("ada/Bob_1_assignsubmission_file_/x.ipynb", "ada", "", "", False),
    ],
)
def test_whose_it_is(submissions, name, learner, id, platform, late):
    write(submissions / name, b"{}")
    (one,) = found(submissions).values()
    assert (one.learner, one.id, one.platform, one.late) == (learner, id, platform, late)
    assert one.source == name
    assert one.when == datetime(2026, 11, 30, 12, 0)
    assert one.read() == b"{}"


@pytest.mark.parametrize(
    ("zip_name", "inner", "learner", "month"),
    [
        ("carol.zip", "20_light.ipynb", "carol", 12),  # her own zip: its dates are hers to write
        ("carol.zip", "my_lessons/20_light.ipynb", "carol", 12),
        ("all.zip", "ada.ipynb", "ada", 11),
        ("all.zip", "handed-in/ada/20_light.ipynb", "ada", 11),
        ("moodle.zip", "Ada Lovelace_12345_assignsubmission_file_/x.ipynb", "Ada Lovelace", 11),
        ("canvas.zip", "lovelaceada_LATE_123_456_x.ipynb", "lovelaceada", 11),
        ("carol/work.zip", "bob_1_2_x.ipynb", "carol", 12),
        ("carol/work.zip", "bob/x.ipynb", "carol", 12),
        ("carol_1_2_work.zip", "bob/x.ipynb", "carol", 12),
    ],
)
def test_whose_a_zip_is_and_from_when(submissions, zip_name, inner, learner, month):
    path = submissions / zip_name
    path.parent.mkdir(exist_ok=True)
    make_zip(path, [(inner, b"{}")])
    (one,) = found(submissions).values()
    assert one.learner == learner
    assert one.source == f"{zip_name}/{inner}"
    assert one.read() == b"{}"
    assert one.when.month == month


def test_a_zip_alone_is_a_folder_of_submissions(tmp_path):
    path = make_zip(tmp_path / "all.zip", [("ada.ipynb", b"1"), ("bob.ipynb", b"2"), ("note.txt", b"3")])
    with take_in(path, LESSONS) as intake:
        assert [(each.learner, each.read()) for each in intake.handins] == [("ada", b"1"), ("bob", b"2")]
        assert intake.ignored == ["all.zip/note.txt"]


def test_links_and_devices_are_told_and_not_followed(submissions, tmp_path):
    secret = write(tmp_path / "secret.ipynb", b"secret")
    (submissions / "ada").mkdir()
    (submissions / "ada" / "link.ipynb").symlink_to(secret)
    (submissions / "ada" / "folder").symlink_to(tmp_path)
    (submissions / "ada" / "hard.ipynb").hardlink_to(secret)
    os.mkfifo(submissions / "ada" / "pipe.ipynb")
    reasons = {name: each.refused for name, each in found(submissions).items()}
    assert "links are not followed" in reasons["ada/link.ipynb"]
    assert "hard link" in reasons["ada/hard.ipynb"]
    assert "no ordinary file" in reasons["ada/pipe.ipynb"]
    assert len(reasons) == 3
    for each in found(submissions).values():
        with pytest.raises(IntakeError):
            each.read()


def test_a_file_exchanged_for_a_link_after_the_look_is_not_read(submissions, tmp_path):
    path = write(submissions / "ada.ipynb", b"{}")
    (one,) = found(submissions).values()
    path.unlink()
    path.symlink_to(write(tmp_path / "secret.ipynb", b"secret"))
    with pytest.raises(IntakeError, match="cannot be read"):
        one.read()
    path.unlink()
    write(submissions / "other", b"")  # so that the inode is not given out again
    write(path, b"another")
    with pytest.raises(IntakeError, match="changed while"):
        one.read()


def test_a_huge_file_is_not_read(submissions):
    path = submissions / "ada.ipynb"
    with path.open("wb") as file:
        file.truncate(200_000_000)
    (one,) = found(submissions).values()
    assert "200 MB" in one.refused and "clear its outputs" in one.refused


def test_a_zip_bomb_is_not_unpacked(submissions):
    make_zip(submissions / "ada_1_2_x.zip", [("bomb.ipynb", b"0" * 20_000_000), ("good.ipynb", b"{}")])
    by_name = found(submissions)
    assert "200 times" in by_name["ada_1_2_x.zip/bomb.ipynb"].refused
    assert by_name["ada_1_2_x.zip/good.ipynb"].read() == b"{}"


def test_a_zip_that_lies_of_its_sizes_is_read_up_to_the_limit(submissions, monkeypatch):
    path = make_zip(submissions / "ada_1_2_x.zip", [("a.ipynb", os.urandom(5_000))])
    data = bytearray(path.read_bytes())
    for signature, offset in ((b"PK\x03\x04", 22), (b"PK\x01\x02", 24)):
        at = data.index(signature) + offset
        data[at : at + 4] = (100).to_bytes(4, "little")
    path.write_bytes(data)
    monkeypatch.setattr(intake_module, "LARGEST", 1_000)
    (one,) = found(submissions).values()
    with pytest.raises(IntakeError, match=r"unpacked|MB"):
        one.read()


def test_what_grows_while_it_is_read_is_read_up_to_the_limit(submissions, monkeypatch):
    make_zip(submissions / "ada_1_2_x.zip", [("a.ipynb", os.urandom(5_000_000))])
    with take_in(submissions, LESSONS) as intake:
        monkeypatch.setattr(intake_module, "LARGEST", 4_999_999)
        with pytest.raises(IntakeError, match="it has 5 MB, at most 4 are read"):
            intake.handins[0].read()


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("../../x.ipynb", "leads out of the zip"),
        ("/etc/x.ipynb", "leads out of the zip"),
        ("C:\\x.ipynb", "leads out of the zip"),
        ("..\\x.ipynb", "leads out of the zip"),
        ("inner.zip", "a zip in a zip"),
    ],
)
def test_names_in_a_zip(submissions, name, reason):
    make_zip(submissions / "ada_1_2_x.zip", [(name, b"{}")])
    (one,) = found(submissions).values()
    assert reason in one.refused
    assert one.learner == "ada"


def test_a_link_in_a_zip(submissions):
    info = zipfile.ZipInfo("x.ipynb")
    info.external_attr = 0o120777 << 16
    with zipfile.ZipFile(submissions / "ada_1_2_x.zip", "w") as archive:
        archive.writestr(info, "/etc/passwd")
    (one,) = found(submissions).values()
    assert "a link" in one.refused


def test_a_zip_of_too_many_files_or_too_much(submissions, monkeypatch):
    make_zip(submissions / "ada_1_2_x.zip", [(f"{number}.ipynb", b"{}") for number in range(30)])
    monkeypatch.setattr(intake_module, "LARGEST_WITHIN", 59)
    assert "the zip holds" in next(iter(found(submissions).values())).refused
    monkeypatch.setattr(intake_module, "MOST_FILES", 29)
    (one,) = found(submissions).values()
    assert "30 files" in one.refused


def test_a_broken_zip_is_one_hand_in_with_a_reason(submissions):
    write(submissions / "ada_1_2_x.zip", b"PK\x03\x04 no zip")
    write(submissions / "bob.ipynb", b"{}")
    by_name = found(submissions)
    assert "zip cannot be read" in by_name["ada_1_2_x.zip"].refused
    assert by_name["bob.ipynb"].refused == ""


def test_what_stands_beside_a_notebook_is_listed_and_ignored(submissions):
    write(submissions / "ada" / "x.ipynb", b"{}")
    for name in ("conftest.py", "pytest.ini", "numpy.py", "sitecustomize.py", "x.pth"):
        write(submissions / "ada" / name, b"raise SystemExit")
    write(submissions / "ada" / ".ipynb_checkpoints" / "x-checkpoint.ipynb", b"{}")
    with take_in(submissions, LESSONS) as intake:
        assert [each.source for each in intake.handins] == ["ada/x.ipynb"]
        assert len(intake.ignored) == 5


def test_odd_names_are_made_visible(submissions):
    name = "=cmd|' ,\u202eadA\n<b>-p x::[1]"
    write(submissions / name / "x.ipynb", b"{}")
    write(submissions / os.fsdecode(b"\xff\xfe") / "x.ipynb", b"{}")
    learners = {each.learner for each in found(submissions).values()}
    assert learners == {"=cmd|' ,\\u202eadA\\n<b>-p x::[1]", "\\udcff\\udcfe"}
    json.dumps(sorted(learners)).encode("utf-8")


def test_deep_folders_come_to_an_end(submissions):
    path = submissions / "ada"
    for _ in range(40):
        path = path / "d"
    write(path / "x.ipynb", b"{}")
    write(submissions / "bob.ipynb", b"{}")
    with take_in(submissions, LESSONS) as intake:
        assert [each.learner for each in intake.handins] == ["bob"]
        assert any("folders deep" in each for each in intake.ignored)


def test_nothing_there_is_said(submissions):
    with pytest.raises(IntakeError, match="no notebooks"):
        take_in(submissions)
    with pytest.raises(IntakeError, match="there is nothing"):
        take_in(submissions / "nowhere")
