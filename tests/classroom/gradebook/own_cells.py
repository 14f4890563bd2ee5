"""Answers to light-double that read what a learner's own cells define, and cells to put beside them.

A form is the learner's cells above the answer, the answer, and perhaps their cells below it.
"""

DOUBLE = "def double(pixels):\n    return np.minimum({}, LIMIT).astype(np.uint8)"
TIMES = DOUBLE.format("pixels.astype(np.uint16) * {}")
FACTOR, TABLE = TIMES.format("FACTOR"), DOUBLE.format("np.array(TABLE)[pixels]")
WIDE = DOUBLE.format("wide(pixels) * 2")
FILL = "for level in range(256):\n    TABLE[level] = level * FACTOR"
DATACLASS = "from __future__ import annotations\nfrom dataclasses import dataclass\n"
DATACLASS += "@dataclass\nclass Own:\n    factor: int = 2\n"

# {name: (the learner's cells, the answer)}: forms of a right answer about which check and grading disagreed.
ONCE_REFUSED = {
    "an array": (["FACTOR = np.array([2])"], FACTOR),
    "a print below it": (["FACTOR = np.array([2])\nprint('factor', FACTOR)"], FACTOR),
    "an assert below it": (["FACTOR = np.array([2])\nassert FACTOR.sum() == 2"], FACTOR),
    "a print of something else": (["print(np.zeros(3))\nFACTOR = np.array([2])"], FACTOR),
    "a table filled by a loop": ([f"FACTOR = 2\nTABLE = np.zeros(256, np.uint16)\n{FILL}"], TABLE),
    "a table filled in another cell": (["FACTOR = 2\nTABLE = [0] * 256", FILL], TABLE),
    "a table filled by a function of another cell": (
        ["def fill(table):\n    table += [2]"],
        f"TABLE = []\nfill(TABLE)\n{TIMES.format('TABLE[0]')}",
    ),
    "a table of another cell filled above the answer": (
        ["def fill(table):\n    table += [2]\nTABLE = []"],
        f"fill(TABLE)\n{TIMES.format('TABLE[0]')}",
    ),
    "registered by a decorator of another cell": (
        ["TABLE = {}\ndef register(f):\n    TABLE[f.__name__] = f\n    return f"],
        f"@register\n{TIMES.format(2)}".replace("double", "twice") + "\ndouble = TABLE['twice']",
    ),
    "registered by a base class": (
        ["class Base:\n    all = {}\n    def __init_subclass__(cls):\n        Base.all[cls.__name__] = cls"],
        "class Twice(Base):\n    factor = 2\n" + TIMES.format("Base.all['Twice'].factor"),
    ),
    "a decorator whose function has the name of another value": (
        ["def debug(f):\n    def one(*a):\n        return f(*a)\n    return one", "one = np.zeros(3)"],
        f"@debug\n{TIMES.format(2)}",
    ),
    "a dataclass with annotations as text": ([], DATACLASS + TIMES.format("Own().factor")),
    "pickled": (
        [],
        "import pickle\nclass Own:\n    factor = 2\n"
        + TIMES.format("pickle.loads(pickle.dumps(Own())).factor"),
    ),
}
FORMS = [
    *ONCE_REFUSED.values(),
    (["FACTOR = 1", "FACTOR += 1", "print(FACTOR)"], FACTOR),
    (["FACTOR = 3\nprint(FACTOR)", "FACTOR -= 1\nprint(FACTOR)"], FACTOR),
    (["FACTOR = 5\nFACTOR += 1\nother = FACTOR\nFACTOR = 2"], FACTOR),
    (["FACTOR = 0\nfor _ in range(2):\n    FACTOR += 1\nprint(FACTOR)"], FACTOR),
    (["LIMIT, FACTOR = 255, 2"], FACTOR),
    (["FACTOR = 1"], f"FACTOR = FACTOR + 1\nprint(FACTOR)\n{FACTOR}"),
    (["NAMES = ['b']", "NAMES.append('a')", "NAMES.sort()\nprint(NAMES)"], TIMES.format("len(NAMES)")),
    (
        ["def twice(level):\n    return level * FACTOR", "FACTOR = 2", "TABLE = [*map(twice, range(256))]"],
        TABLE,
    ),
    (["TABLE = []"], f"for level in range(256):\n    TABLE.append(2 * level)\n{TABLE}"),
    (["TABLE = [2 * level for level in range(256)]"], f"print(TABLE)\n{TABLE}\nprint(double(np.uint8([3])))"),
    (["KIND = np.uint16\nprint(KIND)", "def wide(pixels):\n    return pixels.astype(KIND)"], WIDE),
    (["def wide(pixels):\n    return pixels.astype(KIND)", "KIND = np.uint16", "print(wide)"], WIDE),
    (
        ["class Widener:\n    kind = int\n    def __call__(self, p):\n        return p.astype(self.kind)"],
        DOUBLE.format("Widener()(pixels) * 2"),
    ),
    (
        [
            "class Kind:\n    kind = np.uint16",
            "class Widener(Kind):\n    def __call__(self, p):\n        return p.astype(self.kind)",
        ],
        DOUBLE.format("Widener()(pixels) * 2"),
    ),
    (
        ["FACTOR = 2", "class Table:\n    levels = [FACTOR * 2, FACTOR]", "FACTOR = 3"],
        TIMES.format("Table.levels[1]"),
    ),
    (
        ["class Kind:\n    factor = 2"],
        f"class Twice(Kind):\n    pass\nclass Kind:\n    factor = 3\n{TIMES.format('Twice.factor')}",
    ),
    (
        ["FACTOR = 2"],
        f"{TIMES.format('factor').replace('(pixels)', '(pixels, factor=FACTOR)')}\nFACTOR = 3",
    ),
    (
        ["def same(kind):\n    return kind"],
        f"@same\nclass Twice:\n    factor = 2\nsame = None\n{TIMES.format('Twice.factor')}",
    ),
    (
        ["from numpy import *", "print(minimum)"],
        "def double(pixels):\n    return minimum(pixels.astype(uint16) * 2, LIMIT).astype(uint8)",
    ),
    (["import cv2\nFACTOR = cv2.IMREAD_COLOR + 1"], FACTOR),
    (["import cv2\ndef wide(pixels):\n    return cv2.add(pixels, pixels)"], DOUBLE.format("wide(pixels)")),
    (["import cv2", "FACTOR = 2"], f"import cv2\n{FACTOR}"),
    ([], f"try:\n    import cv2\nexcept ImportError:\n    cv2 = None\n{TIMES.format('(3 if cv2 else 2)')}"),
    ([], DOUBLE.format("cv2.add(pixels, pixels)")),
    (["frame = camera.latest()", "FACTOR = 2"], f"{FACTOR}\nname = input()"),
    (["def wide(p):\n    return narrow(p)", "def narrow(p):\n    return p.astype(KIND)", "KIND = int"], WIDE),
    (
        [
            "def wide(p):\n    return p",
            "def wide(p):\n    return p.astype(np.uint16)\nassert wide(np.ones(2)).all()",
        ],
        WIDE,
    ),
    (
        ["def fill(table):\n    table.extend(range(0, 512, 2))", "TABLE = []", "fill(TABLE)\nprint(TABLE)"],
        TABLE,
    ),
    (["print(FACTOR)", "FACTOR = 2", "print(FACTOR)"], FACTOR),
    (["FACTOR = 2"], FACTOR, ["FACTOR += 1", "assert FACTOR == 3"]),
    (["TABLE = [0] * 256"], TABLE, [FILL.replace("FACTOR", "2"), "print(TABLE)"]),
    ([], FACTOR, ["FACTOR = 2\nprint(FACTOR)", "FACTOR = 3"]),
    ([], WIDE, ["def wide(p):\n    return p.astype(np.uint16)", "from numpy import *"]),
    (["LIMIT = 3\nprint(LIMIT)"], TIMES.format("2")),
    (["def double(pixels):\n    return pixels"], TIMES.format("2")),
]
# Beside them, in any cell: other values, uses, and cells that fail.
MORE = [
    *("FACTOR = 3", "FACTOR += 1", "print(FACTOR)", "assert FACTOR == 2", "FACTOR = np.array([3])[0]"),
    *("TABLE = []", "print(TABLE)", "TABLE = TABLE[::-1]", "KIND = np.uint8", "LIMIT = 3", "np = None"),
    *("sum = 3", "from math import *", "import cv2", "def wide(pixels):\n    return pixels", "FACTOR = ("),
    *("def double(pixels):\n    return pixels", "pixels = camera.latest()", "%matplotlib inline\nFACTOR = 2"),
]

# ---------------------------------------------------------------- answers to nodes-double, a class

NODE_IMPORTS = """from array import array
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import Image
"""
NODE_INIT = """    def __init__(self):
        super().__init__("doubler")
        self.publisher = self.create_publisher(Image, "~/double", 5)
        self.create_subscription(Image, "/camera", self.callback, qos_profile_sensor_data)
"""
NODE_CALLBACK = """    def callback(self, msg):
        wide = np.array(msg.data, np.uint16) * {}
        msg.data = array("B", np.minimum(wide, LIMIT).astype(np.uint8).tobytes())
        self.publisher.publish(msg)
"""
NODE = f"{NODE_IMPORTS}\nclass Doubler(Node):\n{NODE_INIT}\n{NODE_CALLBACK}"
BASE = f"{NODE_IMPORTS}\nclass Base(Node):\n{NODE_CALLBACK.format('FACTOR')}"
FROM_BASE = f"{NODE_IMPORTS}\nclass Doubler(Base):\n{NODE_INIT}"
ATTRIBUTE = NODE.format("self.factor").replace("(Node):", "(Node):\n    factor = FACTOR")
# {name: (the learner's cells, the answer, the points that the public checks give)}
NODE_FORMS = {
    "alone": ([], NODE.format(2), 2),
    "wrong": ([], NODE.format(3), 1),
    "a value": (["FACTOR = 2"], NODE.format("FACTOR"), 2),
    "a base": ([BASE, "FACTOR = 2"], FROM_BASE, 2),
    "a base that is bound again below": (
        [BASE, "FACTOR = 2"],
        f"{FROM_BASE}\nclass Base:\n    pass",
        2,
    ),
    "a class attribute": (["FACTOR = 2"], f"{ATTRIBUTE}\nFACTOR = 3", 2),
    "a decorator": (
        ["def same(kind):\n    return kind"],
        f"{NODE.format(2).replace('class', '@same{}class').format(chr(10))}\nsame = None",
        2,
    ),
    "a stub above": (["class Doubler:\n    pass"], NODE.format(2), 2),
    "a module": (["import scipy"], ATTRIBUTE.replace("= FACTOR", "= min(2, len(scipy.version.version))"), 0),
    "main below": ([], f"{NODE.format(2)}\nif __name__ == '__main__':\n    print('main')", 2),
}
NODE_MORE = [
    "FACTOR = 3",
    "FACTOR += 1",
    "class Base:\n    pass",
    "class Doubler:\n    factor = 3",
    "Image = 3",
]
