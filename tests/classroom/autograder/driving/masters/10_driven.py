# ---
# jupyter:
#   imgproc_course:
#     title: Driven
# ---

# %% [markdown]
# # Driven
# A lesson for the grader's own tests: one controller, on short drives through the recorded room.

# %%
import numpy as np

from imgproc_course.exercises import check

# %% role="given" exercise=["driven-control"]
NEAR = 0.5

# %% role="exercise"
exercise(
    "driven-control",
    title="Drive",
    function="control",
    subject="drive",
    sensors=("scan",),
    hints=("What?", "How?", "The code."),
    explanation="Because.",
    another_way="Otherwise.",
)


def scenario(rng, duration, metres, **more):
    """A hidden drive is longer: what the public one drives, repeated, does not get so far."""
    thresholds = {"bumps": ["<=", 0], "distance": [">=", metres]}
    return {"seed": int(rng.integers(1 << 31)), "duration": duration, "thresholds": thresholds} | more


# %% role="answer"
def control(observation, memory):
    return 0.0, 0.0


# %% role="solution"
def control(observation, memory):
    scan = observation["scan"]
    if min(scan[:30].min(), scan[-30:].min()) > NEAR:
        return 0.25, 0.0
    return 0.0, 0.8


# %% role="check"
check("driven-control", control)


# %% role="case" title="a free way" points=1 hint="Look ahead."
def inputs(rng):
    return (scenario(rng, 1.0, 0.15, seed=7),)


# %% role="hidden" title="another way" points=2 hint="Look ahead."
def inputs(rng):
    return (scenario(rng, 2.0, 0.3),)


# %% role="hidden" title="a third way" points=2 hint="Look ahead."
def inputs(rng):
    return (scenario(rng, 2.0, 0.3, lighting="evening"),)
