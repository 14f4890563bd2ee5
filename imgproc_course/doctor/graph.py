"""The doctor's checks of ROS: what is loaded, DDS profile, shared memory, domain, network, topics."""

import contextlib
import importlib.metadata
import importlib.util
import os
import socket
import sys

from imgproc_course.doctor.report import failure, failure_of, ok, warning
from imgproc_course.ros_domain import DOMAINS, discovery_problem, discovery_range, shared_domain

FRAMES = 3  # that must arrive
MULTICAST_GROUP = "239.255.0.1"  # through which DDS programs discover each other


def check_ros():
    from imgproc_course.ros import dds_profile, ros_problem

    problem = ros_problem()
    if problem is not None:
        is_missing = importlib.util.find_spec("rclpy") is None
        yield (warning if is_missing else failure)("ROS 2", *problem.split("; ", 1))
        return
    names = ("rclpy", "sensor_msgs")
    yield ok("ROS 2", ", ".join(f"{name} {_version_of(name)}" for name in names))
    # Ask rclpy, which imgproc_course.ros has imported, what it loaded: the variable may be unset.
    yield ok("middleware", sys.modules["rclpy.utilities"].get_rmw_implementation_identifier())
    profile = dds_profile()
    if profile.note is None:
        yield ok("DDS profile", profile)
    else:
        yield warning("DDS profile", str(profile).partition("; ")[0], profile.note)
    yield from _domain()


def _version_of(package):
    for distribution in (f"ros-jazzy-{package.replace('_', '-')}", package):
        with contextlib.suppress(importlib.metadata.PackageNotFoundError):
            return importlib.metadata.version(distribution)
    return "of this system"


def _domain():
    domain = os.environ.get("ROS_DOMAIN_ID", "0") or "0"
    if not (domain.isascii() and domain.isdecimal() and int(domain) < DOMAINS):
        remedy = "give a number from 0 to 101: export ROS_DOMAIN_ID=7"
        yield failure("domain", f"ROS_DOMAIN_ID={domain}", remedy)
    elif problem := discovery_problem():
        # A discovery server may run: the finding of the topic says whether images arrive.
        is_sure = "ROS_DISCOVERY_SERVER" not in problem
        yield (failure if is_sure else warning)("domain", *problem.split("; ", 1))
    elif problem := shared_domain(int(domain)):
        yield warning("domain", *problem.split("; ", 1))
    else:
        scope = "with everyone on this network in the same domain"
        if discovery_range() == "LOCALHOST":
            scope = "only with programs on this machine, not with a robot"
        yield ok("domain", f"{domain}; topics are shared {scope}")


def check_network():
    """Whether packets to this machine itself arrive, and packets to the multicast group of DDS."""
    if not _packet_arrives("127.0.0.1"):
        remedy = "a firewall blocks UDP on 127.0.0.1: allow it, e.g. sudo ufw allow in on lo"
        yield failure("loopback", "a packet from this machine to itself did not arrive", remedy)
    elif not _packet_arrives(MULTICAST_GROUP):
        remedy = "export ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST, or allow multicast: sudo ip link set lo"
        remedy += " multicast on; sudo ufw allow in proto udp to 224.0.0.0/4"
        problem = "works, but multicast does not, through which programs discover each other"
        yield warning("loopback", problem, remedy)
    else:
        yield ok("loopback", "packets and multicast arrive")


def _packet_arrives(address, timeout=1.0):
    loopback = socket.inet_aton("127.0.0.1")
    udp = (socket.AF_INET, socket.SOCK_DGRAM)
    with socket.socket(*udp) as receiver, socket.socket(*udp) as sender:
        try:
            receiver.settimeout(timeout)
            receiver.bind(("" if address == MULTICAST_GROUP else address, 0))
            if address == MULTICAST_GROUP:
                group = socket.inet_aton(address) + loopback
                receiver.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, group)
                sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, loopback)
                sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 0)
            sender.sendto(b"doctor", (address, receiver.getsockname()[1]))
            return receiver.recv(16) == b"doctor"
        except OSError:
            return False


def check_topics():
    """Waits for frames of the camera that runs; if none runs, the doctor starts it and ends it again."""
    from imgproc_course.ros import RosSession, ros_available

    if not ros_available():
        return
    was_running = RosSession().running
    try:
        problem = _why_no_frames_of_the_camera()
        also = "see the lines on DDS profile and loopback; a firewall may block the frames"
        if problem is None:
            yield ok("topic", "frames arrive from the camera, a process of its own")
        else:
            yield failure_of("topic", f"{problem}; {also}")
    # A node or the robot process did not start; the error names the environment variable that is wrong.
    except (ValueError, RuntimeError) as error:
        yield failure_of("topic", error, "correct it, then restart the kernel")
    finally:
        if not was_running:
            RosSession().stop()


def _why_no_frames_of_the_camera():
    from imgproc_course.ros import RosSession, open_camera
    from imgproc_course.ros.robot_process import running_robot

    robot = running_robot(RosSession.current().context.get_domain_id())
    if robot.get("running"):
        return _why_no_frames(robot["topic"])  # whatever it plays
    with open_camera() as camera:
        return _why_no_frames(camera.topic)


def _why_no_frames(topic, timeout=15.0):
    """Why no frames arrive, in one line; None if they do."""
    from imgproc_course.ros import ImageSubscriber

    with ImageSubscriber(topic) as subscriber:
        try:
            for _ in range(FRAMES):
                subscriber.wait(timeout)
        except TimeoutError as error:
            return str(error)
    return None
