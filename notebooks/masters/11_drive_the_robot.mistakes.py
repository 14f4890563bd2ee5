# %% [markdown]
# # drive-wheels

# %% role="mistake" name="left and right exchanged" says="Left and right are exchanged. A positive angular velocity turns the robot to the left, so the right wheel is the faster one: subtract for the left wheel, add for the right wheel."
def wheel_speeds(linear, angular, distance):
    return solution(linear, angular, distance)[::-1]

# %% role="mistake" name="the whole distance" says="You multiplied by the whole distance between the wheels. Each wheel is only half of it away from the centre of the robot: distance / 2."
def wheel_speeds(linear, angular, distance):
    return solution(linear, angular, 2 * distance)

# %% role="mistake" name="the whole distance, left and right exchanged" says="Two things are wrong: use half the distance (distance / 2), and subtract for the left wheel, because a positive angular velocity turns to the left."
def wheel_speeds(linear, angular, distance):
    return solution(linear, angular, 2 * distance)[::-1]

# %% role="mistake" name="angular velocity without the distance" says="You added the angular velocity itself. It is in radians per second, not in metres per second: multiply it by the radius, distance / 2."
def wheel_speeds(linear, angular, distance):
    return linear - angular, linear + angular

# %% role="mistake" name="half the angular velocity" says="You added half the angular velocity, without the distance between the wheels. Multiply it by the distance too: angular * distance / 2."
def wheel_speeds(linear, angular, distance):
    return linear - angular / 2, linear + angular / 2

# %% role="mistake" name="divided by the distance" says="You divided by the distance between the wheels. Multiply: a wheel that is further away from the centre has a longer way, so it is faster."
def wheel_speeds(linear, angular, distance):
    return linear - angular / distance / 2, linear + angular / distance / 2

# %% role="mistake" name="divided by the whole distance" says="You divided by the distance between the wheels. Multiply: a wheel that is further away from the centre has a longer way, so it is faster: angular * distance / 2."
def wheel_speeds(linear, angular, distance):
    return linear - angular / distance, linear + angular / distance

# %% role="mistake" name="divided by half the distance" says="You divided by half the distance. Multiply by it: a wheel that is further away from the centre has a longer way, so it is faster."
def wheel_speeds(linear, angular, distance):
    return linear - angular / (distance / 2), linear + angular / (distance / 2)

# %% role="mistake" name="the turn on one wheel only" says="Your left wheel drives with the linear velocity alone. The turn is shared by both wheels: the left one loses angular * distance / 2, and the right one gains as much."
def wheel_speeds(linear, angular, distance):
    return linear, linear + angular * distance

# %% role="mistake" name="half the turn on one wheel only" says="Your left wheel drives with the linear velocity alone. The turn changes both wheels: subtract angular * distance / 2 for the left one."
def wheel_speeds(linear, angular, distance):
    return linear, linear + angular * distance / 2

# %% role="mistake" name="no turn" says="Both wheels get the linear velocity, so the robot would never turn. Use angular and distance too."
def wheel_speeds(linear, angular, distance):
    return linear, linear

# %% role="mistake" name="the turn alone" says="Your wheels turn the robot on the spot: the linear velocity is missing. Add it to both."
def wheel_speeds(linear, angular, distance):
    return -angular * distance / 2, angular * distance / 2

# %% role="mistake" name="all divided by 2" says="The linear velocity is halved too, because of the parentheses. Only angular * distance is divided by 2."
def wheel_speeds(linear, angular, distance):
    return (linear - angular * distance) / 2, (linear + angular * distance) / 2

# %% role="mistake" name="degrees" says="You converted the angular velocity with math.radians. It is in radians per second already: use it as it is."
def wheel_speeds(linear, angular, distance):
    return solution(linear, math.radians(angular), distance)

# %% role="mistake" name="converted into degrees" says="You converted the angular velocity into degrees. The formula needs radians, and angular is in radians per second already: use it as it is."
def wheel_speeds(linear, angular, distance):
    return solution(linear, math.degrees(angular), distance)

# %% role="mistake" name="the turn times the linear velocity" says="You multiplied the turn by the linear velocity, so a robot that turns on the spot would not turn its wheels. The speed of the turn is angular * distance / 2 alone."
def wheel_speeds(linear, angular, distance):
    turn = linear * angular * distance / 2
    return linear - turn, linear + turn

# %% role="mistake" name="parentheses too wide" says="Your parentheses also multiply the linear velocity by half the distance. Only the angular velocity belongs to it: linear - angular * half."
def wheel_speeds(linear, angular, distance):
    half = distance / 2
    return (linear - angular) * half, (linear + angular) * half

# %% role="mistake" name="a fixed distance" says="You typed 0.20 m, or 0.10 m, the distance of this robot. Use the argument distance, so that the function works for other robots too."
def wheel_speeds(linear, angular, distance):
    return solution(linear, angular, 0.2)

# %% role="mistake" name="the other way round" says="Your function computes the motion of the robot from two wheel speeds. Here it is the other way round: linear and angular are given, and the wheel speeds are wanted."
def wheel_speeds(linear, angular, distance):
    return (linear + angular) / 2, (angular - linear) / distance

# %% role="mistake" name="no negative speeds" says="A speed that should be negative is positive, as with abs. A wheel that turns backward has a negative speed: leave abs out."
def wheel_speeds(linear, angular, distance):
    left, right = solution(linear, angular, distance)
    return abs(left), abs(right)

# %% role="mistake" name="rounded" says="The results are rounded. Return the exact numbers, and leave round out: only the print in the lesson rounds."
def wheel_speeds(linear, angular, distance):
    left, right = solution(linear, angular, distance)
    return round(left, 2), round(right, 2)

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

# %% role="mistake" name="remainder of pi" says="You took the remainder of pi, which is half a turn. Directions repeat after a whole turn: math.remainder(..., 2 * math.pi)."
def next_pose(x, y, yaw, linear, angular, dt):
    return *solution(x, y, yaw, linear, angular, dt)[:2], math.remainder(yaw + angular * dt, math.pi)

# %% role="mistake" name="distance without dt" says="The robot drives too far: dt is missing in the distance. In dt seconds it drives linear * dt metres."
def next_pose(x, y, yaw, linear, angular, dt):
    x1, y1, yaw1 = solution(0, 0, yaw, linear, angular, dt)
    return x + x1 / dt, y + y1 / dt, yaw1

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

# %% role="mistake" name="yaw forgotten" says="The robot does not turn: your new yaw is the old one. It is yaw + angular * dt."
def next_pose(x, y, yaw, linear, angular, dt):
    return *solution(x, y, yaw, linear, angular, dt)[:2], yaw

# %% role="mistake" name="the turn alone" says="Your new yaw is only the turn of this step. Add it to the old yaw: yaw + angular * dt."
def next_pose(x, y, yaw, linear, angular, dt):
    return *solution(x, y, yaw, linear, angular, dt)[:2], math.remainder(angular * dt, 2 * math.pi)

# %% role="mistake" name="starts at zero" says="You return only the way of this step. Add it to the old x and y."
def next_pose(x, y, yaw, linear, angular, dt):
    return solution(0, 0, yaw, linear, angular, dt)

# %% role="mistake" name="y downward" says="The sign of the way along y is wrong. In a map, y grows to the left of x, not downward as the rows of an image: add linear * dt * sin(...)."
def next_pose(x, y, yaw, linear, angular, dt):
    x1, y1, yaw1 = solution(x, 0, yaw, linear, angular, dt)
    return x1, y - y1, yaw1

# %% role="mistake" name="turns to the right" says="The turn has the wrong sign. A positive angular velocity turns to the left, so yaw grows: yaw + angular * dt."
def next_pose(x, y, yaw, linear, angular, dt):
    return solution(x, y, yaw, linear, -angular, dt)

# %% role="mistake" name="yaw converted into degrees" says="You converted the direction into degrees. math.cos and math.sin take radians, and yaw is in radians already: use it as it is."
def next_pose(x, y, yaw, linear, angular, dt):
    return moved(x, y, yaw, linear, angular, dt, math.degrees(yaw + angular * dt / 2))

# %% role="mistake" name="yaw in degrees" says="You converted the direction with math.radians. It is in radians already: use it as it is."
def next_pose(x, y, yaw, linear, angular, dt):
    return moved(x, y, yaw, linear, angular, dt, math.radians(yaw + angular * dt / 2))

# %% role="mistake" name="rounded" says="The results are rounded. Return the exact numbers, and leave round out: only the print in the lesson rounds."
def next_pose(x, y, yaw, linear, angular, dt):
    x, y, yaw = solution(x, y, yaw, linear, angular, dt)
    return round(x, 4), round(y, 4), round(yaw, 3)

# %% [markdown]
# # drive-stop

# %% role="mistake" name="only the braking" says="This is only the way of braking. The robot also drives before it brakes: add speed * (1 / rate + latency)."
def stopping_distance(speed, deceleration, rate, latency):
    return speed**2 / (2 * deceleration)

# %% role="mistake" name="only the time before" says="This is only the way before the robot brakes. Add the way of braking: speed ** 2 / (2 * deceleration)."
def stopping_distance(speed, deceleration, rate, latency):
    return speed * (1 / rate + latency)

# %% role="mistake" name="the rate as a time" says="You used the rate as a time. With a rate of 10 frames per second, the next frame comes after 1 / 10 s: 1 / rate."
def stopping_distance(speed, deceleration, rate, latency):
    return speed * (rate + latency) + speed**2 / (2 * deceleration)

# %% role="mistake" name="without the latency" says="The latency is missing: the robot also drives on while it computes. Add it to 1 / rate."
def stopping_distance(speed, deceleration, rate, latency):
    return speed / rate + speed**2 / (2 * deceleration)

# %% role="mistake" name="without the wait for a frame" says="The wait for the next frame is missing: add 1 / rate to the latency."
def stopping_distance(speed, deceleration, rate, latency):
    return speed * latency + speed**2 / (2 * deceleration)

# %% role="mistake" name="half a frame" says="You counted half of the time between two frames. The obstacle may appear just after a frame: count the whole 1 / rate."
def stopping_distance(speed, deceleration, rate, latency):
    return speed * (0.5 / rate + latency) + speed**2 / (2 * deceleration)

# %% role="mistake" name="braking without the 2" says="The way of braking is twice as long as it should be: the 2 is missing. While the robot brakes, its mean speed is only half: speed ** 2 / (2 * deceleration)."
def stopping_distance(speed, deceleration, rate, latency):
    return speed * (1 / rate + latency) + speed**2 / deceleration

# %% role="mistake" name="speed not squared" says="The speed is not squared in the way of braking: speed ** 2 / (2 * deceleration)."
def stopping_distance(speed, deceleration, rate, latency):
    return speed * (1 / rate + latency) + speed / (2 * deceleration)

# %% role="mistake" name="twice the speed, or the time of braking" says="Your way of braking has the speed, not its square, and the 2 is lost: speed / deceleration is the time of braking, in seconds. The way is speed ** 2 / (2 * deceleration). (In Python, * 2 doubles a number, and ** 2 squares it.)"
def stopping_distance(speed, deceleration, rate, latency):
    return speed * (1 / rate + latency) + speed / deceleration

# %% role="mistake" name="parentheses missing" says="Parentheses are missing: / 2 * deceleration divides by 2 and then multiplies by the deceleration. Write / (2 * deceleration)."
def stopping_distance(speed, deceleration, rate, latency):
    return speed * (1 / rate + latency) + speed**2 / 2 * deceleration

# %% role="mistake" name="parentheses missing before" says="Parentheses are missing in the way before braking: speed must multiply the whole time, speed * (1 / rate + latency)."
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

# %% role="mistake" name="a fixed deceleration" says="You typed 0.6, the deceleration of our robot. Use the argument deceleration, so that the function works for other robots too."
def stopping_distance(speed, deceleration, rate, latency):
    return speed * (1 / rate + latency) + speed**2 / 1.2

# %% role="mistake" name="a fixed rate" says="You typed 10 frames per second. Use the argument rate, so that the function works for other cameras too."
def stopping_distance(speed, deceleration, rate, latency):
    return speed * (1 / 10 + latency) + speed**2 / (2 * deceleration)

# %% role="mistake" name="a fixed latency" says="You typed 0.06 s. Use the argument latency."
def stopping_distance(speed, deceleration, rate, latency):
    return speed * (1 / rate + 0.06) + speed**2 / (2 * deceleration)

# %% role="mistake" name="the numbers of the lesson" says="You typed the numbers of the lesson: 10 frames per second, 0.06 s and 0.6 m/s². Use the arguments rate, latency and deceleration, so that the function works for other robots too."
def stopping_distance(speed, deceleration, rate, latency):
    return speed * (1 / 10 + 0.06) + speed**2 / 1.2

# %% role="mistake" name="rounded" says="The result is rounded. Return the exact number, and leave round out: only the print in the lesson rounds."
def stopping_distance(speed, deceleration, rate, latency):
    return round(speed * (1 / rate + latency) + speed**2 / (2 * deceleration), 2)

# %% role="mistake" name="rounded to millimetres" says="The result is rounded to three digits. Return the exact number, and leave round out: only the print in the lesson rounds."
def stopping_distance(speed, deceleration, rate, latency):
    return round(speed * (1 / rate + latency) + speed**2 / (2 * deceleration), 3)

# %% role="mistake" name="multiplied" says="You multiplied 1 / rate by the latency. They are two times, one after the other: add them."
def stopping_distance(speed, deceleration, rate, latency):
    return speed * (1 / rate * latency) + speed**2 / (2 * deceleration)

# %% role="mistake" name="the braking subtracted" says="You subtracted the way of braking. The robot drives both ways, one after the other: add them."
def stopping_distance(speed, deceleration, rate, latency):
    return speed * (1 / rate + latency) - speed**2 / (2 * deceleration)

# %% role="mistake" name="the square of the whole" says="Only the speed is squared, not the whole fraction: speed ** 2 / (2 * deceleration)."
def stopping_distance(speed, deceleration, rate, latency):
    return speed * (1 / rate + latency) + (speed / (2 * deceleration)) ** 2
