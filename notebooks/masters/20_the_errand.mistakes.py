# %% [markdown]
# # errand-frame

# %%
def in_circle(angle):
    return math.remainder(angle, 2 * math.pi)

def frame_with(place, counted, turn=None, yaw=None, sign=-1):
    """The place plus or minus the counted way, turned by `turn`; the yaw as it is given."""
    difference = in_circle(place[2] - counted[2])
    turn = difference if turn is None else turn
    x, y, _ = joined((0.0, 0.0, turn), counted)
    return place[0] + sign * x, place[1] + sign * y, difference if yaw is None else yaw

def joined(frame, pose):
    c, s = math.cos(frame[2]), math.sin(frame[2])
    return frame[0] + c * pose[0] - s * pose[1], frame[1] + s * pose[0] + c * pose[1], in_circle(frame[2] + pose[2])

def seen_from(first, second):
    """The second pose in the frame of the first."""
    c, s = math.cos(first[2]), math.sin(first[2])
    dx, dy = second[0] - first[0], second[1] - first[1]
    return c * dx + s * dy, c * dy - s * dx, in_circle(second[2] - first[2])

# %% role="mistake" name="turned by the yaw of the place" says="You turn the counted way by the yaw of the place. Turn it by the yaw of the frame, which is the difference of both yaws."
def map_to_odom(place, counted):
    return frame_with(place, counted, turn=place[2])

# %% role="mistake" name="turned by the counted yaw" says="You turn the counted way by the counted yaw. Turn it by the yaw of the frame, which is the difference of both yaws."
def map_to_odom(place, counted):
    return frame_with(place, counted, turn=counted[2])

# %% role="mistake" name="turned to the wrong side" says="You turn the counted way to the wrong side, as by minus the yaw. Of the counted x and y, it is c * x - s * y and s * x + c * y."
def map_to_odom(place, counted):
    return frame_with(place, counted, turn=counted[2] - place[2])

# %% role="mistake" name="not wrapped" says="Your yaw is not wrapped, so it can be larger than π or smaller than -π. Use math.remainder(yaw, 2 * math.pi)."
def map_to_odom(place, counted):
    return frame_with(place, counted, yaw=place[2] - counted[2])

# %% role="mistake" name="wrapped only from above" says="You wrap only a yaw that is larger than π. It can also be smaller than -π. math.remainder(yaw, 2 * math.pi) does both."
def map_to_odom(place, counted):
    yaw = place[2] - counted[2]
    return frame_with(place, counted, yaw=yaw - 2 * math.pi if yaw > math.pi else yaw)

# %% role="mistake" name="wrapped only from below" says="You wrap only a yaw that is smaller than -π. It can also be larger than π. math.remainder(yaw, 2 * math.pi) does both."
def map_to_odom(place, counted):
    yaw = place[2] - counted[2]
    return frame_with(place, counted, yaw=yaw + 2 * math.pi if yaw < -math.pi else yaw)

# %% role="mistake" name="remainder by half a turn" says="You took the remainder by π, which is half a turn. Use 2 * math.pi."
def map_to_odom(place, counted):
    yaw = math.remainder(place[2] - counted[2], math.pi)
    return frame_with(place, counted, turn=yaw, yaw=yaw)

# %% role="mistake" name="only the yaw is negative" says="x and y are right; only the sign of the yaw is wrong: return place[2] - counted[2], wrapped."
def map_to_odom(place, counted):
    return frame_with(place, counted, yaw=in_circle(counted[2] - place[2]))

# %% role="mistake" name="the yaw of the place" says="x and y are right, but you return the yaw of the place. The yaw of the frame is the difference: place[2] - counted[2], wrapped."
def map_to_odom(place, counted):
    return frame_with(place, counted, yaw=place[2])

# %% role="mistake" name="composed" says="You compose place and counted. The marker's place is what comes out of compose, not its frame. Undo compose: turn the counted way by the difference of both yaws, and subtract it from the place."
def map_to_odom(place, counted):
    return joined(place, counted)

# %% role="mistake" name="the place as the wheels see it" says="This is the relative pose: the place, as seen from the counted pose. But both are not in one frame. Turn the counted way by the difference of both yaws, and subtract it from the place."
def map_to_odom(place, counted):
    return seen_from(counted, place)

# %% role="mistake" name="the counted pose seen from the place" says="This is the relative pose: the counted pose, as seen from the place. But both are not in one frame. Turn the counted way by the difference of both yaws, and subtract it from the place."
def map_to_odom(place, counted):
    return seen_from(place, counted)

# %% role="mistake" name="the difference turned" says="You turn the difference of the places. Turn only the counted way, and subtract it from the place, which is given in the map already."
def map_to_odom(place, counted):
    return joined((0.0, 0.0, in_circle(place[2] - counted[2])), (place[0] - counted[0], place[1] - counted[1], 0.0))

# %% role="mistake" name="the inverse" says="This is the inverse: where the map stands in odom. Asked is where odom stands in the map: subtract the turned counted way from the place."
def map_to_odom(place, counted):
    return seen_from(solution(place, counted), (0.0, 0.0, 0.0))

# %% role="mistake" name="the place" says="You return the place of the robot. The frame odom stands somewhere else: where the robot was when the wheels counted 0."
def map_to_odom(place, counted):
    return tuple(place)

# %% role="mistake" name="parentheses missing" says="The counted y has the wrong sign twice, as if parentheses were missing: place[0] - (c * counted[0] - s * counted[1]), and so for place[1]."
def map_to_odom(place, counted):
    x, y, yaw = solution(place, counted)
    return x - 2 * math.sin(yaw) * counted[1], y + 2 * math.cos(yaw) * counted[1], yaw

# %% role="mistake" name="x and y exchanged" says="In your result, x and y are exchanged: x is the first."
def map_to_odom(place, counted):
    x, y, yaw = solution(place, counted)
    return y, x, yaw

# %% role="mistake" name="the direction between both places" says="The yaw of the frame is not the direction from one place to the other: it is the difference of both yaws."
def map_to_odom(place, counted):
    return frame_with(place, counted, yaw=math.atan2(place[1] - counted[1], place[0] - counted[0]))

# %% role="mistake" name="without the yaw" says="The yaw is missing: return x, y and the yaw of the frame."
def map_to_odom(place, counted):
    return solution(place, counted)[:2]

# %% role="mistake" name="rounded" says="The result is rounded. Return the exact numbers, and leave round out."
def map_to_odom(place, counted):
    return tuple(round(value, 2) for value in solution(place, counted))

# %% role="mistake" name="rounded to millimetres" says="The result is rounded to three digits. Return the exact numbers, and leave round out."
def map_to_odom(place, counted):
    return tuple(round(value, 3) for value in solution(place, counted))

# %% [markdown]
# # errand-direction

# %%
def apart(direction, goal):
    return abs(math.remainder(direction - goal, 2 * math.pi))

def nearest_of(directions, mask, goal, measure=apart, choose=min, none=None):
    """The direction of the mask with the smallest measure; `none` if there is none."""
    chosen = [float(direction) for direction, free in zip(directions, mask, strict=True) if free]
    return choose(chosen, key=lambda direction: measure(direction, goal)) if chosen else none

# %% role="mistake" name="not wrapped" says="Your difference is not wrapped: from 170° to -170° there are 20°, not 340°. Use abs(math.remainder(direction - goal, 2 * math.pi)): all angles are in radians, where a full turn is 2 * math.pi, not 360."
def choose_direction(directions, ways, goal, need):
    return nearest_of(directions, ways >= need, goal, lambda a, b: abs(a - b))

# %% role="mistake" name="wrapped only from below" says="You wrap only a difference that is smaller than -π. It can also be larger than π. Use abs(math.remainder(direction - goal, 2 * math.pi)), which does both."
def choose_direction(directions, ways, goal, need):
    return nearest_of(directions, ways >= need, goal, lambda a, b: abs(a - b + 2 * math.pi if a - b < -math.pi else a - b))

# %% role="mistake" name="the first with enough" says="You take the first direction with enough way. Is the return inside of the loop? Look at all directions, keep the one nearest to the goal, and return it after the loop."
def choose_direction(directions, ways, goal, need):
    return nearest_of(directions, ways >= need, goal, lambda a, b: 0)

# %% role="mistake" name="position among the free ones" says="The position belongs to the smaller array with the free directions only: take the direction from that array, too."
def choose_direction(directions, ways, goal, need):
    free = directions[ways >= need]
    return float(directions[int(np.argmin([apart(d, goal) for d in free]))]) if len(free) else None

# %% role="mistake" name="the position" says="You return the position. Return the direction itself, directions[k], as a float."
def choose_direction(directions, ways, goal, need):
    right = solution(directions, ways, goal, need)
    return None if right is None else int(np.flatnonzero(directions == right)[0])

# %% role="mistake" name="the difference" says="You return the difference to the goal. Return the direction itself."
def choose_direction(directions, ways, goal, need):
    right = solution(directions, ways, goal, need)
    return None if right is None else math.remainder(right - goal, 2 * math.pi)

# %% role="mistake" name="inf if there is none" says="If no direction has enough way, return None, not inf."
def choose_direction(directions, ways, goal, need):
    return nearest_of(directions, ways >= need, goal, none=math.inf)

# %% role="mistake" name="the nearest if there is none" says="If no direction has enough way, return None, and not the one nearest to the goal."
def choose_direction(directions, ways, goal, need):
    return nearest_of(directions, ways >= need, goal, none=nearest_of(directions, ways > -1, goal))

# %% role="mistake" name="argmin of nothing" says="argmin of nothing is an error. If no direction has enough way, return None."
def choose_direction(directions, ways, goal, need):
    free = directions[ways >= need]
    return float(free[np.argmin([apart(direction, goal) for direction in free])])

# %% role="mistake" name="only the nearest direction" says="You look only at the direction nearest to the goal. If its way is too short, another direction may be free: first leave out those with less than need, then take the nearest."
def choose_direction(directions, ways, goal, need):
    k = int(np.argmin([apart(direction, goal) for direction in directions]))
    return float(directions[k]) if ways[k] >= need else None

# %% role="mistake" name="need typed" says="Your result is always that of need = 1.0, as in the lesson. Use the argument need."
def choose_direction(directions, ways, goal, need):
    return nearest_of(directions, ways >= 1.0, goal)

# %% role="mistake" name="the cell of the lesson" says="This is the cell of the lesson: it computes in whole degrees. Compute in radians, without np.degrees and round; wrap the difference by math.remainder, and return None if no direction has enough way."
def choose_direction(directions, ways, goal, need):
    degrees = np.degrees(directions).round()
    enough = degrees[ways >= need]
    return float(enough[np.argmin(np.abs(enough - round(math.degrees(goal))))])

# %% role="mistake" name="all directions with enough way" says="You return all directions with enough way. Return the one nearest to the goal, as one float."
def choose_direction(directions, ways, goal, need):
    return directions[ways >= need]

# %% [markdown]
# # errand-believe

# %%
def steps_between(a, b):
    row = list(range(len(b) + 1))
    for i, first in enumerate(a, 1):
        above, row = row, [i]
        for j, second in enumerate(b, 1):
            row.append(min(above[j] + 1, row[j - 1] + 1, above[j - 1] + (first != second)))
    return row[-1]

def near(text, name, most=1):
    return steps_between(text.upper(), name) <= most

def votes_of(readings, name, is_vote=near):
    return sum(any(is_vote(text, name) for text in look) for look in readings)

def winner(readings, names, votes, count=votes_of, enough=None):
    counts = [count(readings, name) for name in names]
    best = max(counts, default=0)
    return names[counts.index(best)] if counts and best >= (votes if enough is None else enough) else None

# %% role="mistake" name="compared in small letters" says="You return None for every call, as if no text voted. Usual causes: a whole look (a list) is compared, not each of its texts; small letters, not edit_distance(text.upper(), name) <= 1; a count is never larger than the best; a missing return."
def believe(readings, names, votes):
    return winner(readings, names, votes, lambda looks, name: votes_of(looks, name, lambda text, sign: steps_between(text.lower(), sign) <= 1))

# %% role="mistake" name="place by place" says="You compare character by character. If one is missing, all later ones are moved: use edit_distance."
def believe(readings, names, votes):
    def is_vote(text, sign):
        return len(text) == len(sign) and sum(a != b for a, b in zip(text.upper(), sign, strict=True)) <= 1

    return winner(readings, names, votes, lambda looks, name: votes_of(looks, name, is_vote))

# %% role="mistake" name="a part of the name" says="A part of the name is not enough: HEN is in KITCHEN. Use edit_distance(text.upper(), name) <= 1."
def believe(readings, names, votes):
    return winner(readings, names, votes, lambda looks, name: votes_of(looks, name, lambda text, sign: text.upper() in sign))

# %% role="mistake" name="only the nearest text" says="You let a look vote for one name only, that of its nearest text. It may vote for several names, if it shows several: each with an edit distance of at most 1."
def believe(readings, names, votes):
    closest = []
    for look in readings:
        pairs = [(steps_between(text.upper(), name), name) for text in look for name in names]
        distance, name = min(pairs, key=lambda pair: pair[0], default=(99, ""))
        closest.append(name if distance <= 1 else "")
    return winner(readings, names, votes, lambda looks, name: closest.count(name))

# %% role="mistake" name="only the first text that is near" says="You stop at the first text of a look that is near a name. A look may vote for several names, if it shows several: ask for each name whether any of its texts is near."
def believe(readings, names, votes):
    firsts = [next((name for text in look for name in names if near(text, name)), "") for look in readings]
    return winner(readings, names, votes, lambda looks, name: firsts.count(name))

# %% role="mistake" name="votes typed" says="Your result is always that of votes = 2. Use the argument votes: it says how many looks are enough."
def believe(readings, names, votes):
    return winner(readings, names, votes, enough=2)

# %% role="mistake" name="one text of the whole look" says="You join the texts of a look to one. Compare each text for itself."
def believe(readings, names, votes):
    return winner(readings, names, votes, lambda looks, name: sum(near(" ".join(look), name) for look in looks))

# %% role="mistake" name="one name for each look" says="Count for each name the looks that vote for it, before you choose. A look may vote for several names: do not stop at the first one."
def believe(readings, names, votes):
    firsts = [next((name for name in names if any(near(text, name) for text in look)), "") for look in readings]
    return winner(readings, names, votes, lambda looks, name: firsts.count(name))

# %% role="mistake" name="of equals the one read first" says="Of names with the same number of votes, the first one in names wins, not the one that was read first. A Counter or a dict goes through the names in the order in which it first counted them: take max(names, key=...), which goes through names."
def believe(readings, names, votes):
    seen = [name for look in readings for name in names if any(near(text, name) for text in look)]
    best = max(seen, key=seen.count, default=None)
    return best if seen.count(best) >= votes else None

# %% role="mistake" name="of equals the last of the alphabet" says="Of names with the same number of votes, the first one in names wins, not the last one of the alphabet. Do not sort or compare pairs of votes and name."
def believe(readings, names, votes):
    return winner(readings, sorted(names, reverse=True), votes)

# %% role="mistake" name="of equals the first of the alphabet" says="Of names with the same number of votes, the first one in names wins, not the first one of the alphabet. Do not sort the names."
def believe(readings, names, votes):
    return winner(readings, sorted(names), votes)

# %% role="mistake" name="votes not used" says="The argument votes must decide: count all looks, old and new, for each name, and return the best name only if its count is at least votes, else None."
def believe(readings, names, votes):
    return winner(readings, names, votes, enough=1)

# %% role="mistake" name="exactly votes" says="More votes are enough too: at least means >=, not ==."
def believe(readings, names, votes):
    best = winner(readings, names, votes)
    return best if best and votes_of(readings, best) == votes else None

# %% role="mistake" name="all looks" says="You ask whether all looks vote for the name. The number votes says how many are enough."
def believe(readings, names, votes):
    return next((name for name in names if readings and votes_of(readings, name) == len(readings)), None)

# %% role="mistake" name="more than half" says="You ask whether more than half of the looks vote for the name. The number votes says how many are enough."
def believe(readings, names, votes):
    return next((name for name in names if votes_of(readings, name) > len(readings) / 2), None)

# %% role="mistake" name="name and count" says="You return more than one value. Return the name alone."
def believe(readings, names, votes):
    right = solution(readings, names, votes)
    return right and (right, votes_of(readings, right))

# %% role="mistake" name="all names" says="You return all names with enough votes. Return the one with the most votes."
def believe(readings, names, votes):
    return [name for name in names if votes_of(readings, name) >= votes]

# %% role="mistake" name="the text None" says="If no name has enough votes, return None without quotes; a text with the word None is a name like another."
def believe(readings, names, votes):
    return solution(readings, names, votes) or "None"

# %% [markdown]
# # errand-drive

# %% role="mistake" name="its speeds are too large" says="Usual causes: an angle is in degrees (all angles here are in radians), or its factor is too large (2 or 3 times the angle is usual); or the two numbers are exchanged (the linear speed is the first)."
def control(observation, memory):
    linear, angular = solution(observation, memory)
    return linear, math.degrees(angular)

# %% role="mistake" name="it drives backward" says="It drove backward, where the camera sees nothing. The linear speed is the first number that you return: is it the second one here, or is it negative?"
def control(observation, memory):
    linear, angular = solution(observation, memory)
    return -linear, angular

# %% role="mistake" name="it stands" says="Usual causes: it read the word, and stays there (drive back to (0, 0) of the odometry: the direction is math.atan2(-y, -x), less the yaw); or it waits for a word that it cannot read any more, because the sign is above the image; or it stands while it sees no sign (turn until it does)."
def control(observation, memory):
    speeds = solution(observation, memory)
    return speeds if memory["task"] == "go" else (0.0, 0.0)

# %% role="mistake" name="it turns on the spot" says="Usual causes: find_sign gives word, angle and distance, in this order, and the angular speed must be in proportion to the angle; so near that the sign is above the image it sees none (decide with the words that you have, and go back); a stored direction less the yaw must be wrapped; the direction of the answer is computed again in each step, and not stored once."
def control(observation, memory):
    return 0.03, 0.6

# %% role="mistake" name="it drives the same way" says="Your robot drives the same way in each room, whatever it sees. Use find_sign and the odometry (or is a condition on them never true?)."
def control(observation, memory):
    return 0.25, 0.3

# %% role="mistake" name="reach" says="Usual causes: it never leaves the search, because a value in memory is set again in each call (memory.setdefault sets it once), or a condition is never true; or it turns away from the sign (an angle to the left is positive, and so is the angular speed); or it ends its way to the sign too early."
def control(observation, memory):
    return 0.0, 0.2 * math.sin(observation["time"])

# %% role="mistake" name="from the start, at the end" says="Usual causes: it does not drive back to (0, 0) of its odometry (the direction is math.atan2(-y, -x), less the yaw); or it forgets in which part of its task it is (a value in memory is set only once: memory.setdefault; near its start, both x and y are small); or it drives too near to the sign (1 m is near enough), or it never came there, because it turns away from it (an angle to the left is positive, and so is the angular speed)."
def control(observation, memory):
    speeds = solution(observation, memory)
    return speeds if memory["task"] == "go" else (0.1, 0.2)

# %% role="mistake" name="error of the answer" says="Usual causes: the degrees of the word are not made radians; they count from the sign, to the left (plus), and not from the start or from where the word was read, so look at the sign again at the end and add the angle to its direction; the last turn ends too early; or it is not stored once, but computed again while the robot turns."
def control(observation, memory):
    speeds = solution(observation, memory)
    if "yaw" in memory:
        memory["yaw"] = memory["seen"]  # it looks at the sign itself
    return speeds

# %% [markdown]
# # errand-explore

# %% role="mistake" name="it drives backward" says="It drove backward, where the camera sees nothing. The linear speed is the first number that you return: is it the second one here, or is it negative?"
def control(observation, memory):
    linear, angular = solution(observation, memory)
    return angular, linear

# %% role="mistake" name="its speeds are too large" says="Usual causes: an angle is in degrees (all angles here are in radians), or its factor is too large (2 or 3 times the angle is usual); or the two numbers are exchanged (the linear speed is the first)."
def control(observation, memory):
    linear, angular = solution(observation, memory)
    return linear, math.degrees(angular)

# %% role="mistake" name="it drives the same way" says="Your robot drives the same way in each room, whatever it sees. Use the observation (or is a condition on it never true?): things stand at other places each time."
def control(observation, memory):
    return 0.25, 0.3

# %% role="mistake" name="something low" says="Does it use the points of the camera? remembered(observation, memory) has both, and remembers them: what is low and near is below the image."
def control(observation, memory):
    others = {name: observation[name] for name in observation if name != "depth"}
    return solution(others | {"depth": np.zeros((90, 160), np.uint16)}, memory)

# %% role="mistake" name="something low seen" says="The camera sees such things from farther away, and remembered keeps them. Usual causes: it does not ask way_before(points, 0.0) in each step, and stop 0.45 m before; the corridor is narrower than the robot with room on each side; an angle is in degrees, or the two speeds are exchanged."
def control(observation, memory):
    seen = dict(observation, depth=np.zeros_like(observation["depth"]))
    return solution(seen, memory)

# %% role="mistake" name="it comes too near" says="Usual causes: the corridor of way_before is narrower than the robot with room on each side; it drives while it turns to a new heading; it does not ask way_before(points, 0.0) in each step, and stop 0.45 m before what is in its way; an angle is in degrees, or a stored heading is not yaw + direction; the two numbers are exchanged; the points of remembered are already seen from the robot, and must not be turned again."
def control(observation, memory):
    return 0.3, solution(observation, memory)[1]

# %% role="mistake" name="it stands" says="Usual causes: it ends before it has come to 20 places; or the way ahead is not free, and it chooses no other direction: take the one with the most new cells, turn to it, and drive on."
def control(observation, memory):
    if way_before(obstacles(observation), 0.0) < 0.45:
        return 0.0, 0.0
    return 0.3, 0.0

# %% role="mistake" name="it turns on the spot" says="Usual causes: a stored heading is in the frame of the odometry (yaw + direction), and the turn is the heading minus the yaw, wrapped; an angle is in degrees; it never drives on while way_before ahead is long enough; no direction is ever chosen (is a condition never true?)."
def control(observation, memory):
    return 0.03, 0.6

# %% role="mistake" name="it turns left and right" says="Usual causes: each call chooses again (store the heading in memory, and choose a new one when the way is not free, or after a metre); a stored heading is yaw + direction, and the turn is the heading minus the yaw, wrapped; a direction on the left is positive; way_before counts from the robot, so straight ahead is 0.0 and not yaw; an angle is in degrees."
def control(observation, memory):
    linear, angular = solution(observation, memory)
    return linear, -angular

# %% role="mistake" name="it stays in one place" says="Usual causes: a stored heading is yaw + direction, and the turn is the heading minus the yaw, wrapped; it waits for a turn that never ends; each call chooses again (store the heading in memory, and choose a new one when the way is not free, or after a metre)."
def control(observation, memory):
    return 0.0, 0.1

# %% role="mistake" name="it drives in circles" says="Usual causes: it takes the first free direction that it finds, always on the same side, and not the one with the most new cells; it chooses again before its turn is done; a stored heading is yaw + direction, and the turn is the heading minus the yaw, wrapped."
def control(observation, memory):
    return 0.1 if way_before(obstacles(observation), 0.0) > 1.0 else 0.09, 0.5

# %% role="mistake" name="it is slow" says="The time is over before it comes to 20 places: drive with 0.3 m/s where the way ahead is free."
def control(observation, memory):
    linear, angular = solution(observation, memory)
    return min(linear, 0.1), angular

# %% role="mistake" name="it drives to the same places again" says="Usual causes: it does not choose the way with the most new cells, by count_new (the largest, not the smallest); or it gives count_new a direction without the yaw."
def control(observation, memory):
    yaw, points = observation["odometry"][2], remembered(observation, memory)
    error = math.remainder(memory.setdefault("heading", yaw) - yaw, 2 * math.pi)
    if abs(error) > 0.1:
        return 0.0, min(max(2.5 * error, -1.0), 1.0)
    if way_before(points, error, 0.64) > 0.45:
        return 0.3, 1.5 * error
    directions = np.radians(np.arange(-165, 181, 15))
    ways = [min(way_before(points, direction, 0.64), 3.0) - 0.1 * abs(direction) for direction in directions]
    memory["heading"] = yaw + float(directions[np.argmax(ways)])
    return 0.0, 0.0
