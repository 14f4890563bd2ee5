# ---
# jupyter:
#   imgproc_course:
#     title: ROS 2 packages
# ---

# %% [markdown]
# # ROS 2 packages
#
# A node in a notebook stops when the notebook stops. A *script* is a program of its own. On a robot, nodes belong to *[[term:package|packages]]*. A package is a folder with a fixed structure; you can build it, install it and start its nodes by name. Here you build two packages, `image_gray_processor` and `image_edge_detection`, and run their nodes outside this notebook.
#
# **You will be able to**
# - read a node that is a complete script, from `rclpy.init` to `shutdown`,
# - explain each file of an `ament_python` package (a ROS 2 package in Python; *[[term:ament]]* is the build system of ROS 2),
# - build a *[[term:workspace]]* (a folder with packages) with `colcon`, source it, and start its nodes in a terminal,
# - recognise common mistakes with packages, and repair them,
# - deeper: write the files of a package of your own, build it, run its node, and explain what changes on the real robot.
#
# **Time** [[minutes]], with a pause after section 4. **You need** [[grayscale_node]] and [[edge_detection_node]]. You type the commands into a terminal of JupyterLab. Each command also has a cell that does the same, so this lesson works without a terminal too. To run the nodes you need ROS 2.

# %% role="given" exercise=["packages-executable"]
from pathlib import Path

# %%
import atexit
import os
import shutil
import signal
import subprocess
import sys
import time

# %%
import numpy as np

import imgproc_course
from imgproc_course.display import live_view
from imgproc_course.exercises import check, compare_guess, hint, solution
from imgproc_course.imaging import to_gray
from imgproc_course.ros import ImageSubscriber, open_camera, ros_available

# %% role="texts"
figure_texts = {
    "script": (
        "The gray images that the script publishes from another process.",
        "The living room in gray, live, while the robot drives.",
    ),
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
# ## 1 · A node as a script ([[minutes]])
#
# The course has both nodes as short scripts, as you find them in many tutorials. The next cell makes a folder, `ros2_ws`, beside this notebook. It copies the scripts and the packages of the course into it, and prints the first script:

# %%
workspace = Path("ros2_ws").absolute()
course = Path(imgproc_course.__file__).parents[1] / "environment" / "ros2_ws"
for name in ("scripts", "src"):
    shutil.copytree(course / name, workspace / name, dirs_exist_ok=True)

script = workspace / "scripts" / "image_gray_processor.py"
print(script.read_text(encoding="utf-8"))

# %% [markdown]
# You know the class from [[grayscale_node]]: the QoS profile, the subscription and the callback, which converts with `imgmsg_to_cv2`, processes with `cv2.cvtColor`, and logs an error. What is new, from the top to the bottom:
#
# - `#!/usr/bin/env python3` is the *shebang*. It tells Linux which program runs this file.
# - `cv2.imshow` shows the image in a window, and `cv2.waitKey(1)` gives OpenCV one millisecond to draw it. Where no window can be opened (`windows.py` beside the script finds that out), the script says so once, and publishes the image on `~/view` with `cv2_to_imgmsg`.
# - `rclpy.init()` starts ROS in this program. In a notebook, the course's session does this.
# - `rclpy.spin(node)` waits for messages and calls the callback, until you press Ctrl-C.
# - Ctrl-C ends `spin` with an exception, `ExternalShutdownException` or `KeyboardInterrupt`. Both end a program as planned, so the script does nothing: `pass`. (The comments in the script say why it needs the line with `signal.signal`.)
# - `except RuntimeError` is for a rare case: Ctrl-C ends ROS just while the callback calls ROS, such as `publish`, and this call fails. If ROS still runs (`rclpy.ok()`), the error has another cause: `raise` raises it again.
# - `finally` is always done at the end: `cv2.destroyAllWindows()` closes the windows, `destroy_node()` deletes the node, and `rclpy.try_shutdown()` ends ROS in this program.
# - `if __name__ == "__main__":` means: call `main` only if this file is started, not if it is imported.

# %%
# Check: what the text says about the script
source = script.read_text(encoding="utf-8")
for name in ("#!/usr/bin/env python3", "BEST_EFFORT", "VOLATILE", "imgmsg_to_cv2", "cv2_to_imgmsg", "cv2.imshow"):
    assert name in source
for name in ("cv2.waitKey(1)", "rclpy.init()", "rclpy.spin(node)", "signal.signal", "ExternalShutdownException", "destroy_node", "try_shutdown", "except RuntimeError", "rclpy.ok()"):
    assert name in source

# %% [markdown]
# Open a terminal: **File → New → Terminal**. Drag its tab to the right edge, so that you see the terminal and this notebook side by side. Type these lines, one after the other, and press Enter after each line:
#
# ```sh
# cd "$JUPYTER_SERVER_ROOT/ros2_ws"
# source ../../.venv/bin/activate
# ```
#
# 1. `cd` (change directory) goes into a folder. JupyterLab sets `JUPYTER_SERVER_ROOT` to the folder of your lessons. It is an *[[term:environment variable]]*: a named text that a program receives when it starts.
# 2. The second line selects the Python of the course. (If bash, the program that runs in a terminal, answers *No such file or directory*, use the path of your own virtual environment.)
#
# Cells can run the commands for you. They use the three functions below. You do not need to write such code. If the node runs in your terminal already, the cell does not start it again.

# %%
terminal = os.environ.copy()  # the environment variables of a new terminal
python_folder = str(Path(sys.executable).parent)
terminal["PATH"] = python_folder + os.pathsep + terminal["PATH"]


def run(line):
    """Runs one line in the workspace; returns what it prints."""
    result = subprocess.run(
        ["bash", "-c", line], cwd=workspace, env=terminal,
        capture_output=True, text=True)
    return (result.stdout + result.stderr).strip()

# %%
def start(line):
    """Starts a program in the workspace, and does not wait until it ends."""
    with (workspace / "node.log").open("w") as log:
        process = subprocess.Popen(
            ["bash", "-c", line], cwd=workspace, env=terminal,
            stdout=log, stderr=log)
    atexit.register(process.terminate)  # stops it when the kernel stops
    return process


# %%
def stop(process):
    """Stops a program, as Ctrl-C in its terminal does."""
    process.send_signal(signal.SIGINT)
    process.wait(timeout=20)

# %% [markdown]
# ### Run the script ([[minutes]], deeper)
#
# This notebook starts the camera (or joins it) and subscribes to the script's topic:

# %%
script_node = None
if ros_available():
    camera = open_camera("recording")
    script_topic = "/image_gray_processor/view"
    script_images = ImageSubscriber(script_topic, encoding="mono8")

# %% [markdown]
# Then run the script in your terminal:
#
# ```sh
# python scripts/image_gray_processor.py
# ```
#
# The terminal is busy now, because the node spins. The node prints its log there. If the script does not run, the next cell starts it.

# %% tags=["nbval-ignore-output"]
if ros_available():
    time.sleep(1)
    if script_images.matched == 0:  # no publisher: the script does not run yet
        script_node = start("exec python scripts/image_gray_processor.py")
    script_image = script_images.wait(timeout=30)
    print("from another process:", script_image.shape, script_image.dtype)
    text = "ros2_packages/script"
    script_view = live_view(script_images, encoding="mono8", text=text)

# %%
# Check: the script publishes gray images
assert not ros_available() or script_image.shape == (720, 1280)

# %% [markdown]
# These images come from another *process* (a running program): ROS carries them from there to this notebook. Now stop the script: click into the terminal and press **Ctrl-C**. The next cell does the same if this notebook started the script.

# %% tags=["nbval-ignore-output"]
if ros_available():
    script_view.stop()
    if script_node is not None:
        stop(script_node)
        print("exit code:", script_node.returncode)

# %%
# Check: the script ended without an error
assert script_node is None or script_node.returncode == 0

# %% [markdown]
# ## 2 · What is in a package ([[minutes]])
#
# If ROS 2 is fully installed, one command creates the files of a new package. For our two packages the commands are:
#
# ```sh
# ros2 pkg create image_gray_processor --build-type ament_python --node-name image_gray_processor --dependencies rclpy sensor_msgs cv_bridge
# ros2 pkg create image_edge_detection --build-type ament_python --node-name image_edge_detection --dependencies rclpy sensor_msgs cv_bridge
# ```
#
# `--node-name` is the name of the first node, and `--dependencies` are the other packages that the node needs. (Our packages use the course's own converter in place of `cv_bridge`, so the list in their files is a little different.) The course does not have the command `ros2`; it contains both packages with all their files.
#
# A *workspace* is a folder with packages in its folder `src`. (*Source code* is the code that you write; `src` is short for source.) Our folder `ros2_ws` is a workspace. These are the files of its first package:

# %%
package = workspace / "src" / "image_gray_processor"
for path in sorted(package.rglob("*")):
    if path.is_file() and path.suffix != ".pyc":
        print(path.relative_to(package))

# %%
# Check: the files that every ament_python package has
for name in ("package.xml", "setup.py", "setup.cfg", "resource/image_gray_processor"):
    assert (package / name).is_file()

# %% [markdown]
# | file | what it is for |
# |---|---|
# | `package.xml` | name, version, licence, and the *dependencies*: the other packages that this package needs |
# | `setup.py` | says which files are installed, and which programs you can start |
# | `setup.cfg` | says that these programs are installed into `lib/<package>`, where `ros2 run` looks for them |
# | `resource/…` | an empty file with the name of the package, the *marker* by which ROS finds the package |
# | `…/image_gray_processor.py` | the node |
# | `launch/…launch.py` | the *[[term:launch file]]*: it tells `ros2 launch` which node to start, with which topic and which parameters |
# | `test/` | a test of the node's function, without ROS |
#
# Here is `package.xml`:

# %%
print((package / "package.xml").read_text(encoding="utf-8"))

# %% [markdown]
# - `exec_depend` names what the node needs when it runs, `test_depend` what only the tests need. These names are *[[term:rosdep|rosdep keys]]*: a tool of ROS, `rosdep`, finds the package to install by such a name.
# - `build_type` says how the package is built: `ament_python` is for Python.
# - The Python package of this course, `imgproc_course`, has no rosdep key. It must be installed in the Python that builds and runs the nodes. Here this is the Python of this notebook.
#
# Here is `setup.py`:

# %%
print((package / "setup.py").read_text(encoding="utf-8"))

# %% [markdown]
# - `packages` are the folders with Python code.
# - `data_files` are the other files: the marker, `package.xml` and the launch files. They are installed into `share`.
# - `console_scripts` makes an *[[term:executable]]*, a program that you can start. The text reads `NAME = MODULE:FUNCTION`: the executable `image_gray_processor` calls the function `main` of the node's file.
#
# And here is the node's file:

# %%
node_file = package / "image_gray_processor" / "image_gray_processor.py"
print(node_file.read_text(encoding="utf-8"))

# %%
# Check: what the text says about the three files
code = node_file.read_text(encoding="utf-8")
setup = (package / "setup.py").read_text(encoding="utf-8")
assert "cv2.cvtColor" in code and "ImageProcessor" in code and "def main" in code
assert "run_processor(make_node, args)" in code and "**node_options" in code
manifest = (package / "package.xml").read_text(encoding="utf-8")
for name in ("exec_depend", "test_depend", "<build_type>ament_python</build_type>"):
    assert name in manifest
assert "console_scripts" in setup and "data_files" in setup

# %% [markdown]
# - The node consists of a function and an `ImageProcessor`, as in [[edge_detection_node]].
# - `**node_options` stands for all named arguments with which `make_node` is called. It passes them on to the node.
# - `run_processor` does what `main` of the script does: it starts ROS, creates the node with `make_node`, and spins it until Ctrl-C.

# %% [markdown]
# ## 3 · Planned failure: a dependency that cannot be found ([[minutes]], deeper)
#
# On a robot, the command `rosdep install` reads `package.xml` and installs the dependencies with the package manager of the robot's Linux. If `package.xml` has a name that is no rosdep key, rosdep stops:
#
# ```
# ERROR: the following packages/stacks could not have their rosdep keys resolved
# to system dependencies: image_gray_processor: Cannot locate rosdep definition for [...]
# ```
#
# This happens with many tutorials: they write `<exec_depend>opencv-python</exec_depend>`. `opencv-python` is the name that pip uses, and rosdep does not know it. **Repair it**: write the rosdep key. These are the keys of our package:

# %%
import xml.etree.ElementTree as ET

keys = [element.text for element in ET.parse(package / "package.xml").iter("exec_depend")]
print(keys)

# %%
# Check: the key of OpenCV
assert "python3-opencv" in keys and "opencv-python" not in keys

# %% [markdown]
# ## 4 · Build ([[minutes]])
#
# The build tool of ROS 2 is [[term:colcon]]. It finds the packages in `src`, builds them, and installs them into the folder `install`. Now our workspace has two folders, `scripts` and `src`. **Predict** how many more folders it has after the build.

# %% role="predict"
guess_folders = None  # your guess: how many new folders?

# %% [markdown]
# Type these lines into your terminal, one after the other. (If it is a new one, begin with the first two lines of section 1.)
#
# ```sh
# python -m colcon build --packages-select image_gray_processor
# python -m colcon build
# ```
#
# 1. `--packages-select` builds only the packages that you name. This saves time while you work on one package. colcon prints many lines. You can ignore those that begin with *warning*; the last line says *Finished*.
# 2. Without it, colcon builds all packages in `src`.
#
# The next cell does the same as the last line. If you have built in the terminal, colcon builds once more, which does no harm.

# %% tags=["nbval-ignore-output"]
printed = run("python -m colcon build")
for line in printed.splitlines():
    if line.startswith("Finished"):
        print(line)

new_folders = []
for path in sorted(workspace.iterdir()):
    if path.is_dir() and path.name not in ("scripts", "src"):
        new_folders.append(path.name)
print(new_folders)
compare_guess(guess_folders, len(new_folders))

# %%
# Check: both packages are built
assert printed.count("Finished") == 2 and new_folders == ["build", "install", "log"]

# %% [markdown]
# `build` holds intermediate files and `log` holds log files. `install` holds the result. You can delete all three at any time and build again.
#
# **This is a good place for a pause.** When you come back, choose **Run → Run All Above Selected Cell**.
#
# ## 5 · Ask ROS for the package ([[minutes]])
#
# The packages are built. Click into the first terminal, open a *second* one with **File → New → Terminal**, and ask ROS for the package. **Predict**: can ROS find it?

# %% role="predict"
guess_found = None  # your guess: "yes" or "no"?

# %% [markdown]
# Type this into the second terminal (`ament_index` is a small tool of ROS 2 that prints where a package is installed):
#
# ```sh
# cd "$JUPYTER_SERVER_ROOT/ros2_ws"
# source ../../.venv/bin/activate
# ament_index packages image_gray_processor
# ```

# %%
question = "ament_index packages image_gray_processor"
where = run("unset AMENT_PREFIX_PATH; " + question)  # as a new terminal
print(where)
found = where.endswith("install/image_gray_processor")
compare_guess(guess_found, found)

# %%
# Check: a new terminal does not find the package
assert not found and (not ros_available() or "AMENT_PREFIX_PATH" in where)

# %% [markdown]
# This is a **planned failure**. `ros2 run` reports the same mistake as *Package 'image_gray_processor' not found*. ROS searches the folders in the environment variable `AMENT_PREFIX_PATH`, and our folder is not in it.
#
# **Repair it**: *[[term:source]]* the workspace. To source a file is to run its commands in the current terminal. Type into the second terminal:
#
# ```sh
# source install/setup.bash
# ament_index packages image_gray_processor
# ```
#
# These commands add your workspace to the variable. Your workspace is now an *overlay*, and the ROS installation is the *[[term:underlay]]*: ROS searches the overlay first. You must source the workspace in *every* terminal that uses its packages.

# %%
sourced = "source install/setup.bash && "
where = run(sourced + question)
if ros_available():
    print("found:", Path(where).relative_to(workspace))

# %%
# Check: after sourcing, ROS finds the package in the workspace
assert not ros_available() or where == str(workspace / "install" / "image_gray_processor")

# %% [markdown]
# ## 6 · Run ([[minutes]])
#
# `ros2 run image_gray_processor image_gray_processor` finds the folder of the package, as you just did. Then it starts the file `lib/PACKAGE/EXECUTABLE` in this folder. Without the command `ros2`, start the file itself. First this notebook starts the camera (or joins it), and subscribes to the node's topic:

# %%
node = None
if ros_available():
    camera = open_camera("recording")
    gray_topic = "/image_gray_processor/gray"
    gray_images = ImageSubscriber(gray_topic, encoding="mono8")

# %% [markdown]
# Then type into the second terminal, in which you sourced the workspace (press the Tab key after some letters, and bash completes the name):
#
# ```sh
# install/image_gray_processor/lib/image_gray_processor/image_gray_processor
# ```
#
# The terminal is busy now, because the node spins. The node prints its log there: the topic to which it subscribes, and a line with *DDS profile*. (DDS is the kind of [[term:middleware]] that ROS 2 uses; the profile is its settings. You can ignore this line, also if it is a warning.) If you do not use a terminal, the next cell starts the node.

# %%
if ros_available():
    time.sleep(1)
    if gray_images.matched == 0:  # no publisher: no node runs in a terminal
        folder = "install/image_gray_processor/lib/image_gray_processor/"
        node = start(sourced + "exec " + folder + "image_gray_processor")
    else:
        print("A node publishes already: yours in the terminal, or that of a lesson that is still open.")

# %% tags=["nbval-ignore-output"]
if ros_available():
    gray = gray_images.wait(timeout=30)
    print("from another process:", gray.shape, gray.dtype)
    view = live_view(gray_images, encoding="mono8", text="ros2_packages/gray")

# %%
# Check: the other process publishes gray images
assert not ros_available() or (gray.shape == (720, 1280) and gray.dtype == np.uint8)

# %% [markdown]
# ### Both gray images, pixel by pixel ([[minutes]], deeper)
#
# On a robot, speed is important, so the node calls OpenCV. Is its gray image equal to the one that `to_gray` computes, for every pixel? The node copies the header, so its image has the same stamp as the camera's image. We use the stamp to find the two images that belong together: two callbacks store the images under their stamps.

# %%
color_frames = {}
gray_frames = {}


def stamp_of(msg):
    return (msg.header.stamp.sec, msg.header.stamp.nanosec)


def keep_color(frame, msg):
    color_frames[stamp_of(msg)] = frame


def keep_gray(frame, msg):
    gray_frames[stamp_of(msg)] = frame


# %% [markdown]
# Next, we wait until three gray images and their colour frames have arrived. We count how many of their pixels differ. (One image has 921,600 pixels.)

# %% tags=["nbval-ignore-output", "long"]
different = 0
pairs = []
if ros_available():
    color_subscriber = ImageSubscriber(camera.topic, keep_color)
    gray_subscriber = ImageSubscriber(gray_topic, keep_gray, encoding="mono8")
    end = time.monotonic() + 20
    while len(pairs) < 3 and time.monotonic() < end:
        time.sleep(0.1)
        pairs = [stamp for stamp in list(gray_frames) if stamp in color_frames]
    color_subscriber.stop()
    gray_subscriber.stop()
    for stamp in pairs:
        different += (to_gray(color_frames[stamp]) != gray_frames[stamp]).sum()
print("pairs of images:", len(pairs))
print("pixels that differ:", different)

# %%
# Check: both gray images are equal in every pixel
assert different == 0 and 720 * 1280 == 921_600
assert not ros_available() or len(pairs) >= 3

# %% [markdown]
# ### Stop the node ([[minutes]])
#
# Press **Ctrl-C** in the node's terminal. The live view then says in red that no image arrives: that is right. The next cell does the same if the notebook started the node.

# %% tags=["nbval-ignore-output"]
if ros_available():
    view.stop()
    if node is not None:
        stop(node)
        print((workspace / "node.log").read_text().splitlines()[-1])

# %%
# Check: the node stopped without an error
assert node is None or node.returncode == 0

# %% [markdown]
# The node stopped without an error and printed its statistics. (*Ignored* images are images that came while the node had no subscriber. The node does not process them.)

# %% [markdown]
# ## 7 · Practice: where is the executable? ([[minutes]], deeper)
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
    hint="The parts are: install, package, lib, package, executable. The executable has the name of the package. install and package are the arguments: their values differ from call to call, so type no name of a folder but lib.",
    hints=(
        "Look at the path in section 6: which folders come after install, and how often does the name of the"
        " package occur?",
        "1. The parts are, in this order: install, the name of the package, lib, the name of the package, and the"
        " executable, which has the name of the package too.\n"
        "2. Join them with / between them.\n"
        "3. Return the string.",
        'return f"{install}/{...}/lib/{...}/{...}"',
    ),
    explanation="An f-string replaces each name in braces by its value. The package's name occurs three times: each"
    " package has a folder of its own in install, a folder of its own in lib, and here its executable has the"
    " same name. The path begins with install exactly as it is given, and nothing is searched on the disk.",
    another_way='You can also write "/".join([install, package, "lib", package, package]), or'
    " (Path(install) / package / \"lib\" / package / package).as_posix().",
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

# %% [markdown]
# ## 8 · Practice: run the edge node ([[minutes]], deeper)
#
# Now run the edge-detection node in the second terminal. Its thresholds are *parameters*, and you can set them in the command:
#
# ```sh
# install/image_edge_detection/lib/image_edge_detection/image_edge_detection --ros-args -p low:=50 -p high:=150
# ```
#
# Run the next cells and observe the edges. To try other thresholds, stop the node with Ctrl-C, press the arrow key ↑ to get the line back, change the numbers, and press Enter. (Without a terminal: change the numbers in the next cell, and run the next two cells again.)

# %%
edge_node = None

# %%
if ros_available():
    if edge_node is not None:
        stop(edge_node)  # the node of the previous run of this cell
    edge_topic = "/image_edge_detection/edges"
    edge_images = ImageSubscriber(edge_topic, encoding="mono8")
    time.sleep(1)
    if edge_images.matched == 0:  # no publisher: no node runs in a terminal
        folder = "install/image_edge_detection/lib/image_edge_detection/"
        parameters = "image_edge_detection --ros-args -p low:=50 -p high:=150"
        edge_node = start(sourced + "exec " + folder + parameters)

# %% tags=["nbval-ignore-output"]
if ros_available():
    edges = edge_images.wait(timeout=30)
    text = "ros2_packages/edges"
    edge_view = live_view(edge_images, encoding="mono8", text=text)

# %%
# Check: an edge image holds 0 and 255 only
assert not ros_available() or set(np.unique(edges)) <= {0, 255}

# %% [markdown]
# The second script, `scripts/image_edge_detection.py`, shows three images side by side: the frame, its gray image, and the edges. If you like, run it in place of the node of the package, and look at its images with `live_view("/image_edge_detection/view")` in a cell of your own.
#
# To stop the node, press Ctrl-C in the terminal. A node that the notebook started runs until the kernel stops; or set `stop_now = True` in the next cell and run it.

# %%
stop_now = False
if stop_now and edge_node is not None:
    edge_view.stop()
    stop(edge_node)

# %% [markdown]
# ## 9 · Your turn: a package of your own ([[minutes]], deeper)
#
# Write a third package, `image_negative`. Its node publishes the *negative* of each gray image: `255 - gray`, so black becomes white. With a full ROS 2 installation you would begin with
#
# ```sh
# ros2 pkg create image_negative --build-type ament_python --node-name image_negative --dependencies rclpy sensor_msgs
# ```
#
# and change the files. Here you write the three files that matter as texts; `package_files` returns them. (The other files are the same in each package: the cell below the check writes them.) Each step is one line of the check.
#
# 1. **package.xml.** Fill in the name and the build type, `ament_python`. The node imports `rclpy`, `sensor_msgs` and `cv2`: write an `exec_depend` for each, with its rosdep key. *Afterwards* colcon knows the package, and `rosdep` can install what it needs.
# 2. **setup.py.** Fill in the name and the folder with Python code. Install the marker and `package.xml`, as in section 2. The executable `image_negative` calls the function `main` of the node's file. *Afterwards* `ros2 run image_negative image_negative` finds it.
# 3. **The node.** Its name is `image_negative`. It subscribes to `/kachaka/front_camera/image_raw` (best effort, volatile, depth 5), and publishes `255 - gray` on `~/negative`, as `mono8` with the header of the message. A message that cannot be converted is logged as an error. Begin with your class of [[grayscale_node]]. *Afterwards* each image of the camera gives its negative.

# %% role="exercise"
exercise(
    "packages-own",
    subject="package",
    title="A package of your own",
    function="package_files",
    time_limit=5,
    allowed=("cv2", "imgproc_course.messages"),
    hint="Compare each file with the same file of image_gray_processor in section 2.",
    hints=(
        "Compare with the files of image_gray_processor in section 2: what is the same in each package, and"
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


# %% role="case" title="step 1: package.xml" points=1 hint="Compare with the package.xml in section 2: the name, one exec_depend for each import, the build type."
def inputs(rng):
    return ("package.xml", [])


# %% role="case" title="step 2: setup.py" points=1 hint="Compare with the setup.py in section 2, word by word."
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
# The next cell writes your files into the workspace, and the files that are the same in each package. Then it builds your package and starts its executable, as you did for the gray node. (With a full ROS 2 installation: `ros2 run image_negative image_negative`.)

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

# %% tags=["nbval-ignore-output"]
own_node, own_image = None, None
if own_result.passed and ros_available():
    write_package(same_files | package_files())
    run("python -m colcon build --packages-select image_negative")
    own_node = start(
        sourced + "exec install/image_negative/lib/image_negative/image_negative")
    print("my node subscribes to", camera.topic)
    own_images = ImageSubscriber("/image_negative/negative", encoding="mono8")
    own_image = own_images.wait(timeout=30)
    own_view = live_view(own_images, encoding="mono8", text="ros2_packages/own")
else:
    print("this needs a package that passes the check, and a running ROS 2")

# %%
# Check: your node publishes images of the camera's size
assert own_image is None or own_image.shape == (720, 1280)

# %% tags=["nbval-ignore-output"]
if own_node is not None:
    own_view.stop()
    stop(own_node)
    print("exit code:", own_node.returncode)

# %% [markdown]
# ## 10 · On the robot ([[minutes]], deeper)
#
# | in this course | with a full ROS 2 installation |
# |---|---|
# | `imgproc-course play` | the robot's own camera |
# | `python -m colcon build` | `rosdep install --from-paths src -i`, then `colcon build` |
# | `ament_index packages PKG` | `ros2 pkg prefix PKG` |
# | start `install/PKG/lib/PKG/EXE` | `ros2 run PKG EXE`, or `ros2 launch PKG PKG.launch.py` |
# | `ImageSubscriber(topic).measured_rate` | `ros2 topic hz TOPIC` |
# | `doctor()` | `ros2 doctor`, `ros2 topic info -v TOPIC` |
#
# On a computer with a full ROS 2 installation, these are the commands from the first to the last, in a workspace in your home folder:
#
# ```sh
# cd ~/ros2_ws
# colcon build --packages-select image_gray_processor image_edge_detection
# source install/setup.bash
# ros2 run image_gray_processor image_gray_processor
# ros2 run image_edge_detection image_edge_detection
# ```
#
# (Each `ros2 run` needs a terminal of its own, and each terminal must be sourced.) With a real Kachaka robot, these things change too:
#
# - **Topic names.** The camera's topic is `/kachaka/front_camera/image_raw`. A robot with another name has another *[[term:namespace]]*: the first part of the topic name (here `/kachaka`). Do not change the name in the code. Use *[[term:remapping]]* instead: start the node with `--ros-args -r /kachaka/front_camera/image_raw:=/my_robot/front_camera/image_raw`.
# - **Topics without messages.** The robot's *[[term:bridge]]* is the program that publishes the robot's data in ROS. It publishes images only while the topic has a subscriber, and it publishes `camera_info` only together with an image.
# - **Wi-Fi.** The raw images need 221 Mbit/s, which is too much for many Wi-Fi networks. Remap to the topic that ends in `/compressed`. The nodes can read compressed images too; you do not have to change them.
# - **Versions.** ROS 2 has a new *release* every year. The robot's bridge is made for the release *Humble*, and this course uses the release *Jazzy*. Do not mix two releases in one ROS graph: use a bridge that is built for Jazzy.
# - **Other robots.** A node only finds nodes with the same *[[term:domain]]*, a number. By default, all robots and almost all laptops in a classroom use domain 0. Give each robot and its laptop a domain of their own: `export ROS_DOMAIN_ID=7`.
# - **The charger.** While the robot is on its charger, its depth camera sends images of 0 × 0 pixels. A node must not stop because of them. Your nodes do not stop: `ImageProcessor` counts such an image as a failure and continues.

# %% [markdown]
# ## Recap
#
# A package is a folder with a fixed structure. Build it, source the workspace, and start the node by name. Deeper: in `package.xml`, write rosdep keys, not pip names; to use another topic, remap the topic in the command.
#
# | stage | shape | dtype | range | unit |
# |---|---|---|---|---|
# | `…/image_raw`, `rgb8` | (720, 1280, 3) | uint8 | 0 to 255 | gray level of red, green, blue |
# | `/image_gray_processor/gray`, `mono8` | (720, 1280) | uint8 | 0 to 255 | gray level |
# | `/image_edge_detection/edges`, `mono8` | (720, 1280) | uint8 | 0 and 255 | no and yes |

# %%
# Check: the Mbit/s of ten raw images per second
assert round(720 * 1280 * 3 * 8 * 10 / 1e6) == 221

# %% [markdown]
# ## 11 · Goodbye, and what next ([[minutes]])
#
# You began with the bytes of a message, and came to gray images and edges. You began with a function, and came to a node, and to a package that runs without a notebook. Well done!
#
# **Next:** in [[drive_the_robot]], the robot does what your code says. Then it sees what is in its way ([[obstacles_ahead]]), follows a ball ([[object_tracking]]), finds its own place ([[where_am_i]]), draws a map ([[mapping_and_slam]]), reads a sign ([[reading_text]]), names the things around it ([[recognising_objects]]), finds and hides faces ([[faces]]), obeys your hand ([[gestures]]), and does an errand ([[the_errand]]).
#
# **Go on with a robot of your own**
# - Every robot with a camera and ROS 2 publishes `sensor_msgs/Image`. Find its topic with `ros2 topic list`, and remap your nodes to it.
# - Without a robot, a webcam is enough: `open_camera("webcam")` publishes its images.
#
# **Go on with a node of your own**
# 1. Copy the folder `src/image_gray_processor` in your workspace, and replace the old name by a new one in all files, file names and folder names.
# 2. Replace the function `process` by your own: a threshold, a filter, the position of a coloured ball.
# 3. Write a small test with an image whose result you know. Build, source, run.
#
# **Go on reading**
# - ROS 2: the [tutorials of Jazzy](https://docs.ros.org/en/jazzy/Tutorials.html), first those on client libraries.
# - OpenCV: the [tutorials for Python](https://docs.opencv.org/4.x/d6/d00/tutorial_py_root.html). You know the functions of its first chapters already.
# - scikit-image: the [gallery of examples](https://scikit-image.org/docs/stable/auto_examples/index.html), each with images and code.
# - NumPy: [the absolute basics for beginners](https://numpy.org/doc/stable/user/absolute_beginners.html).
# - A book: R. Szeliski, [Computer Vision: Algorithms and Applications](https://szeliski.org/Book/), free to read on the web.
# - The paper behind [[canny_stages]]: J. Canny, [A Computational Approach to Edge Detection](https://doi.org/10.1109/TPAMI.1986.4767851), 1986.
