"""The room: a robot that drives through the recorded drive's living room, in steps of simulated time.

No ROS and no clock: the same seed and commands give the same images and poses on every machine.
environment/room/README.md says how the room was made.
"""

from .drive import Odometry
from .laser import LaserScan
from .simulation import CAMERA, TOF_CAMERA, Simulation

__all__ = ["CAMERA", "TOF_CAMERA", "LaserScan", "Odometry", "Simulation"]
