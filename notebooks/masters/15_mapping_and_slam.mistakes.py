# %% [markdown]
# # mapping-ray

# %%
def on_way(start, end, k, steps):
    """Where a coordinate is after step k."""
    way = (2 * k * abs(end - start) + steps) // (2 * steps)
    return start + way * (1 if end > start else -1)

def line_of(start, end, steps, place=on_way):
    return [(place(start[0], end[0], k, steps), place(start[1], end[1], k, steps)) for k in range(steps + 1)]

def length_of(start, end):
    return max(abs(end[0] - start[0]), abs(end[1] - start[1]))

# %% role="mistake" name="without the end" says="The last cell is missing: the ray ends in end. range(steps + 1) counts to steps."
def ray_cells(start, end):
    return solution(start, end)[:-1]

# %% role="mistake" name="without the start" says="The first cell is missing: the ray begins in start. Count k from 0."
def ray_cells(start, end):
    return solution(start, end)[1:]

# %% role="mistake" name="rounded down" says="You round down. Take the nearest row and column: add steps before you divide, (2 * k * abs(way) + steps) // (2 * steps)."
def ray_cells(start, end):
    return line_of(start, end, length_of(start, end), lambda a, b, k, n: a + k * abs(b - a) // n * (1 if b > a else -1))

# %% role="mistake" name="rounded down also below zero" says="You round each row and column down, also where they become smaller. Take the nearest: round the length of the way, and multiply by the sign afterwards."
def ray_cells(start, end):
    return line_of(start, end, length_of(start, end), lambda a, b, k, n: a + k * (b - a) // n)

# %% role="mistake" name="rounded up" says="You round up. Take the nearest row and column: (2 * k * abs(way) + steps) // (2 * steps)."
def ray_cells(start, end):
    return line_of(start, end, length_of(start, end), lambda a, b, k, n: a - -k * abs(b - a) // n * (1 if b > a else -1))

# %% role="mistake" name="Python's round" says="A half goes to the wrong side: round(0.5) is 0, but round(1.5) is 2. Use the formula with whole numbers: (2 * k * abs(way) + steps) // (2 * steps)."
def ray_cells(start, end):
    return line_of(start, end, length_of(start, end), lambda a, b, k, n: a + round(k * (b - a) / n))

# %% role="mistake" name="round of the place" says="A half goes to the wrong side: round(0.5) is 0, but round(1.5) is 2. Use the formula with whole numbers, and add it to the start."
def ray_cells(start, end):
    return line_of(start, end, length_of(start, end), lambda a, b, k, n: round(a + k * (b - a) / n))

# %% role="mistake" name="halves towards the start" says="A half goes to the wrong side: of two equally near cells, take the one farther from the start."
def ray_cells(start, end):
    return line_of(start, end, length_of(start, end), lambda a, b, k, n: a - (-2 * k * abs(b - a) + n) // (2 * n) * (1 if b > a else -1))

# %% role="mistake" name="halves up on each way" says="Where a coordinate becomes smaller, a half goes to the wrong side: // and floor round a negative number down. Round the length of the way, abs(way), and multiply by the sign afterwards."
def ray_cells(start, end):
    return line_of(start, end, length_of(start, end), lambda a, b, k, n: a + (2 * k * (b - a) + n) // (2 * n))

# %% role="mistake" name="steps are the columns" says="Your ray takes one step for each column, so a steep ray has gaps, or is missing. The number of steps is the larger of both ways: max(abs(row_way), abs(col_way))."
def ray_cells(start, end):
    steps = abs(end[1] - start[1])
    return line_of(start, end, steps) if steps else [start]

# %% role="mistake" name="steps are the rows" says="Your ray takes one step for each row, so a flat ray has gaps. The number of steps is the larger of both ways: max(abs(row_way), abs(col_way))."
def ray_cells(start, end):
    steps = abs(end[0] - start[0])
    return line_of(start, end, steps) if steps else [start]

# %% role="mistake" name="both ways as steps" says="You take as many steps as both ways together. The number of steps is the larger of both: max(abs(row_way), abs(col_way))."
def ray_cells(start, end):
    return line_of(start, end, abs(end[0] - start[0]) + abs(end[1] - start[1]))

# %% role="mistake" name="the smaller way" says="The number of steps is the larger of both ways, not the smaller one: max, not min."
def ray_cells(start, end):
    return line_of(start, end, max(1, min(abs(end[0] - start[0]), abs(end[1] - start[1]))))

# %% role="mistake" name="diagonal first" says="Your ray goes diagonally first, and then straight. Spread the smaller way over all steps: compute row and column by the formula for each k."
def ray_cells(start, end):
    (row, col), cells = start, [start]
    while (row, col) != tuple(end):
        row += (end[0] > row) - (end[0] < row)
        col += (end[1] > col) - (end[1] < col)
        cells.append((row, col))
    return cells

# %% role="mistake" name="from the end" says="The cells are in the wrong order: begin with start."
def ray_cells(start, end):
    return solution(start, end)[::-1]

# %% role="mistake" name="computed from the end" says="You begin at end. Begin at start: the halves are rounded away from it, and the first cell of the list is start."
def ray_cells(start, end):
    return solution(end, start)

# %% role="mistake" name="only both ends" says="Only the first and the last cell are there. Append a cell in each step, in a loop."
def ray_cells(start, end):
    return [start, end]

# %% role="mistake" name="numbers with a point" says="You did not round: a cell has whole numbers. Use the formula with // and whole numbers."
def ray_cells(start, end):
    return line_of(start, end, length_of(start, end), lambda a, b, k, n: a + k * (b - a) / n)

# %% [markdown]
# # mapping-scan

# %%
def odds_log(p):
    return math.log(p / (1 - p))

def changes(shape, rays, at_end, on_way, ends_last=True):
    change = np.zeros(shape)
    loops = [[(ray[:-1], on_way) for ray in rays], [(ray[-1:], at_end) for ray in rays]]
    for parts in loops if ends_last else loops[::-1]:
        for cells, value in parts:
            for row, col in cells:
                change[row, col] = value
    return change

# %% role="mistake" name="each ray counts" says="You add for each ray: a cell that many rays pass changes many times. In one scan, each cell changes once: write each change into a grid of zeros, with = alone, and add this grid at the end."
def add_scan(grid, rays, hit, passed):
    new = grid.copy()
    for ray in rays:
        for row, col in ray[:-1]:
            new[row, col] += odds_log(passed)
        new[ray[-1][0], ray[-1][1]] += odds_log(hit)
    return np.clip(new, -6, 6)

# %% role="mistake" name="hit and passed added" says="Where one ray ends and another one passes, you add both. The hit wins: write the ends last, with =."
def add_scan(grid, rays, hit, passed):
    on_way = changes(grid.shape, rays, 0.0, odds_log(passed), ends_last=False)
    ends = changes(grid.shape, rays, odds_log(hit), 0.0, ends_last=True)
    ends[ends < 0] = 0
    return np.clip(grid + on_way + ends, -6, 6)

# %% role="mistake" name="passing rays win" says="A ray that passes wins over one that ends. The hit must win: write the ends in a second loop, after all cells on the way."
def add_scan(grid, rays, hit, passed):
    return np.clip(grid + changes(grid.shape, rays, odds_log(hit), odds_log(passed), ends_last=False), -6, 6)

# %% role="mistake" name="one loop" says="A later ray writes over the end of an earlier one. Write the ends in a second loop over all rays."
def add_scan(grid, rays, hit, passed):
    change = np.zeros(grid.shape)
    for ray in rays:
        for row, col in ray[:-1]:
            change[row, col] = odds_log(passed)
        change[ray[-1][0], ray[-1][1]] = odds_log(hit)
    return np.clip(grid + change, -6, 6)

# %% role="mistake" name="clipped at 6 only" says="Cells also stop at -6: np.clip(..., -6, 6)."
def add_scan(grid, rays, hit, passed):
    return np.minimum(grid + changes(grid.shape, rays, odds_log(hit), odds_log(passed)), 6)

# %% role="mistake" name="clipped at -6 only" says="Cells also stop at 6: np.clip(..., -6, 6)."
def add_scan(grid, rays, hit, passed):
    return np.maximum(grid + changes(grid.shape, rays, odds_log(hit), odds_log(passed)), -6)

# %% role="mistake" name="not clipped" says="The sums leave the range -6 to 6: nothing is clipped, or only a part of the sum. At the end: np.clip(grid + change, -6, 6)."
def add_scan(grid, rays, hit, passed):
    return grid + changes(grid.shape, rays, odds_log(hit), odds_log(passed))

# %% role="mistake" name="probability subtracted" says="You use the probabilities as they are. Add their log-odds, math.log(p / (1 - p)): those of passed are negative by themselves."
def add_scan(grid, rays, hit, passed):
    return np.clip(grid + changes(grid.shape, rays, hit, -passed), -6, 6)

# %% role="mistake" name="logarithm to base 2" says="You use the logarithm to base 2. Use the natural one: math.log or np.log."
def add_scan(grid, rays, hit, passed):
    return np.clip(grid + changes(grid.shape, rays, odds_log(hit) / math.log(2), odds_log(passed) / math.log(2)), -6, 6)

# %% role="mistake" name="hit and passed exchanged" says="Hit and passed are exchanged: hit belongs to the last cell of a ray, passed to all others."
def add_scan(grid, rays, hit, passed):
    return np.clip(grid + changes(grid.shape, rays, odds_log(passed), odds_log(hit)), -6, 6)

# %% role="mistake" name="only the way" says="The ends of the rays are not hits. Add the log-odds of hit in the last cell of each ray."
def add_scan(grid, rays, hit, passed):
    return np.clip(grid + changes(grid.shape, rays, 0.0, odds_log(passed), ends_last=False), -6, 6)

# %% role="mistake" name="the end also passed" says="You treat the last cell as if the ray passed it. It is a hit: ray[:-1] are the others."
def add_scan(grid, rays, hit, passed):
    return np.clip(grid + changes(grid.shape, [[*ray, ray[-1]] for ray in rays], odds_log(passed), odds_log(passed)), -6, 6)

# %% role="mistake" name="probabilities returned" says="You return probabilities. Return the log-odds."
def add_scan(grid, rays, hit, passed):
    return 1 / (1 + np.exp(-solution(grid, rays, hit, passed)))

# %% [markdown]
# # mapping-error

# %%
def edge_parts(first, second, yaw=None, side=1.0):
    """ahead, left and the plain difference of the yaws; side -1 turns to the wrong side."""
    yaw = first[2] if yaw is None else yaw
    c, s = math.cos(yaw), side * math.sin(yaw)
    dx, dy = second[0] - first[0], second[1] - first[1]
    return c * dx + s * dy, c * dy - s * dx, second[2] - first[2]

def error_with(first, second, measured, yaw=None, side=1.0, angle=wrapped):
    ahead, left, turn = edge_parts(first, second, yaw, side)
    return np.array([ahead - measured[0], left - measured[1], angle(turn - measured[2])])

# %% role="mistake" name="not wrapped" says="Your angle is not wrapped: from 170° to -170°, a robot turns by 20°, not by -340°. Use math.remainder(angle, 2 * math.pi)."
def edge_error(first, second, measured):
    return error_with(first, second, measured, angle=float)

# %% role="mistake" name="wrapped too early" says="You wrap before the measured angle is subtracted. The difference can be too large again: wrap at the very end."
def edge_error(first, second, measured):
    ahead, left, turn = edge_parts(first, second)
    return np.array([ahead - measured[0], left - measured[1], wrapped(turn) - measured[2]])

# %% role="mistake" name="all three wrapped" says="You wrap all three values, and the first two are metres. Wrap only the angle."
def edge_error(first, second, measured):
    ahead, left, turn = edge_parts(first, second) - np.array(measured)
    return np.array([wrapped(ahead), wrapped(left), wrapped(turn)])

# %% role="mistake" name="remainder by half a turn" says="You took the remainder by π, which is half a turn. Use 2 * math.pi."
def edge_error(first, second, measured):
    return error_with(first, second, measured, angle=lambda angle: math.remainder(angle, math.pi))

# %% role="mistake" name="turned to the wrong side" says="You turn to the wrong side (a sign of s is wrong): ahead = c * dx + s * dy, left = c * dy - s * dx."
def edge_error(first, second, measured):
    return error_with(first, second, measured, side=-1.0)

# %% role="mistake" name="turned by the second yaw" says="You turn by the yaw of the second pose. The motion is seen from the first pose: use first[2]."
def edge_error(first, second, measured):
    return error_with(first, second, measured, yaw=second[2])

# %% role="mistake" name="turned by the measured angle" says="You turn by the measured angle. Use the yaw of the first pose, first[2]."
def edge_error(first, second, measured):
    return error_with(first, second, measured, yaw=measured[2])

# %% role="mistake" name="ahead and left exchanged" says="Ahead and left are exchanged: the first number is ahead."
def edge_error(first, second, measured):
    ahead, left, turn = edge_parts(first, second)
    return np.array([left - measured[0], ahead - measured[1], wrapped(turn - measured[2])])

# %% role="mistake" name="from the second to the first" says="This is the motion from the second pose to the first. Compute second minus first, turned by first[2]."
def edge_error(first, second, measured):
    return error_with(second, first, measured)

# %% role="mistake" name="second less first exchanged" says="dx, dy and the angle have the wrong sign: they are second minus first."
def edge_error(first, second, measured):
    ahead, left, turn = edge_parts(first, second)
    return np.array([-ahead - measured[0], -left - measured[1], wrapped(-turn - measured[2])])

# %% role="mistake" name="absolute angle" says="The sign of the angle is lost: a turn to the right is negative. Leave abs out."
def edge_error(first, second, measured):
    ahead, left, angle = solution(first, second, measured)
    return np.array([ahead, left, abs(angle)])

# %% role="mistake" name="squared" says="You return the squares. Return the differences themselves."
def edge_error(first, second, measured):
    return solution(first, second, measured) ** 2

# %% role="mistake" name="one number" says="You return one number. Return the three differences: ahead, left and angle."
def edge_error(first, second, measured):
    return float((solution(first, second, measured) ** 2).sum())

# %% role="mistake" name="degrees" says="The angle is in degrees. Leave it in radians."
def edge_error(first, second, measured):
    return solution(first, second, measured) * (1, 1, 180 / math.pi)

# %% role="mistake" name="yaw taken as degrees" says="The yaws are in radians already. Do not convert them from degrees."
def edge_error(first, second, measured):
    return error_with(first, second, measured, yaw=math.radians(first[2]))

# %% role="mistake" name="rounded" says="The numbers are rounded. Return the exact numbers, and leave round out."
def edge_error(first, second, measured):
    return solution(first, second, measured).round(2)
