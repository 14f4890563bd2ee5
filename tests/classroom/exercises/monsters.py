"""Wrong answers to grayscale-luma that are a burden for the search for their mistake.

{name: source}. In the notebook, `frame` is an image of the drive.
"""

WIDE = "    wide = bgr.astype(np.uint32)\n"
SUM = "(wide[..., 0] * 3735 + wide[..., 1] * 19235 + wide[..., 2] * 9798 >> 15).astype(np.uint8)"
LINES = ",\n".join(map(str, range(20_000)))
MONSTERS = {
    "the lesson's frame for the argument": f"def luma(bgr):\n{WIDE.replace('bgr', 'frame')}    return {SUM}",
    "a helper longer than the answer": "def brightest(values):\n    best = 0\n    for value in values:\n"
    "        if value > best:\n            best = value\n    return best\n\n"
    "def luma(bgr):\n    return brightest(bgr[..., 1].ravel())",
    "a table that a new axis squares": "TABLE = np.arange(65_536.0)\n\ndef luma(bgr):\n"
    "    table = TABLE + TABLE\n    return (bgr[..., 0] + table[1]).astype(np.uint8)",
    "a result of a gigabyte": "def luma(bgr):\n    return np.ones((4_000, 4_000, 8))",
    "a long list": "def luma(bgr):\n    return [0] * 30_000_000",
    "a power that no signal ends": "def luma(bgr):\n    return bgr[..., 0] + 3 ** 10 ** 6 % 2",
    "a recursion": "def luma(bgr, n=0):\n    return bgr[..., 0] if n > 9000 else luma(bgr, n + 1)",
    "a literal of 20,000 lines": f"def luma(bgr):\n    table = [{LINES}]\n    return bgr[..., 0] + table[3]",
    "a range that grows": "def luma(bgr):\n    total = 0\n    for k in range(10 ** 6):\n        total += k\n"
    "    return bgr[..., 0] * (total > 9 ** 99)",
    "a pattern without an end": "import re\n\ndef luma(bgr):\n"
    "    return bgr[..., 0] * bool(re.match('(a+)+$', 'a' * 20 + 'b'))",
    "the argument, filled in place": "def luma(bgr):\n    bgr[...] = 0\n    return bgr[..., 0]",
    "the lesson's frame, filled in place": "def luma(bgr):\n"
    "    frame[...] = frame - 1\n    return bgr[..., 0]",
    "a sort of a large array": "def luma(bgr):\n    values = np.random.default_rng(1).random(4_000_000)\n"
    "    return bgr[..., 0] * bool(np.sort(values)[0] > 1)",
    "a million warnings": "def luma(bgr):\n    for k in range(10 ** 6): np.uint8(200) + np.uint8(99)\n"
    "    return bgr[..., 0]",
    "a dict of long keys": "def luma(bgr):\n    return {f'{k:9999}': bgr for k in range(9000)}",
    "an error of a gigabyte": "def luma(bgr):\n    raise ValueError('x' * 10 ** 9)",
}
