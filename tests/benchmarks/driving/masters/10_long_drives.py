# ---
# jupyter:
#   imgproc_course:
#     title: Long drives
# ---

# %% [markdown]
# # Long drives
# A lesson for the benchmark of grading: drives of 40 s with scan and depth.

# %%
import numpy as np

from imgproc_course.exercises import check

# %% role="exercise"
exercise(
    "long-drives",
    title="Drive",
    function="control",
    subject="drive",
    sensors=("scan", "depth"),
    hints=("What?", "How?", "The code."),
    explanation="Because.",
    another_way="Otherwise.",
)


def scenario(rng):
    thresholds = {"bumps": ["<=", 0], "distance": [">=", 3.0]}
    return {"seed": int(rng.integers(1 << 31)), "duration": 40.0, "thresholds": thresholds}


# %% role="answer"
def control(observation, memory):
    return 0.0, 0.0


# %% role="solution"
def control(observation, memory):
    scan, depth = observation["scan"], observation["depth"]
    angle = np.arange(360) * (np.pi / 180)
    x, y = 0.156 + scan * np.cos(angle), scan * np.sin(angle)
    finite = np.isfinite(scan)
    ahead = finite & (x > 0.2) & (np.abs(y) < 0.40)
    gap = x[ahead].min() - 0.237 if ahead.any() else 5.0
    near = depth[40:60, 50:110]
    near = near[near > 0]
    gap = min(gap, np.percentile(near, 5) / 1000 - 0.1 if near.size else 5.0)
    if gap < 0.5:
        if "turn" not in memory:
            left, right = np.minimum(scan[20:100], 2).mean(), np.minimum(scan[260:340], 2).mean()
            memory["turn"] = 0.9 if left > right else -0.9
        return 0.0, memory["turn"]
    memory.pop("turn", None)
    return min(0.25, 0.6 * (gap - 0.38)), 0.0


# %% role="check"
check("long-drives", control)


# %% role="case" title="a drive" points=1 hint="Look ahead."
def inputs(rng):
    return (scenario(rng),)


# %% role="hidden" title="drive 1" points=1 hint="Look ahead."
def inputs(rng):
    return (scenario(rng),)


# %% role="hidden" title="drive 2" points=1 hint="Look ahead."
def inputs(rng):
    return (scenario(rng),)


# %% role="hidden" title="drive 3" points=1 hint="Look ahead."
def inputs(rng):
    return (scenario(rng),)


# %% role="hidden" title="drive 4" points=1 hint="Look ahead."
def inputs(rng):
    return (scenario(rng),)
