"""Which Fast DDS profile is used, and what happens if it cannot be the course's."""

import os
import re
import time
import xml.etree.ElementTree as ET

import pytest

from imgproc_course.ros import profile

MIB = 1 << 20
free_shared_memory = profile.free_shared_memory


@pytest.fixture
def clean_environment(monkeypatch, tmp_path):
    """An environment without a user's choice, with plenty of shared memory and no node."""
    for name in (*profile.PROFILE_VARIABLES, "RMW_IMPLEMENTATION", "FASTDDS_BUILTIN_TRANSPORTS"):
        monkeypatch.setenv(name, "")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(profile, "free_shared_memory", lambda: 1000 * MIB)
    monkeypatch.setattr(profile, "_a_node_exists", lambda: False)
    return monkeypatch


def test_the_courses_profile_is_chosen_under_both_names(clean_environment):
    dds_profile = profile.choose_profile()
    assert (dds_profile.chosen_by, dds_profile.path) == ("course", str(profile.LARGE))
    assert os.environ["FASTRTPS_DEFAULT_PROFILES_FILE"] == str(profile.LARGE)
    assert os.environ["FASTDDS_DEFAULT_PROFILES_FILE"] == str(profile.LARGE)
    assert str(dds_profile) == "the course's fastdds.xml: 64 MiB shared memory, and UDP"


def test_a_child_process_knows_that_the_course_chose(clean_environment):
    profile.choose_profile()
    assert profile.choose_profile().chosen_by == "course"


@pytest.mark.parametrize("name", profile.PROFILE_VARIABLES)
def test_a_users_profile_is_left_alone(clean_environment, tmp_path, name):
    user_file = tmp_path / "mine.xml"
    user_file.write_text("<dds><initialAnnouncements/></dds>")
    clean_environment.setenv(name, str(user_file))
    dds_profile = profile.choose_profile()
    assert (dds_profile.chosen_by, dds_profile.path) == ("user", str(user_file))
    assert (dds_profile.note is None) == (name == profile.PROFILE_VARIABLES[0])
    other_variable = next(variable for variable in profile.PROFILE_VARIABLES if variable != name)
    assert os.environ[other_variable] == ""


def test_a_users_profile_that_does_not_exist_is_noted(clean_environment):
    clean_environment.setenv("FASTRTPS_DEFAULT_PROFILES_FILE", "/nowhere/mine.xml")
    note = "FASTRTPS_DEFAULT_PROFILES_FILE names a file that does not exist; unset it"
    assert profile.choose_profile().note == note


@pytest.mark.parametrize(
    "variable", ["FASTRTPS_DEFAULT_PROFILES_FILE", "NONE"]
)  # read from the working folder
def test_what_a_users_profile_lacks_is_noted(clean_environment, tmp_path, variable):
    user_file = tmp_path / "DEFAULT_FASTRTPS_PROFILES.xml"
    user_file.write_text("<dds/>")
    clean_environment.setenv(variable, str(user_file))
    assert profile.choose_profile().note.startswith(
        "without <initialAnnouncements> the first image can come 3 s"
    )


def test_the_newer_name_alone_is_not_read_by_this_fast_dds(clean_environment, tmp_path):
    (tmp_path / "mine.xml").write_text("<dds/>")
    clean_environment.setenv("FASTDDS_DEFAULT_PROFILES_FILE", str(tmp_path / "mine.xml"))
    assert "reads only FASTRTPS_DEFAULT_PROFILES_FILE" in profile.choose_profile().note


@pytest.mark.parametrize(
    "name, value",
    [("RMW_IMPLEMENTATION", "rmw_cyclonedds_cpp"), ("FASTDDS_BUILTIN_TRANSPORTS", "UDPv4")],
)
def test_another_choice_of_the_user_is_left_alone(clean_environment, name, value):
    clean_environment.setenv(name, value)
    dds_profile = profile.choose_profile()
    assert dds_profile.chosen_by == "user"
    assert f"{name}={value}" in dds_profile.note
    assert [os.environ[variable] for variable in profile.PROFILE_VARIABLES] == ["", ""]


def test_naming_the_default_middleware_is_not_another_choice(clean_environment):
    clean_environment.setenv("RMW_IMPLEMENTATION", "rmw_fastrtps_cpp")
    assert profile.choose_profile().chosen_by == "course"


def test_a_profile_in_the_working_folder_is_the_users(clean_environment, tmp_path):
    (tmp_path / "DEFAULT_FASTRTPS_PROFILES.xml").write_text("<dds/>")
    dds_profile = profile.choose_profile()
    assert (dds_profile.chosen_by, dds_profile.path) == (
        "user",
        str(tmp_path / "DEFAULT_FASTRTPS_PROFILES.xml"),
    )


def test_little_shared_memory_selects_the_small_profile_with_a_note(clean_environment):
    clean_environment.setattr(profile, "free_shared_memory", lambda: 64 * MIB)
    dds_profile = profile.choose_profile()
    assert str(dds_profile).startswith("the course's fastdds_small.xml: 16 MiB shared memory")
    assert "/dev/shm has only 64 MiB free" in dds_profile.note and "--shm-size=1g" in dds_profile.note


def test_stale_segments_are_removed_before_the_small_profile_is_selected(clean_environment):
    free = [64 * MIB, 500 * MIB]
    clean_environment.setattr(profile, "free_shared_memory", lambda: free.pop(0))
    clean_environment.setattr(profile, "remove_stale_segments", lambda: 3)
    assert profile.choose_profile().path == str(profile.LARGE)


def test_too_little_shared_memory_is_warned_about(clean_environment):
    clean_environment.setattr(profile, "free_shared_memory", lambda: 10 * MIB)
    with pytest.warns(RuntimeWarning, match="has 10 MiB free, but images need 18"):
        dds_profile = profile.choose_profile()
    assert dds_profile.chosen_by == "nobody"
    assert [os.environ[variable] for variable in profile.PROFILE_VARIABLES] == ["", ""]


def test_shared_memory_that_cannot_be_written_is_warned_about(clean_environment):
    clean_environment.setattr(os, "access", lambda path, mode: path != profile.SHARED_MEMORY)
    assert free_shared_memory() is None
    with pytest.warns(
        RuntimeWarning, match=r"/dev/shm cannot be written, .* or subscribe to the /compressed"
    ):
        assert profile.choose_profile().chosen_by == "nobody"


def test_a_node_that_exists_too_early_is_warned_about(clean_environment):
    clean_environment.setattr(profile, "_a_node_exists", lambda: True)
    with pytest.warns(RuntimeWarning, match=r"restart the kernel and import imgproc_course\.ros first"):
        assert profile.choose_profile().chosen_by == "nobody"


def test_without_a_shared_memory_folder_the_large_profile_is_selected(clean_environment):
    clean_environment.setattr(profile, "free_shared_memory", lambda: None)
    assert profile.choose_profile().path == str(profile.LARGE)


def test_the_two_profiles_differ_only_in_their_sizes():
    def tree(path):
        return [
            (element.tag, "" if re.search(r"segment_size|maxMessageSize", element.tag) else element.text)
            for element in ET.parse(path).iter()
        ]

    assert tree(profile.LARGE) == tree(profile.SMALL)
    for path, size in profile.SEGMENT_BYTES.items():
        assert f"<segment_size>{size}</segment_size>" in path.read_text(encoding="utf-8")


def test_the_participant_uses_shared_memory_and_udp():
    # On loopback Fast DDS opens UDP sockets by default, so a test over loopback could not notice this.
    name = "{http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles}"
    root = ET.parse(profile.LARGE)
    kinds = {
        transport.findtext(f"{name}transport_id"): transport.findtext(f"{name}type")
        for transport in root.iter(f"{name}transport_descriptor")
    }
    used = [kinds[transport.text] for transport in root.find(f".//{name}userTransports")]
    assert used == ["SHM", "UDPv4"]


def test_a_program_announces_itself_often_also_when_it_is_old():
    # A new program misses the answers to its first announcement: it waits for the next one of the others.
    name = "{http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles}"
    (discovery,) = ET.parse(profile.LARGE).iter(f"{name}discovery_config")
    period = int(discovery.findtext(f"{name}initialAnnouncements/{name}period/{name}nanosec"))
    assert period <= 100_000_000
    assert int(discovery.findtext(f"{name}initialAnnouncements/{name}count")) * period >= 3_000_000_000
    assert int(discovery.findtext(f"{name}leaseAnnouncement/{name}nanosec")) <= 300_000_000


MAPPED = """
import os, pathlib, psutil
from rclpy.context import Context
from rclpy.node import Node
context = Context(); context.init(); node = Node("observer", context=context)
# A process also maps the segments of those that it has discovered; of its own ones it holds the lock.
opened = {os.path.realpath(link) for link in pathlib.Path("/proc/self/fd").iterdir()}
maps = [line.split() for line in pathlib.Path("/proc/self/maps").read_text().splitlines()]
spans = [fields[0].split("-") for fields in maps if fields[-1] + "_el" in opened and "port" not in fields[-1]]
ports = [socket.laddr.port for socket in psutil.Process().net_connections("udp4")]
base = 7400 + 250 * int(os.environ["ROS_DOMAIN_ID"])
print(max(int(b, 16) - int(a, 16) for a, b in spans) >> 20, any(base <= port < base + 250 for port in ports))
node.destroy_node(); context.try_shutdown()
"""


@pytest.mark.ros
@pytest.mark.parametrize(
    "beginning, segment_mib",
    [
        ("import imgproc_course.ros", 67),
        ("import rclpy; rclpy.init(); import imgproc_course.ros", 67),  # no node exists yet: early enough
        ("", 0),
    ],
)
def test_fast_dds_uses_the_profile_and_keeps_udp(run_python, beginning, segment_mib):
    no_choice = dict.fromkeys(profile.PROFILE_VARIABLES)
    code, out, err = run_python(beginning + MAPPED, **no_choice)
    assert (code, out.split(), err) == (0, [str(segment_mib), "True"], "")


@pytest.mark.ros
def test_a_node_that_exists_already_is_noticed(run_python):
    code, out, err = run_python(
        "import rclpy, warnings\n"
        "from rclpy.context import Context; from rclpy.node import Node\n"
        "context = Context(); context.init(); node = Node('early', context=context)\n"
        "with warnings.catch_warnings(record=True) as caught:\n"
        "    warnings.simplefilter('always')\n"
        "    import imgproc_course.ros as ros\n"
        "print(ros.dds_profile().chosen_by, len(caught), 'restart the kernel' in str(caught[0].message))\n"
        "node.destroy_node(); context.try_shutdown()",
        **dict.fromkeys(profile.PROFILE_VARIABLES),
    )
    assert (code, out.split(), err) == (0, ["nobody", "1", "True"], "")


@pytest.mark.ros
def test_the_segment_of_a_killed_process_is_removed_and_that_of_a_running_one_stays(start_python):
    # In separate domains, because a process also maps the segments of the processes that it has discovered.
    living, killed = (start_python(HOLDS_A_SEGMENT, ROS_DOMAIN_ID=domain) for domain in ("18", "19"))
    living_segments, killed_segments = living.stdout.readline().split(), killed.stdout.readline().split()
    assert living_segments and killed_segments and not set(living_segments) & set(killed_segments)
    for name in killed_segments:  # a session that starts elsewhere removes those that are ten seconds old
        os.utime(profile.SHARED_MEMORY / name)
    killed.kill()
    killed.wait()
    assert all((profile.SHARED_MEMORY / name).exists() for name in killed_segments)
    long_ago = time.time() - 1000
    assert profile.remove_stale_segments(older_than=2000) == 0
    for name in (*living_segments, *killed_segments):  # only these: others may be about to lock theirs
        os.utime(profile.SHARED_MEMORY / name, (long_ago, long_ago))
    profile.remove_stale_segments(older_than=500)
    assert not any((profile.SHARED_MEMORY / name).exists() for name in killed_segments)
    assert all((profile.SHARED_MEMORY / name).exists() for name in living_segments)


HOLDS_A_SEGMENT = """
import pathlib, re, time
from imgproc_course.ros import RosSession
RosSession.current()
maps = pathlib.Path("/proc/self/maps").read_text()
print(*sorted(set(re.findall(r"/dev/shm/(fastrtps_[0-9a-f]{16})\\b", maps))))
time.sleep(60)
"""


REMOVES_ITS_PORTS = """
import os
from pathlib import Path
from imgproc_course.ros import RosSession, open_camera, ImageSubscriber, profile
from imgproc_course.ros.diagnostics import explain_missing_messages
from sensor_msgs.msg import Image
session = RosSession.current()
locks = {os.path.realpath(link) for link in Path("/proc/self/fd").iterdir()}
ports = [Path(lock.removesuffix("_el")) for lock in locks if "fastrtps_port" in lock]
subscription = session.node.create_subscription(Image, "/images", print, 10)

def remove_ports():  # in the thread that restores them
    print(len(ports), len(profile.lost_ports()))
    for port in ports:
        port.unlink()
    print(set(profile.lost_ports()) == {port.name for port in ports})
    print("wait again" in explain_missing_messages(session.node, subscription, 3, 0))

session.run(remove_ports)
while profile.lost_ports():
    pass
with open_camera(speed=3.0) as camera:
    print(ImageSubscriber(camera.topic).wait(30).shape)
"""


@pytest.mark.ros
def test_a_port_that_another_program_removed_is_opened_again(run_python):
    code, out, err = run_python(REMOVES_ITS_PORTS)
    assert (code, out.splitlines(), err) == (0, ["2 0", "True", "True", "(720, 1280, 3)"], "")
