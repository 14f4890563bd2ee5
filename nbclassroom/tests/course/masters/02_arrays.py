# ---
# jupyter:
#   small_course:
#     title: Arrays
# ---

# %% [markdown]
# # Arrays
#
# You will find the mean of an array. **Time** [[minutes]].

# %% role="given" exercise="arrays-middle"
import numpy as np

# %%
from nbclassroom.exercises import check, hint, solution

# %% role="exercise"
from nbclassroom.exercises import exercise

exercise(
    "arrays-middle",
    title="The mean of each row",
    function="row_means",
    time_limit=2,
    tolerance=1e-9,
    hints=("What is the mean of one row?", "Which axis are the columns?", "array.mean(axis=...)"),
    explanation="The axis that is named goes away.",
    another_way="You can also write array.sum(axis=1) / array.shape[1].",
)

# %% [markdown]
# **Your turn.** Write `row_means(array)`: the mean of each row of a matrix.

# %% role="answer"
def row_means(array):
    raise NotImplementedError("your turn")

# %% role="solution"
def row_means(array):
    return np.mean(array, axis=1)

# %% role="check"
check("arrays-middle", row_means)

# %% role="case" title="A small matrix" points=1 hint="Is there one mean for each row?"
def inputs(rng):
    return (rng.integers(0, 9, (2, 3)),)

# %% role="hidden" title="Any matrix" points=1 hint="Is there one mean for each row?"
def inputs(rng):
    return [(rng.integers(0, 99, shape),) for shape in ((1, 4), (4, 1), (3, 7))]

# %% role="mistake" name="the other axis" says="These are the means of the columns: axis=1 is the axis of columns."
def row_means(array):
    return np.mean(array, axis=0)

# %% [markdown]
# **Recap.** The axis that is named goes away.
