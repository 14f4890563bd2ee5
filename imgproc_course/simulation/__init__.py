"""The room: a robot that drives through the recorded drive's living room, in steps of simulated time.

No ROS and no clock: the same seed and commands give the same images and poses on every machine.
environment/room/README.md says how the room was made.
"""

from .faces import draw_face, put_face, random_identity
from .furnished import furnished
from .hands import GESTURES, Hand, draw_hand, gesture_track, hand_mask, random_hand
from .laser import LaserScan
from .room import Room, recorded_room
from .simulation import CAMERA, TOF_CAMERA, Simulation
from .wheels import Odometry

__all__ = [
    "CAMERA",
    "GESTURES",
    "TOF_CAMERA",
    "Hand",
    "LaserScan",
    "Odometry",
    "Room",
    "Simulation",
    "draw_face",
    "draw_hand",
    "furnished",
    "gesture_track",
    "hand_mask",
    "put_face",
    "random_hand",
    "random_identity",
    "recorded_room",
]
