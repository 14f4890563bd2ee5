# ---
# jupyter:
#   imgproc_course:
#     title: Light
# ---

# %% [markdown]
# # Light
# A lesson for the tests: a function that returns an image, and one that returns two.

# %% role="given" exercise=["light-double", "light-halves"]
import numpy as np

LIMIT = 255

# %%
from imgproc_course.exercises import check

# %% role="exercise"
exercise(
    "light-double",
    title="Twice as bright",
    function="double",
    time_limit=1,
    hints=("What?", "How?", "The code."),
    explanation="Because.",
    another_way="Otherwise.",
)

# %% role="answer"
def double(pixels):
    raise NotImplementedError("your turn")

# %% role="solution"
def double(pixels):
    return np.minimum(pixels.astype(np.uint16) * 2, LIMIT).astype(np.uint8)

# %% role="check"
check("light-double", double)

# %% role="case" title="An image" points=1 hint="Widen before you multiply."
def inputs(rng):
    return (rng.integers(0, 256, (18, 24), dtype=np.uint8),)

# %% role="hidden" title="Any image" points=2 hint="What does 200 become?"
def inputs(rng):
    return [(rng.integers(0, 256, (5, 5), dtype=np.uint8),) for _ in range(2)]

# %% role="mistake" name="uint8 wraps" says="uint8 ends at 255: widen first."
def double(pixels):
    return pixels * 2

# %% role="exercise"
exercise(
    "light-halves",
    title="Two halves",
    function="halves",
    time_limit=1,
    hints=("What?", "How?", "The code."),
    explanation="Because.",
    another_way="Otherwise.",
)

# %% role="answer"
def halves(pixels):
    ...

# %% role="solution"
def halves(pixels):
    return pixels[:2].copy(), pixels[2:].copy()

# %% role="check"
check("light-halves", halves)

# %% role="case" title="Four rows" points=2 hint="The upper half comes first."
def inputs(rng):
    return (rng.integers(0, 256, (4, 3), dtype=np.uint8),)

# %% role="hidden" title="Four rows more" points=1 hint="Return both halves."
def inputs(rng):
    return (rng.integers(0, 256, (4, 6), dtype=np.uint8),)

# %% role="mistake" name="lower half first" says="The upper half comes first."
def halves(pixels):
    upper, lower = solution(pixels)
    return lower, upper
