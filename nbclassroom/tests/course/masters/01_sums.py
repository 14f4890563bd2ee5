# ---
# jupyter:
#   small_course:
#     title: Sums
# ---

# %% [markdown]
# # Sums
#
# You will add numbers up. **Time** [[minutes]].

# %%
from nbclassroom.exercises import check, compare_guess, hint, solution

# %% [markdown]
# **Predict** the sum of 1, 2 and 3: write your guess instead of `None`.

# %% role="predict"
guess_sum = None  # your guess: which number?

# %%
added = 1 + 2 + 3
compare_guess(guess_sum, added)

# %% role="exercise"
from nbclassroom.exercises import exercise

exercise(
    "sums-total",
    title="The sum of a list",
    function="total",
    time_limit=2,
    hints=("What is the sum of an empty list?", "Begin with 0.", "for number in numbers: ..."),
    explanation="Each number is added to what was there before.",
    another_way="You can also write sum(numbers).",
)

# %% [markdown]
# **Your turn.** Write `total(numbers)`: the sum of a list of integers.

# %% role="answer"
def total(numbers):
    raise NotImplementedError("your turn")

# %% role="solution"
def total(numbers):
    result = 0
    for number in numbers:
        result += number
    return result

# %% role="check"
check("sums-total", total)

# %% role="case" title="Three numbers" points=1 hint="Is each number added?"
def inputs(rng):
    return (rng.integers(1, 9, 3).tolist(),)

# %% role="hidden" title="Any list" points=2 hint="Is a list of any length added up?"
def inputs(rng):
    return [(rng.integers(-99, 99, count).tolist(),) for count in (0, 1, 5, 9)]

# %% role="mistake" name="the last one is missing" says="The last number is missing in your sum."
def total(numbers):
    return sum(numbers[:-1])

# %% [markdown]
# **Recap.** A sum begins with 0.
