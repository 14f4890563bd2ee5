"""The camera as a process of its own: what it prints, whom it serves, how it leaves."""

import signal

import pytest

pytestmark = pytest.mark.ros

PLAY = "import sys\nfrom imgproc_course.ros.player import play\nsys.exit(play({}))"
FIRST = (
    "drive at {} Hz in domain {}: /kachaka/front_camera/image_raw, "
    "/kachaka/front_camera/image_raw/compressed, "
    "/kachaka/front_camera/camera_info, /kachaka/front_camera/image_raw/camera_info (Ctrl-C stops)\n"
)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_it_plays_until_it_is_told_to_stop(start_python, session, wait_until, number):
    from imgproc_course.ros import ImageSubscriber

    process = start_python(PLAY.format("speed=2.0, status_seconds=0.5"))
    assert process.stdout.readline() == FIRST.format(20, session.context.get_domain_id())
    with ImageSubscriber("/kachaka/front_camera/image_raw") as subscriber:
        assert subscriber.wait(20).shape == (720, 1280, 3)
        while "subscribers: none" in (line := process.stdout.readline()):
            pass
    assert line.endswith(" pictures; subscribers: /kachaka/front_camera/image_raw 1\n")
    process.send_signal(number)
    out, err = process.communicate(timeout=20)
    assert (process.returncode, err) == (0, "")
    assert out.splitlines()[-1].startswith("stopped after ")


def test_without_loop_it_ends_by_itself(run_python):
    code, out, err = run_python(PLAY.format("speed=30.0, loop=False"))
    assert (code, err) == (0, "")
    assert (
        out.splitlines()[-1] == "stopped after 90 pictures, 0 of them sent raw, as nobody subscribed to these"
    )


def test_a_status_without_subscribers_says_so(start_python):
    process = start_python(PLAY.format("status_seconds=0.2"))
    process.stdout.readline()
    assert process.stdout.readline().endswith("pictures; subscribers: none\n")


def test_bad_arguments_are_said(run_python):
    code, _, err = run_python(PLAY.format("speed=-1"))
    assert code == 1
    assert err.splitlines()[-1].startswith("ValueError: speed -1 is no positive number")
