"""The nodes of lessons, as programs of their own: with what a lesson defines, and no more.

    python tests/ros/lesson_nodes.py LESSON [SECONDS]     until Ctrl-C, or for seconds of the robot's stamps

A node sees published topics alone. At its end it prints how often it looked, or what RESULTS says.
"""

import ast
import signal
import sys
from pathlib import Path

import cv2
import numpy as np
import rclpy
from nbclassroom.authoring.masters import read_master
from rclpy.signals import SignalHandlerOptions

from imgproc_course.geometry import Pose
from imgproc_course.ros import dds_profile  # chooses the profile, before the first node

MASTERS = Path(__file__).parents[2] / "notebooks" / "masters"
DEFINITIONS = ast.Import | ast.ImportFrom | ast.FunctionDef | ast.ClassDef


def lesson_definitions(lesson, **names):
    """The imports, functions and classes of a lesson's master, and the names given, which they may read.

    No cell that opens a camera runs; of `if ros_available():`, what stands in it.
    """
    (master,) = MASTERS.glob(f"*_{lesson}.py")
    for cell in read_master(master).cells:
        if cell.kind != "code" or cell.role not in ("", "given"):
            continue
        for node in ast.parse(cell.source).body:
            inner = node.body if isinstance(node, ast.If) else [node]
            definitions = [statement for statement in inner if isinstance(statement, DEFINITIONS)]
            exec(compile(ast.Module(definitions, []), cell.id, "exec"), names)
    return names


def run_assignments(lesson, needed, names):
    """Adds what a lesson's cells compute for the names needed to its definitions, in the lesson's order.

    An assignment to an attribute runs only if the name that it belongs to is needed.
    """
    (master,) = MASTERS.glob(f"*_{lesson}.py")
    for cell in read_master(master).cells:
        if cell.kind != "code" or cell.role not in ("", "given"):
            continue
        for node in ast.parse(cell.source).body:
            targets = node.targets if isinstance(node, ast.Assign) else []
            stored = {part.id for t in targets for part in ast.walk(t) if isinstance(part, ast.Name)}
            if stored & needed:
                exec(compile(ast.Module([node], []), cell.id, "exec"), names)
    return names


def spin(make_node, is_over, result):
    """Spins a node until is_over(node) or Ctrl-C, and prints result(node)."""
    print(dds_profile(), file=sys.stderr)
    # An exception, or the end of the context, may come in the middle of a callback: Ctrl-C sets a flag.
    interrupts = []
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    signal.signal(signal.SIGINT, lambda *_: interrupts.append(True))
    node = make_node()
    try:
        while not interrupts and not is_over(node):
            rclpy.spin_once(node, timeout_sec=1.0)
    finally:
        print(result(node), flush=True)
        node.destroy_node()
        rclpy.try_shutdown()


def looked_for(seconds):
    """The function that tells whether a node's images span so many seconds of the robot's stamps."""
    first = None

    def is_over(node):
        nonlocal first
        if not node.looks:
            return False
        stamp = node.image.header.stamp
        newest = stamp.sec + stamp.nanosec / 1e9
        first = newest if first is None else first
        return newest - first >= seconds

    return is_over


def object_tracking():
    """With the weights of 18 bins of the hue that the lesson computes from the drive's first frame."""
    from imgproc_course.recording import open_recording

    recording = open_recording("drive")
    hsv = cv2.cvtColor(recording.frame(0)[::2, ::2].copy(), cv2.COLOR_BGR2HSV)
    col, row, width, height = cv2.boundingRect((recording.labels(0)[::2, ::2] == 9).astype(np.uint8))
    patch = hsv[row : row + height, col : col + width]
    counts = np.bincount(patch[patch[:, :, 1] > 140][:, 0] // 10, minlength=18)
    weights = (255 * counts / counts.max()).astype(np.uint8)
    return lesson_definitions("object_tracking", weights=weights)["FollowNode"]


def where_am_i():
    mount = Pose(np.array([[0.0, 0, 1], [-1, 0, 0], [0, -1, 0]]), np.array([0.21, 0, 0.20]))  # of the camera
    return lesson_definitions("where_am_i", mount=mount, detector=None)["VisualOdometryNode"]


def mapping_and_slam():
    names = lesson_definitions("mapping_and_slam", cell_size=0.05, corner=np.array([-1.5, -2.7]))
    return names["MappingNode"]


def names_of_reading_text():
    import rapidocr

    one_thread = {f"EngineConfig.onnxruntime.{kind}_op_num_threads": 1 for kind in ("intra", "inter")}
    reader = rapidocr.RapidOCR(params={"Global.log_level": "error", **one_thread})
    return lesson_definitions("reading_text", reader=reader)


def reading_text():
    names = names_of_reading_text()
    return lambda: names["TextNode"](names["read_text"])


def recognising_objects():
    """It learns from the recorded drive as the lesson does."""
    needed = {"recording", "CLASSES", "thing_names", "train_crops", "train_classes", "train", "model"}
    needed |= {"weights", "bias", "FARTHEST", "JUMP", "SMALLEST", "WIDEST", "SURE", "mount"}
    names = run_assignments("recognising_objects", needed, lesson_definitions("recognising_objects"))
    return lambda: names["ObjectsNode"](names["class_of"])


def faces():
    """It publishes the images of /visitor/image with hidden faces."""
    needed = {"HAAR_FOLDER", "HAAR_FILE", "HAS_HAAR", "haar"}
    names = run_assignments("faces", needed, lesson_definitions("faces"))
    return lambda: names["AnonymiserNode"](names["find_faces"], names["paint_over"], topic="/visitor/image")


def gestures():
    needed = {"recording", "background", "references", "FARTHEST"}
    names = run_assignments("gestures", needed, lesson_definitions("gestures"))
    return lambda: names["GestureNode"](names["fingers_of"], names["gesture_of"])


def the_errand():
    """It ends when the errand is done."""
    sys.path.append(str(MASTERS.parent))
    from the_errand import Errand, ErrandNode, course_parts, flat_markers, read_with_places

    from imgproc_course.simulation import Simulation

    errand = Errand(flat_markers(Simulation()), read_with_places, course_parts)
    return lambda: ErrandNode(errand)


def errand_result(node):
    """How often it looked, the tasks that are done, where it believes to be, and the name that it read."""
    errand = node.errand
    tasks = ",".join(task for task, _ in errand.diary)
    x, y, yaw = errand.place.pose
    return f"{node.looks}\t{tasks}\t{x:.2f} {y:.2f} {yaw:.2f}\t{errand.name or ''}"


RESULTS = {
    "mapping_and_slam": lambda node: f"{node.looks} {len(node.mapper.poses)} {len(node.mapper.loops)}",
    "faces": lambda node: f"{node.frames} {node.faces}",
    "the_errand": errand_result,
}


def is_done(node):
    """Whether a node's errand is done; False without one."""
    return hasattr(node, "errand") and node.errand.task == node.errand.finished


def main(lesson, seconds=None):
    is_over = looked_for(float(seconds)) if seconds else is_done
    spin(globals()[lesson](), is_over, RESULTS.get(lesson, lambda node: node.looks))


if __name__ == "__main__":
    main(*sys.argv[1:])
