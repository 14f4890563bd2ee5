"""Recognising objects: accuracy by features and by how the data are split, one certain thing over the drive,
and the lesson's node for a minute in the room.

Printed: the share of crops that the lesson's linear classifier has right; in how many frames SIFT and RANSAC
find a thing; live, what a subscriber received, and how many texts were right.

Required: colours beat HOG on the second half of the drive and only guess in the evening; SIFT finds the
marker in every frame; live, the subscriber receives what the node published, and two of three texts stand
above a thing of their name.

Run it with `environment/test --benchmarks recognising_objects`; SECONDS_IN_THE_ROOM=20 is shorter, and 0
leaves the live minute out.
"""

import cv2
import numpy as np
from geometry_msgs.msg import PoseStamped
from in_the_room import (
    ODOMETRY,
    SECONDS,
    TRUTH,
    Topics,
    drive_circles,
    nanoseconds,
    nearest,
    print_rows,
    program,
    room,
    verdict,
    wait_for,
)
from nav_msgs.msg import Odometry
from object_recogniser import recognising_objects
from sensor_msgs.msg import CameraInfo
from sklearn.linear_model import RidgeClassifier
from tqdm import tqdm
from visualization_msgs.msg import MarkerArray

from imgproc_course.recording import open_recording
from imgproc_course.simulation import CAMERA, Simulation, furnished
from imgproc_course.simulation.room_model import load_room

START = (0.45, -1.0, 0.0)
LINEAR, ANGULAR = 0.25, 0.25  # m/s and rad/s: a circle of 1 m radius, to the left
INSTANCES = {"marker": (13, 88), "shelf": (10, 60), "sign": (12, 88)}  # label, and frame of the thing's image
LABELS, INFO = "/objects/labels", "/kachaka/front_camera/camera_info"
MOVERS = {"person": "person", "ball": "ball", "toycar": "toy"}  # pose topic, and name of the class
NEAR_ENOUGH = 0.4  # metres between a text and the thing of its name
NEAR = 3.0  # pixels: the largest distance of an inlier


def evening_views(recording, crops_of):
    """(crops, classes) of what the second half of the drive would show in the room, in the evening."""
    with Simulation(seed=1, size=(CAMERA.width, CAMERA.height), lighting="evening") as simulation:
        for k in tqdm(range(0, 90, 3), "evening", leave=False):
            simulation.look(recording.pose("camera", k))
            if k >= 45:
                labels = simulation.labels().repeat(2, axis=0).repeat(2, axis=1)
                yield crops_of(simulation.frame(), labels)
            simulation.step(0, 0, dt=0.3)


def print_accuracies(recording, lesson):
    """Prints the share that the linear classifier has right; {(test, feature): share}."""
    crops_of = lesson["crops_of"]
    drive = [crops_of(recording.frame(k), recording.labels(k)) for k in tqdm(range(0, 90, 3), "drive")]
    tests = {
        "second half of the drive": drive[15:],
        "end of the drive (frames 60 to 89)": drive[20:],
        "evening": list(evening_views(recording, crops_of)),
        "six other rooms": [
            lesson["look_around"]([furnished(n)]) for n in tqdm(range(100, 106), "rooms", leave=False)
        ],
    }
    rows, shares = [], {}
    for feature in ("colours_of", "hog_of"):
        vectors, classes = described(drive[:15], lesson[feature])
        classifier = RidgeClassifier(alpha=1.0).fit(vectors, classes)
        for name, views in tests.items():
            shares[name, feature] = classifier.score(*described(views, lesson[feature]))
            rows.append((name, feature.removesuffix("_of"), f"{shares[name, feature]:.2f}"))
    print_rows(rows, "learned from the first half of the drive; tested on", "features", "right")
    return shares


def described(views, describe):
    """The feature vectors and classes of all crops of the views."""
    vectors = [np.ravel(describe(crop)) for crops, _ in views for crop in crops]
    return np.array(vectors), np.concatenate([classes for _, classes in views]).astype(int)


# one certain thing


def bounding_box(mask):
    rows, cols = np.nonzero(mask)
    return np.array([cols.min(), rows.min(), cols.max() + 1, rows.max() + 1])


def iou(a, b):
    width, height = np.maximum(np.minimum(a[2:], b[2:]) - np.maximum(a[:2], b[:2]), 0)
    areas = [(box[2] - box[0]) * (box[3] - box[1]) for box in (a, b)]
    return width * height / (sum(areas) - width * height)


def find_in_frame(thing, frame):
    """The box of a gray thing in a gray frame, or None."""
    keypoints, descriptors = cv2.SIFT_create(1500).detectAndCompute(thing, None)
    seen, seen_descriptors = cv2.SIFT_create(5000).detectAndCompute(frame, None)
    pairs = cv2.BFMatcher(cv2.NORM_L2).knnMatch(descriptors, seen_descriptors, k=2)
    matches = [best for best, second in pairs if best.distance < 0.8 * second.distance]
    if len(matches) < 8:
        return None
    points = np.array([keypoints[m.queryIdx].pt for m in matches])
    pixels = np.array([seen[m.trainIdx].pt for m in matches])
    matrix, inliers = cv2.findHomography(points, pixels, cv2.RANSAC, NEAR)
    if matrix is None or inliers.sum() < 8:
        return None
    height, width = thing.shape
    corners = np.array([[[0, 0], [width, 0], [width, height], [0, height]]], float)
    (place,) = cv2.perspectiveTransform(corners, matrix)
    return np.concatenate([place.min(axis=0), place.max(axis=0)])


def print_instances(recording):
    """Prints in how many of 15 frames each thing is found; {thing: how many}."""
    found = {}
    for name, (label, k) in INSTANCES.items():
        left, top, right, bottom = bounding_box(recording.labels(k) == label)
        gray = cv2.cvtColor(recording.frame(k), cv2.COLOR_BGR2GRAY)
        thing = gray[max(top - 4, 0) : bottom + 4, max(left - 4, 0) : right + 4]
        thing = cv2.resize(thing, None, fx=2, fy=2, interpolation=cv2.INTER_CUBIC)
        found[name] = 0
        for other in tqdm(range(0, 85, 6), name, leave=False):
            box = find_in_frame(thing, cv2.cvtColor(recording.frame(other), cv2.COLOR_BGR2GRAY))
            found[name] += box is not None and iou(box, bounding_box(recording.labels(other) == label)) > 0.5
    print("found by SIFT, in 15 frames:", {name: int(count) for name, count in found.items()})
    return found


# live


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
    with room(START, rate=5) as live:
        poses = [TRUTH, *(f"/truth/pose/{name}" for name in MOVERS)]
        kinds = {LABELS: MarkerArray, ODOMETRY: Odometry, INFO: CameraInfo}
        topics = Topics(kinds | dict.fromkeys(poses, PoseStamped))
        with program("object_recogniser.py", "inf") as node:
            wait_for(lambda: topics.count(LABELS), node)
            before = topics.count(INFO)
            drive_circles(live.robot, LINEAR, ANGULAR)
        bumps, images = live.bumps(), topics.count(INFO) - before
    looks, received = int(node.printed), topics.count(LABELS)
    right, texts = right_texts(topics)
    print(
        f"{SECONDS:.0f} s live: {looks} looks at {images} images, {received} MarkerArray received; "
        f"{right} of {texts} texts right; {bumps} bumps"
    )
    return bumps > 0 or abs(looks - received) > 0.05 * looks or 3 * right < 2 * texts


def main():
    recording = open_recording("drive")
    share = print_accuracies(recording, recognising_objects())
    second_half = "second half of the drive"
    failed = share[second_half, "colours_of"] < share[second_half, "hog_of"]
    failed |= share["evening", "colours_of"] > 0.2
    failed |= print_instances(recording)["marker"] < 15
    return verdict(failed or (SECONDS > 0 and print_live()))


if __name__ == "__main__":
    raise SystemExit(main())
