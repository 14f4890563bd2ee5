# ---
# jupyter:
#   imgproc_course:
#     title: ROS 2 packages
# ---

# %% [markdown]
# # ROS 2 packages
#
# A node in a notebook stops when the notebook stops. On a robot, nodes belong to *[[term:package|packages]]*. A package is a folder with a fixed structure; you can build it, install it and start its nodes by name. Here you build two packages, `image_gray_processor` and `image_edge_detection`, and run a node outside this notebook.
#
# **You will be able to**
# - explain each file of an `ament_python` package (a ROS 2 package in Python; *[[term:ament]]* is the build system of ROS 2),
# - write the line by which `ros2 run` finds a node,
# - build a *[[term:workspace]]* (a folder with packages) with `colcon`, and start its nodes,
# - deeper: write a package of your own.
#
# **Time** [[minutes]]. **You need** [[grayscale_node]] and [[edge_detection_node]]. You type the commands into a terminal of JupyterLab; each command also has a cell that does the same. To run the nodes you need ROS 2.

# %%
import atexit
import os
import shutil
import signal
import sys
import time
from pathlib import Path
from subprocess import PIPE, STDOUT, Popen

# %%
import numpy as np
from IPython.display import HTML, display

import imgproc_course
from imgproc_course.display import live_view
from imgproc_course.exercises import check, compare_guess, hint, solution
from imgproc_course.ros import ImageSubscriber, open_camera, ros_available

# %% role="texts"
figure_texts = {
    "gray": (
        "The gray images that the node publishes from another process.",
        "The living room in gray, live, while the robot drives.",
    ),
    "own": (
        "The negatives that the node of my own package publishes.",
        "The living room as a negative, live: black is white.",
    ),
    "edges": (
        "The edges that the node publishes from another process.",
        "The living room as white lines on black, live, while the robot drives.",
    ),
}

# %% [markdown]
# The next cell holds what later cells need to run commands for you: the folder of the workspace, and functions that start, run and stop a command. You need not read it.

# %%
workspace = Path("ros2_ws").absolute()

def start(line):
    process = Popen(["bash", "-c", line], cwd=workspace, text=True, stdout=PIPE, stderr=STDOUT)
    atexit.register(process.terminate)  # when the kernel stops
    return process

def run(line):
    process = start(line)
    # shows each line as it comes, with paths that begin in the workspace
    sys.stdout.writelines(text.replace(f"{workspace}/", "") for text in process.stdout)
    return process.wait()

def stop(process):
    process.send_signal(signal.SIGINT)  # as Ctrl-C in a terminal
    process.wait(timeout=20)

# %% [markdown]
# ## 1 · What is in a package ([[minutes]])
#
# If you have the command `ros2`, it creates the files of a new package. It prints, among other lines:
#
# ```
# $ ros2 pkg create image_gray_processor --build-type ament_python --node-name image_gray_processor --dependencies rclpy sensor_msgs cv_bridge
# creating ./image_gray_processor/setup.py
# creating ./image_gray_processor/setup.cfg
# creating ./image_gray_processor/resource/image_gray_processor
# creating ./image_gray_processor/image_gray_processor/image_gray_processor.py
# ```
#
# The course contains both packages with all their files. A *workspace* is a folder with packages in its folder `src` (*source code* is the code that you write). The next cell copies the packages into a workspace, `ros2_ws`, beside this notebook. These are the files of the first one:
#
# | file | what it is for |
# |---|---|
# | `package.xml` | what the package is called, and which other packages it needs |
# | `setup.py` | which files are installed, which programs you can start |
# | `setup.cfg` | installs these programs into `lib/<package>`, where `ros2 run` looks for them |
# | `resource/…` | an empty file, the *marker* by which ROS finds the package |
# | `…/image_gray_processor.py` | the node |
# | `launch/…launch.py` | the *[[term:launch file]]*: which nodes `ros2 launch` starts, with which topics and parameters |

# %%
course = Path(imgproc_course.__file__).parents[1] / "environment" / "ros2_ws"
workspace = shutil.copytree(course / "src", workspace / "src", dirs_exist_ok=True).parent
package = workspace / "src" / "image_gray_processor"
node_file = package / "image_gray_processor" / "image_gray_processor.py"
print(node_file.read_text(encoding="utf-8"))

# %%
# Check: the files that every ament_python package has, and what the texts say about them
for name in ("package.xml", "setup.py", "setup.cfg", "resource/image_gray_processor"):
    assert (package / name).is_file()
setup = (package / "setup.py").read_text(encoding="utf-8")
manifest = (package / "package.xml").read_text(encoding="utf-8")
assert "image_gray_processor = image_gray_processor.image_gray_processor:main" in setup
assert "python3-opencv" in manifest and "<build_type>ament_python</build_type>" in manifest

# %% [markdown]
# This is the class of [[grayscale_node]], now in a file. Its function `main` starts ROS, makes the node, and spins it until Ctrl-C.
#
# Here is `package.xml`. It names other packages by their *[[term:rosdep|rosdep keys]]*: on a robot, the command `rosdep` installs them. With pip's name `opencv-python`, rosdep stops with *Cannot locate rosdep definition*.

# %%
print((package / "package.xml").read_text(encoding="utf-8"))

# %% [markdown]
# Here is `setup.py`. Read the comments: each explains its line.

# %%
print((package / "setup.py").read_text(encoding="utf-8"))

# %% [markdown]
# ## 2 · Your turn: the line that ros2 run needs ([[minutes]])
#
# `ros2 run PACKAGE EXECUTABLE` starts an *[[term:executable]]*: a program that the build makes. Each line of `console_scripts` makes one. Without the line, the package builds, but `ros2 run` says *No executable found*. The line reads
#
# ```
# EXECUTABLE = PACKAGE.FILE:FUNCTION
# ```
#
# It means: the executable imports the file (written without `.py`) from the folder of the package, and calls the function.
#
# Write `entry_point(executable, package, file, function)`. It returns this line, with one space on each side of `=`.
#
# | Input | Output | Example call |
# |---|---|---|
# | four names, each a string; `file` is the name without `.py` | the line, a string | `entry_point("gray", "image_gray_processor", "my_node", "main")` is `"gray = image_gray_processor.my_node:main"` |

# %% role="exercise"
exercise(
    "packages-entry",
    title="The line that ros2 run needs",
    function="entry_point",
    practice=True,
    time_limit=5,
    hint="Compare with the line of console_scripts in section 1: which signs stand between the four names?",
    hints=(
        "Look at the line of console_scripts in section 1. Which of its words are names, and which signs stand"
        " between them?",
        "1. Write an f-string: f\"...\".\n"
        "2. Put the four names into it, in braces, in the order of the line.\n"
        "3. Put = with its two spaces, a dot and a colon between them.",
        'return f"{executable} = {...}.{...}:{...}"',
    ),
    explanation="An f-string replaces each name in braces by its value. The dot is Python's own: import"
    " image_gray_processor.my_node finds the file my_node.py in the folder image_gray_processor. The colon separates"
    " the function.",
    another_way='You can also add the parts: executable + " = " + package + "." + file + ":" + function.',
)

# %% role="answer"
def entry_point(executable, package, file, function):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def entry_point(executable, package, file, function):
    return f"{executable} = {package}.{file}:{function}"


# %% role="check"
entry_result = check("packages-entry", entry_point)
entry_result

# %% role="case" title="the gray node"
def inputs(rng):
    return ("image_gray_processor", "image_gray_processor", "image_gray_processor", "main")

# %% role="case" title="four different names" hint="Compare the order of the names, and each sign between them."
def inputs(rng):
    return ("edges", "image_edge_detection", "edge_node", "run_edges")

# %% role="hidden" title="another function" hint="Do you use all four arguments?"
def inputs(rng):
    return ("front", "robot_cameras", "camera_node", "start_front")

# %% [markdown]
# If your function is right, the next cell writes its line into the `setup.py` of the package. So this package gets a second executable, `gray`.

# %%
executable = "image_gray_processor"
if entry_result.passed:
    executable = "gray"
    my_line = entry_point("gray", "image_gray_processor", "image_gray_processor", "main")
    setup_py = "src/image_gray_processor/setup.py"
    text = (course / setup_py).read_text(encoding="utf-8")
    text = text.replace('"console_scripts": [', f'"console_scripts": ["{my_line}",')
    (workspace / setup_py).write_text(text, encoding="utf-8")

# %% [markdown]
# ## 3 · Build ([[minutes+8]])
#
# The build tool of ROS 2 is [[term:colcon]]. It finds the packages in `src`, and builds and installs them. Open a terminal: **File → New → Terminal**. Drag its tab to the right edge, so that you see it beside this notebook. Type these lines, and press Enter after each:
#
# ```sh
# cd "$JUPYTER_SERVER_ROOT/ros2_ws"
# source ../../.venv/bin/activate
# python -m colcon build --packages-select image_gray_processor
# ```
#
# 1. `cd` (change directory) goes into a folder. JupyterLab sets `JUPYTER_SERVER_ROOT` to the folder of your lessons. It is an *[[term:environment variable]]*: a named text that a program receives when it starts.
# 2. The second line selects the Python of the course. (If bash, the program that runs in a terminal, answers *No such file or directory*, use the path of your own virtual environment.)
# 3. colcon ends with *Finished*, or with *Failed* and the reason. You can ignore lines that begin with *warning*.
#
# The next cell does the same; to build twice does no harm. The bar moves until colcon ends.

# %%
# python is the course's own, as after the second line
os.environ["PATH"] = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"


def build(packages):
    """Builds packages of the workspace; returns 0, or another number if a build failed."""
    bar = display(HTML("<progress aria-label='colcon builds'></progress>"), display_id=True)
    code = run("python -m colcon build --packages-select " + packages)
    bar.update(HTML(""))
    return code

# %% tags=["nbval-ignore-output"]
code = build("image_gray_processor")
for path in sorted(workspace.glob("install/*/lib/*/*")):
    if path.is_file():
        print("executable:", path.relative_to(workspace))

# %%
# Check: the package is built, with the executables of its lines
assert code == 0
for name in ("image_gray_processor", executable):
    assert (workspace / "install/image_gray_processor/lib/image_gray_processor" / name).is_file()

# %% [markdown]
# The workspace has three new folders: `build` and `log` hold intermediate files, `install` holds the result. You can delete all three and build again. If your line of section 2 is right, `gray` is among the executables. After each change of a file in `src`, build again.

# %% [markdown]
# ### A change without a build ([[minutes]], deeper)
#
# **Predict**: you change the file of the node in `src`, and you do not build. Does the changed node run, or the old one?

# %% role="predict"
guess_runs = None  # your guess: "changed" or "old"?

# %%
node_file.write_text(node_file.read_text(encoding="utf-8") + "# changed\n", encoding="utf-8")
[installed] = workspace.glob("install/image_gray_processor/lib/python*/site-packages/*/image_gray_processor.py")
runs = "changed" if "# changed" in installed.read_text(encoding="utf-8") else "old"
compare_guess(guess_runs, runs)

# %%
# Check: the installed file is a copy
assert runs == "old"

# %% [markdown]
# colcon *copies* the file, and the copy runs.

# %% [markdown]
# ## 4 · Planned failure: a package that ROS does not find ([[minutes+4]])
#
# **Pause?** Afterwards choose **Run → Run All Above Selected Cell**.
#
# Ask ROS where the package is installed. (`ament_index` is a small tool of ROS 2.)
#
# ```sh
# ament_index packages image_gray_processor
# ```

# %%
new_terminal = "unset AMENT_PREFIX_PATH; "
question = "ament_index packages image_gray_processor"
print("exit code:", run(new_terminal + question))

# %% [markdown]
# An exit code that is not 0 means: it failed. `ros2 run` reports the same mistake as *Package 'image_gray_processor' not found*. ROS searches the folders in the environment variable `AMENT_PREFIX_PATH`, and our folder is not in it.
#
# **Repair it**: *[[term:source]]* the workspace. To source a file is to run its commands in the current terminal. Then ask again:
#
# ```sh
# source install/setup.bash
# ament_index packages image_gray_processor
# ```

# %% tags=["nbval-ignore-output"]
sourced = "source install/setup.bash; "
code_sourced = run(sourced + question)
print("exit code:", code_sourced)

# %%
# Check: after sourcing, ROS finds the package
assert not ros_available() or code_sourced == 0

# %% [markdown]
# ### One more terminal ([[minutes]], deeper)
#
# Your workspace is now an *overlay* of the ROS installation, the *[[term:underlay]]*: ROS searches the overlay first. **Predict**: you open one more terminal. Does ROS find the package there?

# %% role="predict"
guess_found = None  # your guess: "yes" or "no"?

# %% tags=["nbval-ignore-output"]
found = "yes" if run(new_terminal + question) == 0 else "no"
compare_guess(guess_found, found)

# %%
# Check: a new terminal does not find the package
assert found == "no"

# %% [markdown]
# ## 5 · Run ([[minutes+2]])
#
# Source the workspace in *every* terminal that uses its packages.
#
# `ros2 run image_gray_processor image_gray_processor` finds the folder of the package, and starts the file `lib/PACKAGE/EXECUTABLE` in it. Without `ros2`, start the file itself, in the terminal in which you sourced the workspace (the Tab key completes names). If your line is right, write `gray` in place of the last word:
#
# ```sh
# install/image_gray_processor/lib/image_gray_processor/image_gray_processor
# ```
#
# The terminal is busy now, because the node spins, and prints its log. The next cells start the camera, and the node too if it does not run in your terminal, and subscribe to its topic.

# %% tags=["long"]
def run_node(executable, topic, text):
    """Starts a node, unless it runs already: (its process, the live view of its images)."""
    images = ImageSubscriber(topic, encoding="mono8")
    time.sleep(1)
    node = None
    if images.matched == 0:  # no publisher: the node does not run in a terminal
        node = start(f"{sourced} exec install/{executable} > node.log 2>&1")
    end = time.monotonic() + 30
    while images.latest() is None and time.monotonic() < end:
        if node is not None and node.poll() is not None:
            print("The node has ended. It printed:")
            run("cat node.log")
            return None, None
        time.sleep(0.1)
    return node, live_view(images, encoding="mono8", text=text)

# %% tags=["nbval-ignore-output"]
node, view, gray = None, None, None
if ros_available():
    camera = open_camera("recording")
    gray_node = f"image_gray_processor/lib/image_gray_processor/{executable}"
    gray_topic = "/image_gray_processor/gray"
    node, view = run_node(gray_node, gray_topic, text="ros2_packages/gray")
    if view is not None:
        gray = ImageSubscriber(gray_topic, encoding="mono8").wait(timeout=30)
        print("from another process:", gray.shape, gray.dtype)

# %%
# Check: the other process publishes gray images
assert not ros_available() or (gray.shape == (720, 1280) and gray.dtype == np.uint8)

# %% [markdown]
# These images come from another *process* (a running program). To stop the node, press **Ctrl-C** in its terminal. The live view then says in red that no image arrives: that is right. The next cell stops the node if the notebook started it.

# %% tags=["nbval-ignore-output"]
if view is not None:
    view.stop()
if node is not None:
    stop(node)
    run("cat node.log")

# %%
# Check: the node has stopped
assert node is None or node.poll() is not None

# %% [markdown]
# ## 6 · Run the edge node ([[minutes+4]], deeper)
#
# Now build the second package, and run its node. Its thresholds are *parameters*, and you can set them in the command:
#
# ```sh
# python -m colcon build --packages-select image_edge_detection
# source install/setup.bash
# install/image_edge_detection/lib/image_edge_detection/image_edge_detection --ros-args -p low:=50 -p high:=150
# ```
#
# To try other thresholds, stop the node with Ctrl-C, press the arrow key ↑ to get the line back, change the numbers, and press Enter. Without a terminal: change the numbers in the next cell, and run it again.

# %% tags=["nbval-ignore-output"]
edge_node, edge_code = None, build("image_edge_detection")

# %%
# Check: the package is built
assert edge_code == 0

# %% tags=["nbval-ignore-output"]
if edge_node is not None:
    stop(edge_node)  # the node of the previous run of this cell
if ros_available():
    thresholds = "--ros-args -p low:=50 -p high:=150"
    edge_file = "image_edge_detection/lib/image_edge_detection/image_edge_detection"
    edge_topic = "/image_edge_detection/edges"
    edge_node, edge_view = run_node(
        f"{edge_file} {thresholds}", edge_topic, text="ros2_packages/edges")

# %%
# Check: the live view has no error
assert not ros_available() or edge_view.error is None

# %% [markdown]
# A node that the notebook started runs until the kernel stops.

# %% [markdown]
# ## 7 · Your turn: a package of your own ([[minutes+5]], deeper)
#
# Write a third package, `image_negative`. Its node publishes the *negative* of each gray image, `255 - gray`: black becomes white. You write the three files that matter as texts; `package_files` returns them under their paths in the package. Each step is one line of the check.
#
# 1. **package.xml.** Fill in the name and the build type. The node imports `rclpy`, `sensor_msgs` and `cv2`: write an `exec_depend` for each, with its rosdep key.
# 2. **setup.py.** Fill in the name and the folder with Python code. Install the marker and `package.xml`, as in section 1. The executable `image_negative` calls the function `main` of the node's file.
# 3. **The node.** Its name is `image_negative`. It subscribes to `/kachaka/front_camera/image_raw` (best effort, volatile, depth 5), and publishes `255 - gray` on `~/negative`, as `mono8` with the header of the message. A message that cannot be converted is logged as an error. Begin with your class of [[grayscale_node]].

# %% role="exercise"
exercise(
    "packages-own",
    subject="package",
    title="A package of your own",
    function="package_files",
    time_limit=5,
    allowed=("cv2", "imgproc_course.messages"),
    hint="Compare each file with the same file of image_gray_processor in section 1.",
    hints=(
        "Compare with the files of image_gray_processor in section 1: what is the same in each package, and"
        " where does the name of the package stand?",
        "1. In package.xml: the name, three lines exec_depend, and the build type in export.\n"
        "2. In setup.py: the name three times, and one line NAME = MODULE:FUNCTION.\n"
        "3. The node is your ImageGrayProcessor with other names, and publishes 255 - gray.",
        "<exec_depend>python3-opencv</exec_depend>\n\n"
        '"console_scripts": ["image_negative = image_negative.image_negative:main"]\n\n'
        'negative_msg = self.bridge.cv2_to_imgmsg(255 - gray, "mono8", msg.header)',
    ),
    explanation="A package is a folder of texts. package.xml says what the package needs, setup.py says what is"
    " installed and started, and the node's file does the work. The name of the package must be the same in all of them.",
    another_way="You can also store the name in a variable of setup.py, and write packages=find_packages().",
)


def blocks(rng):
    """A frame of coloured blocks."""
    colours = rng.integers(0, 256, size=(4, 6, 3), dtype=np.uint8)
    return colours.repeat(8, axis=0).repeat(8, axis=1)


def sent(image, number, encoding="bgr8", **more):
    """A step of a drive: an image of the camera."""
    return {
        "image": image,
        "encoding": encoding,
        "topic": "/kachaka/front_camera/image_raw",
        "stamp": (100 + number, 1000 * number + 7),
        "frame_id": f"camera_{number}",
    } | more


# %% role="answer"
PACKAGE_XML = """
<?xml version="1.0"?>
<package format="3">
  <name>...</name>
  <version>0.1.0</version>
  <description>Publishes the negative of each image.</description>
  <maintainer email="me@example.org">me</maintainer>
  <license>Apache-2.0</license>
  <exec_depend>...</exec_depend>
  <export>
    <build_type>...</build_type>
  </export>
</package>
"""

SETUP_PY = """
from setuptools import setup

setup(
    name="...",
    version="0.1.0",
    packages=["..."],
    data_files=[
        ("share/ament_index/resource_index/packages", ["resource/..."]),
        ("share/...", ["package.xml"]),
    ],
    entry_points={"console_scripts": ["..."]},
)
"""

NODE_PY = """
import cv2
import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import Image

# On a robot with cv_bridge: from cv_bridge import CvBridge, CvBridgeError
from imgproc_course.messages.cv_bridge import CvBridge, CvBridgeError


class ImageNegative(Node):
    def __init__(self):
        pass  # step 3


def main(args=None):
    rclpy.init(args=args)
    node = ImageNegative()
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()
"""


def package_files():
    raise NotImplementedError("step 1: fill in PACKAGE_XML, and delete this line")
    return {
        "package.xml": PACKAGE_XML,
        "setup.py": SETUP_PY,
        "image_negative/image_negative.py": NODE_PY,
    }


# %% role="solution"
PACKAGE_XML = """
<?xml version="1.0"?>
<package format="3">
  <name>image_negative</name>
  <version>0.1.0</version>
  <description>Publishes the negative of each image.</description>
  <maintainer email="me@example.org">me</maintainer>
  <license>Apache-2.0</license>
  <exec_depend>rclpy</exec_depend>
  <exec_depend>sensor_msgs</exec_depend>
  <exec_depend>python3-opencv</exec_depend>
  <export>
    <build_type>ament_python</build_type>
  </export>
</package>
"""

SETUP_PY = """
from setuptools import setup

setup(
    name="image_negative",
    version="0.1.0",
    packages=["image_negative"],
    data_files=[
        ("share/ament_index/resource_index/packages", ["resource/image_negative"]),
        ("share/image_negative", ["package.xml"]),
    ],
    entry_points={"console_scripts": ["image_negative = image_negative.image_negative:main"]},
)
"""

NODE_PY = """
import cv2
import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import Image

# On a robot with cv_bridge: from cv_bridge import CvBridge, CvBridgeError
from imgproc_course.messages.cv_bridge import CvBridge, CvBridgeError


class ImageNegative(Node):
    def __init__(self):
        super().__init__("image_negative")
        self.bridge = CvBridge()
        qos = QoSProfile(
            depth=5,
            reliability=ReliabilityPolicy.BEST_EFFORT,
            durability=DurabilityPolicy.VOLATILE,
        )
        self.publisher = self.create_publisher(Image, "~/negative", qos)
        self.create_subscription(
            Image, "/kachaka/front_camera/image_raw", self.image_callback, qos
        )

    def image_callback(self, msg):
        try:
            frame = self.bridge.imgmsg_to_cv2(msg, "bgr8")
        except CvBridgeError as error:
            self.get_logger().error(str(error))
            return
        gray = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
        negative_msg = self.bridge.cv2_to_imgmsg(255 - gray, "mono8", msg.header)
        self.publisher.publish(negative_msg)


def main(args=None):
    rclpy.init(args=args)
    node = ImageNegative()
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()
"""


def package_files():
    return {
        "package.xml": PACKAGE_XML,
        "setup.py": SETUP_PY,
        "image_negative/image_negative.py": NODE_PY,
    }


# %% role="check"
own_result = check("packages-own", package_files)
own_result


# %% role="case" title="step 1: package.xml" points=1 hint="Compare with the package.xml in section 1: the name, one exec_depend for each import, the build type."
def inputs(rng):
    return ("package.xml", [])


# %% role="case" title="step 2: setup.py" points=1 hint="Compare with the setup.py in section 1, word by word."
def inputs(rng):
    return ("setup.py", [])


# %% role="case" title="step 3: the node" points=1 hint="Compare with your ImageGrayProcessor: which names are different, and what is published?"
def inputs(rng):
    bad = sent(blocks(rng), 2, "bgr16", bad=True)
    return [("setup", []), ("images", [sent(blocks(rng), 1), bad, sent(blocks(rng), 3)])]


# %% role="hidden" title="other images" points=1 hint="Does each image of the camera give its negative?"
def inputs(rng):
    cut = sent(blocks(rng), 5, cut=True, bad=True)
    return ("images", [sent(blocks(rng), 4, "rgb8"), cut, sent(blocks(rng), 6)])


# %% [markdown]
# The next cell writes your files into the workspace, and the files that are the same in each package. Then it builds your package and starts its node. (With a full ROS 2 installation: `ros2 run image_negative image_negative`.)

# %%
same_files = {
    "setup.cfg": (
        "[develop]\nscript_dir=$base/lib/image_negative\n"
        "[install]\ninstall_scripts=$base/lib/image_negative\n"
    ),
    "resource/image_negative": "",
    "image_negative/__init__.py": "",
}

# %%
def write_package(files):
    """Writes the texts of a package into the workspace."""
    for path, text in files.items():
        target = workspace / "src" / "image_negative" / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text.strip() + "\n", encoding="utf-8")

# %% tags=["nbval-ignore-output", "long"]
own_node, own_view = None, None
if not own_result.passed or not ros_available():
    print("this needs a package that passes the check, and a running ROS 2")
else:
    write_package(same_files | package_files())
    if build("image_negative") == 0:
        own_file = "image_negative/lib/image_negative/image_negative"
        own_node, own_view = run_node(
            own_file, "/image_negative/negative", text="ros2_packages/own")
    else:
        print("The build failed. What Python says about your setup.py:")
        run("cd src/image_negative && python setup.py --name")

# %%
# Check: the live view of your node has no error
assert own_view is None or own_view.error is None

# %% tags=["nbval-ignore-output"]
if own_view is not None:
    own_view.stop()
if own_node is not None:
    stop(own_node)

# %%
# Check: your node has stopped
assert own_node is None or own_node.poll() is not None

# %% [markdown]
# ## 8 · On the robot ([[minutes]], deeper)
#
# With a full ROS 2 installation, `rosdep install --from-paths src -i` installs what your packages need; then `colcon build`, source, and `ros2 run`.
#
# - **Names.** Another robot has another *[[term:namespace]]*. Do not change the code: *[[term:remapping|remap]]* the topic with `--ros-args -r OLD:=NEW`.
# - **Others.** A node only finds nodes of the same *[[term:domain]]*. Give each robot its own: `export ROS_DOMAIN_ID=7`.

# %% [markdown]
# ## Recap
#
# The line `EXECUTABLE = PACKAGE.FILE:FUNCTION` makes a program of a package's node. Build it, source the workspace, and start the executable. In `package.xml`, write rosdep keys, not pip names.
#
# | stage | shape | dtype | range | unit |
# |---|---|---|---|---|
# | `…/image_raw`, `rgb8` | (720, 1280, 3) | uint8 | 0 to 255 | gray level of red, green, blue |
# | `/image_gray_processor/gray`, `mono8` | (720, 1280) | uint8 | 0 to 255 | gray level |
# | `/image_edge_detection/edges`, `mono8` | (720, 1280) | uint8 | 0 and 255 | no and yes |
#
# ## 9 · Goodbye, and what next ([[minutes]])
#
# You came from bytes to a package that runs without a notebook. Well done!
#
# **Next:** in [[drive_the_robot]], the robot does what your code says. If you have a webcam, `open_camera("webcam")` publishes its images. To read: the [tutorials of ROS 2](https://docs.ros.org/en/jazzy/Tutorials.html), those of [OpenCV](https://docs.opencv.org/4.x/d6/d00/tutorial_py_root.html), and R. Szeliski's book [Computer Vision](https://szeliski.org/Book/).
