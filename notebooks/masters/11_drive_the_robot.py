# ---
# jupyter:
#   imgproc_course:
#     title: Drive the robot
# ---

# %% [markdown]
# # Drive the robot
#
# Until now the robot drove, and you watched its images. Now you drive. The robot of this lesson is simulated: it drives through the room of the recording, and its camera sees what it would see there. It has the topics of the real robot, so what you write here can also drive a real one.
#
# **You will be able to**
# - say with two numbers how a robot moves, and compute the speed of each wheel and the next pose,
# - read and publish the messages of a moving robot: `Twist` and `Odometry`,
# - write a node that drives a square, and measure where the robot really ends,
# - compute how far a robot drives before it stands still, and protect it against a node that stops publishing.
#
# **Time** [[minutes]]. **You need** [[grayscale_node]] and [[ros2_packages]]. The cells that talk to ROS do nothing on a computer without ROS 2; everything else works there too.

# %% role="given" exercise=["drive-pose", "drive-stop"]
import math

# %%
import time

from matplotlib.figure import Figure

from imgproc_course.display import drive, show, show_figure
from imgproc_course.exercises import check, compare_guess, hint, solution
from imgproc_course.recording import open_recording
from imgproc_course.ros import Robot, RosSession, open_camera
from imgproc_course.ros import record, ros_available
from imgproc_course.simulation import Simulation

# %% role="texts"
figure_texts = {
    "start": (
        "What the camera of the robot sees at the start: the room of the recording.",
        "The living room from near the floor: a rug with a ball, a table, and a person in the background.",
    ),
    "circle": (
        "One turn with 0.2 m/s and 0.5 rad/s: the middle of the robot drives a circle, and the right wheel has the longer way.",
        "Three circles around one centre: the left wheel inside, the middle of the robot, and the right wheel outside.",
    ),
    "square": (
        "The square as the wheels counted it, and as the robot really drove it.",
        "Two paths that begin together: one is a square that closes; the other is turned a little more at each corner and ends beside the start.",
    ),
    "failure": (
        "What the camera sees at the end, without and with the rule.",
        "Left, large backs of books right in front of the camera; right, it still sees the whole room.",
    ),
    "drive": (
        "Click on the map, then hold an arrow key.",
        "The image of the robot's camera, a map of the room from above with the robot's way, and buttons for driving.",
    ),
    "live": (
        "The node drives the square. The map shows the way that the odometry counts.",
        "The image of the robot's camera, and a map from above on which a small square appears.",
    ),
    "mine": (
        "The first image of my own recording.",
        "The living room from near the floor.",
    ),
}

# %% [markdown]
# ## 1 · A room to drive in ([[minutes]])
#
# `Simulation` is a robot in a room, without ROS and without a clock. You will use it to try your code: the same commands give the same result in every run. It starts in the origin of the room (x = 0 m, y = 0 m) and looks along the axis x. `frame()` is the image of its camera, with 640 × 360 pixels.

# %%
robot = Simulation(seed=7, start=(0.0, 0.0, 0.0))
frame = robot.frame()
print(frame.shape, frame.dtype)
show(frame, text="drive_the_robot/start")

# %% [markdown]
# The same robot also runs in ROS. There it has a clock: it drives in real time, and any node can drive it. The next cell starts it (or joins it, if another notebook has started it).

# %% tags=["nbval-ignore-output"]
if ros_available():
    camera = open_camera("room", rate=10)  # images per second
    print("the robot publishes", camera.topic)

# %%
# Check: it has the topic of the real robot's camera
assert not ros_available() or camera.topic == "/kachaka/front_camera/image_raw"
assert frame.shape == (360, 640, 3)

# %% [markdown]
# **Drive it yourself.** Run the next cell, and click on the map beside the image. Hold an arrow key (or W, A, S, D): the robot drives as long as you hold it; with Shift it drives at half the speed. The buttons and a gamepad work too. Drive to the ball, and look at the map: it shows your way, and what the robot's laser scanner sees.

# %% tags=["nbval-ignore-output"]
if ros_available():
    live_robot = Robot()
    view = drive(live_robot, text="drive_the_robot/drive")

# %%
# Check: the view has no error
assert not ros_available() or view.error is None

# %% [markdown]
# When you have driven enough, run the next cell. It stops the view and the robot, so that your computer has time for the rest.

# %% tags=["nbval-ignore-output"]
if ros_available():
    view.stop()

# %%
# Check: the view had no error
assert not ros_available() or view.error is None

# %% [markdown]
# ## 2 · Two numbers move the robot ([[minutes]])
#
# A command has two numbers:
#
# - the **[[term:linear velocity]]** *v*, in metres per second: how fast the robot drives forward (negative: backward);
# - the **[[term:angular velocity]]** *ω* (omega), in radians per second: how fast it turns. Positive means to the **left**.
#
# A *[[term:radian]]* is an angle: half a turn is π = 3.14 radians, so one radian is about 57 degrees. ROS has a rule for units and axes, *REP 103*: metres, seconds and radians. On a robot, x points forward, y to the left and z up, and a positive angle turns to the left.
#
# The robot has two wheels, on the left and on the right. They are 0.20 m apart, and each has its own motor. (This is called a *[[term:differential drive]]*.) If both wheels have the same speed, the robot drives straight ahead. If the right wheel is faster, the robot turns to the left.
#
# The centre of the robot is in the middle between the wheels: each wheel is 0.10 m away from it. When the robot turns with ω, a point that is 0.10 m away moves with ω · 0.10 m/s. **Predict** the speed of the *right* wheel if the robot drives with v = 0.2 m/s and ω = 0.5 rad/s.

# %% role="predict"
guess_right = None  # your guess: how many metres per second?

# %%
v, w = 0.2, 0.5  # w stands for ω
half = 0.20 / 2  # metres from the centre to a wheel
left = v - w * half
right = v + w * half
print("left", round(left, 2), "m/s   right", round(right, 2), "m/s")
compare_guess(guess_right, round(right, 2), "m/s")

# %%
# Check: the numbers in this section
assert (round(left, 9), round(right, 9)) == (0.15, 0.25) and round(math.degrees(1)) == 57
assert round(math.pi, 2) == 3.14

# %% [markdown]
# ## 3 · Where the robot is after a step ([[minutes]])
#
# A *[[term:pose]]* of a robot on the floor has three numbers: `x` and `y`, its place in metres, and *[[term:yaw]]*, its direction in radians. Yaw 0 is along x; yaw grows when the robot turns to the left.
#
# In a short time `dt`, the robot drives the distance v · dt, and it turns by ω · dt. In which direction does it drive? At the beginning of the step its direction is `yaw`, at the end it is `yaw + ω · dt`. A good choice is the direction in the **middle**: `yaw + ω · dt / 2`. The cosine of this direction says how much of the way goes along x, and the sine how much goes along y.

# %%
x, y, yaw = 0.0, 0.0, 0.0
dt = 0.1  # seconds
middle = yaw + w * dt / 2
x = x + v * dt * math.cos(middle)
y = y + v * dt * math.sin(middle)
yaw = yaw + w * dt
print("x", round(x, 4), "  y", round(y, 4), "  yaw", round(yaw, 3))

# %% [markdown]
# After one step of 0.1 s, the robot has driven 2 cm and has turned by 0.05 rad. Now we do many such steps. With ω = 0.5 rad/s, a whole turn (2 π radians) takes 12.57 seconds. **Predict** how far from the start the robot is after this time.

# %% role="predict"
guess_circle = None  # your guess: how many metres?

# %%
steps = 200
dt = 2 * math.pi / w / steps
x, y, yaw = 0.0, 0.0, 0.0
path = [(x, y, yaw)]
for _ in range(steps):
    middle = yaw + w * dt / 2
    x = x + v * dt * math.cos(middle)
    y = y + v * dt * math.sin(middle)
    yaw = yaw + w * dt
    path.append((x, y, yaw))
compare_guess(guess_circle, abs(round(math.hypot(x, y), 3)), "m")  # hypot: from (0, 0) to (x, y)

# %% [markdown]
# The robot is back at the start: it has driven a circle. Its radius is v / ω = 0.4 m. **Look** at the ways of the two wheels.

# %% tags=["long"]
figure = Figure(figsize=(5, 4), layout="constrained")
axes = figure.subplots()
for name, offset in (("left wheel", 0.1), ("centre", 0), ("right wheel", -0.1)):
    across = [round(x - offset * math.sin(yaw), 3) for x, y, yaw in path]
    upward = [round(y + offset * math.cos(yaw), 3) for x, y, yaw in path]
    axes.plot(across, upward, label=name)
axes.plot(0, 0, "ko")
axes.annotate("start", (0, 0), (0.04, 0.08), arrowprops={"arrowstyle": "-"})
axes.set(xlabel="x (m)", ylabel="y (m)", aspect="equal")
axes.legend(loc="center")
show_figure(figure, text="drive_the_robot/circle")

# %%
# Check: the numbers in this section
assert round(2 * math.pi / w, 2) == 12.57 and v / w == 0.4 and math.hypot(x, y) < 1e-9
assert round(v * 0.1, 3) == 0.02 and round(w * 0.1, 3) == 0.05

# %% [markdown]
# After the circle, yaw is 6.28, but the direction is the same as at the start. Directions repeat after 2 π, so programs keep yaw between −π and π. `math.remainder(angle, 2 * math.pi)` does this: it adds or subtracts whole turns.

# %%
for angle in (1.0, 3.5, 6.28, -3.5):
    print(angle, "->", round(math.remainder(angle, 2 * math.pi), 3))

# %%
# Check: the numbers in this section
assert round(yaw, 2) == 6.28 and round(math.remainder(3.5, 2 * math.pi), 3) == -2.783

# %% [markdown]
# ### Your turn: the next pose
#
# Write `next_pose(x, y, yaw, linear, angular, dt)`: one step as above, with the direction in the middle of the step, and with the new yaw between −π and π. `math` is imported for you.
#
# | Input | Output | Example call |
# |---|---|---|
# | `x`, `y`: floats, metres; `yaw`: float, radians; `linear`: float, m/s; `angular`: float, rad/s; `dt`: float, seconds | three floats: the new `x`, `y` and `yaw` | `next_pose(0.0, 0.0, 0.0, 0.2, 0.5, 0.1)` returns about `0.02, 0.0005, 0.05` |

# %% role="exercise"
exercise(
    "drive-pose",
    title="The next pose",
    function="next_pose",
    tolerance=1e-6,
    hint="The robot drives linear * dt in the direction yaw + angular * dt / 2, and turns by angular * dt.",
    hints=(
        "Which direction has the robot in the middle of the step? And how far does it drive in dt seconds?",
        "1. The direction in the middle of the step: yaw plus half of the turn, angular * dt / 2.\n"
        "2. The distance: linear * dt. Add distance * cos(direction) to x, and distance * sin(direction) to y.\n"
        "3. The new yaw: yaw + angular * dt, brought between -pi and pi with math.remainder.\n"
        "4. Return all three.",
        "middle = yaw + angular * dt / 2\nx = x + linear * dt * math.cos(...)\ny = y + linear * dt * math.sin(...)\n"
        "yaw = math.remainder(..., 2 * math.pi)\nreturn x, y, yaw",
    ),
    explanation="In a step the robot drives a short arc. The straight line between the two ends of the arc has exactly"
    " the direction in the middle of the step, so this choice is better than the direction at the beginning or at the end."
    " math.remainder keeps yaw between -pi and pi, however often the robot turns.",
    another_way="You can also write (yaw + angular * dt + math.pi) % (2 * math.pi) - math.pi for the new yaw.",
)

# %% role="answer"
def next_pose(x, y, yaw, linear, angular, dt):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def next_pose(x, y, yaw, linear, angular, dt):
    middle = yaw + angular * dt / 2
    x = x + linear * dt * math.cos(middle)
    y = y + linear * dt * math.sin(middle)
    return x, y, math.remainder(yaw + angular * dt, 2 * math.pi)

# %% role="check"
check("drive-pose", next_pose)

# %% role="case" title="one step" points=1
def inputs(rng):
    return [
        (0.0, 0.0, 0.0, 0.2, 0.5, 0.1),
        (1.0, 2.0, round(rng.uniform(0.4, 1.2), 2), 0.3, round(rng.uniform(0.6, 1.2), 2), 0.5),
    ]


# %% role="case" title="a turn over the border at π" points=1 hint="The direction is yaw + angular * dt / 2, of the yaw before it is wrapped. The new yaw is between -pi and pi: math.remainder(angle, 2 * math.pi) adds or subtracts whole turns."
def inputs(rng):
    return [
        (-1.0, 0.5, round(rng.uniform(2.9, 3.1), 2), 0.2, round(rng.uniform(1.0, 1.5), 2), 0.5),
        (0.5, -0.5, round(rng.uniform(-3.1, -2.9), 2), -0.2, round(rng.uniform(-1.5, -1.0), 2), 0.4),
    ]


# %% role="hidden" title="any step" points=1 hint="Is the direction yaw + angular * dt / 2, and is the distance linear * dt?"
def inputs(rng):
    low, high = (-3, -3, -3.1, -0.3, -1.5, 0.05), (3, 3, 3.1, 0.3, 1.5, 0.5)
    return [tuple(float(value) for value in rng.uniform(low, high).round(3)) for _ in range(5)]


# %% [markdown]
# ## 4 · The messages of a moving robot ([[minutes]])
#
# In ROS, a command is a message of the type `geometry_msgs/Twist`. It has six numbers, because it can also describe a drone. A robot on the floor uses two of them: `linear.x` is v, and `angular.z` is ω, a turn about the axis z. Write 1.0, not 1: rclpy does not convert it, and the robot gets a wrong number.

# %%
if ros_available():
    from geometry_msgs.msg import Twist
    from nav_msgs.msg import Odometry

    command = Twist()
    command.linear.x = 0.2
    command.angular.z = 0.5
    print("forward", command.linear.x, "m/s   to the left", command.angular.z, "rad/s")

# %% [markdown]
# The robot answers with messages of the type `nav_msgs/Odometry`, about 50 per second. They say where the robot is, as its wheels count it. The direction is not a yaw but a *[[term:quaternion]]*: four numbers `x`, `y`, `z`, `w` that describe a turn in space. For a robot on the floor, x and y are 0, `z` is the sine of half the yaw, and `w` is its cosine. So `2 * math.atan2(z, w)` is the yaw. (`atan2` computes an angle from its sine and its cosine.) **Predict** the yaw in degrees for z = 0.7071 and w = 0.7071.

# %% role="predict"
guess_yaw = None  # your guess: how many degrees?

# %%
def yaw_of(orientation):
    return 2 * math.atan2(orientation.z, orientation.w)


right_angle = 2 * math.atan2(0.7071, 0.7071)
compare_guess(guess_yaw, round(math.degrees(right_angle), 1), "degrees")

# %%
# Check: a quarter turn
assert round(math.degrees(right_angle), 1) == 90.0 and round(math.sin(math.pi / 4), 4) == 0.7071

# %% [markdown]
# `Robot` is the course's class for the robot in ROS. Its `drive` publishes commands again and again, and at the end one that stops the robot. Its `odometry` is the newest message of the odometry.

# %% tags=["nbval-ignore-output"]
if ros_available():
    live_robot.drive(0.2, 0.5, seconds=2.0)
    msg = live_robot.odometry
    place = msg.pose.pose.position
    print("frame", msg.header.frame_id)
    print("x", round(place.x, 2), "m   y", round(place.y, 2), "m")
    print("yaw", round(yaw_of(msg.pose.pose.orientation), 2), "rad")

# %%
# Check: the message of the odometry
assert not ros_available() or (isinstance(msg, Odometry) and msg.header.frame_id == "odom")

# %% [markdown]
# ## 5 · Drive a square ([[minutes]])
#
# How does a robot know where it is? It counts the turns of its wheels, and adds up steps like yours. This is called *[[term:odometry]]*. The next class uses it to drive a square. `command` gets the pose of the odometry, and returns the next v and ω. You know this form from [[grayscale_node#2]].

# %% tags=["long"]
class SquareDriver:
    def __init__(self, side):
        self.side = side  # metres
        self.corner = None  # where this side began
        self.sides = 0  # how many are done

    def command(self, x, y, yaw):
        if self.corner is None:  # the first call
            self.corner, self.direction = (x, y), yaw
        missing = self.side - math.dist(self.corner, (x, y))
        if missing < 0.01:  # the next side: a quarter turn to the left
            self.corner = (x, y)
            self.direction = self.direction + math.pi / 2
            self.sides = self.sides + 1
        if self.sides == 4:
            return 0.0, 0.0
        turn = math.remainder(self.direction - yaw, 2 * math.pi)
        if abs(turn) > 0.1:  # first turn on the spot
            return 0.0, max(-1.0, min(1.0, 3 * turn))
        return min(0.3, 2 * missing), 3 * turn

# %% [markdown]
# - `missing` is how much of this side is left, in metres: `math.dist` is the distance between two points. The robot drives slower when little is left.
# - `turn` is how far the robot must still turn, in radians. While it drives, it also corrects small errors of its direction: `3 * turn`. `max(-1.0, min(1.0, …))` keeps the angular velocity between −1 and 1 rad/s.
#
# Drive a square with sides of 0.6 m. `robot.odometry()` is what the wheels say, and `robot.pose("robot")` is the truth, which only a simulation knows.

# %% tags=["long"]
def true_place():
    return [round(float(value), 3) for value in robot.pose("robot")[:2]]


driver = SquareDriver(0.6)
counted, true = [(0.0, 0.0)], [true_place()]
while driver.sides < 4:
    odometry = robot.odometry()
    linear, angular = driver.command(odometry.x, odometry.y, odometry.yaw)
    robot.step(linear, angular)  # 0.02 s
    counted.append((round(odometry.x, 3), round(odometry.y, 3)))
    true.append(true_place())
print(len(true), "steps of 0.02 s:", round(0.02 * len(true)), "s")
print("the odometry says:", round(math.dist(counted[0], counted[-1]), 2), "m from the start")

# %% [markdown]
# The odometry says that the robot is back at the start. **Predict** how far from the start it really is.

# %% role="predict"
guess_drift = None  # your guess: how many metres?

# %%
drift = math.dist(true[0], true[-1])
compare_guess(guess_drift, round(drift, 2), "m")

# %%
figure = Figure(figsize=(6, 4.5), layout="constrained")
axes = figure.subplots()
for name, path in (("odometry", counted), ("truth", true)):
    axes.plot([x for x, y in path], [y for x, y in path], label=name)
axes.plot(0, 0, "ko")
axes.annotate("start", (0, 0), (-0.08, -0.05))
axes.set(xlabel="x (m)", ylabel="y (m)", aspect="equal")
axes.legend(loc="center")
show_figure(figure, text="drive_the_robot/square")

# %%
# Check: the numbers in this section
assert len(true) == 891 and round(0.02 * len(true)) == 18
assert round(drift, 2) == 0.15 and math.dist(counted[0], counted[-1]) < 0.01
true_yaw = 2 * math.atan2(*robot.pose("robot")[5:])
wrong_yaw = math.remainder(true_yaw - robot.odometry().yaw, 2 * math.pi)
assert round(math.degrees(wrong_yaw)) == 20

# %% [markdown]
# The robot is 15 cm away from its start, and its direction is wrong by 20 degrees. The odometry notices nothing: the wheels are not exactly as large as the robot believes, and they slip a little. Each error stays and is added to the next one. This is called *[[term:drift]]*. So a robot also needs something outside itself: a camera, a laser scanner, a map.
#
# ROS has a name for each of these views, a *[[term:coordinate frame]]* (not a frame of the camera): in `odom`, the robot's place is what the odometry says; in `world` (on many robots `map`), it is where the robot really is in the room; and `base_footprint` moves with the robot.
#
# Now the same class drives the robot in ROS. Each odometry message calls it, and its answer is published as a `Twist`. If no odometry arrives, the node sends no command.

# %% tags=["long"]
if ros_available():
    from rclpy.node import Node
    from rclpy.qos import qos_profile_sensor_data

    class SquareNode(Node):
        def __init__(self, side, context=None):
            super().__init__("square", context=context)
            self.driver = SquareDriver(side)
            self.publisher = self.create_publisher(
                Twist, "/kachaka/manual_control/cmd_vel", qos_profile_sensor_data)
            self.create_subscription(
                Odometry, "/kachaka/odometry/odometry", self.on_odometry,
                qos_profile_sensor_data)

        def on_odometry(self, msg):
            place = msg.pose.pose.position
            yaw = yaw_of(msg.pose.pose.orientation)
            command = Twist()
            command.linear.x, command.angular.z = self.driver.command(
                place.x, place.y, yaw)
            self.publisher.publish(command)

# %% [markdown]
# `restart` puts the robot to the origin of the room, where there is enough space; its odometry begins at zero again. Then it drives a small square, with sides of 0.3 m. Watch the map. (A line below the image may say that two publishers send commands now: your `live_robot` and the node. The robot follows the newest command.)

# %% tags=["nbval-ignore-output", "long"]
if ros_available():
    live_robot.restart(start=(0.0, 0.0, 0.0))
    view = drive(live_robot, text="drive_the_robot/live")
    session = RosSession.current()
    node = session.add_node(SquareNode(0.3, context=session.context))  # context: of this kernel's session
    end = time.monotonic() + 60
    while node.driver.sides < 4 and time.monotonic() < end:
        time.sleep(0.1)
    session.remove_node(node)
    view.stop()
    print("sides driven:", node.driver.sides)

# %%
# Check: the node drove
assert not ros_available() or node.driver.sides == 4

# %% [markdown]
# ## 6 · How far until it stands? ([[minutes]])
#
# The robot sees an obstacle. How many metres does it still drive before it stands still? There are three parts:
#
# 1. It waits for the next frame. With a *rate* of 10 frames per second, it waits up to 1/10 s.
# 2. It computes, and the command travels to the wheels. This time is the *[[term:latency]]*, for example 0.06 s. Until then, the robot drives on with its speed.
# 3. It brakes. With a *[[term:deceleration]]* a (in m/s²: how much slower it becomes in each second), it needs v² / (2 a) metres.
#
# Our robot brakes with 0.6 m/s². At 0.3 m/s it drives 0.3 · (0.1 + 0.06) = 0.048 m before it brakes, and 0.3² / (2 · 0.6) = 0.075 m while it brakes. Together these are 0.123 m, its *[[term:stopping distance]]*. **Predict** the stopping distance at half the speed, 0.15 m/s.

# %% role="predict"
guess_stop = None  # your guess: how many metres?

# %%
def distance_of(speed):
    before = speed * (1 / 10 + 0.06)
    braking = speed**2 / (2 * 0.6)
    return before + braking


print("0.30 m/s:", round(distance_of(0.3), 3), "m")
compare_guess(guess_stop, round(distance_of(0.15), 3), "m")

# %% [markdown]
# It is less than half: the braking distance depends on the *square* of the speed. Does the formula agree with the robot? We let a robot drive on for 0.16 s (eight steps of 0.02 s), and then brake.

# %% tags=["long"]
def measured(speed):
    robot = Simulation(seed=2)
    for _ in range(100):
        robot.step(speed, 0.0)
    seen = robot.pose("robot")  # now the obstacle appears
    for _ in range(8):
        robot.step(speed, 0.0)
    while robot.speeds[0] > 0:
        robot.step(0.0, 0.0)
    return math.dist(seen[:2], robot.pose("robot")[:2])


for speed in (0.1, 0.2, 0.3):
    print(speed, "m/s   formula", round(distance_of(speed), 3), "m   measured", round(measured(speed), 3), "m")

# %%
# Check: the numbers in this section
assert round(distance_of(0.3), 3) == 0.123 and round(distance_of(0.15), 3) == 0.043
assert round(0.3 * 0.16, 3) == 0.048 and round(0.3**2 / 1.2, 3) == 0.075 and round(8 * 0.02, 2) == 0.16
for speed in (0.1, 0.2, 0.3):
    assert abs(measured(speed) - distance_of(speed)) < 0.005

# %% [markdown]
# ### Your turn: the stopping distance
#
# Write `stopping_distance(speed, deceleration, rate, latency)`.
#
# | Input | Output | Example call |
# |---|---|---|
# | `speed`: float, m/s, not negative; `deceleration`: float, m/s²; `rate`: float, frames per second; `latency`: float, seconds | float: the stopping distance in metres, if the obstacle appears just after a frame was taken | `stopping_distance(0.3, 0.6, 10, 0.06)` returns `0.123` |

# %% role="exercise"
exercise(
    "drive-stop",
    title="The stopping distance",
    function="stopping_distance",
    tolerance=1e-6,
    hint="The robot drives speed * (1 / rate + latency) before it brakes, and speed ** 2 / (2 * deceleration) while it brakes.",
    hints=(
        "For how many seconds does the robot drive on before it brakes, if the rate is 10 frames per second?",
        "1. The time before braking: one frame takes 1 / rate seconds, and the latency is added.\n"
        "2. The way before braking: speed times this time.\n"
        "3. The way of braking: the square of the speed, divided by twice the deceleration.\n"
        "4. Return the sum of both ways.",
        "before = speed * (1 / rate + ...)\nbraking = speed ** 2 / (2 * ...)\nreturn before + braking",
    ),
    explanation="Before the robot brakes, its speed is constant, so the way is speed times time. While it brakes, its speed"
    " goes down to 0 evenly, in speed / deceleration seconds; the mean speed is half of the first one, so the way is"
    " speed ** 2 / (2 * deceleration). The obstacle may appear just after a frame: then a whole 1 / rate is lost.",
    another_way="You can also compute the time of braking, speed / deceleration, and multiply it by speed / 2.",
)

# %% role="answer"
def stopping_distance(speed, deceleration, rate, latency):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def stopping_distance(speed, deceleration, rate, latency):
    before = speed * (1 / rate + latency)
    braking = speed**2 / (2 * deceleration)
    return before + braking


# %% role="check"
check("drive-stop", stopping_distance)

# %% role="case" title="the robot of the lesson" points=1
def inputs(rng):
    return [(0.3, 0.6, 10.0, 0.06), (round(rng.uniform(0.1, 0.25), 2), 0.6, 10.0, 0.1),
            (round(rng.uniform(0.1, 0.3), 3), 0.6, 10.0, round(rng.uniform(0.02, 0.2), 3))]


# %% role="case" title="another robot" points=1 hint="Do you use all four arguments, and no number of the example?"
def inputs(rng):
    speed, deceleration, rate, latency = rng.uniform((0.5, 0.8, 12, 0.02), (2.0, 3.0, 40, 0.3)).round(2)
    return [(float(speed), float(deceleration), float(rate), float(latency)), (0.0, 1.0, 30.0, 0.05)]


# %% role="hidden" title="any robot" points=1 hint="Which part of the way depends on the square of the speed?"
def inputs(rng):
    low, high = (0.1, 0.3, 5, 0.0), (2.0, 4.0, 60, 0.4)
    return [tuple(float(value) for value in rng.uniform(low, high).round(3)) for _ in range(4)]


# %% [markdown]
# ## 7 · Planned failure: the node stops publishing ([[minutes]])
#
# A node sends `linear.x = 0.3`, and then it ends with an error. Nobody sends a new command. What does the robot do? Suppose it simply keeps the last command. **Predict** how far it drives until it bumps into something.

# %% role="predict"
guess_bump = None  # your guess: how many metres?

# %% tags=["long"]
def drive_on(robot, longest_age):
    """Drives with one last command, until the robot bumps or stands still."""
    start = robot.pose("robot")
    for step in range(2000):
        age = 0.02 * step  # seconds since the last command
        if age < longest_age:
            robot.step(0.3, 0.0)
        else:
            robot.step(0.0, 0.0)  # the command is too old
        if robot.bumped or robot.speeds[0] == 0:
            break
    return math.dist(start[:2], robot.pose("robot")[:2])


without_rule = Simulation(seed=2)
distance = drive_on(without_rule, longest_age=math.inf)
compare_guess(guess_bump, round(distance, 1), "m")

# %% [markdown]
# The robot drives 5.3 m through the whole room, until it bumps into the bookcase. **Repair it**: a robot must not obey an old command. The Kachaka stops if no new command comes for 0.5 s, and so does ours. (Such a rule is called a *[[term:watchdog]]*.) Therefore a node that wants to drive must publish again and again, also if the command does not change.

# %%
with_rule = Simulation(seed=2)
short = drive_on(with_rule, longest_age=0.5)
print("with the rule:", round(short, 2), "m")
show([without_rule.frame(), with_rule.frame()], ["without", "with"],
     text="drive_the_robot/failure")

# %%
# Check: the numbers in this section
assert round(distance, 1) == 5.3 and round(short, 2) == 0.15
assert without_rule.bumped and not with_rule.bumped

# %% [markdown]
# Does the robot in ROS have the rule? The next cell sends commands for one second, and then nothing. It waits until the odometry says that the robot stands still: about 0.4 s later it brakes, which takes 0.3 s.

# %% tags=["nbval-ignore-output"]
if ros_available():
    for _ in range(10):
        live_robot.drive(0.2, 0.0)
        time.sleep(0.1)
    begin = time.monotonic()
    while live_robot.odometry.twist.twist.linear.x != 0:
        time.sleep(0.02)
        if time.monotonic() > begin + 30:
            break
    print("stands still after", round(time.monotonic() - begin, 1), "s")

# %%
# Check: the robot stands still, and nobody stopped it
assert not ros_available() or live_robot.odometry.twist.twist.linear.x == 0

# %% [markdown]
# ## 8 · Record your own drive ([[minutes]])
#
# `record` writes topics of the robot into a new folder beside this notebook: here images, depth and odometry. The format is *MCAP*, which other programs, such as Foxglove, open too. `open_recording` opens the folder, so you can run your functions of every lesson on your own drive. Change the command in the next cell as you like. `with` ends the recording after the drive. (In a terminal, `imgproc-course record` does the same.)

# %% tags=["nbval-ignore-output"]
if ros_available():
    folder = time.strftime("my_drive_%Y-%m-%d_%H-%M-%S")
    camera = open_camera("room", rate=10)  # if it has been stopped
    live_robot.restart(start=(0.0, 0.0, 0.0))
    topics = [camera.compressed_topic, camera.info_topics[0],
              "/kachaka/front_camera/depth", "/kachaka/odometry/odometry"]
    with record(topics, folder):
        live_robot.drive(0.2, 0.4, seconds=4.0)
    camera.stop()
    my_drive = open_recording(folder)
    print(folder, "has", len(my_drive), "images")
    show(my_drive.frame(0), text="drive_the_robot/mine")

# %%
# Check: the recording has images of the room's camera
assert not ros_available() or my_drive.frame(0).shape == (360, 640, 3)

# %% [markdown]
# ## Recap
#
# Two numbers move a robot: v and ω. Odometry adds up small steps and drifts, so a robot also needs to see the room. Before it stands still, it drives for the time of one frame and the latency, and then it brakes. A node that drives publishes again and again, because an old command stops the robot.
#
# | stage | type | fields | unit |
# |---|---|---|---|
# | command, `/kachaka/manual_control/cmd_vel` | `geometry_msgs/Twist` | `linear.x`, `angular.z` | m/s, rad/s |
# | odometry, `/kachaka/odometry/odometry` | `nav_msgs/Odometry` | `pose.pose` in the frame `odom`; `twist.twist` | metres and a quaternion; m/s, rad/s |
# | *frame*, `/kachaka/front_camera/image_raw` | `sensor_msgs/Image` | (360, 640, 3) uint8 | gray level of blue, green, red |
# | pose | three floats | x, y, yaw | metres, radians (−π to π) |
# | wheel speeds | two floats | left, right | m/s |
# | stopping distance | one float | | metres |
#
# **Next:** [[obstacles_ahead]]. First choose **File → Close and Shut Down Notebook**: it frees the robot.

# %%
# Check: the shape in the table
assert frame.shape == (360, 640, 3)
