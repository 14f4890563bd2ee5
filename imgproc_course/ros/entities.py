"""What an object of ours has in the ROS graph, and when that is destroyed."""

import contextvars
import weakref
from typing import Any, Self

from imgproc_course.ros.session import RosSession


class Entities:
    """The publishers, subscriptions and clients of an object, in the session's node.

    They are destroyed by `close`, and when no reference to their owner is left. A session that stops destroys
    them itself; before, it calls `on_shutdown()`.
    """

    def __init__(self, owner, on_shutdown):
        session = RosSession.current()
        self.node = session.node
        self.all: list[Any] = []
        session.on_shutdown(self.all, on_shutdown)
        self.close = weakref.finalize(owner, _destroy, session, self.node, self.all)
        self.close.atexit = False  # the session destroys them then

    @property
    def closed(self):
        return not self.close.alive

    def add(self, entity):
        self.all.append(entity)
        return entity

    def subscribe(self, message_type, topic, qos, method, *arguments, **options):
        """A subscription that calls `method(*arguments, msg, info)` as long as the method's object exists."""
        call = weak_callback(method)

        def on_message(msg, info):
            call(*arguments, msg, info)

        return self.add(self.node.create_subscription(message_type, topic, on_message, qos, **options))


class Stoppable:
    """What stops at the end of its `with`, in any case."""

    def stop(self) -> None:
        raise NotImplementedError

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *exception):
        self.stop()


def _destroy(session, node, entities):
    session.on_shutdown(entities, None)

    def destroy():
        for entity in entities:
            for kind in (node.destroy_publisher, node.destroy_subscription, node.destroy_client):
                kind(entity)  # does nothing with what is of another kind

    session.post(destroy)


def weak_callback(method):
    """A function that calls the method while its object exists; it prints below the cell of this call."""
    reference, cell = weakref.WeakMethod(method), contextvars.copy_context()

    def call(*arguments):
        bound_method = reference()
        return cell.copy().run(bound_method, *arguments) if bound_method is not None else None

    return call
