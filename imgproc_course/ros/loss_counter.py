"""How many messages of a topic were lost on the way, by the numbers that the publisher gives them."""


class LossCounter:
    """Counts the messages that the publisher sent and this process never received.

    A publisher numbers its messages. If a number is missing, that message is lost: on the way, or because it
    was overwritten in the queue while the callback's thread was busy.
    """

    def __init__(self):
        self.total = 0  # messages known to be lost
        self._can_count = True
        self._last_number: int | None = None

    def receive(self, number):
        """Takes the number of a message that arrived; None or 0 if the middleware does not number them."""
        if not number:
            self._can_count = False
        elif self._can_count and self._last_number is not None and number > self._last_number:
            self.total += number - self._last_number - 1
        self._last_number = number

    def set_publishers(self, count):
        """Takes the new number of publishers: each has its own numbers, and two cannot be told apart."""
        self._last_number = None
        self._can_count = count <= 1

    def on_matched(self, event):
        """The callback of a subscription whose publishers have changed."""
        self.set_publishers(event.current_count)

    @property
    def lost(self):
        """`total`, or None while it cannot be known: several publishers, or messages without numbers."""
        return self.total if self._can_count else None
