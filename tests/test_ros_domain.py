"""The ROS domain of a user, and what keeps the lessons' topics on this machine."""

import os
import subprocess
import sys

import pytest

from imgproc_course import ros_domain

pytestmark = pytest.mark.ros  # without rclpy, no domain is chosen


@pytest.fixture
def lines():
    """What the learner is told, line by line."""
    return []


@pytest.fixture
def no_discovery_variables(monkeypatch):
    for name in ros_domain.VARIABLES:
        monkeypatch.delenv(name, raising=False)
    yield
    monkeypatch.delenv("ROS_AUTOMATIC_DISCOVERY_RANGE", raising=False)


@pytest.mark.parametrize(
    ("user", "domain", "words"),
    [
        (0, "0", ""),
        (1007, "7", ", in domain 7, which is yours alone"),
        (1101, "101", ", in domain 101, which is yours alone"),
        (1102, "0", ""),
    ],
)
def test_topics_stay_on_this_machine_by_default_and_each_user_has_a_domain(
    no_discovery_variables, monkeypatch, lines, user, domain, words
):
    monkeypatch.setattr(os, "getuid", lambda: user)
    monkeypatch.setattr(ros_domain, "users_in", lambda domain: set())
    ros_domain.prepare_lab(lines.append)
    assert os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] == "LOCALHOST"
    assert os.environ["ROS_DOMAIN_ID"] == domain
    assert lines == [
        f"ROS topics stay on this machine{words}. To subscribe to a robot's topics, start with its domain: "
        "ROS_DOMAIN_ID=7 environment/lab"
    ]


@pytest.mark.parametrize(
    ("user", "programs", "domain", "parts"),
    [
        (1000, {0: 0}, "0", ["another user (root) are in domain 0 ", "for a domain of your own: export "]),
        (0, {0: 0}, "0", None),
        (0, {0: 54321}, "101", ["(54321) are in domain 0 ", "; your programs take domain 101: "]),
        (0, {0: 54321, 101: 54322}, "100", ["(54321)", "; your programs take domain 100: "]),
        (
            0,
            {0: 54321, 101: 0},
            "101",
            ["(54321)", "; your programs take domain 101: "],
        ),  # with its first one
        (1007, {0: 0}, "7", None),
        (1007, {7: 1109}, "101", [" are in domain 7 ", "; your programs take domain 101: "]),
    ],
)
def test_users_do_not_meet_in_a_domain_without_a_word(
    no_discovery_variables, monkeypatch, tmp_path, lines, user, programs, domain, parts
):
    row = " 0: 00000000:{:04X} 00000000:0000 07 00000000:00000000 00:00000000 00000000 {} 0 1 2 0 0\n"
    ports = [(7400 + 250 * number + port, owner) for number, owner in programs.items() for port in (10, 11)]
    sockets = tmp_path / "udp"
    sockets.write_text("sl local_address\n" + "".join(row.format(*port) for port in [(7912, 3), *ports]))
    monkeypatch.setattr(ros_domain, "SOCKETS", sockets)
    monkeypatch.setattr(os, "getuid", lambda: user)
    assert ros_domain.choose_domain(lines.append) == os.environ["ROS_DOMAIN_ID"] == domain
    assert len(lines) == bool(parts) and all(part in lines[0] for part in parts or ())


HOLDS_PORTS = """
import os, socket, sys
os.setuid(int(sys.argv[1]))
sockets = [socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(2)]
for port, udp in enumerate(sockets, 7400 + 250 * 17 + 248):
    udp.bind(("127.0.0.1", port))
print(flush=True)
sys.stdin.read()
"""


def test_the_programs_of_a_user_are_known_by_their_ports():
    owner = 65534 if os.getuid() == 0 else os.getuid()  # only root can be another user
    command = [sys.executable, "-c", HOLDS_PORTS, str(owner)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as process:
        process.stdout.readline()
        users = ros_domain.users_in(17)
        process.stdin.close()
    assert users == {owner} and ros_domain.users_in(17) == set()


def test_without_ros_it_says_what_will_not_work(monkeypatch, lines):
    monkeypatch.setattr(ros_domain.importlib.util, "find_spec", lambda _: None)
    ros_domain.prepare_lab(lines.append)
    assert lines == [
        "ROS 2 is not installed: everything works from the recording, live topics do not. "
        "environment/pixi.toml says how to install it."
    ]


@pytest.mark.parametrize("chosen", [{"ROS_DOMAIN_ID": "7"}, {"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET"}])
def test_the_learners_own_domain_or_range_is_kept(no_discovery_variables, monkeypatch, lines, chosen):
    for name, value in chosen.items():
        monkeypatch.setenv(name, value)
    ros_domain.prepare_lab(lines.append)
    values = {name: os.environ.get(name) for name in ros_domain.VARIABLES}
    assert {name: value for name, value in values.items() if value} == chosen
    assert lines == []
