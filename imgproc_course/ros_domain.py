"""The ROS domain of a user who chose none: another one for each user of a machine."""

import os

# The id of a machine's first ordinary user, who stays in ROS's own default, 0; so does root.
FIRST_USER = 1000
DOMAINS = 102  # ROS allows 0 to 101


def choose_domain() -> str:
    """Sets ROS_DOMAIN_ID for this process and its children, unless it is set. Returns it.

    Two users share a domain only if they say so, or if their ids differ by a multiple of 102.
    """
    user = os.getuid() if hasattr(os, "getuid") else 0
    default = str(max(0, user - FIRST_USER) % DOMAINS)
    if not os.environ.get("ROS_DOMAIN_ID"):
        os.environ["ROS_DOMAIN_ID"] = default
    return os.environ["ROS_DOMAIN_ID"]
