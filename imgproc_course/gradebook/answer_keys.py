"""A answer_keys's keys: which lessons there are, what was handed out, and which key fits which version."""

import json

from imgproc_course.autograder.answer_key import HANDED_OUT, KeyFolderError, load_key


class AnswerKeys:
    """The keys that a folder of submissions is graded with.

    Parameters
    ----------
    keys : list of Key, one a version of a lesson; the first one that has a lesson is its usual key
    """

    def __init__(self, keys):
        self.keys = list(keys)
        self.lessons = {}
        for key in self.keys:
            for name, lesson in key.lessons.items():
                self.lessons.setdefault(name, lesson)
        self._handed_out = {key.digest: _read_handed_out(key.path) for key in self.keys}

    def key_for(self, lesson, version):
        """The key made from that version of a lesson; the lesson's usual one where there is none."""
        having = [key for key in self.keys if lesson in key.lessons]
        return next((key for key in having if key.lessons[lesson].version == version), having[0])

    def answer_ids(self, lesson):
        """The ids of a lesson's answer cells, in any version, as a set."""
        having = [key.lessons[lesson] for key in self.keys if lesson in key.lessons]
        return {f"answer-{each.id}" for lesson in having for each in lesson.exercises}

    def handed_out(self, key, lesson):
        """{cell id: source of a check or given cell, None for the others}; empty where it was not kept."""
        return self._handed_out[key.digest].get(lesson, {})

    def key_of(self, digest):
        """The key with that digest."""
        return next(key for key in self.keys if key.digest == digest)


def load_keys(paths):
    """Read the keys in these folders.

    Parameters
    ----------
    paths : sequence of Path

    Returns
    -------
    AnswerKeys

    Raises
    ------
    KeyFolderError : one of them is none
    """
    return AnswerKeys([load_key(path) for path in paths])


def _read_handed_out(path):
    try:
        lessons = json.loads((path / HANDED_OUT).read_text(encoding="utf-8"))
        return {
            name: {id: source if isinstance(source, str) else None for id, source in cells.items()}
            for name, cells in lessons.items()
        }
    except FileNotFoundError:
        return {}
    except (OSError, ValueError, AttributeError) as error:
        raise KeyFolderError(f"{path}/{HANDED_OUT}: cannot be read ({error}); make the key again") from error
