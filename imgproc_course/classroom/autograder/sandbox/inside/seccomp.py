"""Refuse the system calls that would give a kernel resources that no limit counts, or a way out. Linux.

Memory in an anonymous file, in System V segments or in a new file system does not count as memory of a
process, and a new user namespace makes its owner root there. Keyrings, the system's log, and sockets of most
families are in no namespace: what one kernel writes there, the next could read. Watches on files show what
other processes open, and a lease on a file makes them wait. Hints on how long the data of a file will live,
and some requests of `ioctl` to a file system, stay with a file that everybody reads. Some calls say which
parts of a file are in memory, or put them out of it, without looking at a clock. `sync` and `syncfs` make
everybody wait for the disk. Answers need none of these.
"""

import ctypes
import errno
import os
import platform
import struct

# machine: (AUDIT_ARCH, numbers of the calls); linux/audit.h, asm/unistd.h
_CALLS = {
    "x86_64": (
        0xC000003E,
        {
            "clone": 56,
            "socket": 41,
            "ioctl": 16,
            "mincore": 27,
            "shmget": 29,
            "semget": 64,
            "msgget": 68,
            "fcntl": 72,
            "syslog": 103,
            "sync": 162,
            "mount": 165,
            "fadvise64": 221,
            "add_key": 248,
            "request_key": 249,
            "keyctl": 250,
            "inotify_init": 253,
            "unshare": 272,
            "inotify_init1": 294,
            "fanotify_init": 300,
            "syncfs": 306,
            "setns": 308,
            "memfd_create": 319,
            "preadv2": 327,
        },
    ),
    "aarch64": (
        0xC00000B7,
        {
            "clone": 220,
            "socket": 198,
            "ioctl": 29,
            "mincore": 232,
            "shmget": 194,
            "semget": 190,
            "msgget": 186,
            "fcntl": 25,
            "syslog": 116,
            "sync": 81,
            "mount": 40,
            "fadvise64": 223,
            "add_key": 217,
            "request_key": 218,
            "keyctl": 219,
            "unshare": 97,
            "inotify_init1": 26,
            "fanotify_init": 262,
            "syncfs": 267,
            "setns": 268,
            "memfd_create": 279,
            "preadv2": 286,
        },
    ),
}
_EVERYWHERE = {"io_uring_setup": 425, "fsopen": 430, "clone3": 435, "memfd_secret": 447, "cachestat": 451}
_PARTLY = ("clone", "clone3", "socket", "fcntl", "ioctl")  # some uses of them are refused
# Commands of fcntl: F_SETLEASE, F_NOTIFY, F_SET_RW_HINT, F_SET_FILE_RW_HINT
_WATCHES = (1024, 1026, 1036, 1038)
_IOCTL_KINDS = (0x5400, 0x8900)  # the second byte of a request: terminals and descriptors; sockets
_NEW_USER = 0x10000000
_SOCKET_FAMILIES = (1, 2, 10, 16)  # UNIX, INET, INET6, NETLINK: a network namespace separates them
_X32 = 0x40000000  # calls of the x32 interface, with other numbers
_LOAD, _EQUAL, _AT_LEAST, _ANY_BIT, _RETURN, _AND = 0x20, 0x15, 0x35, 0x45, 0x06, 0x54
_NUMBER, _MACHINE, _FIRST_ARGUMENT, _SECOND_ARGUMENT = 0, 4, 16, 24  # offsets in struct seccomp_data
_ALLOW, _ERROR = 0x7FFF0000, 0x00050000
_PR_SET_SECCOMP, _FILTER = 22, 2


def refuse_system_calls():
    """Refuse them to this process and all that it starts, for good; no_new_privs must be set.

    On a machine whose call numbers are not in the table, nothing is refused.

    Raises
    ------
    OSError : this system has no seccomp filters
    """
    if not _PROGRAM:
        return
    instructions = ctypes.create_string_buffer(_PROGRAM, len(_PROGRAM))
    program = struct.pack("HxxxxxxP", len(_PROGRAM) // 8, ctypes.addressof(instructions))
    if _prctl(_PR_SET_SECCOMP, _FILTER, program, 0, 0) != 0:
        number = ctypes.get_errno()
        raise OSError(number, f"seccomp: {os.strerror(number)}")


def _filter(machine, numbers):
    """The instructions of the filter, each a struct sock_filter."""
    yield _instruction(_LOAD, _MACHINE)
    yield _instruction(_EQUAL, machine, 1, 0)
    yield _fail(errno.EPERM)
    yield _instruction(_LOAD, _NUMBER)
    yield from _if(_AT_LEAST, _X32, errno.EPERM)
    for name, number in (numbers | _EVERYWHERE).items():
        if name not in _PARTLY:
            yield from _if(_EQUAL, number, errno.EPERM)
    # clone3 has its flags in memory, where no filter sees them; after ENOSYS the C library calls clone.
    yield from _if(_EQUAL, _EVERYWHERE["clone3"], errno.ENOSYS)
    yield _instruction(_EQUAL, numbers["fcntl"], 0, 2 + 2 * len(_WATCHES))
    yield _instruction(_LOAD, _SECOND_ARGUMENT)
    for command in _WATCHES:
        yield from _if(_EQUAL, command, errno.EPERM)
    yield _instruction(_RETURN, _ALLOW)
    yield _instruction(_EQUAL, numbers["ioctl"], 0, 3 + 2 * len(_IOCTL_KINDS))
    yield _instruction(_LOAD, _SECOND_ARGUMENT)
    yield _instruction(_AND, 0xFF00)
    for kind in _IOCTL_KINDS:
        yield _instruction(_EQUAL, kind, 0, 1)
        yield _instruction(_RETURN, _ALLOW)
    yield _fail(errno.ENOTTY)
    yield _instruction(_EQUAL, numbers["socket"], 0, 2 + 2 * len(_SOCKET_FAMILIES))
    yield _instruction(_LOAD, _FIRST_ARGUMENT)
    for family in _SOCKET_FAMILIES:
        yield _instruction(_EQUAL, family, 0, 1)
        yield _instruction(_RETURN, _ALLOW)
    yield _fail(errno.EAFNOSUPPORT)
    yield _instruction(_EQUAL, numbers["clone"], 1, 0)
    yield _instruction(_RETURN, _ALLOW)
    yield _instruction(_LOAD, _FIRST_ARGUMENT)
    yield from _if(_ANY_BIT, _NEW_USER, errno.EPERM)
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
_PROGRAM = b"".join(_filter(*_CALLS[platform.machine()])) if platform.machine() in _CALLS else b""
