# ---
# jupyter:
#   imgproc_course:
#     title: ROS 2 packages
#     minutes: 50
# ---

# %% [markdown]
# # ROS 2 packages
#
# A node in a notebook stops when the notebook stops. On a robot, nodes belong to *packages*. A package is a folder with a fixed structure; you can build it, install it and start its nodes by name. Here you build two packages, `image_gray_processor` and `image_edge_detection`, and run their nodes outside this notebook.
#
# **You will be able to**
# - explain each file of an `ament_python` package (a ROS 2 package in Python; *ament* is the build system of ROS 2),
# - build a workspace with `colcon`, source it, and start a node by the name of its package,
# - recognise two common mistakes: a workspace that is not sourced, and a dependency that `rosdep` does not know,
# - explain what changes on the real robot.
#
# **Time** about 50 minutes. **You need** [[grayscale_node]] and [[edge_detection_node]]. You can build the packages on every machine that runs this notebook. To run the nodes you need ROS 2.

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
# If ROS 2 is fully installed, one command creates the files of a new package:
#
# ```sh
# ros2 pkg create --build-type ament_python --node-name image_gray_processor image_gray_processor
# ```
#
# The course contains both packages with all their files. A *workspace* is a folder with packages in its folder `src`. The next cell makes a workspace beside this notebook, copies the two packages into it, and lists the files of the first one:

# %% tags=["nbval-ignore-output"]
workspace = Path("ros2_ws").absolute()
sources = Path(imgproc_course.__file__).parents[1] / "environment" / "ros2_ws" / "src"
shutil.copytree(sources, workspace / "src", dirs_exist_ok=True, ignore=shutil.ignore_patterns("__pycache__"))

package = workspace / "src" / "image_gray_processor"
files = sorted(path.relative_to(package).as_posix() for path in package.rglob("*") if path.is_file())
print("\n".join(files))
assert {"package.xml", "setup.py", "setup.cfg", "resource/image_gray_processor"} <= set(files)  # <= : is a subset of

# %% [markdown]
# | file | what it is for |
# |---|---|
# | `package.xml` | name, version, licence, and the dependencies: the other packages that this package needs (section 2) |
# | `setup.py` | says which Python modules are installed, and which function each *executable* (a program that you can start) calls (`console_scripts`) |
# | `setup.cfg` | says that the executables are installed into `lib/<package>`, where `ros2 run` looks for them |
# | `resource/image_gray_processor` | an empty file, the *marker* by which ROS finds the package |
# | `image_gray_processor/image_gray_processor.py` | the node |
# | `launch/…launch.py` | the *launch file*: a program for `ros2 launch`, which starts the node with the topic and the parameters that you choose |
# | `test/` | a test of the node's function, without ROS |

# %%
code = (package / "image_gray_processor" / "image_gray_processor.py").read_text(encoding="utf-8")
print(code)

assert "cv2.cvtColor" in code and "ImageProcessor" in code

# %% [markdown]
# The node consists of a function and an `ImageProcessor`, as in [[grayscale_node]]. On a robot, speed is important, so the function calls OpenCV. Section 5 checks that its result is the same gray image that you computed by hand in [[grayscale]].
#
# ## 2 · Planned failure: a name that rosdep does not know (5 minutes)
#
# On a robot, the command `rosdep install` reads `package.xml` and installs the dependencies with the package manager of the robot's Linux. It identifies each dependency by a name, the *rosdep key*. Many tutorials write `<exec_depend>opencv-python</exec_depend>`. But this is the name that pip uses, not a rosdep key. So rosdep reports:
#
# ```
# ERROR: the following packages/stacks could not have their rosdep keys resolved
# to system dependencies: image_gray_processor: Cannot locate rosdep definition for [opencv-python]
# ```
#
# **Repair it**: the rosdep key of OpenCV for Python is `python3-opencv`. Here are the keys in our package:

# %%
import xml.etree.ElementTree as ET

manifest = ET.parse(package / "package.xml").getroot()
keys = [element.text for element in manifest.iter("exec_depend")]
print(keys)

assert "python3-opencv" in keys and "opencv-python" not in keys

# %% [markdown]
# `imgproc_course`, the Python package of this course, has no rosdep key. It must be installed in the Python that builds and runs the nodes. Here this is the Python of this notebook.
#
# ## 3 · Build (6 minutes)
#
# `colcon` is the build tool of ROS 2. It finds the packages in `src`, builds them, and installs them into the folder `install`. In a terminal (**File → New → Terminal**) you would type `cd ros2_ws` and `python -m colcon build`. The next cell does the same; `subprocess.run` runs another program and waits for it. This takes some seconds.

# %% tags=["nbval-ignore-output"]
colcon = [sys.executable, "-m", "colcon", "build"]  # the nodes will run in the Python that builds them
build = subprocess.run(colcon, cwd=workspace, capture_output=True, text=True)
finished = [line for line in build.stdout.splitlines() if line.startswith("Finished")]
print("\n".join(finished) or build.stderr)
assert build.returncode == 0 and len(finished) == 2

# %% [markdown]
# ## 4 · Planned failure: not sourced (6 minutes)
#
# The packages are built. The next cell looks for one of them as a new terminal would. **Predict**: can ROS find the package?

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
# `ros2 run` reports the same mistake as *Package 'image_gray_processor' not found*. An *environment variable* is a named text that a program receives when it starts. ROS searches the folders in the environment variable `AMENT_PREFIX_PATH`, and our folder is not in it.
#
# **Repair it**: in a terminal, type `source install/setup.bash`. To *source* a file is to run its commands in the current terminal. These commands add your workspace to the variable. Your workspace is now an *overlay*, and the ROS installation is the *underlay*: ROS searches the overlay first. You must source the workspace in *every* terminal that uses its packages. A Python cell cannot source a file. So the next cell starts bash (the program that runs in a terminal), which sources the file and prints its environment variables:

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
# `ros2 run PACKAGE EXECUTABLE` does two things: it finds the folder of the package, as you just did, and starts the file `lib/PACKAGE/EXECUTABLE` in this folder. We can do the same. `subprocess.Popen` starts a program and does not wait until it ends:

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
# This image comes from another *process* (a running program): ROS carried it from there to this notebook. **Look** at the images live:

# %% tags=["nbval-ignore-output"]
if ros_available():
    view = live_view(gray_images, encoding="mono8", caption="The gray images that the node publishes from another process.",
                     alt="The living room in gray, live, while the robot drives.")
    assert node.poll() is None  # the node is still running

# %% [markdown]
# **Check**: is the gray image from the other process (computed by OpenCV) equal to the gray image computed by `to_gray`, for every pixel? The node copies the header, so its image has the same stamp as the camera's image. We use the stamp to find the two images that belong together.

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
    while len(color_frames.keys() & gray_frames.keys()) < 3 and time.monotonic() < end:  # &: stamps in both
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
# The node stopped without an error and printed its statistics. (*Ignored* images are images that came while the node had no subscriber. The node does not process them.)
#
# ## 6 · Practice: where is the executable? (5 minutes)
#
# Write `executable_of(install, package)`. It returns the path of the file that `ros2 run` starts. Here the executable has the same name as its package. The function only puts the path together; it does not look at the disk. `Path` is imported already.
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
    hints=(
        "Look at the path in section 5: which folders come after `install`, and how often does the name of the"
        " package occur?",
        "The parts, in this order, are: `install`, the name of the package, `lib`, the name of the package, and the"
        " executable, which has the name of the package too. Join them with `/`, and return a string.",
        'return f"{install}/{...}/lib/{...}/{...}"',
    ),
    explanation="An f-string replaces each name in braces by its value. The package's name occurs three times: each"
    " package has a folder of its own in `install`, a folder of its own in `lib`, and here its executable has the"
    " same name. The path begins with `install` exactly as it is given, and nothing is searched on the disk.",
    another_way='You can also write `"/".join([install, package, "lib", package, package])`, or'
    " `(Path(install) / package / \"lib\" / package / package).as_posix()`.",
)


# %% role="answer"
def executable_of(install, package):
    raise NotImplementedError("your turn: delete this line and write the function")


# %% role="solution"
def executable_of(install, package):
    return f"{install}/{package}/lib/{package}/{package}"


# %% role="check"
check("packages-executable", executable_of)


# %% role="case" title="the edge node"
def inputs(rng):
    return ("/home/robot/ros2_ws/install", "image_edge_detection")


# %% role="case" title="a relative path" hint="The path begins with install exactly as it is given, here without the current folder. It is not made absolute."
def inputs(rng):
    return ("my_ws/install", "image_gray_processor")


# %% role="hidden" title="another package" hint="Do you use both arguments for every part of the path?"
def inputs(rng):
    return ("/opt/ws/install", "front_camera")


# %% role="mistake" name="stops at the folder" says="Your path stops at the folder lib/<package>. The executable is a file in it: add the name of the package once more at the end."
def executable_of(install, package):
    return f"{install}/{package}/lib/{package}"


# %% role="mistake" name="stops at lib" says="Your path stops at the folder lib. The executable is in lib/<package>: add the name of the package twice at the end."
def executable_of(install, package):
    return f"{install}/{package}/lib"


# %% role="mistake" name="bin instead of lib" says="ROS keeps the executables of a package in lib/<package>, not in bin. See setup.cfg."
def executable_of(install, package):
    return f"{install}/{package}/bin/{package}"


# %% role="mistake" name="bin instead of lib, with its folder" says="ROS keeps the executables of a package in lib/<package>, not in bin. See setup.cfg."
def executable_of(install, package):
    return f"{install}/{package}/bin/{package}/{package}"


# %% role="mistake" name="share instead of lib" says="share holds package.xml and other data of a package. The executables are in lib."
def executable_of(install, package):
    return f"{install}/{package}/share/{package}/{package}"


# %% role="mistake" name="src instead of lib" says="src is the folder of the source code in a workspace. The installed executables are in lib."
def executable_of(install, package):
    return f"{install}/{package}/src/{package}/{package}"


# %% role="mistake" name="without lib" says="The folder lib is missing between the folder of the package and its executables."
def executable_of(install, package):
    return f"{install}/{package}/{package}/{package}"


# %% role="mistake" name="without lib, one name missing" says="The folder lib is missing, and the name of the package occurs once more: the parts are install, package, lib, package, executable."
def executable_of(install, package):
    return f"{install}/{package}/{package}"


# %% role="mistake" name="without the folder of the package" says="Each package has a folder of its own in install: after install comes the name of the package, then lib."
def executable_of(install, package):
    return f"{install}/lib/{package}/{package}"


# %% role="mistake" name="a script with .py" says="The installed executable has no ending: leave out .py."
def executable_of(install, package):
    return f"{install}/{package}/lib/{package}/{package}.py"


# %% role="mistake" name="another name for the executable" says="The executable has the same name as the package: do not add _node."
def executable_of(install, package):
    return f"{install}/{package}/lib/{package}/{package}_node"


# %% role="mistake" name="a fixed package" says="You typed image_gray_processor. Use the argument package, so that the function works for other packages too."
def executable_of(install, package):
    return f"{install}/image_gray_processor/lib/image_gray_processor/image_gray_processor"


# %% role="mistake" name="a fixed package: the edge node" says="You typed image_edge_detection. Use the argument package, so that the function works for other packages too."
def executable_of(install, package):
    return f"{install}/image_edge_detection/lib/image_edge_detection/image_edge_detection"


# %% role="mistake" name="the example's result" says="You typed the result of the example. Use the arguments install and package, so that the function works for other packages too."
def executable_of(install, package):
    return "ros2_ws/install/image_gray_processor/lib/image_gray_processor/image_gray_processor"


# %% role="mistake" name="no f before the quotes" says="The names in braces are not replaced, because the f before the quotes is missing: f\"...\"."
def executable_of(install, package):
    return "{install}/{package}/lib/{package}/{package}"


# %% role="mistake" name="words instead of values" says="Inside the quotes, the words install and package stand for themselves. Use the values of the arguments: an f-string, f\"{install}/{package}/...\"."
def executable_of(install, package):
    return "install/package/lib/package/package"


# %% role="mistake" name="no slashes" says="The parts are joined with nothing between them. Put \"/\" between each two parts."
def executable_of(install, package):
    return install + package + "lib" + package + package


# %% role="mistake" name="spaces instead of slashes" says="The parts are joined with spaces. Put / between the parts."
def executable_of(install, package):
    return " ".join([install, package, "lib", package, package])


# %% role="mistake" name="backslashes" says="Your path has a backslash between the parts. ROS 2 on Linux uses /."
def executable_of(install, package):
    return "\\".join([install, package, "lib", package, package])


# %% role="mistake" name="a slash at the end" says="The path of a file does not end with /: leave out the last slash."
def executable_of(install, package):
    return f"{install}/{package}/lib/{package}/{package}/"


# %% role="mistake" name="a slash before install" says="You put a / before install. The path begins with install, exactly as it is given."
def executable_of(install, package):
    return f"/{install}/{package}/lib/{package}/{package}"


# %% role="mistake" name="a list of the parts" says="You return a list of the parts. Join them to one string: \"/\".join(parts)."
def executable_of(install, package):
    return [install, package, "lib", package, package]


# %% role="mistake" name="a tuple of the parts" says="You return a tuple of the parts. Join them to one string: \"/\".join(parts)."
def executable_of(install, package):
    return install, package, "lib", package, package


# %% role="mistake" name="the arguments exchanged" says="install and package are exchanged: the path must begin with install, and the name of the package follows."
def executable_of(install, package):
    return f"{package}/{install}/lib/{install}/{install}"


# %% role="mistake" name="install twice" says="The argument install is already the folder install: do not add /install once more."
def executable_of(install, package):
    return f"{install}/install/{package}/lib/{package}/{package}"


# %% role="mistake" name="the name of the file only" says="You return only the name of the file. The task asks for its whole path, which begins with install."
def executable_of(install, package):
    return package


# %% role="mistake" name="the path without install" says="Your path does not begin with install: put install and a / before it."
def executable_of(install, package):
    return f"{package}/lib/{package}/{package}"


# %% role="mistake" name="the command" says="This is the command that starts the node. The task asks for the path of the file that the command starts."
def executable_of(install, package):
    return f"ros2 run {package} {package}"


# %% role="mistake" name="join on a list" says="A value does not have what you write after its dot. join is a method of the separator, not of the list: \"/\".join(parts)."
def executable_of(install, package):
    return [install, package].join("/")


# %% [markdown]
# ## 7 · Practice: run the edge node (5 minutes)
#
# Now run the edge-detection node. Its thresholds are parameters, and you can set them in the command, for example with `--ros-args -p low:=30 -p high:=90`. Change the numbers in the second cell, run it again, and observe the edges.

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
    atexit.register(edge_node.terminate)  # stops the node when the kernel stops
    edge_images = ImageSubscriber("/image_edge_detection/edges", encoding="mono8")
    edges = edge_images.wait(timeout=30)
    edge_view = live_view(edge_images, encoding="mono8", caption="The edges that the node publishes from another process.",
                          alt="The living room as white lines on black, live, while the robot drives.")
    assert set(np.unique(edges)) <= {0, 255}

# %% [markdown]
# To stop the node, set `stop_now = True` in the next cell and run the cell. Otherwise the node runs until the kernel of this notebook stops.

# %%
stop_now = False
if ros_available() and stop_now:
    edge_view.stop()
    stop_all(running_nodes)
    print("the node stopped with exit code", edge_node.returncode)

# %% [markdown]
# ## 8 · On the robot (7 minutes)
#
# | in this course | with a full ROS 2 installation |
# |---|---|
# | `imgproc-course play` | the robot's own camera |
# | `colcon build` | `rosdep install --from-paths src -i`, then `colcon build` |
# | start `install/PKG/lib/PKG/EXE` | `ros2 run PKG EXE`, or `ros2 launch PKG PKG.launch.py` |
# | `ImageSubscriber(topic).measured_rate` | `ros2 topic hz TOPIC` |
# | `doctor()` | `ros2 doctor`, `ros2 topic info -v TOPIC` |
#
# The table compares the commands. With a real Kachaka robot, these things change too:
#
# - **Topic names.** The camera's topic is `/kachaka/front_camera/image_raw`. A robot with another name has another *namespace*: the first part of the topic name (here `/kachaka`). Do not change the name in the code. Use *remapping* instead: start the node with `--ros-args -r /kachaka/front_camera/image_raw:=/my_robot/front_camera/image_raw`.
# - **Topics without messages.** The robot's *bridge* is the program that publishes the robot's data in ROS. It publishes images only while the topic has a subscriber, and it publishes `camera_info` only together with an image.
# - **Wi-Fi.** The raw images need 221 Mbit/s, which is too much for many Wi-Fi networks. Remap to the topic that ends in `/compressed`. The nodes can read compressed images too; you do not have to change them.
# - **Versions.** The robot's bridge is made for the ROS 2 release *Humble*, and this course uses the release *Jazzy*. Do not mix two releases in one ROS graph: use a bridge that is built for Jazzy.
# - **Other robots.** A node only finds nodes with the same *domain*, a number. By default, all robots and all laptops in a classroom use domain 0. Give each robot and its laptop a domain of their own: `export ROS_DOMAIN_ID=7`.
# - **The charger.** While the robot is on its charger, its depth camera sends images of 0 × 0 pixels. A node must not stop because of them. Your nodes do not stop: `ImageProcessor` counts such an image as a failure and continues.
#
# ## Recap
#
# A package is a folder with a fixed structure. Build it, source the workspace, and start the node by name. In `package.xml`, write rosdep keys, not pip names. To use another topic, remap the topic in the command.
#
# | stage | shape | dtype | range | unit |
# |---|---|---|---|---|
# | `…/image_raw`, `rgb8` | (720, 1280, 3) | uint8 | 0 to 255 | gray level of red, green, blue |
# | `/image_gray_processor/gray`, `mono8` | (720, 1280) | uint8 | 0 to 255 | gray level |
# | `/image_edge_detection/edges`, `mono8` | (720, 1280) | uint8 | 0 and 255 | no and yes |

# %%
assert round(720 * 1280 * 3 * 8 * 10 / 1e6) == 221  # Mbit/s, ten raw images per second
