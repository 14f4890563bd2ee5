"""The camera in a process of its own: what it prints, what it publishes, how it ends."""

import signal

import pytest

pytestmark = pytest.mark.ros

PLAY = "import sys\nfrom imgproc_course.ros.player import play\nsys.exit(play({}))"
FIRST = (
    "started: playing drive at {} Hz on /kachaka/front_camera/image_raw in domain {}, with "
    "/kachaka/front_camera/image_raw/compressed, "
    "/kachaka/front_camera/camera_info, /kachaka/front_camera/image_raw/camera_info (Ctrl-C stops)\n"
)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_it_plays_until_a_signal_stops_it(start_python, session, wait_until, number):
    from imgproc_course.ros import ImageSubscriber

    process = start_python(PLAY.format("speed=2.0, status_seconds=0.5"))
    assert process.stdout.readline() == FIRST.format(20, session.context.get_domain_id())
    assert process.stdout.readline().endswith(" images; subscribers: none\n")
    with ImageSubscriber("/kachaka/front_camera/image_raw") as subscriber:
        assert subscriber.wait(60).shape == (720, 1280, 3)
        while "subscribers: none" in (line := process.stdout.readline()):
            pass
    assert line.endswith(" images; subscribers: /kachaka/front_camera/image_raw 1\n")
    process.send_signal(number)
    out, err = process.communicate(timeout=60)
    assert (process.returncode, err) == (0, "")
    assert out.splitlines()[-1].startswith("stopped after ")


def test_without_loop_it_ends_by_itself(run_python):
    code, out, err = run_python(PLAY.format("speed=30.0, loop=False"))
    assert (code, err) == (0, "")
    assert (
        out.splitlines()[-1] == "stopped after 90 images; 0 raw images sent (the raw topic had no subscriber)"
    )


def test_it_joins_a_camera_that_runs_and_leaves_it_running(start_python, session):
    from imgproc_course.ros import ImageSubscriber
    from imgproc_course.ros.robot_process import User

    first = start_python(PLAY.format("speed=3.0, status_seconds=600"))
    assert first.stdout.readline().startswith("started: playing drive at 30 Hz")
    second = start_python(PLAY.format("speed=3.0, status_seconds=600"))
    name = User("python -c", first.pid)
    assert second.stdout.readline().startswith(f"joined the robot of {name}: playing drive at 30 Hz")
    second.send_signal(signal.SIGINT)
    out, err = second.communicate(timeout=60)
    assert (second.returncode, out, err) == (0, f"left; the camera goes on for {name}\n", "")
    third = start_python(PLAY.format("switch=True"))
    assert third.stdout.readline().startswith(f"joined the robot of {name}: playing drive at 10 Hz")
    assert first.stderr.readline().startswith(f"{User('python -c', third.pid)} has switched the robot: ")
    first.send_signal(signal.SIGINT)  # the one that started it
    out, _ = first.communicate(timeout=60)
    assert out == f"left; the camera goes on for {User('python -c', third.pid)}\n"
    assert ImageSubscriber("/kachaka/front_camera/image_raw").wait(60).shape == (720, 1280, 3)


def test_the_robot_process_computes_images_in_one_thread(run_python):
    code, out, err = run_python(
        """if True:
        import cv2
        from imgproc_course.ros import robot_body

        robot_body.serve = lambda *_: print(cv2.getNumThreads())
        cv2.setNumThreads(3)
        robot_body.main([])
        """
    )
    assert (code, out.split(), err) == (0, ["1"], "")
