"""Recognising objects: the lesson's node for a minute in the room.

Required: the subscriber receives what the node published, and two of three texts stand above a thing of their
name. Its accuracies are asserted by the lesson.

Run it with `environment/test --benchmarks recognising_objects`; SECONDS_IN_THE_ROOM=20 is shorter.
"""

import numpy as np
from geometry_msgs.msg import PoseStamped
from in_the_room import ODOMETRY, SECONDS, TRUTH, circles_in_the_room, nanoseconds, nearest, verdict
from sensor_msgs.msg import CameraInfo
from tqdm import tqdm
from visualization_msgs.msg import MarkerArray

from imgproc_course.simulation.room_model import load_room

START = (0.45, -1.0, 0.0)
LABELS, INFO = "/objects/labels", "/kachaka/front_camera/camera_info"
MOVERS = {"person": "person", "ball": "ball", "toycar": "toy"}  # pose topic, and name of the class
NEAR_ENOUGH = 0.4  # metres between a text and the thing of its name


def right_texts(topics):
    """(how many texts are right, how many there are).

    A text is right if a thing of this name stands at most NEAR_ENOUGH from it, seen from above. Its place
    relative to the robot is taken from odometry, the robot's place in the room from the truth.
    """
    model = load_room()
    numbers = {name: number for number, name in model.label_names.items()}
    true, counted = topics.poses(TRUTH), topics.poses(ODOMETRY)
    movers = {name: topics.poses(f"/truth/pose/{mover}") for mover, name in MOVERS.items()}
    right, markers = 0, [marker for message in topics.messages[LABELS] for marker in message.markers]
    for marker in tqdm(markers, "truth"):
        when, place = nanoseconds(marker), marker.pose.position
        in_room = nearest(true, when) @ nearest(counted, when).inverse()
        is_it = (model.joint < 0) & (model.label == numbers[marker.text])
        corners = model.triangles[is_it][..., :2].reshape(-1, 2)
        if marker.text in movers:
            corners = np.vstack([corners, nearest(movers[marker.text], when).position[:2]])
        away = corners - in_room.apply([place.x, place.y, place.z])[:2]
        right += np.linalg.norm(away, axis=1).min() < NEAR_ENOUGH
    return int(right), len(markers)


def print_live():
    """Prints a minute of circles in the room, with the node in another process; whether it failed."""
    kinds = {LABELS: MarkerArray, INFO: CameraInfo}
    kinds |= {f"/truth/pose/{name}": PoseStamped for name in MOVERS}
    topics, printed, bumps = circles_in_the_room(
        "recognising_objects", START, kinds, lambda topics: topics.count(LABELS), rate=5
    )
    looks, received = int(printed), topics.count(LABELS)
    images = sum(when >= topics.times[LABELS][0] for when in topics.times[INFO])
    right, texts = right_texts(topics)
    print(
        f"{SECONDS:.0f} s live: {looks} looks at {images} images, {received} MarkerArray received; "
        f"{right} of {texts} texts right; {bumps} bumps"
    )
    return bumps > 0 or abs(looks - received) > 0.05 * looks or 3 * right < 2 * texts


if __name__ == "__main__" and SECONDS:
    raise SystemExit(verdict(print_live()))
