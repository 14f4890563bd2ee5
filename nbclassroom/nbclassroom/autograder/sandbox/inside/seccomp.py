"""Refuse the system calls that would give a kernel resources that no limit counts, or a way out. Linux.

Memory in an anonymous file, in System V segments or in a new file system does not count as memory of a
process, and a new user namespace makes its owner root there. Keyrings, the system's log, and sockets of most
families are in no namespace: what one kernel writes there, the next could read. `sync` and `syncfs` make
everybody wait for the disk, and a lease on a file those who open it. Answers need none of these.
"""

import ctypes
import errno
import os
import platform
import struct

_MACHINES = {"x86_64": 0xC000003E, "aarch64": 0xC00000B7}  # AUDIT_ARCH; linux/audit.h
# Numbers of the calls on these machines; asm/unistd.h
_CALLS = {
    "clone": (56, 220),
    "socket": (41, 198),
    "shmget": (29, 194),
    "fcntl": (72, 25),
    "semget": (64, 190),
    "msgget": (68, 186),
    "syslog": (103, 116),
    "sync": (162, 81),
    "mount": (165, 40),
    "add_key": (248, 217),
    "request_key": (249, 218),
    "keyctl": (250, 219),
    "unshare": (272, 97),
    "syncfs": (306, 267),
    "setns": (308, 268),
    "memfd_create": (319, 279),
    "io_uring_setup": (425, 425),
    "fsopen": (430, 430),
    "clone3": (435, 435),
    "memfd_secret": (447, 447),
}
_PARTLY = ("clone", "clone3", "socket", "fcntl")  # some uses of them are refused
_SOCKET_FAMILIES = (1, 2, 10, 16)  # UNIX, INET, INET6, NETLINK: a network namespace separates them
_X32 = 0x40000000  # calls of the x32 interface, with other numbers
_LOAD, _EQUAL, _AT_LEAST, _ANY_BIT, _RETURN = 0x20, 0x15, 0x35, 0x45, 0x06
_NUMBER, _MACHINE, _FIRST_ARGUMENT, _SECOND_ARGUMENT = 0, 4, 16, 24  # offsets in struct seccomp_data
_ALLOW, _ERROR = 0x7FFF0000, 0x00050000
_PR_SET_SECCOMP, _FILTER = 22, 2
_REFUSED_USES = (  # to set a lease on a file, and to make a user namespace
    ("fcntl", _SECOND_ARGUMENT, _EQUAL, 1024),
    ("clone", _FIRST_ARGUMENT, _ANY_BIT, 0x10000000),
)


def refuse_system_calls():
    """Refuse them to this process and all that it starts, for good; no_new_privs must be set.

    On a machine whose call numbers are not in the table, nothing is refused. Without seccomp: OSError.
    """
    if not _PROGRAM:
        return
    instructions = ctypes.create_string_buffer(_PROGRAM, len(_PROGRAM))
    program = struct.pack("HxxxxxxP", len(_PROGRAM) // 8, ctypes.addressof(instructions))
    if _prctl(_PR_SET_SECCOMP, _FILTER, program, 0, 0) != 0:
        number = ctypes.get_errno()
        raise OSError(number, f"seccomp: {os.strerror(number)}")


def _program_for(machine):
    """The filter for a machine, b"" if the numbers of its calls are not known."""
    if machine not in _MACHINES:
        return b""
    column = list(_MACHINES).index(machine)
    return b"".join(_filter(_MACHINES[machine], {name: call[column] for name, call in _CALLS.items()}))


def _filter(machine, numbers):
    """The instructions of the filter, each a struct sock_filter."""
    yield _instruction(_LOAD, _MACHINE)
    yield _instruction(_EQUAL, machine, 1, 0)
    yield _fail(errno.EPERM)
    yield _instruction(_LOAD, _NUMBER)
    yield from _if(_AT_LEAST, _X32, errno.EPERM)
    for name, number in numbers.items():
        if name not in _PARTLY:
            yield from _if(_EQUAL, number, errno.EPERM)
    # clone3 has its flags in memory, where no filter sees them; after ENOSYS the C library calls clone.
    yield from _if(_EQUAL, numbers["clone3"], errno.ENOSYS)
    for name, argument, test, value in _REFUSED_USES:
        yield _instruction(_EQUAL, numbers[name], 0, 4)
        yield _instruction(_LOAD, argument)
        yield from _if(test, value, errno.EPERM)
        yield _instruction(_RETURN, _ALLOW)
    yield _instruction(_EQUAL, numbers["socket"], 0, 2 + 2 * len(_SOCKET_FAMILIES))
    yield _instruction(_LOAD, _FIRST_ARGUMENT)
    for family in _SOCKET_FAMILIES:
        yield _instruction(_EQUAL, family, 0, 1)
        yield _instruction(_RETURN, _ALLOW)
    yield _fail(errno.EAFNOSUPPORT)
    yield _instruction(_RETURN, _ALLOW)


def _if(test, value, number):
    yield _instruction(test, value, 0, 1)
    yield _fail(number)


def _fail(number):
    return _instruction(_RETURN, _ERROR | number)


def _instruction(code, value, jump_if_true=0, jump_if_false=0):
    return struct.pack("HBBI", code, jump_if_true, jump_if_false, value)


# Made when this module is loaded, before the first kernel is forked.
_prctl = ctypes.CDLL(None, use_errno=True).prctl
_PROGRAM = _program_for(platform.machine())
