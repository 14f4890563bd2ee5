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

THRESHOLDS = {"bumps": ["<=", 0], "distance": [">=", 0.2]}


def scenario(rng, **more):
    return {"seed": int(rng.integers(1 << 31)), "duration": 1.5, "thresholds": THRESHOLDS} | more


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
    return (scenario(rng, seed=7),)


# %% role="hidden" title="another way" points=2 hint="Look ahead."
def inputs(rng):
    return (scenario(rng),)


# %% role="hidden" title="a third way" points=2 hint="Look ahead."
def inputs(rng):
    return (scenario(rng, lighting="evening"),)
