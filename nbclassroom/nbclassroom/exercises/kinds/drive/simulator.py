"""A simulator: a process that holds the environment of a drive, so that a notebook's kernel does not.

`simulators` starts it as `python -m` this module. It reads requests, and writes a reply to each, as pickles;
it ends when nobody can send any more.
"""

import os
import pickle
import sys
import traceback

from nbclassroom.exercises.kinds.drive.drive import Drive, environment
from nbclassroom.exercises.kinds.drive.images import draw_map, look_back


class Simulator:
    """Answers requests; each of its methods is one, and `begin` comes before those of a drive."""

    def begin(self, sensors, scenario):
        self._drive = Drive(environment(sensors), scenario)
        return self._reply()

    def act(self, linear, angular):
        self._drive.act((linear, angular))
        return self._reply()

    def stop(self, reason):
        self._drive.stop(reason)
        return self._reply()

    def draw_map(self, record, scenario):
        return [draw_map(record, scenario)]

    def look_back(self, record, scenario):
        return look_back(environment(()), record, scenario)

    def _reply(self):
        """The next observation, or the record of a drive that is over."""
        return {"record": self._drive.record()} if self._drive.over else self._drive.observation


def main():
    """Answer the requests on the standard input; what libraries print does not get between the replies."""
    replies = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    simulator = Simulator()
    while True:
        try:
            name, *arguments = pickle.load(sys.stdin.buffer)
        except EOFError:
            return
        try:
            reply = True, getattr(simulator, name)(*arguments)
        except Exception:  # noqa: BLE001 - the one that asked raises it
            reply = False, traceback.format_exc()
        pickle.dump(reply, replies)
        replies.flush()


if __name__ == "__main__":
    main()
