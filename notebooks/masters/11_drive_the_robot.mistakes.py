# %% [markdown]
# # drive-pose

# %%
def moved(x, y, yaw, linear, angular, dt, heading):
    """The next pose if the robot drives in another direction than the right one."""
    end = math.remainder(yaw + angular * dt, 2 * math.pi)
    return x + linear * dt * math.cos(heading), y + linear * dt * math.sin(heading), end

# %% role="mistake" name="the direction at the beginning" says="You drive in the direction at the beginning of the step. The robot turns while it drives: use the direction in the middle, yaw + angular * dt / 2."
def next_pose(x, y, yaw, linear, angular, dt):
    return moved(x, y, yaw, linear, angular, dt, yaw)

# %% role="mistake" name="the direction at the end" says="You drive in the direction at the end of the step. Use the direction in the middle, yaw + angular * dt / 2."
def next_pose(x, y, yaw, linear, angular, dt):
    return moved(x, y, yaw, linear, angular, dt, yaw + angular * dt)

# %% role="mistake" name="a step and a half" says="You added the turn to yaw first, and then half of the turn once more. The direction of the way is the old yaw + angular * dt / 2: compute it before you change yaw."
def next_pose(x, y, yaw, linear, angular, dt):
    return moved(x, y, yaw, linear, angular, dt, yaw + 1.5 * angular * dt)

# %% role="mistake" name="sine and cosine exchanged" says="Sine and cosine are exchanged. The cosine belongs to x: with yaw 0 the robot drives along x, and cos(0) is 1."
def next_pose(x, y, yaw, linear, angular, dt):
    x1, y1, yaw1 = solution(0, 0, yaw, linear, angular, dt)
    return x + y1, y + x1, yaw1

# %% role="mistake" name="new yaw without dt" says="The new yaw is wrong: dt is missing in the turn. In dt seconds the robot turns by angular * dt."
def next_pose(x, y, yaw, linear, angular, dt):
    return *solution(x, y, yaw, linear, angular, dt)[:2], math.remainder(yaw + angular, 2 * math.pi)

# %% role="mistake" name="direction without dt" says="The direction of the way is wrong: dt is missing in half of the turn. It is yaw + angular * dt / 2."
def next_pose(x, y, yaw, linear, angular, dt):
    return moved(x, y, yaw, linear, angular, dt, yaw + angular / 2)

# %% role="mistake" name="only half a turn" says="Your new yaw has made only half of the turn. Half of the turn is for the direction of the way; the new yaw is yaw + angular * dt."
def next_pose(x, y, yaw, linear, angular, dt):
    middle = math.remainder(yaw + angular * dt / 2, 2 * math.pi)
    return *moved(x, y, yaw, linear, angular, dt, middle)[:2], middle

# %% role="mistake" name="the turn alone" says="Your new yaw is only the turn of this step. Add it to the old yaw: yaw + angular * dt."
def next_pose(x, y, yaw, linear, angular, dt):
    return *solution(x, y, yaw, linear, angular, dt)[:2], math.remainder(angular * dt, 2 * math.pi)

# %% role="mistake" name="starts at zero" says="You return only the way of this step. Add it to the old x and y."
def next_pose(x, y, yaw, linear, angular, dt):
    return solution(0, 0, yaw, linear, angular, dt)

# %% role="mistake" name="turns to the right" says="The turn has the wrong sign. A positive angular velocity turns to the left, so yaw grows: yaw + angular * dt."
def next_pose(x, y, yaw, linear, angular, dt):
    return solution(x, y, yaw, linear, -angular, dt)

# %% role="mistake" name="yaw in degrees" says="You converted the direction from degrees to radians. It is in radians already: use it as it is."
def next_pose(x, y, yaw, linear, angular, dt):
    return moved(x, y, yaw, linear, angular, dt, math.radians(yaw + angular * dt / 2))

# %% [markdown]
# # drive-stop

# %% role="mistake" name="only the braking" says="This is only the way of braking. The robot also drives before it brakes: add speed * (1 / rate + latency)."
def stopping_distance(speed, deceleration, rate, latency):
    return speed**2 / (2 * deceleration)

# %% role="mistake" name="without the latency" says="The latency is missing: the robot also drives on while it computes. Add it to 1 / rate."
def stopping_distance(speed, deceleration, rate, latency):
    return speed / rate + speed**2 / (2 * deceleration)

# %% role="mistake" name="without the wait for a frame" says="The wait for the next frame is missing, or 0 (1 // rate): add 1 / rate to the latency."
def stopping_distance(speed, deceleration, rate, latency):
    return speed * latency + speed**2 / (2 * deceleration)

# %% role="mistake" name="half a frame" says="You counted half of the time between two frames. The obstacle may appear just after a frame: count the whole 1 / rate."
def stopping_distance(speed, deceleration, rate, latency):
    return speed * (0.5 / rate + latency) + speed**2 / (2 * deceleration)

# %% role="mistake" name="twice the speed, or the time of braking" says="Your way of braking has the speed, not its square, and the 2 is lost: speed / deceleration is the time of braking, in seconds. The way is speed ** 2 / (2 * deceleration). (In Python, * 2 doubles a number, and ** 2 squares it.)"
def stopping_distance(speed, deceleration, rate, latency):
    return speed * (1 / rate + latency) + speed / deceleration

# %% role="mistake" name="parentheses missing before" says="In the way before braking, speed does not multiply the latency. It must multiply the whole time, in parentheses: speed * (1 / rate + latency)."
def stopping_distance(speed, deceleration, rate, latency):
    return speed * 1 / rate + latency + speed**2 / (2 * deceleration)

# %% role="mistake" name="divided by the sum" says="You divided by rate + latency. The latency is a time already: speed * (1 / rate + latency)."
def stopping_distance(speed, deceleration, rate, latency):
    return speed / (rate + latency) + speed**2 / (2 * deceleration)

# %% role="mistake" name="milliseconds" says="You divided the latency by 1000. It is in seconds already."
def stopping_distance(speed, deceleration, rate, latency):
    return speed * (1 / rate + latency / 1000) + speed**2 / (2 * deceleration)

# %% role="mistake" name="the time" says="This is the time until the robot stands still, in seconds. The task asks for the distance in metres."
def stopping_distance(speed, deceleration, rate, latency):
    return 1 / rate + latency + speed / deceleration

# %% role="mistake" name="a fixed deceleration" says="Your result is always that of 0.6 m/s², as our robot brakes. Use the argument deceleration, so that the function works for other robots too."
def stopping_distance(speed, deceleration, rate, latency):
    return speed * (1 / rate + latency) + speed**2 / 1.2

# %% role="mistake" name="a fixed rate" says="Your result is always that of 10 frames per second. Use the argument rate, so that the function works for other cameras too."
def stopping_distance(speed, deceleration, rate, latency):
    return speed * (1 / 10 + latency) + speed**2 / (2 * deceleration)

# %% role="mistake" name="a fixed latency" says="Your result is always that of a latency of 0.06 s. Use the argument latency."
def stopping_distance(speed, deceleration, rate, latency):
    return speed * (1 / rate + 0.06) + speed**2 / (2 * deceleration)

# %% role="mistake" name="the numbers of the lesson" says="Your result is always that of the lesson's 10 frames per second, 0.06 s and 0.6 m/s². Use the arguments rate, latency and deceleration, so that the function works for other robots too."
def stopping_distance(speed, deceleration, rate, latency):
    return speed * (1 / 10 + 0.06) + speed**2 / 1.2

# %% role="mistake" name="multiplied" says="You multiplied 1 / rate by the latency. They are two times, one after the other: add them."
def stopping_distance(speed, deceleration, rate, latency):
    return speed * (1 / rate * latency) + speed**2 / (2 * deceleration)
