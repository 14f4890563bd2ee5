"""The ROS session of a process: one context, one executor, one thread that spins it, for as long as you like.

A cell must never call rclpy.spin, which does not return. Here a thread of its own spins instead, and is gone
before the interpreter is: a thread still spinning at exit would abort the process.
"""

import atexit
import collections
import concurrent.futures
import contextlib
import ctypes
import logging
import os
import sys
import threading
import time

from rclpy.context import Context
from rclpy.exceptions import InvalidHandle
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node

from imgproc_course.ros.profile import remove_stale_segments

RCLError = rclpy_implementation.RCLError  # rclpy exports it nowhere else
log = logging.getLogger("imgproc_course.ros")

PATIENCE = 5.0  # seconds that a callback may keep others waiting


class Throttle:
    """True at most once every so many seconds, so that a fault at 30 Hz is told and does not flood."""

    def __init__(self, seconds=PATIENCE):
        self._seconds = seconds
        self._last = None

    def __call__(self):
        now = time.monotonic()
        if self._last is not None and now - self._last < self._seconds:
            return False
        self._last = now
        return True


class RosSession:
    """Context, executor and spinning thread of this process.

    There is one per process: `RosSession()` gives the same object each time, `RosSession.current()` also
    starts it. Starting twice, stopping twice, and starting again after a stop are all fine. Its context is
    its own, so that your rclpy.init() and rclpy.shutdown() in the same process do not touch it.

    Attributes
    ----------
    node : the session's own node, on which cameras and subscribers of this process live; None while stopped
    context, executor : as rclpy knows them; None while stopped
    """

    _only = None
    _birth = threading.Lock()

    def __new__(cls):
        with cls._birth:
            if cls._only is None:
                cls._only = super().__new__(cls)
                cls._only._life = threading.RLock()  # one start at a time
                cls._only._graph = None
                cls._only._forked = False
            return cls._only

    @classmethod
    def current(cls):
        """The running session of this process, started if it was not running."""
        return cls().start()

    def start(self):
        """Starts the session, or does nothing when it is running. Returns the session.

        Raises
        ------
        ValueError : ROS_DOMAIN_ID is no domain
        RuntimeError : called from a callback of a session that is stopping, or in a process that was forked
            from one with a running session
        """
        if self.running:
            return self
        if self.is_spinning_thread():
            raise RuntimeError("the ROS session is stopping; start it from outside its callbacks")
        if self._forked:
            raise RuntimeError(
                "this process was forked from one with a running ROS session, which DDS does not survive; "
                "start it with multiprocessing.get_context('spawn') or subprocess instead"
            )
        with self._life:
            if not self.running:
                self.stop()
                _check_domain()
                remove_stale_segments()
                self._graph = _Graph()
        return self

    def stop(self):
        """Stops cameras and subscribers, destroys the nodes, joins the thread. A second stop does nothing.

        May be called from anywhere, a callback included (the thread then leaves after that callback).
        """
        if self._graph is None or self._forked:
            return
        self._graph.leave()
        if not self.is_spinning_thread():
            self._graph.thread.join(PATIENCE)
            if self._graph.thread.is_alive():
                log.warning(
                    "a callback has not returned for %g s; the ROS session leaves without it", PATIENCE
                )

    @property
    def running(self):
        """Whether the session's thread spins, and is to go on."""
        return self._graph is not None and not self._forked and self._graph.spinning

    context = property(lambda self: self._graph.context if self.running else None)
    executor = property(lambda self: self._graph.executor if self.running else None)
    node = property(lambda self: self._graph.node if self.running else None)

    def __enter__(self):
        return self.start()

    def __exit__(self, *exception):
        self.stop()

    def __repr__(self):
        return f"<RosSession: {f'domain {self.context.get_domain_id()}' if self.running else 'stopped'}>"

    def add_node(self, node):
        """Spins a node of yours too, made with `context=session.context`; the session's end destroys it."""
        graph = self._running_graph()
        self.run(lambda: graph.add(node))
        return node

    def remove_node(self, node):
        """Stops spinning a node of yours, and destroys it. A second call does nothing."""
        graph = self._graph
        if self.running:
            self.run(lambda: graph.destroy(node))

    def resolve_topic(self, topic):
        """The full name of a topic, remapped as the command line says.

        Raises
        ------
        ValueError : it is no topic name
        """
        try:
            return self._running_graph().node.resolve_topic_name(topic)
        except RCLError as error:
            cause = str(error).removeprefix("failed to resolve name: ").partition(", at ")[0]
            raise ValueError(
                f"{topic!r} is no topic name ({cause}); one looks like /camera/image_raw"
            ) from error

    def run(self, function, timeout=PATIENCE):
        """Calls a function in the spinning thread, between two callbacks, and returns what it returns.

        Nodes and subscriptions must be destroyed there: rclpy's executor stumbles over one that vanishes
        while it waits for it.

        Raises
        ------
        RuntimeError : the session is stopped
        TimeoutError : a callback keeps the thread busy; the function will still be called
        """
        if self.is_spinning_thread():
            return function()
        answer = concurrent.futures.Future()

        def call():
            try:
                answer.set_result(function())
            except Exception as error:  # noqa: BLE001  it is the caller's, who gets it
                answer.set_exception(error)

        if not self._running_graph().post(call):
            raise RuntimeError("the ROS session has just stopped; RosSession.current() starts it")
        return answer.result(timeout)

    def post(self, function):
        """Has the spinning thread call a function soon, and does not wait; nothing happens when stopped."""
        if self.running:
            self._graph.post(function)

    def is_spinning_thread(self):
        """Whether the caller is a callback of this session."""
        return self._graph is not None and threading.current_thread() is self._graph.thread

    def at_stop(self, owner, function):
        """Has `function()` called, in the spinning thread, when the session stops; None takes it back."""
        if self.running:
            self._graph.at_stop(owner, function)

    def _running_graph(self):
        if not self.running:
            raise RuntimeError("the ROS session is stopped; RosSession.current() starts it")
        return self._graph

    def _leave_to_parent(self):
        """In a forked child: forgets the graph without touching it; its threads live in the parent only."""
        self._life = threading.RLock()
        if self._graph is None or self._graph.closed:
            return
        self._forked = True
        ctypes.pythonapi.Py_IncRef(ctypes.py_object(self._graph))
        if sys.platform == "linux":
            # Fast DDS's static destructors crash in a process without its threads: leave before they run.
            libc = ctypes.CDLL(None)
            libc.on_exit(libc._exit, None)


class _Graph:
    """One life of the session, from its start to its stop."""

    def __init__(self):
        self.context = _new_context()
        self.executor = SingleThreadedExecutor(context=self.context)
        self.node = Node(f"imgproc_course_{os.getpid()}", context=self.context)
        self.executor.add_node(self.node)
        self.closed = False
        self._nodes = [self.node]
        self._lock = threading.RLock()
        self._leaving = threading.Event()
        self._work = collections.deque()
        self._farewells = {}
        self._complain = Throttle()
        # A daemon, so that a callback that never returns cannot keep the interpreter from leaving.
        self.thread = threading.Thread(target=self._spin, name="imgproc_course ROS session", daemon=True)
        self.thread.start()

    @property
    def spinning(self):
        return self.thread.is_alive() and not self._leaving.is_set()

    def leave(self):
        self._leaving.set()
        self.post(lambda: None)  # the executor's own wake() does not bring spin_once to return

    def post(self, function):
        with self._lock:
            if not self.closed:
                self._work.append(function)
                self.executor.create_task(self._do_work)
            return not self.closed

    def _do_work(self):
        while self._work:
            self._work.popleft()()

    def at_stop(self, owner, function):
        with self._lock:
            self._farewells.pop(id(owner), None)
            if function is not None:
                self._farewells[id(owner)] = function

    def add(self, node):
        self._nodes.append(node)
        self.executor.add_node(node)

    def destroy(self, node):
        if node in self._nodes:
            self._nodes.remove(node)
            self.executor.remove_node(node)
            with contextlib.suppress(InvalidHandle):  # its owner destroyed it already
                node.destroy_node()

    def _spin(self):
        try:
            while not self._leaving.is_set() and self.context.ok():
                self._spin_once()
        except ExternalShutdownException:
            pass  # Ctrl-C, after somebody's rclpy.init() installed ROS's own signal handlers
        finally:
            self._leaving.set()
            self._close()

    def _spin_once(self):
        try:
            spin_once(self.executor)
        except ExternalShutdownException:
            raise
        except InvalidHandle:
            pass  # something was destroyed between the wait and its turn; the next round knows
        except Exception:  # callbacks are other people's code, and the graph must live on
            if self._complain():
                log.exception("a ROS callback failed; the graph goes on")

    def _close(self):
        with self._lock:
            farewells, self._farewells = list(self._farewells.values()), {}
        for farewell in farewells:
            farewell()
        with self._lock:  # from here on nobody can post
            self._do_work()
            for node in list(self._nodes):
                self.destroy(node)
            self.executor.shutdown()
            self.closed = True
        self.context.try_shutdown()


def spin_once(executor, timeout_sec=None):
    """Executes what is ready, as `executor.spin_once`, and knows every end of ROS as one.

    Raises
    ------
    rclpy.executors.ExternalShutdownException : ROS was shut down meanwhile
    """
    try:
        executor.spin_once(timeout_sec)
    except RCLError as error:
        # rclpy asks whether the context lives only after the wait: one that was shut down between two rounds
        # (by ROS's signal handlers, from their own thread) fails while the wait is prepared.
        if executor.context.ok():
            raise
        raise ExternalShutdownException from error


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
    given = os.environ.get("ROS_DOMAIN_ID") or "0"
    if not given.isdecimal() or int(given) > 232:
        raise ValueError(f"ROS_DOMAIN_ID={given} is no ROS domain; choose 0 to 101, the same on all machines")


@atexit.register
def _stop_at_exit():
    if RosSession._only is not None:
        RosSession._only.stop()


def _after_fork_in_child():
    RosSession._birth = threading.Lock()
    if RosSession._only is not None:
        RosSession._only._leave_to_parent()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_after_fork_in_child)
