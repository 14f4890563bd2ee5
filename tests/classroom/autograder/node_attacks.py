"""Attacks on the check of a node: wrong answers to `node-class` that try to gain points by a trick.

Each ends with the class of a node that subscribes rightly, and publishes nothing: it earns the first case alone.
"""

# ruff: noqa: E501 - the long lines are the attackers'

from node_answers import ORIGINAL, PUBLISH

SUBSCRIBES = ORIGINAL.replace(PUBLISH, "")
CALLBACK = "        try:\n"
DRIVER = (
    "from nbclassroom.exercises import running\n"
    "from nbclassroom.exercises.kinds.node import feed as node_feed, recording_node\n"
)
RECORD = '{"steps": [{"delivered": 1, "ended": "", "log": "", "published": []}] * 3, "sleeps": False, "windows": False}'


def in_callback(source):
    return SUBSCRIBES.replace(CALLBACK, f"        {source}\n{CALLBACK}")


# (name, source, outcomes that the cases after the first one may have)
NODE_ATTACKS = (
    ("a feed that forges the record", f"{DRIVER}node_feed.feed = lambda *a: {RECORD}\n{SUBSCRIBES}", {"wrong"}),
    ("the input as the output", in_callback('msg.encoding = "mono8"; self.publisher.publish(msg)'), {"wrong"}),
    ("the arguments of the drive", in_callback("import sys; f = sys._getframe(3); f.f_locals['steps'].clear()"), {"wrong", "raised", "hostile"}),
    ("a class that makes another object", SUBSCRIBES + "\nclass Meta(type):\n    def __call__(cls):\n        return object()\n\n\nclass ImageGrayProcessor(ImageGrayProcessor, metaclass=Meta):\n    pass\n", {"raised", "wrong"}),
    ("an instance that says yes to all", "class ImageGrayProcessor:\n    __mro__ = ()\n\n    def __getattr__(self, name):\n        return lambda *a, **k: True\n", {"raised"}),
    ("not graded, on purpose", in_callback("recording_node = __import__('nbclassroom.exercises.kinds.node.recording_node', fromlist=['x']); recording_node.refuse('this')"), {"not graded", "wrong"}),
)  # fmt: skip
