"""One room for all tests of a worker that only look: making one takes a second."""

import pytest

from imgproc_course.simulation import Simulation


@pytest.fixture(scope="session")
def at_frames(drive):
    """Views of the room at the time and from the pose of recorded frames, {k: (frame, depth, labels)}."""
    views = {}
    with Simulation(size=(1280, 720)) as room:
        for k in range(0, len(drive), 3):
            room.look(drive.pose("camera", k))
            views[k] = room.frame(), room.depth(), room.labels()
            room.step(0, 0, 0.3)
    return views
