# %% [markdown]
# # tracking-iou

# %%
def common(a, b, axis):
    """The signed common length of two boxes: axis 0 for columns, 1 for rows."""
    return min(a[axis] + a[axis + 2], b[axis] + b[axis + 2]) - max(a[axis], b[axis])

def both_of(a, b):
    return max(common(a, b, 0), 0) * max(common(a, b, 1), 0)

# %% role="mistake" name="twice the intersection" says="You computed another measure (Dice): 2 * both / (sum of the areas). The IoU divides the intersection by the union."
def iou(a, b):
    return 2 * both_of(a, b) / (a[2] * a[3] + b[2] * b[3])

# %% role="mistake" name="over the second box" says="You divided by the area of the second box. Divide by the union of both."
def iou(a, b):
    return both_of(a, b) / (b[2] * b[3])

# %% role="mistake" name="over the larger box" says="You divided by the area of the larger box. Divide by the union of both."
def iou(a, b):
    return both_of(a, b) / max(a[2] * a[3], b[2] * b[3])

# %% role="mistake" name="width and height as ends" says="You read a[2] and a[3] as the right and the lower end of the box. They are the width and the height: the right end is a[0] + a[2], the lower end a[1] + a[3]."
def iou(a, b):
    width, height = (min(a[k + 2], b[k + 2]) - max(a[k], b[k]) for k in (0, 1))
    both = max(width, 0) * max(height, 0)
    return both / (a[2] * a[3] + b[2] * b[3] - both)

# %% role="mistake" name="width and height as ends, also in the areas" says="You read a[2] and a[3] as the right and the lower end of the box. They are the width and the height: the right end is a[0] + a[2], the lower end a[1] + a[3], and the area a[2] * a[3]."
def iou(a, b):
    width, height = (min(a[k + 2], b[k + 2]) - max(a[k], b[k]) for k in (0, 1))
    both = max(width, 0) * max(height, 0)
    areas = [(box[2] - box[0]) * (box[3] - box[1]) for box in (a, b)]
    return both / (sum(areas) - both)

# %% role="mistake" name="width and height exchanged" says="Width and height, or col and row, are exchanged: a box is (col, row, width, height), so the columns end at a[0] + a[2], and the rows at a[1] + a[3]."
def iou(a, b):
    width = min(a[0] + a[3], b[0] + b[3]) - max(a[0], b[0])
    height = min(a[1] + a[2], b[1] + b[2]) - max(a[1], b[1])
    both = max(width, 0) * max(height, 0)
    return both / (a[2] * a[3] + b[2] * b[3] - both)

# %% role="mistake" name="only the columns" says="You compared the columns only. The intersection also has a height, from the rows."
def iou(a, b):
    width = max(common(a, b, 0), 0)
    return width / (a[2] + b[2] - width)

# %% role="mistake" name="only the rows" says="You compared the rows only. The intersection also has a width, from the columns."
def iou(a, b):
    height = max(common(a, b, 1), 0)
    return height / (a[3] + b[3] - height)

# %% role="mistake" name="upside down" says="The fraction is upside down: the intersection is above the line, the union below it."
def iou(a, b):
    both = both_of(a, b)
    return (a[2] * a[3] + b[2] * b[3] - both) / both if both else 0.0

# %% role="mistake" name="one pixel more" says="Your intersection is one pixel too wide and too high. Its width is the end minus the start, without + 1."
def iou(a, b):
    both = max(common(a, b, 0) + 1, 0) * max(common(a, b, 1) + 1, 0)
    return both / (a[2] * a[3] + b[2] * b[3] - both)

# %% role="mistake" name="one pixel less" says="Your intersection is one pixel too narrow and too low. Its width is the end minus the start, and a box ends at col + width, without - 1."
def iou(a, b):
    both = max(common(a, b, 0) - 1, 0) * max(common(a, b, 1) - 1, 0)
    return both / (a[2] * a[3] + b[2] * b[3] - both)

# %% role="mistake" name="the middle of a box" says="A box begins at col and row, its upper left corner: it ends at col + width and row + height. They are not its middle."
def iou(a, b):
    return solution(*((col - width / 2, row - height / 2, width, height) for col, row, width, height in (a, b)))

# %% role="mistake" name="the box around both" says="The box around both is not the union: it has corners in which neither box is. The intersection is from the larger start to the smaller end."
def iou(a, b):
    around = math.prod(max(a[k] + a[k + 2], b[k] + b[k + 2]) - min(a[k], b[k]) for k in (0, 1))
    return max(0, a[2] * a[3] + b[2] * b[3] - around) / around

# %% role="mistake" name="rounded" says="The result is rounded. Return the exact number, and leave round out."
def iou(a, b):
    return round(solution(a, b), 2)

# %% role="mistake" name="distance of the union" says="You return 1 - IoU, which is 0 for equal boxes. Return the IoU itself."
def iou(a, b):
    return 1 - solution(a, b)

# %% role="mistake" name="the smaller height" says="Your common height does not depend on where the rows begin. Compute it as the width: the smaller end minus the larger start."
def iou(a, b):
    both = max(common(a, b, 0), 0) * min(a[3], b[3])
    return both / (a[2] * a[3] + b[2] * b[3] - both)

# %% [markdown]
# # tracking-predict

# %% role="mistake" name="without Q" says="Q is missing: each prediction makes the state less certain. Add Q to the covariance."
def predict(state, covariance, F, Q):
    return F @ state, F @ covariance @ F.T

# %% role="mistake" name="state not predicted" says="Your state has not changed. The predicted state is F @ state."
def predict(state, covariance, F, Q):
    return state, F @ covariance @ F.T + Q

# %% role="mistake" name="covariance not predicted" says="Only Q was added to your covariance. F changes it too: F @ covariance @ F.T + Q."
def predict(state, covariance, F, Q):
    return F @ state, covariance + Q

# %% role="mistake" name="added to the state" says="You added F @ state to the state. F @ state is the new state itself: F already contains the old place."
def predict(state, covariance, F, Q):
    return state + F @ state, F @ covariance @ F.T + Q

# %% role="mistake" name="rounded" says="The numbers are rounded. Return the exact numbers, and leave round out."
def predict(state, covariance, F, Q):
    return (F @ state).round(2), (F @ covariance @ F.T + Q).round(2)

# %% role="mistake" name="Q in between" says="Q is added too early: you multiplied it with F as well. Write F @ covariance @ F.T + Q."
def predict(state, covariance, F, Q):
    return F @ state, F @ (covariance + Q) @ F.T

# %% [markdown]
# # tracking-update

# %%
def gain_of(covariance, H, R):
    return covariance @ H.T @ np.linalg.inv(H @ covariance @ H.T + R)

def updated(state, covariance, measurement, H, gain):
    return state + gain @ (measurement - H @ state), (np.eye(len(state)) - gain @ H) @ covariance

# %% role="mistake" name="minus R" says="You subtracted R. The uncertainties of prediction and measurement add up: S = H @ covariance @ H.T + R."
def update(state, covariance, measurement, H, R):
    return updated(state, covariance, measurement, H, gain_of(covariance, H, -R))

# %% role="mistake" name="without the inverse" says="You multiplied by S. The gain divides by it: multiply by its inverse, np.linalg.inv(S)."
def update(state, covariance, measurement, H, R):
    gain = covariance @ H.T @ (H @ covariance @ H.T + R)
    return updated(state, covariance, measurement, H, gain)

# %% role="mistake" name="only what the gain takes away" says="You return gain @ H @ covariance. This is what the measurement takes away: subtract it from the covariance."
def update(state, covariance, measurement, H, R):
    gain = gain_of(covariance, H, R)
    return state + gain @ (measurement - H @ state), gain @ H @ covariance

# %% role="mistake" name="1 as the identity matrix" says="gain @ H is subtracted from 1 in every place. Subtract it from the identity matrix that has the size of the state: np.eye(len(state))."
def update(state, covariance, measurement, H, R):
    gain = gain_of(covariance, H, R)
    return state + gain @ (measurement - H @ state), (1 - gain @ H) @ covariance

# %% role="mistake" name="state used twice" says="You computed the difference with the corrected state and added it once more. Correct the state once."
def update(state, covariance, measurement, H, R):
    gain = gain_of(covariance, H, R)
    state, covariance = updated(state, covariance, measurement, H, gain)
    return state + gain @ (measurement - H @ state), covariance

# %% role="mistake" name="divided value by value" says="1 / S, or S ** -1, divides value by value. The inverse of a matrix is np.linalg.inv(S); only for one measurement are both the same."
def update(state, covariance, measurement, H, R):
    gain = covariance @ H.T @ (1 / (H @ covariance @ H.T + R))
    return updated(state, covariance, measurement, H, gain)

# %% [markdown]
# # tracking-drive

# %% role="mistake" name="its speeds are too large" says="Usual causes: an angle is in degrees (all angles here are in radians), or its factor is too large (2 or 3 times the angle is usual); or max and min are exchanged where a speed is limited; or the two numbers are exchanged (the linear speed is the first)."
def control(observation, memory):
    linear, angular = solution(observation, memory)
    return 100 * linear, angular  # centimetres per second

# %% role="mistake" name="another ball" says="Stand for half a second, then take the spot that has moved, and store it in memory: memory[\"ball\"] = ... stays, memory = {...} is forgotten after the call. From then on, take only spots near the column where you predict it: the last column plus 17.6 times the angular speed that you returned."
def control(observation, memory):
    spots = [(max(width, height), col + width / 2)
             for col, row, width, height in red_spots(observation["image"])]
    if not spots:
        return 0.0, 0.4
    size, middle = max(spots)
    linear = 1.2 * (176.25 * 0.22 / size - 0.6)
    return min(max(linear, -0.3), 0.3), min(max(2 * (160 - middle) / 176.25, -1.0), 1.0)

# %% role="mistake" name="it drives backward" says="It drove backward, where the camera sees nothing. Usual causes: the sign of distance - 0.6 is exchanged (if the ball is farther away, the linear speed is positive); or the two numbers are exchanged (the linear speed is the first); or the distance is too small (it is 176.25 * 0.22 / width of the ball in the image), or that of another spot."
def control(observation, memory):
    linear, angular = solution(observation, memory)
    return -linear, angular

# %% role="mistake" name="it turns fast" says="Usual causes: the angle is in pixels or degrees (it is (160 - column) / 176.25, in radians), or its factor is too large (2 or 3 times the angle is usual); or the angular speed has the wrong sign (positive for a column below 160); or it lost the ball (its column is not stored again in each call, or does not move with the robot's own turn, plus 17.6 times the angular speed)."
def control(observation, memory):
    return 0.3, 1.5

# %% role="mistake" name="it stands" says="Usual causes: it returns 0, 0 when it does not find the ball (turn to where you predict it: its column is moved by the robot's own turn); or it never finds which spot moved (the first image, and its time, are stored once, in the first call; compare with it after half a second or more; time == 0.5 is never true); or its angle is not (160 - the column of the middle) / 176.25, and it turns the ball out of the image; or it forgets the ball, because what is not stored in memory is gone after each call."
def control(observation, memory):
    linear, angular = solution(observation, memory)
    return (linear, angular) if observation["time"] < 1.2 else (0.0, 0.0)

# %% role="mistake" name="it turns left and right" says="Usual causes: the angle is in pixels or degrees (it is (160 - column) / 176.25, in radians), or its factor is too large (2 or 3 times the angle is usual); or it goes to another spot in each call, because the gate is too wide, or the prediction has the wrong sign (plus 17.6 times the last angular speed)."
def control(observation, memory):
    return 0.0, (1.2 if 5 * observation["time"] % 2 < 1 else -1.2)

# %% role="mistake" name="it turns on the spot" says="Usual causes: it lost the ball, because the column where it looks is not stored again in each call, or does not move with the robot's own turn (plus 17.6 times the angular speed: to the left, columns grow); or the angular speed has the wrong sign (positive for a column below 160), is in degrees, or its factor is too large (2 or 3 times the angle); or the linear speed is not in proportion to the distance minus 0.6."
def control(observation, memory):
    return 0.03, 0.6

# %% role="mistake" name="it drives in circles" says="It lost the ball. When the robot turns to the left, all spots move to the right: add 17.6 times the angular speed to the column where you look for the ball. Is the angular speed in radians, and in proportion to 160 minus the column, divided by 176.25?"
def control(observation, memory):
    return 0.3, 1.2

# %% role="mistake" name="it is too near" says="Usual causes: the linear speed is not in proportion to the distance minus 0.6, backward too; the distance is not 176.25 * 0.22 / width of the ball in the image."
def control(observation, memory):
    return 0.2, solution(observation, memory)[1]

# %% role="mistake" name="it is too far away" says="Usual causes: the linear speed is not a factor of 1 or more times (distance - 0.6); the distance is not 176.25 * 0.22 / width of the ball in the image; it does not drive while it turns or searches; it turns past the ball and loses it (its middle is col + width / 2, its angle is in radians)."
def control(observation, memory):
    linear, angular = solution(observation, memory)
    return 0.4 * linear, angular

# %% role="mistake" name="it drives the same way" says="Your robot drives the same way each time, whatever it sees. Use the image (or is a condition on it never true?)."
def control(observation, memory):
    return 0.25, 0.3

# %% role="mistake" name="it turns away from the ball" says="If the ball is on the left, its column is smaller than 160, and the angular speed must be positive. The linear speed is the first number that you return."
def control(observation, memory):
    linear, angular = solution(observation, memory)
    return linear, -angular

# %% role="mistake" name="ball beside the middle" says="Usual causes: it aims at an edge of the box (the middle is col + width / 2), or at another column of the image than 160; or the factor of the angle is too small (2 or 3 times the angle is usual); or it lost the ball (its column is not stored again in each call, or does not move with the robot's own turn, plus 17.6 times the angular speed)."
def control(observation, memory):
    return solution(observation | {"image": np.roll(observation["image"], 30, axis=1)}, memory)
