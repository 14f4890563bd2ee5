# ---
# jupyter:
#   imgproc_course:
#     title: Sound
# ---

# %% [markdown]
# # Sound
# A lesson for the tests without images.

# %%
from imgproc_course.exercises import check

# %% role="exercise"
exercise(
    "sound-mean",
    title="Mean",
    function="mean",
    time_limit=1,
    tolerance=0.01,
    hints=("What?", "How?", "The code."),
    explanation="Because.",
    another_way="Otherwise.",
)

# %% role="answer"
def mean(values):
    raise NotImplementedError("your turn")

# %% role="solution"
def mean(values):
    return float(np.mean(values))

# %% role="check"
check("sound-mean", mean)

# %% role="case" title="Five numbers" points=1 hint="How many are there?"
def inputs(rng):
    return (list(rng.uniform(0, 9, 5)),)

# %% role="hidden" title="Fifty numbers" points=3 hint="How many are there now?"
def inputs(rng):
    return (list(rng.uniform(0, 9, 50)),)

# %% role="mistake" name="the sum" says="Divide by how many there are."
def mean(values):
    return float(np.sum(values))

# %% role="exercise"
exercise(
    "sound-practice",
    title="Free",
    function="free",
    practice=True,
    hints=("What?", "How?", "The code."),
    explanation="Because.",
    another_way="Otherwise.",
)

# %% role="answer"
def free(value):
    raise NotImplementedError("your turn")

# %% role="solution"
def free(value):
    return value

# %% role="check"
check("sound-practice", free)

# %% role="case" title="Anything"
def inputs(rng):
    return (3,)

# %% role="hidden" title="Anything else"
def inputs(rng):
    return (4,)

# %% role="mistake" name="nothing" says="Give it back."
def free(value):
    return None
