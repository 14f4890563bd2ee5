"""The soak, for some seconds: it finds nothing in a good graph, and finds what is wrong in a bad one."""

import os
import signal
import sys

import pytest

pytestmark = pytest.mark.ros

SHORT = "from imgproc_course.ros.soak import soak; raise SystemExit(soak(0.08, 0.5, warm_up=2.0))"
ROOM = SHORT.replace("warm_up", "source='room', warm_up")


@pytest.mark.parametrize(("origin", "soak"), [("installed", SHORT), ("sources", ROOM)])
def test_a_short_soak_finds_no_loss_and_no_growth(start, origin, soak):
    environment = {} if origin == "installed" else {"AMENT_PREFIX_PATH": None}
    process = start(sys.executable, "-c", soak, COLUMNS="110", **environment)
    assert process.wait(120) == 0, process.output
    assert process.output.splitlines()[-1] == "no loss, no growth"
    rows = {line.split("│")[1].strip(): line for line in process.output.splitlines() if line.startswith("│")}
    assert list(rows) == ["camera", "image_gray_processor", "image_edge_detection", "notebook"]
    for node in ("image_gray_processor", "image_edge_detection"):
        frames, lost, failed = (int(cell) for cell in rows[node].split("│")[2:5])
        assert frames > 0 and (lost, failed) == (0, 0)


@pytest.mark.parametrize("pause", ["", "sleep 2\n"], ids=["at once", "after its output was read"])
def test_a_node_that_ends_is_reported_as_a_failure(start, tmp_path, workspace, pause):
    broken = tmp_path / "lib" / "image_gray_processor" / "image_gray_processor"
    broken.parent.mkdir(parents=True)
    broken.write_text(f"#!/bin/sh\necho 'the disk is gone' >&2\n{pause}exit 3\n")
    broken.chmod(0o755)
    path = f"{tmp_path}:{workspace.environment['AMENT_PREFIX_PATH']}"
    process = start(sys.executable, "-c", SHORT, AMENT_PREFIX_PATH=path)
    assert process.wait(120) == 1
    assert "image_gray_processor ended with code 3: the disk is gone" in process.output
    assert "measuring" not in process.output
    assert process.output.splitlines()[-1] == "something was lost or grew"


def test_sigterm_leaves_no_process_behind(start):
    import psutil

    process = start(sys.executable, "-c", SHORT.replace("0.08", "10"))
    process.wait_for("warm after 2 s; measuring 10 minutes", seconds=90)
    children = psutil.Process(process.pid).children(recursive=True)
    assert len(children) >= 3
    assert process.leave(signal.SIGTERM, seconds=60) in (0, 1)
    assert "ended by Ctrl-C" in process.output
    assert not any(child.is_running() for child in children)


def test_growth_is_found_with_its_amount():
    from imgproc_course.ros.soak import MEMORY_SLACK, _ProcessSamples

    samples = _ProcessSamples(os.getpid())
    samples.take()
    [(own, threads, files)] = samples.values
    assert 1 << 20 < own < 1 << 33 and threads >= 1 and files >= 3
    samples.values = [(50 << 20, 4, 9)] * 100
    assert list(samples.growth()) == []
    samples.values = [((50 << 20) + k * (MEMORY_SLACK // 60), 4 + k // 80, 9 + k // 80) for k in range(100)]
    assert list(samples.growth()) == [
        "memory grew by 25.0 MiB",
        "threads grew from 4 to 5",
        "open files grew from 9 to 10",
    ]


def test_ctrl_c_during_the_warm_up_reports_no_result(start):
    process = start(sys.executable, "-c", SHORT.replace("2.0", "100.0"))
    process.wait_for(r"10 s: image_gray_processor \d+ frames", seconds=90)
    assert process.leave(signal.SIGINT, seconds=60) == 130
    assert process.output.splitlines()[-1] == "ended by Ctrl-C during the warm-up: nothing was measured"
    assert "┃" not in process.output


@pytest.mark.parametrize("number", [0, -1, float("inf"), float("nan")])
@pytest.mark.parametrize("name", ["minutes", "speed"])
def test_a_bad_duration_or_speed_is_refused(name, number):
    from imgproc_course.ros.soak import soak

    with pytest.raises(ValueError, match=f"{name} must be a positive number, got"):
        soak(**{name: number})


@pytest.mark.parametrize("seconds", [-1, float("inf"), float("nan")])
def test_a_bad_warm_up_is_refused(seconds):
    from imgproc_course.ros.soak import soak

    with pytest.raises(ValueError, match="the warm-up must be 0 or more seconds, got"):
        soak(warm_up=seconds)


def test_the_command_reports_an_error_in_one_line():
    from click.testing import CliRunner

    from imgproc_course.cli import main

    result = CliRunner().invoke(main, ["soak", "--minutes", "-1"])
    assert (result.exit_code, result.output) == (1, "Error: minutes must be a positive number, got -1.0\n")


def test_missing_packages_are_an_error(monkeypatch, tmp_path):
    import imgproc_course
    from imgproc_course.ros import soak

    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path))
    monkeypatch.setattr(
        imgproc_course, "__file__", str(tmp_path / "site-packages" / "imgproc_course" / "x.py")
    )
    with pytest.raises(ValueError, match=r"image_gray_processor is not found; source a workspace"):
        soak._command("image_gray_processor")
