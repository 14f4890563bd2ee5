# %% name="max in place of min" origin="fresh" sentence="Take the smallest of the three numbers: min." must_say=["smallest|min"] kind="value"
def edit_distance(a, b):
    t = np.zeros((len(a) + 1, len(b) + 1), int)
    t[:, 0] = range(len(a) + 1)
    t[0, :] = range(len(b) + 1)
    for i in range(1, len(a) + 1):
        for j in range(1, len(b) + 1):
            t[i, j] = max(t[i - 1, j] + 1, t[i, j - 1] + 1, t[i - 1, j - 1] + (a[i - 1] != b[j - 1]))
    return int(t[-1, -1])

# %% name="without deleting" origin="fresh" sentence="The number above, plus 1, is missing." must_say=["above|delet"] kind="value"
def edit_distance(a, b):
    t = np.zeros((len(a) + 1, len(b) + 1), int)
    t[:, 0] = range(len(a) + 1)
    t[0, :] = range(len(b) + 1)
    for i in range(1, len(a) + 1):
        for j in range(1, len(b) + 1):
            t[i, j] = min(t[i, j - 1] + 1, t[i - 1, j - 1] + (a[i - 1] != b[j - 1]))
    return int(t[-1, -1])

# %% name="index without minus one" origin="fresh" sentence="Row i belongs to a[i - 1]: a[i] is the character after." must_say=["i - 1|last index|index"] kind="error"
def edit_distance(a, b):
    t = np.zeros((len(a) + 1, len(b) + 1), int)
    t[:, 0] = range(len(a) + 1)
    t[0, :] = range(len(b) + 1)
    for i in range(1, len(a) + 1):
        for j in range(1, len(b) + 1):
            t[i, j] = min(t[i - 1, j] + 1, t[i, j - 1] + 1, t[i - 1, j - 1] + (a[i] != b[j]))
    return int(t[-1, -1])

# %% name="plus one at the upper left always" origin="fresh" sentence="Equal characters cost nothing." must_say=["equal|differ"] kind="value"
def edit_distance(a, b):
    t = np.zeros((len(a) + 1, len(b) + 1), int)
    t[:, 0] = range(len(a) + 1)
    t[0, :] = range(len(b) + 1)
    for i in range(1, len(a) + 1):
        for j in range(1, len(b) + 1):
            t[i, j] = min(t[i - 1, j] + 1, t[i, j - 1] + 1, t[i - 1, j - 1] + 1)
    return int(t[-1, -1])

# %% name="no return" origin="fresh" sentence="The function returns nothing: add return." must_say=["return"] kind="no-return"
def edit_distance(a, b):
    t = np.zeros((len(a) + 1, len(b) + 1), int)
    t[:, 0] = range(len(a) + 1)
    t[0, :] = range(len(b) + 1)
    for i in range(1, len(a) + 1):
        for j in range(1, len(b) + 1):
            t[i, j] = min(t[i - 1, j] + 1, t[i, j - 1] + 1, t[i - 1, j - 1] + (a[i - 1] != b[j - 1]))
    print(t[-1, -1])
# %% name="table one too small" origin="fresh" sentence="The table needs one row and one column more than the texts have characters." must_say=["\\+ ?1|one (row|more)|too small|larger"] kind="value"
def edit_distance(a, b):
    table = np.zeros((len(a), len(b)), int)
    table[:, 0], table[0, :] = range(len(a)), range(len(b))
    for i in range(1, len(a)):
        for j in range(1, len(b)):
            differ = a[i - 1] != b[j - 1]
            table[i, j] = min(table[i - 1, j] + 1, table[i, j - 1] + 1,
                              table[i - 1, j - 1] + differ)
    return int(table[-1, -1])
# %% name="first row and column zero" origin="fresh" sentence="The first row and the first column must count up." must_say=["first row|count up|empty"] kind="value"
def edit_distance(a, b):
    table = np.zeros((len(a) + 1, len(b) + 1), int)
    for i in range(1, len(a) + 1):
        for j in range(1, len(b) + 1):
            differ = a[i - 1] != b[j - 1]
            table[i, j] = min(table[i - 1, j] + 1, table[i, j - 1] + 1,
                              table[i - 1, j - 1] + differ)
    return int(table[len(a), len(b)])
# %% name="place by place" origin="fresh" sentence="You compare place by place; after an insertion all later letters are moved." must_say=["insert|place by place|moved|shift"] kind="value"
def edit_distance(a, b):
    count = 0
    for first, second in zip(a, b):
        if first != second:
            count += 1
    return count + abs(len(a) - len(b))
# %% name="keeping costs one" origin="fresh" sentence="Equal characters cost nothing; you always add 1." must_say=["equal|same|keep|differ"] kind="value"
def edit_distance(a, b):
    table = np.zeros((len(a) + 1, len(b) + 1), int)
    table[:, 0] = range(len(a) + 1)
    table[0, :] = range(len(b) + 1)
    for i in range(1, len(a) + 1):
        for j in range(1, len(b) + 1):
            table[i, j] = min(table[i - 1, j] + 1, table[i, j - 1] + 1,
                              table[i - 1, j - 1] + 1)
    return int(table[len(a), len(b)])
# %% name="loops end one early" origin="fresh" sentence="range ends before its second number: the last row and column are never computed." must_say=["range|last|\\+ ?1"] kind="value"
def edit_distance(a, b):
    table = np.zeros((len(a) + 1, len(b) + 1), int)
    table[:, 0] = range(len(a) + 1)
    table[0, :] = range(len(b) + 1)
    for i in range(1, len(a)):
        for j in range(1, len(b)):
            differ = a[i - 1] != b[j - 1]
            table[i, j] = min(table[i - 1, j] + 1, table[i, j - 1] + 1,
                              table[i - 1, j - 1] + differ)
    return int(table[len(a), len(b)])
# %% name="sizes of the example" origin="fresh" sentence="The sizes 7 and 8 are only those of the example: use len(a) and len(b)." must_say=["7|8|len|example|length"] kind="error"
def edit_distance(a, b):
    table = np.zeros((7, 8), int)
    table[:, 0], table[0, :] = range(7), range(8)
    for i in range(1, 7):
        for j in range(1, 8):
            differ = a[i - 1] != b[j - 1]
            table[i, j] = min(table[i - 1, j] + 1, table[i, j - 1] + 1,
                              table[i - 1, j - 1] + differ)
    return table[6, 7]
# %% name="0 for an empty text" origin="fresh" sentence="From an empty text each character must be inserted: the distance is the other length, not 0." must_say=["empty|insert"] kind="value"
def edit_distance(a, b):
    if a == "" or b == "":
        return 0
    table = np.zeros((len(a) + 1, len(b) + 1), int)
    table[:, 0] = range(len(a) + 1)
    table[0, :] = range(len(b) + 1)
    for i in range(1, len(a) + 1):
        for j in range(1, len(b) + 1):
            differ = a[i - 1] != b[j - 1]
            table[i, j] = min(table[i - 1, j] + 1, table[i, j - 1] + 1,
                              table[i - 1, j - 1] + differ)
    return int(table[len(a), len(b)])
# %% name="adds one if equal" origin="fresh" sentence="The comparison is reversed: you add 1 if the characters are equal." must_say=["equal|differ|==|!=|same"] kind="value"
def edit_distance(a, b):
    table = np.zeros((len(a) + 1, len(b) + 1), int)
    table[:, 0] = range(len(a) + 1)
    table[0, :] = range(len(b) + 1)
    for i in range(1, len(a) + 1):
        for j in range(1, len(b) + 1):
            cost = a[i - 1] == b[j - 1]
            table[i, j] = min(table[i - 1, j] + 1, table[i, j - 1] + 1,
                              table[i - 1, j - 1] + cost)
    return int(table[len(a), len(b)])
# %% name="row and column exchanged" origin="fresh" sentence="The first column has len(a) + 1 numbers and the first row len(b) + 1; you exchanged them." must_say=["exchang|swap|len\\(a|room"] kind="error"
def edit_distance(a, b):
    table = np.zeros((len(a) + 1, len(b) + 1), int)
    table[0, :] = range(len(a) + 1)
    table[:, 0] = range(len(b) + 1)
    for i in range(1, len(a) + 1):
        for j in range(1, len(b) + 1):
            differ = a[i - 1] != b[j - 1]
            table[i, j] = min(table[i - 1, j] + 1, table[i, j - 1] + 1,
                              table[i - 1, j - 1] + differ)
    return int(table[len(a), len(b)])
# %% name="characters at i and j" origin="fresh" sentence="The character of row i is a[i - 1]; a[i] runs over the end." must_say=["- 1|end|last|outside|longer|index"] kind="error"
def edit_distance(a, b):
    table = np.zeros((len(a) + 1, len(b) + 1), int)
    table[:, 0] = range(len(a) + 1)
    table[0, :] = range(len(b) + 1)
    for i in range(1, len(a) + 1):
        for j in range(1, len(b) + 1):
            differ = a[i] != b[j]
            table[i, j] = min(table[i - 1, j] + 1, table[i, j - 1] + 1,
                              table[i - 1, j - 1] + differ)
    return int(table[len(a), len(b)])
