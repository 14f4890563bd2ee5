"""What is said about a drive: the thresholds that it missed, and what its path and its speeds show.

A behaviour is what a drive shows of any controller. A declared mistake of an exercise that
drives has the name of a behaviour, or of a metric that was missed, and advises a learner whose robot does so.
"""

import math

import numpy as np

from .drive import COUNTS, METRICS, STEP, metric_text, steps_of

# Behaviours that say much of any controller, in whichever drive it shows them.
CLEAR = ("its speeds are too large", "it turns left and right", "it stands", "it turns on the spot")
_STAYS = 0.3, 5.0  # metres, seconds: a robot that is in one place so long
_SAME = 0.15  # metres between two paths that are the same
_TURNS = 0.3  # rad/s: a robot that turns, and does not only correct its direction
_LEAST = 0.02, 0.1  # m/s, rad/s: a robot with less of both stands
_LARGE = 3, 10  # times the largest speeds of the robot
_ROUNDS, _CIRCLES = 1.5, 3.0  # times round: a robot that turns on the spot, one that drives in circles
_OFTEN = 5  # changes of the side
_SLOW, _FAST = 0.6, 0.9  # of the largest speed of the robot
_AGAIN = 1.2  # times the way that its places need, if it never came back to one


def sentences_of(record, scenario):
    """What went wrong in a drive, as a list of sentences; empty if it passes."""
    if record["ended"]:
        reason = record["ended"].rstrip(".")
        return [f"The drive ended after {record['steps'] * STEP:.1f} s: {reason}."]
    if record["steps"] < steps_of(scenario):
        return ["The drive did not come to its end."]
    names = _missed(record)
    sentences = [
        _sentence(record, *missed)
        for missed in record["missed"]
        if missed[0] != "clearance" or "bumps" not in names  # a bump says it
    ]
    return [*sentences, *filter(None, behaviours(record, scenario).values())]


def _sentence(record, name, value, operator, limit):
    if value is None:
        return "The robot did not reach the goal." if name == "goal_time" else "The robot never drove."
    asked = f"the task asks for {COUNTS[operator][1]} {metric_text(name, limit)}."
    if name == "bumps" and record["bumps"]:
        obstacle = record["metrics"].get("bumped_into") or "something"
        text = f"The robot bumped into the {obstacle} at {record['bumps'][0][0] * STEP:.1f} s"
        text += _turning(record) + (f", and bumped {value} times in all" if value > 1 else "")
        return f"{text}; {asked}" if limit else f"{text}."
    text = METRICS[name].sentence.format(metric_text(name, value, limit))
    if name == "clearance":
        thing = record["metrics"].get("nearest_to")
        text += f" to {f'the {thing}' if thing else 'what stands still'} at {record['decisive'] * STEP:.1f} s"
    return f"{text}; {asked}"


def _speeds_at_bump(record):
    """The two speeds at the first bump, which the robot's limits cut."""
    return np.clip(record["actions"][record["bumps"][0][0] - 1], *(np.array([[-1], [1]]) * record["limits"]))


def _turning(record):
    """What to add about the first bump, if the robot turned then."""
    linear, angular = _speeds_at_bump(record)
    if abs(angular) < _TURNS:
        return ", while it drove backward" if linear < 0 else ""
    side = "left" if angular > 0 else "right"
    return f", while it drove with {linear:.2f} m/s and turned to the {side} with {abs(angular):.2f} rad/s"


def _missed(record):
    """{metric: its value} of each threshold that is not kept."""
    return {name: value for name, value, *_ in record["missed"]}


def behaviours(record, scenario):
    """{behaviour: a sentence about it, "" if others say it} of a whole drive that did not pass."""
    missed = _missed(record)
    if record["ended"] or not missed or record["steps"] < steps_of(scenario):
        return {}
    metrics = record["metrics"]
    seen = _of_speeds(record) | metrics.get("remarks", {})
    if metrics.get("low") and missed.keys() & {"bumps", "clearance"}:
        seen |= _low(record)
    others = missed.keys() - {"bumps", "clearance", "answer_error"}
    if others and others not in ({"ball_gap"}, {"ball_angle"}):  # of one alone: it follows the ball
        stay = {} if record["bumps"] else _stay(record, scenario.get("goal"))
        seen |= stay or _circles(record)
    if missed.keys() & {"places", "goal_time", "reach", "distance"} and not seen:
        seen = _hesitation(record)
    moves = (np.abs(record["actions"][-1]) > _LEAST).any()
    if moves and missed.keys() & {"reach", "home", "answer_error"} and not (seen or record["bumps"]):
        seen["the time is over"] = "The time was over while the robot still drove or turned."
    seen |= {"it comes too near": ""} if record["bumps"] or missed.get("clearance") is not None else {}
    return seen | {METRICS[name].title: "" for name in missed}


def _low(record):
    """Of something low that the robot touched, or came too near."""
    thing = record["metrics"]["bumped_into"] or record["metrics"]["nearest_to"]
    is_seen = "depth" in (record.get("read") or ("depth",))  # what it read is known in a notebook
    return {"something low" + " seen" * is_seen: f"The laser scanner looks over the {thing}."}


def drives_alike(records):
    """Whether several drives have the same speeds, or the same path as seen from where each began."""
    length = min(record["steps"] for record in records)
    paths = [_from_its_start(np.array(record["path"]))[: length + 1] for record in records]
    same_speeds = all(record["actions"][:length] == records[0]["actions"][:length] for record in records)
    same_path = all(np.hypot(*(path - paths[0]).T).max() < _SAME for path in paths)
    way = np.hypot(*paths[0].T).max()
    return len(paths) > 1 and bool((same_speeds and way > _SAME) or (same_path and way > 10 * _SAME))


def _from_its_start(path):
    c, s = math.cos(path[0, 2]), math.sin(path[0, 2])
    return (path[:, :2] - path[0, :2]) @ np.array([[c, -s], [s, c]])


def _of_speeds(record):
    """Of speeds in another unit, degrees for example, of others at the limit, and backward into something."""
    seen = {"it drives backward": ""} if record["bumps"] and _speeds_at_bump(record)[0] < 0 else {}
    speeds = np.abs(record["actions"]).T
    for own, limit, times, unit in zip(speeds, record["limits"], _LARGE, ("m/s", "rad/s"), strict=True):
        if np.mean(own > times * limit) > 1 / 20:
            text = f"The function returned up to {own.max():.3g} {unit}; the robot can do {limit:g} {unit}."
            return seen | {"its speeds are too large": text}
    share = np.mean(speeds[1] > _FAST * record["limits"][1])
    text = f"In {share:.0%} of the time the robot turned as fast as it can."
    return seen | ({"it turns fast": text} if share > 1 / 2 else {})


def _stay(record, goal):
    """Of the longest time that the robot spent in one place."""
    path, actions = np.array(record["path"]), np.array(record["actions"])
    stays = [(start, _left(path, start)) for start in range(len(path))]
    start, end = max(stays, key=lambda stay: stay[1] - stay[0])
    if (end - start) * STEP < _STAYS[1]:
        return {}
    drives = np.flatnonzero(np.abs(actions[start:end, 0]) > _LEAST[0])
    last = int(drives[-1]) + 1 if drives.size else 0
    if (end - start - last) * STEP > _STAYS[1] and not _changes(actions[start:end, 1]):
        start += last  # from there on it only stood or turned
    moves = (np.abs(actions[start:end]) > _LEAST).any(1)
    start += int(moves.argmax()) if moves.any() else 0  # before that it stood
    until = "the end" if end == len(path) - 1 else f"{end * STEP:.1f} s"
    text = f"From {start * STEP:.1f} s to {until} the robot"
    turned, turns = np.unwrap(path[start : end + 1, 2]), actions[start:end, 1]
    if (np.abs(actions[start:end]) < _LEAST).all():
        away = math.dist(path[end, :2], goal[:2]) if goal else math.inf
        is_there = away < (goal or [0, 0, 0])[2] + _STAYS[0]
        place = f", {away:.1f} m from the goal" if is_there else ""
        speed = "hardly any" if actions[start:end].any() else "no"
        text = f"{text} stood{place}: the function returned {speed} speed."
        return {"it stands at the goal" if is_there else "it stands": text}
    if (rounds := abs(turned[-1] - turned[0]) / (2 * math.pi)) > _ROUNDS:
        return {"it turns on the spot": f"{text} turned on the spot, {rounds:.1f} times round."}
    if changes := _changes(turns):
        text += f" stayed in one place, and changed the side to which it turned {changes} times."
        return {"it turns left and right": text}
    is_long = (end - start) * STEP > 2 * _STAYS[1]
    return {"it stays in one place": f"{text} stayed in one place."} if is_long else {}


def _changes(turns):
    """How often a robot changed the side to which it turned, if that was often; else 0."""
    changes = np.count_nonzero(np.diff(np.sign(turns[np.abs(turns) > _TURNS])))
    return changes if changes > _OFTEN else 0


def _left(path, start):
    """The last step before a robot leaves the place in which it is at a step."""
    away = np.hypot(*(path[start:, :2] - path[start, :2]).T) > _STAYS[0]
    return start + (int(away.argmax()) if away.any() else len(away)) - 1


def _circles(record):
    yaws = np.unwrap(np.array(record["path"])[:, 2])
    rounds = (yaws[-1] - yaws[0]) / (2 * math.pi)
    side = "left" if rounds > 0 else "right"
    text = f"In all, the robot turned {abs(rounds):.0f} times round to the {side}."
    return {"it drives in circles": text} if abs(rounds) > _CIRCLES else {}


def _hesitation(record):
    fastest, limit = np.abs(record["actions"]).max(0)[0], record["limits"][0]
    if _LEAST[0] < fastest < _SLOW * limit:
        text = f"The robot never drove faster than {fastest:.2f} m/s; it can drive with {limit:g} m/s."
        return {"it is slow": text}
    way, places = record["metrics"]["distance"], record["metrics"]["places"]
    if way > _AGAIN * places * 0.5:
        text = f"The robot drove {way:.1f} m, and came to {places} places: often to the same ones again."
        return {"it drives to the same places again": text}
    return {}
