# %% name="braking alone" origin="new" sentence="The robot drives on during its reaction." must_say=["reaction"] kind="value"
def safe_speed(free, reaction, deceleration, limit):
    if free <= 0:
        return 0.0
    return min(limit, math.sqrt(2 * deceleration * free))

# %% name="reaction alone" origin="new" sentence="The way of braking is missing." must_say=["brak"] kind="value"
def safe_speed(free, reaction, deceleration, limit):
    if free <= 0:
        return 0.0
    if reaction == 0:
        return limit
    return min(free / reaction, limit)

# %% name="limit forgotten" origin="new" sentence="The speed must not be higher than limit." must_say=["limit"] kind="value"
def safe_speed(free, reaction, deceleration, limit):
    if free <= 0:
        return 0.0
    h = deceleration * reaction
    return -h + math.sqrt(h**2 + 2 * deceleration * free)

# %% name="max" origin="new" sentence="Take the smaller one: min(speed, limit)." must_say=["min\\("] kind="value"
def safe_speed(free, reaction, deceleration, limit):
    if free <= 0:
        return 0.0
    h = deceleration * reaction
    return max(limit, -h + math.sqrt(h**2 + 2 * deceleration * free))

# %% name="negative root" origin="new" sentence="Ask first whether free is 0 or negative." must_say=["free <= 0|negative"] kind="error"
def safe_speed(free, reaction, deceleration, limit):
    h = deceleration * reaction
    return min(limit, -h + math.sqrt(h**2 + 2 * deceleration * free))

# %% name="only exactly zero" origin="new" sentence="A negative free way is no free way either: free <= 0." must_say=["negative|<= 0"] kind="error"
def safe_speed(free, reaction, deceleration, limit):
    if free == 0:
        return 0.0
    h = deceleration * reaction
    return min(limit, -h + math.sqrt(h**2 + 2 * deceleration * free))

# %% name="abs" origin="new" sentence="A negative free way is no way: return 0.0." must_say=["negative|0\\.0"] kind="value"
def safe_speed(free, reaction, deceleration, limit):
    h = deceleration * reaction
    return min(limit, -h + math.sqrt(h**2 + 2 * deceleration * abs(free)))

# %% name="None" origin="new" sentence="Return 0.0, a number, if nothing is free." must_say=["0\\.0"] kind="type"
def safe_speed(free, reaction, deceleration, limit):
    if free <= 0:
        return None
    h = deceleration * reaction
    return min(limit, -h + math.sqrt(h**2 + 2 * deceleration * free))

# %% name="limit returned for no way" origin="new" sentence="If nothing is free, the robot must stand: 0.0." must_say=["0\\.0"] kind="value"
def safe_speed(free, reaction, deceleration, limit):
    if free <= 0:
        return limit
    h = deceleration * reaction
    return min(limit, -h + math.sqrt(h**2 + 2 * deceleration * free))

# %% name="minus root" origin="new" sentence="This solution is negative; the other one is right: + the root." must_say=["-h \\+|negative"] kind="value"
def safe_speed(free, reaction, deceleration, limit):
    if free <= 0:
        return 0.0
    h = deceleration * reaction
    return min(limit, -h - math.sqrt(h**2 + 2 * deceleration * free))

# %% name="plus and minus clipped" origin="new" sentence="This solution is negative; the other one is right: + the root." must_say=["-h \\+|negative"] kind="value"
def safe_speed(free, reaction, deceleration, limit):
    h = deceleration * reaction
    root = math.sqrt(h**2 + max(0.0, 2 * deceleration * free))
    return max(0.0, min(limit, -h - root))

# %% name="h not halved" origin="new" sentence="h is deceleration * reaction, the half of the factor of v." must_say=["h is deceleration|twice"] kind="value"
def safe_speed(free, reaction, deceleration, limit):
    if free <= 0:
        return 0.0
    h = 2 * deceleration * reaction
    return min(limit, -h + math.sqrt(h**2 + 2 * deceleration * free))

# %% name="q without the 2" origin="new" sentence="q is 2 * deceleration * free." must_say=["2"] kind="value"
def safe_speed(free, reaction, deceleration, limit):
    if free <= 0:
        return 0.0
    h = deceleration * reaction
    return min(limit, -h + math.sqrt(h**2 + deceleration * free))

# %% name="midnight formula, 2a forgotten" origin="new" sentence="The formula divides by 2 * a." must_say=["divide|twice as high"] kind="value"
def safe_speed(free, reaction, deceleration, limit):
    if free <= 0:
        return 0.0
    a, b, c = 1 / (2 * deceleration), reaction, -free
    return min(limit, (-b + math.sqrt(b * b - 4 * a * c)) / a)

# %% name="midnight formula, parentheses" origin="new" sentence="Put the whole numerator into parentheses." must_say=["h is|h \\*\\* 2|parenthes"] kind="value"
def safe_speed(free, reaction, deceleration, limit):
    if free <= 0:
        return 0.0
    a, b, c = 1 / (2 * deceleration), reaction, -free
    return min(limit, -b + math.sqrt(b * b - 4 * a * c) / (2 * a))

# %% name="midnight formula, sign of c" origin="new" sentence="free belongs to the other side: c is negative, so a plus stands under the root." must_say=["plus|negative"] kind="error"
def safe_speed(free, reaction, deceleration, limit):
    if free <= 0:
        return 0.0
    a, b, c = 1 / (2 * deceleration), reaction, free
    return min(limit, (-b + math.sqrt(b * b - 4 * a * c)) / (2 * a))

# %% name="braking without the 2" origin="new" sentence="The way of braking is v ** 2 / (2 * deceleration)." must_say=["2 \\* deceleration"] kind="value"
def safe_speed(free, reaction, deceleration, limit):
    if free <= 0:
        return 0.0
    a, b = 1 / deceleration, reaction
    return min(limit, (-b + math.sqrt(b * b + 4 * a * free)) / (2 * a))

# %% name="multiplied by the deceleration" origin="new" sentence="Parentheses are missing: v ** 2 / (2 * deceleration)." must_say=["2 \\* deceleration\\)|parenthes"] kind="value"
def safe_speed(free, reaction, deceleration, limit):
    if free <= 0:
        return 0.0
    a, b = deceleration / 2, reaction
    return min(limit, (-b + math.sqrt(b * b + 4 * a * free)) / (2 * a))

# %% name="h is reaction" origin="new" sentence="h is deceleration * reaction." must_say=["deceleration \\* reaction"] kind="value"
def safe_speed(free, reaction, deceleration, limit):
    if free <= 0:
        return 0.0
    h = reaction
    return min(limit, -h + math.sqrt(h**2 + 2 * deceleration * free))

# %% name="q is free" origin="new" sentence="q is 2 * deceleration * free." must_say=["2 \\* deceleration \\* free"] kind="value"
def safe_speed(free, reaction, deceleration, limit):
    if free <= 0:
        return 0.0
    h = deceleration * reaction
    return min(limit, -h + math.sqrt(h**2 + free))

# %% name="times 2" origin="new" sentence="** 2 squares, * 2 doubles." must_say=["squar"] kind="value"
def safe_speed(free, reaction, deceleration, limit):
    if free <= 0:
        return 0.0
    h = deceleration * reaction
    return min(limit, -h + math.sqrt(h * 2 + 2 * deceleration * free))

# %% name="root forgotten" origin="new" sentence="The root is missing." must_say=["root"] kind="value"
def safe_speed(free, reaction, deceleration, limit):
    if free <= 0:
        return 0.0
    h = deceleration * reaction
    return min(limit, -h + h**2 + 2 * deceleration * free)

# %% name="stop or go" origin="new" sentence="Between 0 and limit there is the speed that just fits." must_say=["between|just"] kind="value"
def safe_speed(free, reaction, deceleration, limit):
    if reaction * limit + limit**2 / (2 * deceleration) <= free:
        return limit
    return 0.0

# %% name="a share" origin="new" sentence="The way grows with the square of the speed: a share is not right." must_say=["quadratic|square|equation"] kind="value"
def safe_speed(free, reaction, deceleration, limit):
    if free <= 0:
        return 0.0
    whole = reaction * limit + limit**2 / (2 * deceleration)
    return min(limit, limit * free / whole)

# %% name="reaction at the limit" origin="new" sentence="The robot reacts at the speed v, not at the limit." must_say=["limit"] kind="value"
def safe_speed(free, reaction, deceleration, limit):
    if free <= 0:
        return 0.0
    left = free - reaction * limit
    if left <= 0:
        return 0.0
    return min(limit, math.sqrt(2 * deceleration * left))

# %% name="the distance" origin="new" sentence="This is the stopping distance; the speed is asked." must_say=["speed"] kind="value"
def safe_speed(free, reaction, deceleration, limit):
    if free <= 0:
        return 0.0
    return min(limit, reaction * free + free**2 / (2 * deceleration))

# %% name="0.6 typed" origin="new" sentence="Use the argument deceleration." must_say=["argument"] kind="value"
def safe_speed(free, reaction, deceleration, limit):
    if free <= 0:
        return 0.0
    h = 0.6 * reaction
    return min(limit, -h + math.sqrt(h**2 + 1.2 * free))

# %% name="search in steps" origin="new" sentence="Steps give a rounded speed: solve the equation." must_say=["solve|rounded"] kind="value"
def safe_speed(free, reaction, deceleration, limit):
    best = 0.0
    for k in range(1001):
        v = k / 1000
        if v <= limit and reaction * v + v**2 / (2 * deceleration) <= free:
            best = v
    return best

# %% name="two decimals" origin="new" sentence="Do not round." must_say=["round"] kind="value"
def safe_speed(free, reaction, deceleration, limit):
    if free <= 0:
        return 0.0
    h = deceleration * reaction
    return round(min(limit, -h + math.sqrt(h**2 + 2 * deceleration * free)), 2)

# %% name="the formula alone" origin="walk" sentence="The limit and the question for free <= 0 are missing." must_say=["free <= 0", "limit"] kind="error"
def safe_speed(free, reaction, deceleration, limit):
    h = deceleration * reaction
    q = 2 * deceleration * free
    return -h + math.sqrt(h**2 + q)

# %% name="^ for a power" origin="walk" sentence="In Python ^ is not a power: write **." must_say=["not a power"] kind="error"
def safe_speed(free, reaction, deceleration, limit):
    if free <= 0:
        return 0.0
    h = deceleration * reaction
    q = 2 * deceleration * free
    return min(-h + math.sqrt(h ^ 2 + q), limit)
