"""Times several ways of doing one thing in turns, so that a busy machine slows all of them alike."""

import statistics
import time

from rich.console import Console
from rich.table import Table


def time_in_turns(ways, *, rounds=50, warm_up=3):
    """Median seconds a call of each way; the ways take turns, round by round.

    Parameters
    ----------
    ways : dict of name -> function without arguments
    rounds, warm_up : calls of each way that count, and calls before them that do not

    Returns
    -------
    dict of name -> median wall time of one call, in seconds
    """
    for _ in range(warm_up):
        for way in ways.values():
            way()
    taken = {name: [] for name in ways}
    for _ in range(rounds):
        for name, way in ways.items():
            started = time.perf_counter()
            way()
            taken[name].append(time.perf_counter() - started)
    return {name: statistics.median(seconds) for name, seconds in taken.items()}


def print_ratios(title, medians, peer, budgets=None):
    """Prints a table: time of each way, its ratio to `peer`, and the budget that the ratio must keep.

    `budgets` maps a name to the largest ratio allowed. Returns the names over their budget.
    """
    budgets = budgets or {}
    table = Table("way", "µs", f"× {peer}", "budget", title=title, title_justify="left")
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
