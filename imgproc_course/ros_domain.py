"""The ROS domain of a user who chose none, who else is in it, and what keeps programs from each other."""

import contextlib
import importlib.util
import os
from collections.abc import Callable
from pathlib import Path

# The id of a machine's first ordinary user, who stays in ROS's own default, 0, as plain ROS programs do.
FIRST_USER = 1000
DOMAINS = 102  # ROS allows 0 to 101
VARIABLES = ("ROS_DOMAIN_ID", "ROS_AUTOMATIC_DISCOVERY_RANGE", "ROS_LOCALHOST_ONLY", "ROS_STATIC_PEERS")
RANGES = ("SUBNET", "LOCALHOST", "OFF", "SYSTEM_DEFAULT")
SOCKETS = Path("/proc/net/udp")  # of all users of this machine


def choose_domain(say: Callable[[str], object]) -> str:
    """Sets ROS_DOMAIN_ID for this process and its children, unless it is set. Returns it.

    Each user has a domain. If another user's programs are there, who is not the first user takes a free one,
    and `say` tells it. It also tells who stays beside others.
    """
    if not os.environ.get("ROS_DOMAIN_ID"):
        user = os.getuid() if hasattr(os, "getuid") else FIRST_USER
        default = max(0, user - FIRST_USER) % DOMAINS
        domain = default if user == FIRST_USER else _domain_beside_others(default, user)
        os.environ["ROS_DOMAIN_ID"] = str(domain)
        if problem := shared_domain(default):
            own = f"your programs take domain {domain}: for plain ROS programs, export ROS_DOMAIN_ID={domain}"
            say(problem if domain == default else f"{problem.partition('; ')[0]}; {own}")
    return os.environ["ROS_DOMAIN_ID"]


def prepare_lab(say: Callable[[str], object]) -> None:
    """Keeps the lessons' topics on this machine, unless the learner chose a domain or a range.

    All computers of a classroom start in domain 0: each would receive the images of all the others.
    """
    if importlib.util.find_spec("rclpy") is None:
        say(
            "ROS 2 is not installed: everything works from the recording, live topics do not. "
            "environment/pixi.toml says how to install it."
        )
    elif not any(os.environ.get(name) for name in VARIABLES):
        os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
        domain = choose_domain(say)
        others = "" if domain == "0" else f", in domain {domain}, which is yours alone"
        say(
            f"ROS topics stay on this machine{others}. To subscribe to a robot's topics, start with its "
            "domain: ROS_DOMAIN_ID=7 environment/lab"
        )


def _domain_beside_others(default, user):
    """The domain in which the user's programs are already, else the first one without another user's."""
    domains = [default, *range(DOMAINS - 1, 0, -1)]
    taken = [domain for domain in domains[:2] if user in users_in(domain)]
    return next(iter(taken + [domain for domain in domains if not users_in(domain)]), default)


def users_in(domain: int) -> set[int]:
    """The ids of the users of this machine with programs in a domain: each program owns two UDP ports."""
    ports = set()
    with contextlib.suppress(OSError):
        for line in SOCKETS.read_text().splitlines()[1:]:
            fields = line.split()
            ports.add((int(fields[7]), int(fields[1].rpartition(":")[2], 16)))
    first = 7400 + 250 * domain  # of DDS; from the tenth on, a program's ports are an even one and the next
    even_ports = range(first + 10, first + 250, 2)
    return {user for user, port in ports if port in even_ports and (user, port + 1) in ports}


def shared_domain(domain: int) -> str | None:
    """Which other users of this machine are in the domain, and what to do: "observation; remedy"; or None."""
    users = sorted(user for user in users_in(domain) if user != os.getuid())
    if not users:
        return None
    import pwd  # Windows has none

    names = {user.pw_uid: user.pw_name for user in pwd.getpwall()}
    others = ", ".join(names.get(user, str(user)) for user in users)
    return (
        f"ROS programs of another user ({others}) are in domain {domain} on this machine: users see each "
        "other's topics, but no images; for a domain of your own: export ROS_DOMAIN_ID=7 (any from 1 to 101)"
    )


def discovery_range() -> str:
    """The automatic discovery range that the environment asks for."""
    local = os.environ.get("ROS_LOCALHOST_ONLY") == "1"  # the older variable is the stronger one
    return "LOCALHOST" if local else os.environ.get("ROS_AUTOMATIC_DISCOVERY_RANGE") or "SUBNET"


def discovery_problem() -> str | None:
    """Why programs may not discover each other, by the environment: "observation; remedy"; or None."""
    scope, server = discovery_range(), os.environ.get("ROS_DISCOVERY_SERVER")
    problem = f"ROS_AUTOMATIC_DISCOVERY_RANGE={scope}"
    remedy = "unset ROS_AUTOMATIC_DISCOVERY_RANGE, or set it to LOCALHOST; then restart the kernel"
    if scope not in RANGES:
        return f"{problem} is not one of {', '.join(RANGES)}; {remedy}"
    if scope == "OFF":
        return f"{problem}: programs do not discover each other; {remedy}"
    return server and (
        f"ROS_DISCOVERY_SERVER={server}: programs discover each other only through this server; start it, or "
        "unset ROS_DISCOVERY_SERVER (also in ~/.bashrc), then restart the kernel"
    )
