# ---
# jupyter:
#   imgproc_course:
#     title: Attacked
# ---

# %% [markdown]
# # Attacked
# A lesson for the grader's own tests: two functions, one of which is always under attack.

# %% role="given" exercise=["attacked-double", "attacked-mean"]
import numpy as np

LIMIT = 255

# %%
from imgproc_course.exercises import check

# %% role="exercise"
exercise(
    "attacked-double",
    title="Double",
    function="double",
    time_limit=0.5,
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
check("attacked-double", double)

# %% role="case" title="Bright pixels" points=1 hint="Widen first."
def inputs(rng):
    return (rng.integers(100, 256, (3, 4), dtype=np.uint8),)

# %% role="hidden" title="Any pixels" points=2 hint="What does 200 become?"
def inputs(rng):
    return [(rng.integers(0, 256, (5, 5), dtype=np.uint8),) for _ in range(2)]

# %% role="mistake" name="uint8 wraps" says="Widen first."
def double(pixels):
    return pixels * 2

# %% role="mistake" name="half" says="That is half."
def double(pixels):
    return solution(pixels) // 4

# %% role="exercise"
exercise(
    "attacked-mean",
    title="Mean",
    function="mean",
    time_limit=0.5,
    tolerance=0.01,
    hints=("What?", "How?", "The code."),
    explanation="Because.",
    another_way="Otherwise.",
)

# %% role="answer"
def mean(values):
    ...

# %% role="solution"
def mean(values):
    return float(np.mean(values))

# %% role="check"
check("attacked-mean", mean)

# %% role="case" title="Five numbers" points=3
def inputs(rng):
    return (list(rng.uniform(0, 9, 5)),)

# %% role="hidden" title="Fifty numbers" points=4
def inputs(rng):
    return (list(rng.uniform(0, 9, 50)),)

# %% role="mistake" name="the sum" says="Divide by how many there are."
def mean(values):
    return float(np.sum(values))

# %% role="exercise"
exercise(
    "attacked-apply",
    title="Apply",
    function="apply",
    practice=True,
    hints=("What?", "How?", "The code."),
    explanation="Because.",
    another_way="Otherwise.",
)

# %% role="answer"
def apply(function):
    raise NotImplementedError("your turn")

# %% role="solution"
def apply(function):
    return function(2)

# %% role="check"
check("attacked-apply", apply)

# %% role="case" title="An argument that is no data"
def inputs(rng):
    return (lambda value: value + 1,)

# %% role="hidden" title="Another one"
def inputs(rng):
    return (lambda value: value * 5,)

# %% role="mistake" name="the function itself" says="Call it."
def apply(function):
    return 1
