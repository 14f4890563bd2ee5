"""The ROS session of a process: one context, one executor, and one thread that spins it.

A cell must never call rclpy.spin, because it does not return. Here a background thread spins instead. It ends
before the interpreter does: a thread that still spins at exit would abort the process.
"""

import atexit
import collections
import concurrent.futures
import contextlib
import ctypes
import functools
import logging
import math
import os
import sys
import threading
import time
import traceback
from collections.abc import Callable
from typing import Any, Self

import rclpy.node
from rclpy.context import Context
from rclpy.exceptions import InvalidHandle
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.logging import LoggingSeverity, set_logger_level
from rclpy.node import Node

from imgproc_course import learner_errors
from imgproc_course.ros import notebook_log, notebook_spin
from imgproc_course.ros.profile import remove_stale_segments, restore_lost_ports

RCLError = rclpy_implementation.RCLError  # rclpy exports it nowhere else
log = logging.getLogger("imgproc_course.ros")

notebook_log.install()  # before a context exists

CALLBACK_TIMEOUT = 5.0  # seconds that others wait for a callback to return
REMOVAL_TIMEOUT = 60.0  # seconds that the removal of a node waits: its callback may compute for long
LOG_PERIOD = 5.0  # seconds between two log lines about the same fault
RESTORE_PERIOD = 2.0  # seconds between two looks at the shared-memory ports


class Throttle:
    """True for each fault at most once per period, so that a fault at 30 Hz does not flood the log.

    With `while_it_lasts`, the period begins anew whenever the fault occurs.
    """

    def __init__(self, seconds=LOG_PERIOD, *, while_it_lasts=False):
        self._seconds, self._while_it_lasts = seconds, while_it_lasts
        self._last = {}

    def __call__(self, fault=""):
        now = time.monotonic()
        is_due = now - self._last.get(fault, -math.inf) >= self._seconds
        if is_due or self._while_it_lasts:
            self._last[fault] = now
        return is_due


class RosSession:
    """Context, executor and spinning thread of this process.

    There is one session per process: `RosSession()` always returns the same object, and
    `RosSession.current()` also starts it. You may start twice, stop twice, and start again after a stop. The
    session has its own context: your rclpy.init() and rclpy.shutdown() in the same process do not affect it.
    """

    _instance: "RosSession | None" = None
    _instance_lock = threading.Lock()
    _spinner: "Any" = None  # a _Spinner, after the first start
    _was_forked = False

    def __new__(cls) -> "RosSession":
        with cls._instance_lock:
            if cls._instance is None:
                cls._instance = super().__new__(cls)
                cls._instance._start_lock = threading.RLock()
            return cls._instance

    @classmethod
    def current(cls) -> "RosSession":
        """The running session of this process; started if it was stopped."""
        return cls().start()

    def start(self) -> Self:
        """Starts the session; does nothing if it is running. Returns the session.

        Raises
        ------
        ValueError : ROS_DOMAIN_ID is not a domain
        RuntimeError : called from a callback of a session that is stopping, or in a process that was forked
            from one with a running session
        """
        if self.running:
            return self
        if self.is_spinning_thread():
            raise RuntimeError("the ROS session is stopping; start it from outside its callbacks")
        if self._was_forked:
            raise RuntimeError(
                "this process was forked from one with a running ROS session, and DDS does not work after a "
                "fork; start the process with multiprocessing.get_context('spawn') or subprocess instead"
            )
        with self._start_lock:
            if not self.running:
                self.stop()
                _check_domain()
                remove_stale_segments()
                self._spinner = _Spinner()
        return self

    def stop(self) -> None:
        """Stops cameras and subscribers, destroys the nodes, joins the thread. A second call does nothing.

        May be called from anywhere. If a callback calls it, the thread ends after that callback.
        """
        if self._spinner is None or self._was_forked:
            return
        self._spinner.leave()
        if not self.is_spinning_thread():
            self._spinner.thread.join(CALLBACK_TIMEOUT)
            if self._spinner.thread.is_alive():
                log.warning(
                    "a callback has not returned for %g s; the ROS session stops without it", CALLBACK_TIMEOUT
                )

    @property
    def running(self) -> bool:
        """Whether the session's thread spins and has not been asked to stop."""
        return self._spinner is not None and not self._was_forked and self._spinner.spinning

    @property
    def node(self) -> Any:
        """The session's own node, with this process's cameras and subscribers; None if stopped."""
        return self._spinner.node if self.running else None

    @property
    def context(self) -> Any:
        """rclpy's Context of the session; None if stopped."""
        return self._spinner.context if self.running else None

    def __enter__(self) -> Self:
        return self.start()

    def __exit__(self, *exception):
        self.stop()

    def __repr__(self):
        return f"<RosSession: {f'domain {self.context.get_domain_id()}' if self.running else 'stopped'}>"

    def add_node(self, node: Node | type[Node]) -> Node:
        """Spins your node too. Create it with `context=session.context`; the session destroys it on stop.

        It replaces the node of the same name and namespace that was added before: that one is destroyed
        first, so a cell that runs again does not leave two nodes. A class without arguments is created here,
        in the session's context; it replaces nodes of a class of this name.
        """
        added = self._create(node) if isinstance(node, type) else node
        self.run(functools.partial(self._running_spinner().add, added))
        return added

    def _create(self, node_class: Any) -> Node:
        for node in self._running_spinner().nodes():
            if type(node).__name__ == node_class.__name__:
                self.remove_node(node)
        # Its __init__ names no context, so that it is the same as in a script.
        names = vars(rclpy.node)
        default_context, names["get_default_context"] = names["get_default_context"], lambda: self.context
        try:
            return node_class()
        finally:
            names["get_default_context"] = default_context

    def remove_node(self, node: Node) -> None:
        """Stops spinning your node and destroys it. A second call does nothing."""
        if self.running:
            self.run(functools.partial(self._spinner.destroy, node), REMOVAL_TIMEOUT)

    def remove_namesake(self, name: str, namespace: str | None = None, context: Any = None) -> None:
        """Destroys the session's node of this name, before another one is created in the same context.

        ROS mixes up two nodes that have one name at the same time: when the first is destroyed, the second
        has no services and no publishers in the graph any more, and its log does not go to /rosout.
        """
        if self.running and context is self.context:
            full_name = f"/{(namespace or '').strip('/')}/{name}".replace("//", "/")
            self.run(functools.partial(self._spinner.remove_namesakes, full_name))

    def error_of_publisher(self, topic: str) -> str | None:
        """What went wrong last in your node that publishes the topic, in one line with its name; or None."""
        for node in self._spinner.nodes() if self.running else ():
            if topic in (publisher.topic_name for publisher in node.publishers):
                # Only an ImageProcessor knows its own error.
                error = getattr(node, "last_error", None) or self._spinner.callback_errors.get(node)
                return f"{node.get_fully_qualified_name()} publishes it, but {error}" if error else None
        return None

    def resolve_topic(self, topic: str) -> str:
        """The full name of a topic, after the remapping of the command line; ValueError if it is none."""
        try:
            return self._running_spinner().node.resolve_topic_name(topic)
        except RCLError as error:
            cause = str(error).removeprefix("failed to resolve name: ").partition(", at ")[0]
            raise ValueError(
                f"{topic!r} is not a topic name ({cause}); a topic name looks like /camera/image_raw"
            ) from error

    def run(self, function: Callable[[], Any], timeout: float = CALLBACK_TIMEOUT) -> Any:
        """Calls a function in the spinning thread, between two callbacks, and returns its result.

        Destroy nodes and subscriptions in this way: rclpy's executor fails if one disappears while the
        executor waits for it.

        Raises
        ------
        RuntimeError : the session is stopped
        TimeoutError : a callback keeps the thread busy; the function will still be called
        """
        if self.is_spinning_thread():
            return function()
        future: concurrent.futures.Future[Any] = concurrent.futures.Future()

        def call():
            try:
                future.set_result(function())
            except Exception as error:  # noqa: BLE001  the caller receives it
                future.set_exception(error)

        if not self._running_spinner().post(call):
            raise RuntimeError("the ROS session has just stopped; RosSession.current() starts it")
        try:
            return future.result(timeout)
        except TimeoutError as error:
            if future.done():
                raise
            text = f"a callback has not returned for {timeout:g} s; wait until it does, then run this again"
            raise TimeoutError(text) from error

    def post(self, function: Callable[[], Any]) -> None:
        """Lets the spinning thread call a function soon, without waiting. Does nothing if stopped."""
        if self.running:
            self._spinner.post(function)

    def is_spinning_thread(self) -> bool:
        """Whether the caller is a callback of this session."""
        return self._spinner is not None and threading.current_thread() is self._spinner.thread

    def on_shutdown(self, owner: object, callback: Callable[[], Any] | None) -> None:
        """Lets the spinning thread call `callback()` when the session stops.

        Each owner has one callback; a new one replaces it, and None removes it.
        """
        if self.running:
            self._spinner.on_shutdown(owner, callback)

    def _running_spinner(self):
        if not self.running:
            raise RuntimeError("the ROS session is stopped; RosSession.current() starts it")
        return self._spinner

    def _abandon_after_fork(self):
        """In a forked child: forgets the spinner without touching it; its threads are in the parent only."""
        self._start_lock = threading.RLock()
        if self._spinner is None or self._spinner.closed:
            return
        self._was_forked = True
        ctypes.pythonapi.Py_IncRef(ctypes.py_object(self._spinner))
        _exit_without_destructors()


class _Spinner:
    """The context, executor, node and thread of a session, from one start to the next stop."""

    def __init__(self):
        # ROS warns about two nodes of one name in a process, but here the second replaces the first.
        set_logger_level("rcl.logging_rosout", LoggingSeverity.ERROR)
        self.context, self.node = _new_node(f"imgproc_course_{os.getpid()}")
        self.executor = _Executor(context=self.context)
        self.executor.add_node(self.node)
        self.closed = False
        self.callback_errors: dict[Any, str] = {}  # node: what its callback raised last
        self._nodes = [self.node]
        self._lock = threading.RLock()
        self._leaving = threading.Event()
        self._tasks: collections.deque[Callable[[], Any]] = collections.deque()
        self._shutdown_callbacks = {}
        self._errors = learner_errors.RepeatedErrors()
        notebook_spin.install(self.context, self._take_back)
        # A daemon thread, so that a callback that never returns cannot keep the interpreter alive.
        self.thread = threading.Thread(target=self._spin, name="imgproc_course ROS session", daemon=True)
        self.thread.start()

    @property
    def spinning(self):
        return self.thread.is_alive() and not self._leaving.is_set()

    def leave(self):
        self._leaving.set()
        self.post(lambda: None)  # the executor's own wake() does not make spin_once return

    def post(self, function):
        with self._lock:
            if not self.closed:
                self._tasks.append(function)
                self.executor.create_task(self._run_tasks)
            return not self.closed

    def _run_tasks(self):
        while self._tasks:
            self._tasks.popleft()()

    def on_shutdown(self, owner, callback):
        with self._lock:
            self._shutdown_callbacks.pop(id(owner), None)
            if callback is not None:
                self._shutdown_callbacks[id(owner)] = callback

    def add(self, node):
        if node not in self._nodes:
            self.remove_namesakes(node.get_fully_qualified_name())
            self._nodes.append(node)
            self._errors = learner_errors.RepeatedErrors()  # what fails again was not mended
            self.executor.add_node(node)

    def nodes(self):
        return [node for node in self._nodes[1:] if _full_name(node)]

    def _take_back(self, node):
        with self._lock:
            if node in self._nodes and not self.closed:
                self.executor.add_node(node)

    def remove_namesakes(self, full_name):
        for node in self._nodes[1:]:
            if _full_name(node) in (None, full_name):
                self.destroy(node)

    def destroy(self, node):
        if node in self._nodes:
            self._nodes.remove(node)
            self.callback_errors.pop(node, None)
            self.executor.remove_node(node)
            with contextlib.suppress(InvalidHandle):  # its owner destroyed it already
                node.destroy_node()

    def _spin(self):
        try:
            while not self._leaving.is_set() and self.context.ok():
                self._spin_once()
        except ExternalShutdownException:
            pass  # Ctrl-C, after an rclpy.init() elsewhere installed ROS's own signal handlers
        finally:
            self._leaving.set()
            self._close()

    def _spin_once(self):
        try:
            spin_once(self.executor)
        except ExternalShutdownException:
            raise
        except InvalidHandle:
            pass  # something was destroyed between the wait and its callback; the next round is in order
        except Exception as error:  # noqa: BLE001  callbacks are other people's code; the graph must live on
            failed_line = learner_errors.failed_line(error)
            self.callback_errors[self.executor.node] = f"a callback failed {failed_line}"
            lines = learner_errors.describe(error) or "".join(traceback.format_exception(error)).rstrip()
            text = self._errors.news(error, f"a ROS callback failed; the graph continues\n{lines}")
            if text:
                name = self.executor.node.get_logger().name if self.executor.node else ""
                notebook_log.in_cell_of(name)(log.error, "%s", text)

    def _close(self):
        notebook_spin.uninstall()
        with self._lock:
            callbacks, self._shutdown_callbacks = list(self._shutdown_callbacks.values()), {}
        for callback in callbacks:
            callback()
        with self._lock:  # from here on no thread can post
            self._run_tasks()
            for node in list(self._nodes):
                self.destroy(node)
            self.executor.shutdown()
            self.closed = True
        self.context.try_shutdown()


class _Executor(SingleThreadedExecutor):
    """Knows whose callback it calls."""

    node: Any = None  # None: a task of the session

    def wait_for_ready_callbacks(self, *arguments, **options):
        ready: Any = super().wait_for_ready_callbacks(*arguments, **options)
        self.node = ready[2]
        return ready  # (handler, entity, node)


def spin_once(executor, timeout_sec=None):
    """As `executor.spin_once`, but every shutdown of ROS raises ExternalShutdownException."""
    try:
        executor.spin_once(timeout_sec)
    except RCLError as error:
        # rclpy checks the context only after the wait. If ROS's signal handlers shut it down between two
        # rounds, from their own thread, then the preparation of the wait fails.
        if executor.context.ok():
            raise
        raise ExternalShutdownException from error


def _full_name(node):
    """The node's namespace and name; None if it was destroyed."""
    try:
        return node.get_fully_qualified_name()
    except InvalidHandle:
        return None


def _new_node(name):
    """A context and its first node, which creates the DDS participant with its shared-memory ports."""
    context = _new_context()
    try:
        node = Node(name, context=context)
    except RCLError as error:
        if "Unable to resolve peer" not in str(error):
            raise
        peers = os.environ.get("ROS_STATIC_PEERS")
        raise ValueError(
            f"ROS_STATIC_PEERS={peers} has a name that is not found; separate addresses by a semicolon, "
            "give no ports, or unset ROS_STATIC_PEERS"
        ) from error
    node.create_timer(RESTORE_PERIOD, restore_lost_ports)
    return context, node


def _new_context():
    context = Context()
    try:
        context.init()
    except RuntimeError as error:
        if "logging" not in str(error):
            raise
        # ROS's log folder cannot be written (a full or read-only disk): log to the screen only.
        context = Context()
        context.init(initialize_logging=False)
    return context


def _check_domain():
    domain = os.environ.get("ROS_DOMAIN_ID") or "0"
    if not (domain.isascii() and domain.isdecimal()) or int(domain) > 232:
        raise ValueError(
            f"ROS_DOMAIN_ID={domain} is not a ROS domain; choose 0 to 101, the same on all machines"
        )


@atexit.register
def _stop_at_exit():
    session = RosSession._instance
    if session is None or session._spinner is None or session._was_forked:
        return
    session.stop()
    thread = session._spinner.thread
    if thread.is_alive():
        # Python aborts if a thread comes back to it from C while it ends: end the callback's loop.
        ident = ctypes.c_ulong(thread.ident)
        ctypes.pythonapi.PyThreadState_SetAsyncExc(ident, ctypes.py_object(SystemExit))
        thread.join(CALLBACK_TIMEOUT)
        if thread.is_alive():
            _exit_without_destructors()


def _exit_without_destructors():
    """Fast DDS's static destructors crash where its threads are gone, or still run: exits before them."""
    if sys.platform == "linux":
        libc = ctypes.CDLL(None)
        libc.on_exit(libc._exit, None)


def _after_fork_in_child():
    RosSession._instance_lock = threading.Lock()
    if RosSession._instance is not None:
        RosSession._instance._abandon_after_fork()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_after_fork_in_child)
