# ---
# jupyter:
#   imgproc_course:
#     title: Image processing in ROS 2
# ---

# %% [markdown]
# # Image processing in ROS 2
#
# A robot drives through a living room, and its camera sends ten images per second. In this course you learn what a program can do with them: from the bytes of a message to a node that finds edges, live. Everything runs on your computer; you need no robot.
#
# If this is your first visit, open [[start_here]].
#
# The table shows all lessons, what each needs, and how many of its exercises you have passed. Click a lesson to open it. To see your progress, click into the next cell and press **Shift + Enter**. If you follow a route (below), take the next lesson of your route.

# %% tags=["keep-output"]
from imgproc_course.exercises import overview

overview()

# %% [markdown]
# ## Routes
#
# Each lesson has a *core*, and sections that are marked *deeper*. Deeper sections can be left out: no core needs them. The table shows the minutes of the core and of the whole lesson, for somebody who knows a little Python and nothing of NumPy, ROS or image processing.
#
# - **The original lesson in one day** (about 6 hours): the cores of [[start_here]], [[arrays]], [[what_is_image_processing]], [[images_as_messages]], [[grayscale]], [[grayscale_node]], [[canny_stages]], [[edge_detection_node]] and [[ros2_packages]]. You write a node that converts images to gray, change it into one that finds edges with your thresholds, and build both as ROS 2 packages.
# - **The driving robot** (about 6 hours): after the first route, the cores of [[drive_the_robot]], [[obstacles_ahead]], [[object_tracking]] and [[where_am_i]]. A robot drives, brakes, follows a ball and finds its place. If you want more, take section 9 of [[obstacles_ahead]], and then section 10 of the last lesson: the robot explores rooms that nobody has shown to it.
# - **The whole course** (about 31 hours): all lessons in their order, with their deeper sections. The hours do not count the two optional lessons, [[mapping_and_slam]] and [[gestures]]: no route needs them.
#
# ## Beside the lessons
#
# - [Glossary](glossary.md): every term of the course in one or two sentences, with the lesson that introduces it.
# - [Cheat sheet](cheat_sheet.html): two pages to print: arrays, message fields, the stages of Canny, ROS commands.
# - A certificate: `certificate("Ada Lovelace")` in a new cell (with `from imgproc_course.exercises import certificate`) writes a page with what you have passed, to print.
# - Stuck in an exercise? Add a cell (press **Esc**, then `b`), and call `hint` in it, such as `hint("grayscale-luma")`: it shows the next of three hints. `solution("grayscale-luma")` opens after three tries.
#
# ## What happens to an image
#
# This is what happens to every image in the course. A *topic* is a named stream of messages; a *node* is a program that subscribes to topics and publishes on topics.
#
# ```mermaid
# %%{init: {"theme": "base", "themeVariables": {"primaryColor": "#e3eefc", "primaryTextColor": "#111", "lineColor": "#777", "tertiaryColor": "#ededed", "edgeLabelBackground": "#ededed"}}}%%
# flowchart TB
#     accTitle: What happens to an image
#     accDescr: The camera publishes messages on a topic. A node subscribes to the topic, converts and processes each image, and publishes the result on another topic, which the live view shows.
#     camera["camera<br/>(or the recording)"] -->|publishes| raw(["topic<br/>/kachaka/front_camera/image_raw"])
#     raw -->|"subscribes"| node["your node<br/>convert → process"]
#     node -->|publishes| edges(["topic<br/>~/edges"])
#     edges -->|subscribes| view["live view<br/>in the notebook"]
# ```
