# %% [markdown]
# # obstacles-plane

# %%
def normal_of(a, b, c):
    normal = np.cross(b - a, c - a)
    return normal / np.linalg.norm(normal)

# %% role="mistake" name="cross product of the points" says="You took the cross product of points. Take it of two directions in the plane: b - a and c - a."
def plane_of(a, b, c):
    normal = np.cross(b, c)
    normal = normal / np.linalg.norm(normal)
    normal = -normal if normal[1] > 0 else normal
    return normal, float(-(normal @ a))

# %% role="mistake" name="one direction is a point" says="One of your two vectors is a point, and not a direction in the plane. Both must be differences of points: b - a and c - a."
def plane_of(a, b, c):
    normal = np.cross(b - a, c)
    normal = normal / np.linalg.norm(normal)
    normal = -normal if normal[1] > 0 else normal
    return normal, float(-(normal @ a))

# %% role="mistake" name="divided by the squared length" says="You divided by the square of the length: its root is missing. The length is np.linalg.norm(normal)."
def plane_of(a, b, c):
    normal, offset = solution(a, b, c)
    length = np.linalg.norm(np.cross(b - a, c - a))
    return normal / length, offset / length

# %% role="mistake" name="divided by the sum" says="You divided by the sum of the three numbers without signs. The length is the root of the sum of their squares: np.linalg.norm(normal)."
def plane_of(a, b, c):
    normal = np.cross(b - a, c - a)
    normal = normal / np.abs(normal).sum()
    normal = -normal if normal[1] > 0 else normal
    return normal, float(-(normal @ a))

# %% role="mistake" name="divided by the signed sum" says="You divided by the sum of the three numbers. The length is the root of the sum of their squares: np.linalg.norm(normal)."
def plane_of(a, b, c):
    normal = np.cross(b - a, c - a)
    normal = normal / normal.sum()
    normal = -normal if normal[1] > 0 else normal
    return normal, float(-(normal @ a))

# %% role="mistake" name="divided by the largest" says="Your y is -1: you divided by the largest number of the vector, or by its y. Divide by its length: np.linalg.norm(normal)."
def plane_of(a, b, c):
    normal = np.cross(b - a, c - a)
    normal = normal / np.abs(normal).max()
    normal = -normal if normal[1] > 0 else normal
    return normal, float(-(normal @ a))

# %% role="mistake" name="offset 0" says="Your offset is 0. It must give the point a the height 0: -(normal @ a)."
def plane_of(a, b, c):
    return solution(a, b, c)[0], 0.0

# %% role="mistake" name="offset is the distance of a" says="Your offset is how far the point a is from the camera. The offset is measured along the normal: -(normal @ a)."
def plane_of(a, b, c):
    return solution(a, b, c)[0], float(np.linalg.norm(a))

# %% role="mistake" name="offset is the y of a" says="Your offset is the y of a point. This is right for a level floor only; in general it is -(normal @ a)."
def plane_of(a, b, c):
    return solution(a, b, c)[0], float(a[1])

# %% role="mistake" name="all signs made negative" says="You changed the signs of single numbers, as with abs. Turn the whole vector: normal = -normal."
def plane_of(a, b, c):
    normal = -np.abs(normal_of(a, b, c))
    return normal, float(-(normal @ a))

# %% role="mistake" name="only y made negative" says="You changed the sign of y alone, so the vector is no longer perpendicular to the plane. Turn the whole vector: normal = -normal."
def plane_of(a, b, c):
    normal = normal_of(a, b, c)
    normal[1] = -abs(normal[1])
    return normal, float(-(normal @ a))

# %% role="mistake" name="dot product of the directions" says="Your normal is one number: so is a dot product (np.dot, @), and so is a length, np.linalg.norm. The normal is the cross product of both directions, divided by its length."
def plane_of(a, b, c):
    normal = np.dot(b - a, c - a)
    normal = normal / np.linalg.norm(normal)
    return normal if normal[1] < 0 else -normal

# %% role="mistake" name="rounded to two digits" says="The numbers are rounded. Return the exact numbers, and leave round out."
def plane_of(a, b, c):
    normal, offset = solution(a, b, c)
    return normal.round(2), round(offset, 2)

# %% role="mistake" name="turned by z" says="Not all your normals point up, as if z (ahead) or a point decided. Look at the y, normal[1]: it must be negative."
def plane_of(a, b, c):
    normal = normal_of(a, b, c)
    normal = -normal if normal[2] > 0 else normal
    return normal, float(-(normal @ a))

# %% [markdown]
# # obstacles-nearest

# %%
def smallest(forward, mask):
    return float(forward[mask].min()) if mask.any() else math.inf

def standing(height):
    return (height > 0.03) & (height < 0.40)

# %% role="mistake" name="only the left half" says="Only the left half of the corridor counts. Use np.abs(left) <= width / 2, for both sides."
def nearest_obstacle(forward, left, height, width):
    return smallest(forward, (left >= 0) & (left <= width / 2) & standing(height))

# %% role="mistake" name="only the left half, whole width" says="Your corridor reaches from the middle to the left only, over the whole width. Its middle is straight ahead: np.abs(left) <= width / 2."
def nearest_obstacle(forward, left, height, width):
    return smallest(forward, (left >= 0) & (left <= width) & standing(height))

# %% role="mistake" name="above 0" says="Points 2 cm high count here, as if by height > 0. Points up to 3 cm are no obstacles: height > 0.03."
def nearest_obstacle(forward, left, height, width):
    return smallest(forward, (np.abs(left) <= width / 2) & (height > 0) & (height < 0.40))

# %% role="mistake" name="the limits count too" says="Points exactly 0.03 m or 0.40 m high count here. Obstacles are higher than 0.03 m and lower than 0.40 m: > and <, without =."
def nearest_obstacle(forward, left, height, width):
    return smallest(forward, (np.abs(left) <= width / 2) & (height >= 0.03) & (height <= 0.40))

# %% role="mistake" name="no height" says="Floor and high things count too: both height > 0.03 and height < 0.40 must hold, joined by &."
def nearest_obstacle(forward, left, height, width):
    return smallest(forward, np.abs(left) <= width / 2)

# %% role="mistake" name="the farthest, 0 for a free corridor" says="You return the farthest obstacle. The nearest one has the smallest forward: begin with best = math.inf, and keep what is smaller."
def nearest_obstacle(forward, left, height, width):
    mask = (np.abs(left) <= width / 2) & standing(height)
    return float(forward[mask].max(initial=0))

# %% role="mistake" name="the mean" says="You return the mean of all obstacles. The nearest one has the smallest forward: min."
def nearest_obstacle(forward, left, height, width):
    mask = (np.abs(left) <= width / 2) & standing(height)
    return float(forward[mask].mean()) if mask.any() else math.inf

# %% role="mistake" name="the nearest of all points" says="Your minimum is that of all points. Select the points in the corridor first: forward[mask].min()."
def nearest_obstacle(forward, left, height, width):
    mask = (np.abs(left) <= width / 2) & standing(height)
    return float(forward.min()) if mask.any() else math.inf

# %% role="mistake" name="the first point" says="You return the first point in the corridor. The points have no order: take the smallest forward, forward[mask].min()."
def nearest_obstacle(forward, left, height, width):
    mask = (np.abs(left) <= width / 2) & standing(height)
    return float(forward[mask][0]) if mask.any() else math.inf

# %% role="mistake" name="the index" says="You return the index of a point, as argmin gives it. Return the distance: min."
def nearest_obstacle(forward, left, height, width):
    mask = (np.abs(left) <= width / 2) & standing(height)
    return int(forward[mask].argmin()) if mask.any() else math.inf

# %% role="mistake" name="the straight distance" says="You return the straight distance, with the sideways part. The task asks for how far ahead: the smallest forward."
def nearest_obstacle(forward, left, height, width):
    return smallest(np.hypot(forward, left), (np.abs(left) <= width / 2) & standing(height))

# %% role="mistake" name="-1 for a free corridor" says="You return -1 for a free corridor, and a robot would take it for something very near. Return math.inf."
def nearest_obstacle(forward, left, height, width):
    distance = solution(forward, left, height, width)
    return -1.0 if distance == math.inf else distance

# %% role="mistake" name="the minimum of nothing" says="If no point is in the corridor, min fails, because there is nothing to compare. Return math.inf in this case: if not mask.any()."
def nearest_obstacle(forward, left, height, width):
    mask = (np.abs(left) <= width / 2) & standing(height)
    return float(forward[mask].min())

# %% [markdown]
# # obstacles-brake

# %%
def with_scans(change):
    """The right node, which gets changed scans."""

    def on_scan(node, msg):
        change(msg)
        solution.on_scan(node, msg)

    return type("BrakeNode", (solution,), {"on_scan": on_scan})

def turn(angle):
    return lambda msg: setattr(msg, "angle_min", msg.angle_min + angle)

def nothing_near(msg):
    msg.ranges = [math.inf] * len(msg.ranges)

def what_is_behind(msg):
    angles = msg.angle_min + msg.angle_increment * np.arange(len(msg.ranges)) + math.pi / 2
    ways = np.nan_to_num(msg.ranges, nan=math.inf, posinf=0.0)
    if np.any((ways >= msg.range_min) & (ways <= msg.range_max) & (np.cos(angles) < 0)
              & (np.abs(ways * np.sin(angles)) <= 0.2)):
        msg.ranges = [0.3] * len(msg.ranges)

def nan_is_near(msg):
    msg.ranges = [0.1 if math.isnan(value) else value for value in msg.ranges]

# %% role="mistake" name="never stops" says="Your robot stands for none of the scans of these checks. Print the angle, forward and left of a range of 0.3 m straight ahead: are they 0, 0.3 and 0? An angle is angle_min + index * angle_increment + math.pi / 2, in radians. One range in the corridor is enough to publish 0.0."
BrakeNode = with_scans(nothing_near)

# %% role="mistake" name="the angle of the scan itself" says="Your node looks to the left of the robot. Straight ahead is where the angle of the scan plus math.pi / 2 is 0: laser_frame is turned by 90 degrees. Forward is the range times the cosine of this sum, left its sine."
BrakeNode = with_scans(turn(-math.pi / 2))

# %% role="mistake" name="looks behind" says="Your node looks behind the robot. The angle seen from the robot is angle_min + index * angle_increment + math.pi / 2: all three parts count. Forward is the range times its cosine, left its sine."
BrakeNode = with_scans(turn(math.pi))

# %% role="mistake" name="never drives" says="Your robot drives for none of the scans of these checks. Publish a command for each scan: 0.2 where nothing is in the way. Or does something count that is not in the corridor: what is behind, or far to one side (abs of left)?"
BrakeNode = with_scans(lambda msg: setattr(msg, "ranges", [0.3] * len(msg.ranges)))

# %% role="mistake" name="what is behind counts" says="What is behind the robot stops it, too. Something is in its way only if its forward is above 0, and not above 0.4."
BrakeNode = with_scans(what_is_behind)

# %% role="mistake" name="drives backward" says="Your robot drives backward: by REP 103, x points forward, so linear.x is 0.2."
class BrakeNode(solution):
    def __init__(self):
        super().__init__()
        self.forward, self.commands = self.commands, self

    def publish(self, command):
        command.linear.x = -command.linear.x
        self.forward.publish(command)

# %% role="mistake" name="nan is near" says="nan stops your robot. Each comparison with nan is False, so it counts if you only ask what is too near or too far: leave out first what is not between range_min and range_max."
BrakeNode = with_scans(nan_is_near)

# %% role="mistake" name="what is below range_min counts" says="Ranges below range_min stop your robot. They are no measurements: the scanner sees itself. Leave them out: ranges >= msg.range_min."
BrakeNode = with_scans(lambda msg: setattr(msg, "range_min", 0.0))

# %% role="mistake" name="drives on without scans" says="When no scan comes any more, your newest command stays 0.2, and the robot drives on without seeing. A timer must publish Twist() then, and each scan must reset it."
class BrakeNode(solution):
    def stop(self):
        pass

# %% role="mistake" name="the timer is never reset" says="Your timer stops the robot also while scans come: its 0.5 s must count from the last scan. Make one timer in __init__, and call self.timer.reset() in on_scan."
class BrakeNode(solution):
    def __init__(self):
        super().__init__()
        self.timer, self.other = self.create_timer(9.0, self.stop), self.timer

# %% [markdown]
# # obstacles-drive

# %% role="mistake" name="it drives backward" says="It drove backward, where the camera sees nothing. The linear speed is the first number that you return: is it the second one here, or is it negative?"
def control(observation, memory):
    linear, angular = solution(observation, memory)
    return angular, linear

# %% role="mistake" name="its speeds are too large" says="Usual causes: an angle is in degrees (all angles here are in radians), or the two numbers are exchanged (the linear speed is the first)."
def control(observation, memory):
    linear, angular = solution(observation, memory)
    return linear, math.degrees(angular)

# %% role="mistake" name="it drives the same way" says="Your robot drives the same way in each room, whatever it sees. Use the observation (or is a condition on it never true?): things stand at other places each time."
def control(observation, memory):
    return 0.25, 0.3

# %% role="mistake" name="it stands at the goal" says="Do not stop there: choose another goal in a direction in which free_way is long, and drive on."
def control(observation, memory):
    x, y, _ = observation["odometry"]
    if memory.setdefault("stands", False) or math.dist((x, y), (2.2, 0.0)) < 0.4:
        memory["stands"] = True
        return 0.0, 0.0
    return solution(observation, memory)

# %% role="mistake" name="it stands" says="If the way ahead is not free, turn to a direction in which free_way is long, and drive on."
def control(observation, memory):
    if free_way(obstacles(observation), 0.0) < 0.45:
        return 0.0, 0.0
    return 0.3, 0.0

# %% role="mistake" name="it turns on the spot" says="Usual causes: it looks for a way on one side only, or in a few directions; the stored direction is in the frame of the odometry, and the turn is this direction minus the yaw, wrapped; points of earlier looks are not turned back before free_way is asked, or to the wrong side; an angle is in degrees (the yaw is in radians). Print which directions are free for your function where it stands."
def control(observation, memory):
    return 0.03, 0.6

# %% role="mistake" name="it turns left and right" says="Usual causes: it forgets what it saw and decided (store the points of all looks, and the aim, in memory); the points of earlier looks are kept as the robot saw them then (store them in the frame of the odometry, and turn them back); the sign of the angular speed is wrong (a direction on the left is positive); the yaw is not subtracted; an angle is in degrees."
def control(observation, memory):
    linear, angular = solution(observation, memory)
    return linear, -angular

# %% role="mistake" name="something low" says="Does it use the points of the camera? obstacles(observation) has both. It must remember them, too: the camera sees nothing that is beside the robot, or nearer than 0.38 m."
def control(observation, memory):
    others = {name: observation[name] for name in observation if name != "depth"}
    return solution(others | {"depth": np.zeros((90, 160), np.uint16)}, memory)

# %% role="mistake" name="something low seen" says="The camera sees it from farther away, not from near or beside it. Usual causes: it forgets the points of earlier looks (store them in the frame of the odometry); it does not turn them back before it asks free_way; the corridor is narrower than 0.64 m; it does not stop 0.45 m before, in each step; free_way gets degrees (it takes radians)."
def control(observation, memory):
    seen = dict(observation, depth=np.zeros_like(observation["depth"]))
    return solution(seen, memory)

# %% role="mistake" name="it comes too near" says="Usual causes: the corridor is narrower than the robot with 0.2 m on each side (0.64 m); it drives while it turns to a new direction; it does not stop 0.45 m before what is in its way; points of earlier looks are not turned back before free_way is asked; free_way gets degrees (it takes radians)."
def control(observation, memory):
    return 0.3, solution(observation, memory)[1]

# %% role="mistake" name="time to the goal" says="Usual causes: the direction of the goal is math.atan2(0 - y, 2.2 - x) less the yaw, wrapped; the robot must turn to it when the way there is free; and it must decide for one side of an obstacle, and keep to it (in memory) until then."
def control(observation, memory):
    if free_way(obstacles(observation), 0.0, 0.80) < 0.45:
        return 0.0, 0.8
    return 0.3, 0.0
