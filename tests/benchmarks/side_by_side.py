"""Times several functions in turns, so that a busy machine slows all of them equally."""

import statistics
import time

from rich.console import Console
from rich.table import Table


def time_in_turns(functions, *, rounds=50, warm_up=3):
    """Median seconds per call of each function; the functions take turns, round by round.

    Parameters
    ----------
    functions : dict of name -> function without arguments
    rounds, warm_up : calls of each function that count, and calls before them that do not

    Returns
    -------
    dict of name -> median wall time of one call, in seconds
    """
    for _ in range(warm_up):
        for function in functions.values():
            function()
    durations = {name: [] for name in functions}
    for _ in range(rounds):
        for name, function in functions.items():
            started = time.perf_counter()
            function()
            durations[name].append(time.perf_counter() - started)
    return {name: statistics.median(seconds) for name, seconds in durations.items()}


def print_ratios(title, medians, peer, budgets=None):
    """Prints a table: time of each function, its ratio to `peer`, and the budget of this ratio.

    `budgets` maps a name to its largest allowed ratio. Returns the names above their budget.
    """
    budgets = budgets or {}
    table = Table("function", "µs", f"× {peer}", "budget", title=title, title_justify="left")
    over = []
    for name, seconds in medians.items():
        ratio = seconds / medians[peer]
        budget = budgets.get(name)
        if budget is not None and ratio > budget:
            over.append(name)
        verdict = "" if budget is None else f"≤ {budget:g} {'OVER' if ratio > budget else 'kept'}"
        table.add_row(name, f"{seconds * 1e6:,.1f}", f"{ratio:.2f}", verdict)
    Console(width=110).print(table)
    return over
