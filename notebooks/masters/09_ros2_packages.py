# ---
# jupyter:
#   imgproc_course:
#     title: ROS 2 packages
#     minutes: 50
# ---

# %% [markdown]
# # 09 · ROS 2 packages
#
# A node in a notebook ends with the notebook. On a robot, nodes belong to *packages*: folders with a fixed structure that can be built, installed and started by name. Here you build two packages, `image_gray_processor` and `image_edge_detection`, and run their nodes beside this notebook.
#
# **You will be able to**
# - explain each file of an `ament_python` package,
# - build a workspace with colcon, source it, and start a node by the name of its package,
# - recognise two common failures: a workspace that is not sourced, and a name that rosdep does not know,
# - explain what changes on the real robot.
#
# **Time** about 50 minutes. **You need** lessons 04 and 08. Building works wherever this notebook runs; running the nodes needs ROS 2.

# %% role="given" exercise=["packages-executable"]
from pathlib import Path

# %%
import os
import shutil
import subprocess
import sys

import numpy as np

import imgproc_course
from imgproc_course.display import live_view
from imgproc_course.exercises import check
from imgproc_course.imaging import to_gray
from imgproc_course.ros import ImageSubscriber, open_camera, ros_available

# %% [markdown]
# ## 1 · What is in a package (8 minutes)
#
# With a full ROS 2 installation, one command creates the files of a new package:
#
# ```sh
# ros2 pkg create --build-type ament_python --node-name image_gray_processor image_gray_processor
# ```
#
# The course contains both packages, with all files written. A *workspace* is a folder that contains packages. Copy the two into your own workspace, beside this notebook, and list the files:

# %% tags=["nbval-ignore-output"]
workspace = Path("ros2_ws").absolute()
sources = Path(imgproc_course.__file__).parents[1] / "environment" / "ros2_ws" / "src"
shutil.copytree(sources, workspace / "src", dirs_exist_ok=True, ignore=shutil.ignore_patterns("__pycache__"))

package = workspace / "src" / "image_gray_processor"
files = sorted(path.relative_to(package).as_posix() for path in package.rglob("*") if path.is_file())
print("\n".join(files))
assert {"package.xml", "setup.py", "setup.cfg", "resource/image_gray_processor"} <= set(files)

# %% [markdown]
# | file | what it is for |
# |---|---|
# | `package.xml` | name, version, licence, and the dependencies, as *rosdep keys* and not as pip names |
# | `setup.py` | which modules are installed, and which *executable* calls which function (`console_scripts`) |
# | `setup.cfg` | installs the executables into `lib/<package>`, where `ros2 run` looks for them |
# | `resource/image_gray_processor` | an empty file, the *marker* by which ROS finds the package |
# | `image_gray_processor/image_gray_processor.py` | the node |
# | `launch/…launch.py` | the *launch file*: it starts the node with the topic and the parameters that you choose |
# | `test/` | a test of the node's function, without ROS |

# %%
code = (package / "image_gray_processor" / "image_gray_processor.py").read_text(encoding="utf-8")
print(code)

assert "cv2.cvtColor" in code and "ImageProcessor" in code

# %% [markdown]
# The whole node is a function with an `ImageProcessor` around it, as in lesson 04. On a robot, speed matters, so the function calls OpenCV. Section 5 checks that its result is the same gray image that you computed by hand in lesson 03.
#
# ## 2 · Planned failure: a name that rosdep does not know (5 minutes)
#
# On a robot, `rosdep install` reads `package.xml` and installs the dependencies, with the package manager of that Linux. It identifies each dependency by a *key*. Many tutorials write `<exec_depend>opencv-python</exec_depend>`, which is the name for pip. **Predict** what rosdep reports.
#
# ```
# ERROR: the following packages/stacks could not have their rosdep keys resolved
# to system dependencies: image_gray_processor: Cannot locate rosdep definition for [opencv-python]
# ```
#
# **Repair it**: the key of OpenCV is `python3-opencv`. Read the keys of our package:

# %%
import xml.etree.ElementTree as ET

manifest = ET.parse(package / "package.xml").getroot()
keys = [element.text for element in manifest.iter("exec_depend")]
print(keys)

assert "python3-opencv" in keys and "opencv-python" not in keys

# %% [markdown]
# `imgproc_course`, the course's own package, has no rosdep key. It must be installed in the Python that builds and runs the nodes. Here this is the Python of this notebook.
#
# ## 3 · Build (6 minutes)
#
# `colcon` finds the packages in `src`, builds them, and installs them into `install`. In a terminal (**File → New → Terminal**) you would type `cd ros2_ws` and `python -m colcon build`. A cell can do the same. It takes some seconds.

# %% tags=["nbval-ignore-output"]
colcon = [sys.executable, "-m", "colcon", "build"]  # the nodes will run in the Python that builds them
build = subprocess.run(colcon, cwd=workspace, capture_output=True, text=True)
finished = [line for line in build.stdout.splitlines() if line.startswith("Finished")]
print("\n".join(finished) or build.stderr)
assert build.returncode == 0 and len(finished) == 2

# %% [markdown]
# ## 4 · Planned failure: not sourced (6 minutes)
#
# The packages are built. **Predict**: can ROS find them now?

# %%
find_prefix = "from ament_index_python import get_package_prefix as find; print(find('image_gray_processor'))"


def package_prefix(environment):
    search = subprocess.run([sys.executable, "-c", find_prefix], env=environment, capture_output=True, text=True)
    return search.stdout.strip() or search.stderr.strip().splitlines()[-1]


if ros_available():
    message = package_prefix({**os.environ, "AMENT_PREFIX_PATH": "/nowhere"})  # a terminal without sourcing
    print(message)
    assert "PackageNotFoundError" in message

# %% [markdown]
# With `ros2 run`, the message for the same failure is *Package 'image_gray_processor' not found*. ROS searches the folders in the environment variable `AMENT_PREFIX_PATH`, and our folder is not among them.
#
# **Repair it**: type `source install/setup.bash`. This adds your workspace to the variable. Your workspace is then an *overlay* on the ROS installation, the *underlay*: ROS searches the overlay first. You must source it in *every* terminal that uses the packages. A cell cannot source a file, so it starts bash, which sources the file and prints its environment:

# %% tags=["nbval-ignore-output"]
bash = subprocess.run(
    ["bash", "-c", "source install/setup.bash && env -0"], cwd=workspace, capture_output=True, check=True
)
entries = bash.stdout.decode().split("\0")
environment = dict(entry.split("=", 1) for entry in entries if "=" in entry)
assert str(workspace / "install" / "image_gray_processor") in environment["AMENT_PREFIX_PATH"]

# %%
if ros_available():
    prefix = Path(package_prefix(environment))
    print("found:", prefix.relative_to(workspace))
    assert prefix == workspace / "install" / "image_gray_processor"

# %% [markdown]
# ## 5 · Run (8 minutes)
#
# `ros2 run PACKAGE EXECUTABLE` does two things: it finds the folder of the package, as you just did, and starts the file `lib/PACKAGE/EXECUTABLE` in it. We can do the same:

# %% tags=["nbval-ignore-output"]
if ros_available():
    camera = open_camera("recording")
    executable = prefix / "lib" / "image_gray_processor" / "image_gray_processor"
    node = subprocess.Popen([executable], env=environment, text=True,
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    gray_images = ImageSubscriber("/image_gray_processor/gray", encoding="mono8")
    gray = gray_images.wait(timeout=30)
    print("from another process:", gray.shape, gray.dtype)
    assert gray.shape == (720, 1280) and gray.dtype == np.uint8

# %% [markdown]
# The image came from another process, through ROS. **Look** at it live:

# %% tags=["nbval-ignore-output"]
if ros_available():
    view = live_view(gray_images, encoding="mono8", caption="Gray, computed in another process.",
                     alt="The living room in gray, live, while the robot drives.")
    assert node.poll() is None  # the node is still running

# %% [markdown]
# And **check**: is OpenCV's gray, computed in the other process, the same as the gray computed by hand, on every pixel? The node copies the header, so its image has the same stamp as the camera's image. By the stamp we find the two images that belong together.

# %% tags=["nbval-ignore-output", "long"]
import time


def store_in(frames):
    return lambda frame, msg: frames.update({(msg.header.stamp.sec, msg.header.stamp.nanosec): frame})


if ros_available():
    color_frames, gray_frames = {}, {}
    subscribers = [
        ImageSubscriber(camera.topic, store_in(color_frames)),
        ImageSubscriber("/image_gray_processor/gray", store_in(gray_frames), encoding="mono8"),
    ]
    end = time.monotonic() + 20
    while len(color_frames.keys() & gray_frames.keys()) < 3 and time.monotonic() < end:
        time.sleep(0.1)
    for subscriber in subscribers:
        subscriber.stop()
    stamps = color_frames.keys() & gray_frames.keys()
    different = sum(int((to_gray(color_frames[stamp]) != gray_frames[stamp]).sum()) for stamp in stamps)
    print(len(stamps), "images compared; pixels that differ:", different)

# %% tags=["nbval-ignore-output"]
if ros_available():
    import signal

    assert len(stamps) >= 3 and different == 0
    view.stop()
    node.send_signal(signal.SIGINT)  # Ctrl-C
    log, _ = node.communicate(timeout=20)
    print(log.strip().splitlines()[-1])
    assert node.returncode == 0

# %% [markdown]
# The node ended cleanly and printed its statistics. (*Ignored* images came while the node had no subscriber. The node does not process them.)
#
# ## 6 · Practice: where is the executable? (5 minutes)
#
# Write `executable_of(install, package)`. It returns the path that `ros2 run` looks for, when the executable has the same name as its package.
#
# | Input | Output | Example call |
# |---|---|---|
# | `install`: the `install` folder of a workspace, a string; `package`: the name of a package, a string | the path of the executable, a string with `/` between the parts | `executable_of("ros2_ws/install", "image_gray_processor")` |

# %% role="exercise"
exercise(
    "packages-executable",
    title="What ros2 run looks for",
    function="executable_of",
    practice=True,
    time_limit=5,
    hint="The parts are: install, package, lib, package, executable. The executable has the name of the package.",
)

# %% role="answer"
def executable_of(install, package):
    raise NotImplementedError("your turn: delete this line and write the function")


# %% role="solution"
def executable_of(install, package):
    return str(Path(install) / package / "lib" / package / package)


# %% role="check"
check("packages-executable", executable_of)


# %% role="case" title="the edge node"
def inputs(rng):
    return ("/home/robot/ros2_ws/install", "image_edge_detection")


# %% role="hidden" title="another package" hint="Do you use both arguments for every part of the path?"
def inputs(rng):
    return ("/opt/ws/install", "front_camera")


# %% role="mistake" name="bin instead of lib" says="ROS keeps the executables of a package in lib/<package>, not in bin. See setup.cfg."
def executable_of(install, package):
    return str(Path(install) / package / "bin" / package)


# %% role="mistake" name="one folder missing" says="The name of the package occurs three times: the folder in install, the folder in lib, and the executable."
def executable_of(install, package):
    return str(Path(install) / package / "lib" / package)


# %% [markdown]
# ## 7 · Practice: run the other one (5 minutes)
#
# Now run the edge node. You can set its thresholds with parameters in the command, for example `--ros-args -p low:=30 -p high:=90`. Change the numbers in the cell, run it again, and observe the edges.

# %%
def stop_all(processes):
    while processes:
        process = processes.pop()
        process.terminate()
        process.wait(timeout=20)


running_nodes = []

# %% tags=["nbval-ignore-output", "long"]
import atexit

if ros_available():
    stop_all(running_nodes)  # the node of the previous run of this cell: two nodes would publish on one topic
    executable = workspace / "install/image_edge_detection/lib/image_edge_detection/image_edge_detection"
    parameters = ["--ros-args", "-p", "low:=50", "-p", "high:=150"]
    edge_node = subprocess.Popen([executable, *parameters], env=environment, stderr=subprocess.DEVNULL)
    running_nodes.append(edge_node)
    atexit.register(edge_node.terminate)
    edge_images = ImageSubscriber("/image_edge_detection/edges", encoding="mono8")
    edges = edge_images.wait(timeout=30)
    edge_view = live_view(edge_images, encoding="mono8", caption="Edges, detected in another process.",
                          alt="The living room as white lines on black, live, while the robot drives.")
    assert set(np.unique(edges)) <= {0, 255}

# %% [markdown]
# To stop the node, run the next cell with `stop_now = True`. Otherwise the node runs until the kernel of this notebook stops.

# %%
stop_now = False
if ros_available() and stop_now:
    edge_view.stop()
    stop_all(running_nodes)
    print("the node has ended with exit code", edge_node.returncode)

# %% [markdown]
# ## 8 · On the robot (7 minutes)
#
# | here, with pip | with a full ROS 2 |
# |---|---|
# | `imgproc-course play` | the robot's own camera |
# | `colcon build` | `rosdep install --from-paths src -i`, then `colcon build` |
# | start `install/PKG/lib/PKG/EXE` | `ros2 run PKG EXE`, or `ros2 launch PKG PKG.launch.py` |
# | `ImageSubscriber(topic).measured_rate` | `ros2 topic hz TOPIC` |
# | `doctor()` | `ros2 doctor`, `ros2 topic info -v TOPIC` |
#
# These things change with a real Kachaka:
#
# - **Topic names.** The camera's topic is `/kachaka/front_camera/image_raw`. A robot with another name has another prefix. Do not change the name in the code; use *remapping* instead (`-r /kachaka/front_camera/image_raw:=/my_robot/front_camera/image_raw`).
# - **Silent topics.** The robot's bridge publishes images only while they have a subscriber, and it publishes `camera_info` only together with an image. Without a subscriber, the topic exists, but no messages come.
# - **Wi-Fi.** 221 Mbit/s of raw images are too much for Wi-Fi. Remap to the topic that ends in `/compressed`. The nodes can read it without a change.
# - **Versions.** The robot's bridge is made for ROS 2 Humble, and this course uses Jazzy. Do not mix the two in one graph: run a bridge that is built for Jazzy.
# - **Other robots.** By default, all robots and all laptops of a classroom share domain 0. Give each robot and its laptop their own domain: `export ROS_DOMAIN_ID=7`.
# - **The charger.** On its charger, the robot's depth camera sends images of 0 × 0 pixels. A node must survive them. Yours does.
#
# ## Recap
#
# A package is a folder with a fixed structure. Build it, source the workspace, and run the node by name. Write rosdep keys, not pip names. To use another topic, remap it.
#
# | stage | shape | dtype | range | unit |
# |---|---|---|---|---|
# | `…/image_raw`, `rgb8` | (720, 1280, 3) | uint8 | 0 to 255 | gray level of red, green, blue |
# | `/image_gray_processor/gray`, `mono8` | (720, 1280) | uint8 | 0 to 255 | gray level |
# | `/image_edge_detection/edges`, `mono8` | (720, 1280) | uint8 | 0 and 255 | no and yes |

# %%
assert round(720 * 1280 * 3 * 8 * 10 / 1e6) == 221  # Mbit/s, ten raw images per second
