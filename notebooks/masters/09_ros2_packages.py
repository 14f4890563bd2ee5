# ---
# jupyter:
#   imgproc_course:
#     title: ROS 2 packages
#     minutes: 50
# ---

# %% [markdown]
# # 09 · ROS 2 packages
#
# A node in a notebook ends with the notebook. On a robot, nodes live in *packages*: folders of a fixed form that can be built, installed and started by name. Here you build the lesson's two, `image_gray_processor` and `image_edge_detection`, and run them beside this notebook.
#
# **You will be able to**
# - say what each file of an `ament_python` package is for,
# - build a workspace with colcon, source it, and start a node by its package's name,
# - recognise two classic failures: a workspace that is not sourced, and a rosdep key that is none,
# - say what changes on the real robot.
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
# With a full ROS 2 installation one command lays out a new package:
#
# ```sh
# ros2 pkg create --build-type ament_python --node-name image_gray_processor image_gray_processor
# ```
#
# The course brings both packages laid out and filled in. Copy them into a workspace of your own, beside this notebook, and look:

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
# | `package.xml` | name, version, licence, and what the package needs: as *rosdep keys*, not as names of pip |
# | `setup.py` | which modules are installed, and which *executable* calls which function (`console_scripts`) |
# | `setup.cfg` | puts the executables where `ros2 run` looks: `lib/<package>` |
# | `resource/image_gray_processor` | an empty file: the *marker* by which ROS finds the package |
# | `image_gray_processor/image_gray_processor.py` | the node |
# | `launch/…launch.py` | starts the node with a topic and parameters of your choice |
# | `test/` | the node's function, tested without ROS |

# %%
code = (package / "image_gray_processor" / "image_gray_processor.py").read_text(encoding="utf-8")
print(code)

assert "cv2.cvtColor" in code and "ImageProcessor" in code

# %% [markdown]
# Only this: a function, and `ImageProcessor` around it, as in lesson 04. A robot has no time to lose, so the function calls OpenCV. That its gray is the one that you computed by hand in lesson 03 is checked in section 5.
#
# ## 2 · Planned failure: a key that is none (5 minutes)
#
# On a robot, `rosdep install` reads `package.xml` and installs what is needed, on every Linux in its own way. It knows things by *keys*. Many a tutorial writes `<exec_depend>opencv-python</exec_depend>`, the name that pip uses. **Predict** what rosdep answers.
#
# ```
# ERROR: the following packages/stacks could not have their rosdep keys resolved
# to system dependencies: image_gray_processor: Cannot locate rosdep definition for [opencv-python]
# ```
#
# **Repair it**: OpenCV's key is `python3-opencv`. Read what our package says:

# %%
import xml.etree.ElementTree as ET

manifest = ET.parse(package / "package.xml").getroot()
keys = [element.text for element in manifest.iter("exec_depend")]
print(keys)

assert "python3-opencv" in keys and "opencv-python" not in keys

# %% [markdown]
# `imgproc_course`, the course's own package, has no rosdep key. It is in the Python that builds and runs the nodes: here, the one of this notebook.
#
# ## 3 · Build (6 minutes)
#
# `colcon` finds the packages under `src` and installs them into `install`. In a terminal (**File → New → Terminal**) you would write `cd ros2_ws` and `python -m colcon build`. A cell can do the same. It takes some seconds.

# %% tags=["nbval-ignore-output"]
colcon = [sys.executable, "-m", "colcon", "build"]  # the nodes will run in the Python that builds them
built = subprocess.run(colcon, cwd=workspace, capture_output=True, text=True)
finished = [line for line in built.stdout.splitlines() if line.startswith("Finished")]
print("\n".join(finished) or built.stderr)
assert built.returncode == 0 and len(finished) == 2

# %% [markdown]
# ## 4 · Planned failure: not sourced (6 minutes)
#
# The packages are built. **Predict**: does ROS find them now?

# %%
ask = "from ament_index_python import get_package_prefix as prefix; print(prefix('image_gray_processor'))"


def ask_ros(environment):
    answer = subprocess.run([sys.executable, "-c", ask], env=environment, capture_output=True, text=True)
    return answer.stdout.strip() or answer.stderr.strip().splitlines()[-1]


if ros_available():
    answer = ask_ros({**os.environ, "AMENT_PREFIX_PATH": "/nowhere"})  # as in a terminal that sourced nothing
    print(answer)
    assert "PackageNotFoundError" in answer

# %% [markdown]
# With `ros2 run` the same failure reads *Package 'image_gray_processor' not found*. ROS looks in the folders that the environment variable `AMENT_PREFIX_PATH` names, and nobody has named ours. **Repair it**: `source install/setup.bash`. It must be done in *every* terminal that is to know the packages. A cell cannot source for itself, so it asks bash for the environment as it is afterwards:

# %% tags=["nbval-ignore-output"]
sourced = subprocess.run(
    ["bash", "-c", "source install/setup.bash && env -0"], cwd=workspace, capture_output=True, check=True
)
entries = sourced.stdout.decode().split("\0")
environment = dict(entry.split("=", 1) for entry in entries if "=" in entry)
assert str(workspace / "install" / "image_gray_processor") in environment["AMENT_PREFIX_PATH"]

# %%
if ros_available():
    prefix = Path(ask_ros(environment))
    print("found:", prefix.relative_to(workspace))
    assert prefix == workspace / "install" / "image_gray_processor"

# %% [markdown]
# ## 5 · Run (8 minutes)
#
# What `ros2 run PACKAGE EXECUTABLE` does is not much: it looks the prefix up, as you just did, and starts the file `lib/PACKAGE/EXECUTABLE` in it. So can we:

# %% tags=["nbval-ignore-output"]
if ros_available():
    camera = open_camera("recording")
    executable = prefix / "lib" / "image_gray_processor" / "image_gray_processor"
    node = subprocess.Popen([executable], env=environment, text=True,
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    gray_pictures = ImageSubscriber("/image_gray_processor/gray", encoding="mono8")
    gray = gray_pictures.wait(timeout=30)
    print("from another process:", gray.shape, gray.dtype)
    assert gray.shape == (720, 1280) and gray.dtype == np.uint8

# %% [markdown]
# The picture came from another program, through ROS. **Look** at it live:

# %% tags=["nbval-ignore-output"]
if ros_available():
    view = live_view(gray_pictures, encoding="mono8", caption="Gray, computed in another process.",
                     alt="The living room in gray, live, while the robot drives.")
    assert node.poll() is None  # the node is still running

# %% [markdown]
# And **check**: is OpenCV's gray, computed over there, the same as the one by hand, on every pixel? The node copies the header, so its picture and the camera's carry the same time: we can find the two that belong together.

# %% tags=["nbval-ignore-output", "long"]
import time


def keep_in(kept):
    return lambda frame, msg: kept.update({(msg.header.stamp.sec, msg.header.stamp.nanosec): frame})


if ros_available():
    colours, grays = {}, {}
    listeners = [
        ImageSubscriber(camera.topic, keep_in(colours)),
        ImageSubscriber("/image_gray_processor/gray", keep_in(grays), encoding="mono8"),
    ]
    started = time.monotonic()
    while len(colours.keys() & grays.keys()) < 3 and time.monotonic() < started + 20:
        time.sleep(0.1)
    for listener in listeners:
        listener.stop()
    both = colours.keys() & grays.keys()
    different = sum(int((to_gray(colours[stamp]) != grays[stamp]).sum()) for stamp in both)
    print(len(both), "pictures compared; pixels that differ:", different)

# %% tags=["nbval-ignore-output"]
if ros_available():
    import signal

    assert len(both) >= 3 and different == 0
    view.stop()
    node.send_signal(signal.SIGINT)  # Ctrl-C
    said, _ = node.communicate(timeout=20)
    print(said.strip().splitlines()[-1])
    assert node.returncode == 0

# %% [markdown]
# The node left cleanly and counted what it did. (*Unheard* are pictures that came while nobody listened to the node: it does not process them.)
#
# ## 6 · Practice: where is the executable? (5 minutes)
#
# Write `executable_of(install, package)`: the folder `install` of a workspace and a package's name in, both as text; out, as text, the path of the executable of the same name. It is what `ros2 run` looks for, with `/` between the parts.

# %% role="exercise"
exercise(
    "packages-executable",
    title="What ros2 run looks for",
    function="executable_of",
    practice=True,
    time_limit=5,
    hint="install, package, lib, package, executable: and the executable has the package's name.",
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


# %% role="hidden" title="another package" hint="Is every part taken from the arguments?"
def inputs(rng):
    return ("/opt/ws/install", "front_camera")


# %% role="mistake" name="bin instead of lib" says="ROS keeps a package's executables in lib/<package>, not in bin: setup.cfg says so."
def executable_of(install, package):
    return str(Path(install) / package / "bin" / package)


# %% role="mistake" name="one folder missing" says="The package's name stands three times: its folder under install, the folder in lib, and the executable."
def executable_of(install, package):
    return str(Path(install) / package / "lib" / package)


# %% [markdown]
# ## 7 · Practice: run the other one (5 minutes)
#
# Now the edge node. Start it with other thresholds by adding parameters to the command: `--ros-args -p low:=30 -p high:=90`. Change the numbers, run the cell again, observe.

# %%
def stop_all(processes):
    while processes:
        process = processes.pop()
        process.terminate()
        process.wait(timeout=20)


started_here = []

# %% tags=["nbval-ignore-output", "long"]
import atexit

if ros_available():
    stop_all(started_here)  # the node of an earlier run of this cell: two would publish on one topic
    executable = workspace / "install/image_edge_detection/lib/image_edge_detection/image_edge_detection"
    parameters = ["--ros-args", "-p", "low:=50", "-p", "high:=150"]
    edge_node = subprocess.Popen([executable, *parameters], env=environment, stderr=subprocess.DEVNULL)
    started_here.append(edge_node)
    atexit.register(edge_node.terminate)
    edge_pictures = ImageSubscriber("/image_edge_detection/edges", encoding="mono8")
    edges = edge_pictures.wait(timeout=30)
    edge_view = live_view(edge_pictures, encoding="mono8", caption="Edges, found in another process.",
                          alt="The living room as white lines on black, live, while the robot drives.")
    assert set(np.unique(edges)) <= {0, 255}

# %% [markdown]
# When you have seen enough, run the next cell with `enough = True`. Until then the node runs on; it leaves with this notebook's kernel at the latest.

# %%
enough = False
if ros_available() and enough:
    edge_view.stop()
    stop_all(started_here)
    print("the node has left with code", edge_node.returncode)

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
# What changes with a real Kachaka:
#
# - **Names.** The camera is `/kachaka/front_camera/image_raw`; a robot started under another name has another prefix. Never write the name into the code: remap it (`-r /kachaka/front_camera/image_raw:=/my_robot/front_camera/image_raw`).
# - **It is lazy.** Its bridge publishes only while somebody subscribes, and `camera_info` only together with a picture: the topic is listed, and silent.
# - **Wi-Fi.** 221 Mbit/s of raw pictures do not fit: remap to the topic that ends in `/compressed`; the nodes take it as it is.
# - **Versions.** The robot's bridge comes for ROS 2 Humble; this course runs Jazzy. Do not mix the two in one graph: run the bridge built for Jazzy.
# - **Neighbours.** All robots and all laptops of a classroom share domain 0 unless told otherwise. Give each pair its own: `export ROS_DOMAIN_ID=7`.
# - **The charger.** Its depth camera sends pictures of 0 × 0 pixels there. A node must survive them; yours does.
#
# ## Recap
#
# A package is a folder of a fixed form. Build it, source it, run it by name; write rosdep keys and not pip's names; and never write a topic's name into the code.
#
# | stage | shape | dtype | range | unit |
# |---|---|---|---|---|
# | `…/image_raw`, `rgb8` | (720, 1280, 3) | uint8 | 0 to 255 | gray level of red, green, blue |
# | `/image_gray_processor/gray`, `mono8` | (720, 1280) | uint8 | 0 to 255 | gray level |
# | `/image_edge_detection/edges`, `mono8` | (720, 1280) | uint8 | 0 and 255 | no and yes |

# %%
assert round(720 * 1280 * 3 * 8 * 10 / 1e6) == 221  # Mbit/s, ten raw pictures a second
