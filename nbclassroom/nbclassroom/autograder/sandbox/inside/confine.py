"""Confine this process: namespaces, mounts, limits, identity. Linux; the standard library only.

Each fork calls it before any code of a learner's runs there. It repeats what bubblewrap did around the fork
server, so that nothing passes from one fork to the next. It uses `os`, not `pathlib`: each page of memory
that a fork touches has to be copied.

What one kernel could leave for the next, which may be another learner's, and what prevents it:
    files, in /tmp, /dev/shm and home           file systems of its own, everything else is read-only
    open files of the fork server               closed, with the database of IPython's history
    processes, signals, ptrace, /proc/<pid>     a PID namespace, which ends with the kernel
    nice values, limits by user                 a user of its own, if root grades; else the PID namespace
    System V IPC, POSIX message queues          an IPC namespace
    sockets: abstract names, used ports         a network namespace without a working interface
    sockets of other families (vsock)           refused: no namespace separates them
    host name                                   a UTS namespace
    order of being killed for memory            /proc is read-only
    settings in /proc/sys, counters of the machine    /proc has processes only
    keys in the system's keyrings               the calls are refused, and the session keyring is new: the
                                                teacher's cannot be searched either
    the system's log: a crash writes to it      the call that reads it is refused
    terminals                                   /dev/pts is new
    core files                                  a limit of one byte, which pipes to programs obey too
    environment, umask, timers, random state    a fork has copies
    memory and processor time                   what all kernels use together is looked at (`used_under`)
Covert channels remain: whether a file is in the page cache, the times of a device, how busy the machine is.
tests/classroom/autograder/test_channels.py tries each of the others.
"""

import ctypes
import errno
import os
import platform
import resource
import signal
import struct
import time
from contextlib import suppress

NEWNS, NEWUTS, NEWIPC, NEWPID, NEWNET = 0x20000, 0x4000000, 0x8000000, 0x20000000, 0x40000000
USERS_OF_SERVER = 256  # users of the kernels of one fork server, one after another
_JOIN_SESSION_KEYRING = 1
_READ_ONLY, _NOSUID, _NODEV, _NOEXEC, _BIND, _REC, _PRIVATE = 1, 2, 4, 8, 0x1000, 0x4000, 0x40000
_PR_CAPBSET_DROP, _PR_SET_NO_NEW_PRIVS, _PR_SET_DUMPABLE = 24, 38, 4
_LAST_CAPABILITY = 63
# The filter of system calls.
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
_X32 = 0x40000000  # calls of the x32 interface, with other numbers
_LOAD, _EQUAL, _AT_LEAST, _ANY_BIT, _RETURN = 0x20, 0x15, 0x35, 0x45, 0x06
_NUMBER, _MACHINE, _FIRST_ARGUMENT, _SECOND_ARGUMENT = 0, 4, 16, 24  # offsets in struct seccomp_data
_ALLOW, _ERROR = 0x7FFF0000, 0x00050000
_REFUSE = _ERROR | errno.EPERM
_PR_SET_SECCOMP, _FILTER = 22, 2
# Calls of which some uses are refused: {call: (the argument that decides, a test of it, values, what follows
# if the test holds for one of them, and what if for none)}.
_SOME_USES = {
    "fcntl": (_SECOND_ARGUMENT, _EQUAL, (1024,), _REFUSE, _ALLOW),  # a lease on a file
    "clone": (_FIRST_ARGUMENT, _ANY_BIT, (0x10000000,), _REFUSE, _ALLOW),  # a user namespace
    # UNIX, INET, INET6, NETLINK: a network namespace separates them.
    "socket": (_FIRST_ARGUMENT, _EQUAL, (1, 2, 10, 16), _ALLOW, _ERROR | errno.EAFNOSUPPORT),
}
_HERE = platform.machine()
_NUMBERS: dict[str, int] = {}  # of the calls on this machine; {} if they are not known
if _HERE in _MACHINES:
    _NUMBERS = {name: call[[*_MACHINES].index(_HERE)] for name, call in _CALLS.items()}
_libc = ctypes.CDLL(None, use_errno=True)
# Looked up here, before the first kernel is forked.
_mount_call, _unshare_call, _prctl, _capset = _libc.mount, _libc.unshare, _libc.prctl, _libc.capset
_kill, _wait4, _monotonic, _sleep = os.kill, os.wait4, time.monotonic, time.sleep


def _check(result, operation):
    if result != 0:
        number = ctypes.get_errno()
        raise OSError(number, f"{operation}: {os.strerror(number)}")


def unshare(flags):
    """Move this process (with NEWPID: its next children) into new namespaces."""
    _check(_unshare_call(ctypes.c_int(flags)), "unshare")


def return_to_pid_namespace(descriptor):
    """Start the next children in this PID namespace again."""
    _check(_libc.setns(descriptor, ctypes.c_int(NEWPID)), "setns")


def _mount(source, target, kind, flags, data=""):
    texts = [text.encode() if text else None for text in (source, target, kind)]
    _check(_mount_call(*texts, ctypes.c_ulong(flags), data.encode() or None), f"mount {target}")


def confine(limits, user):
    """Confine this process for good; OSError if the system refuses a step: no learner's code may run then.

    `user` is the user and group to become; None inside a user namespace, whose root has no rights outside.
    """
    unshare(NEWNS | NEWIPC | NEWUTS | NEWNET)
    _mount("", "/", "", _REC | _PRIVATE)
    scratch = f"size={limits['scratch']},nr_inodes=2000"
    _mount("tmpfs", "/tmp", "tmpfs", _NOSUID | _NODEV, f"{scratch},mode=1777")
    _mount("tmpfs", "/dev/shm", "tmpfs", _NOSUID | _NODEV | _NOEXEC, f"{scratch},mode=1777")
    if os.path.exists("/dev/pts"):  # `!ls` opens a terminal
        options = "newinstance,ptmxmode=0666,mode=0600,max=16"
        _mount("devpts", "/dev/pts", "devpts", _NOSUID | _NOEXEC, options)
    _mount_proc()
    os.umask(0o022)
    for folder in ("/tmp/home", "/tmp/submission"):
        os.mkdir(folder)
        if user is not None:
            os.chown(folder, user, user)
    os.chdir("/tmp/submission")
    set_limits(limits)
    _drop_privileges(user)


def _mount_proc():
    """Mount /proc with this kernel's processes only: its other files count what the whole machine did."""
    flags = _READ_ONLY | _NOSUID | _NODEV | _NOEXEC
    try:
        _mount("proc", "/proc", "proc", flags, "subset=pid")
    except OSError:  # a system before Linux 5.8
        _mount("proc", "/proc", "proc", flags)
    for process in ("self", "thread-self"):  # the teacher's paths; what a kernel starts still sees them
        with suppress(OSError):
            _mount(os.devnull, f"/proc/{process}/mountinfo", "", _BIND)


def set_limits(limits):
    """Set the limits of this process and all that it starts, but for its time; "memory", "file" in bytes."""
    _set_limit(resource.RLIMIT_AS, limits["memory"])
    _set_limit(resource.RLIMIT_NPROC, limits["processes"])
    _set_limit(resource.RLIMIT_FSIZE, limits["file"])
    _set_limit(resource.RLIMIT_NOFILE, 256)
    _set_limit(resource.RLIMIT_CORE, 1)  # 0 does not keep a system from piping the core to a program


def set_time_limit(seconds):
    """Set the processor time that this process and each that it starts may use."""
    _set_limit(resource.RLIMIT_CPU, seconds)


def _set_limit(kind, limit):
    _, hard = resource.getrlimit(kind)
    limit = limit if hard == resource.RLIM_INFINITY else min(limit, hard)
    resource.setrlimit(kind, (limit, limit))


def _drop_privileges(user):
    _check(_prctl(_PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0), "no_new_privs")
    for capability in range(_LAST_CAPABILITY + 1):
        if _prctl(_PR_CAPBSET_DROP, capability, 0, 0, 0) != 0:
            break  # the last one that this system knows
    if user is not None:
        os.setgroups([])
        os.setresgid(user, user, user)
        os.setresuid(user, user, user)
    # Empty the effective, permitted and inheritable sets (capset, version 3).
    header, no_capabilities = (ctypes.c_uint32 * 2)(0x20080522, 0), (ctypes.c_uint32 * 6)(0, 0, 0, 0, 0, 0)
    _check(_capset(header, no_capabilities), "capset")
    _check(_prctl(_PR_SET_DUMPABLE, 1, 0, 0, 0), "dumpable")
    refuse_system_calls()


def leave_session_keyring():
    """Give this process a new session keyring, so that none of the user's keys can be found from it."""
    if _NUMBERS:  # a system without keyrings has none to leave
        _libc.syscall(ctypes.c_long(_NUMBERS["keyctl"]), ctypes.c_long(_JOIN_SESSION_KEYRING), None)


def end_child(child, patience):
    """How a child ended: by itself within `patience` seconds (signal or exit code), or killed here."""
    ended, give_up = 0, _monotonic() + patience
    while not ended:
        is_late = _monotonic() >= give_up
        if is_late:
            _kill(child, signal.SIGKILL)
        ended, status, usage = _wait4(child, 0 if is_late else os.WNOHANG)
        if not ended:
            _sleep(0.001)
    return {
        "signal": os.WTERMSIG(status) if os.WIFSIGNALED(status) else 0,
        "code": os.WEXITSTATUS(status) if os.WIFEXITED(status) else 0,
        "cpu": usage.ru_utime + usage.ru_stime,
    }


def die_first():
    """Let the system end this process and its children first if memory runs out; for good."""
    with suppress(OSError):
        descriptor = os.open("/proc/self/oom_score_adj", os.O_WRONLY)
        os.write(descriptor, b"1000")
        os.close(descriptor)


def die_with_parent():
    """End this process when its parent ends."""
    with suppress(OSError):
        _check(_prctl(1, signal.SIGKILL, 0, 0, 0), "pdeathsig")


def refuse_system_calls():
    """Refuse calls that give this process, for good, resources that no limit counts, or a way out.

    Memory in an anonymous file, in System V segments or in a new file system does not count as memory of a
    process, and a new user namespace makes its owner root there. Keyrings, the system's log, and sockets of
    most families are in no namespace: what one kernel writes there, the next could read. `sync` and `syncfs`
    make everybody wait for the disk, and a lease on a file those who open it. Answers need none of these.

    It needs no_new_privs. On a machine whose call numbers are not in the table, nothing is refused. Without
    seccomp: OSError.
    """
    if not _PROGRAM:
        return
    instructions = ctypes.create_string_buffer(_PROGRAM, len(_PROGRAM))
    program = struct.pack("HxxxxxxP", len(_PROGRAM) // 8, ctypes.addressof(instructions))
    _check(_prctl(_PR_SET_SECCOMP, _FILTER, program, 0, 0), "seccomp")


def _filter():
    """The instructions of the filter, each a struct sock_filter."""
    yield _instruction(_LOAD, _MACHINE)
    yield _instruction(_EQUAL, _MACHINES[_HERE], 1, 0)
    yield _instruction(_RETURN, _REFUSE)
    yield _instruction(_LOAD, _NUMBER)
    yield from _if(_AT_LEAST, _X32, _REFUSE)
    # clone3 has its flags in memory, where no filter sees them; after ENOSYS the C library calls clone.
    yield from _if(_EQUAL, _NUMBERS["clone3"], _ERROR | errno.ENOSYS)
    for name in _NUMBERS.keys() - _SOME_USES:
        yield from _if(_EQUAL, _NUMBERS[name], _REFUSE)
    for name, (argument, test, values, result, otherwise) in _SOME_USES.items():
        yield _instruction(_EQUAL, _NUMBERS[name], 0, 2 + 2 * len(values))
        yield _instruction(_LOAD, argument)
        for value in values:
            yield from _if(test, value, result)
        yield _instruction(_RETURN, otherwise)
    yield _instruction(_RETURN, _ALLOW)


def _if(test, value, result):
    yield _instruction(test, value, 0, 1)
    yield _instruction(_RETURN, result)


def _instruction(code, value, jump_if_true=0, jump_if_false=0):
    return struct.pack("HBBI", code, jump_if_true, jump_if_false, value)


_PROGRAM = b"".join(_filter()) if _NUMBERS else b""
