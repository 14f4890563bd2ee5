"""Names of pages, and pages without names: there an id that only the key's owner can compute from a name."""

import copy
import hashlib
import hmac
import re
from pathlib import Path

_SHORTEST = 3  # characters of a name that is looked for in texts


def page_name(name):
    """The name of a learner's page: safe on every system, and unique through a digest."""
    slug = re.sub(r"[^a-z0-9]+", "-", name.lower()).strip("-")[:40] or "learner"
    return f"{slug}-{hashlib.sha256(name.encode()).hexdigest()[:10]}"


def anonymous_id(name, answer_keys):
    """The id of a learner: the same in every run with the same first key."""
    digest = hmac.digest(answer_keys.keys[0].digest.encode(), name.encode(), "sha256")
    return f"learner-{digest.hex()[:10]}"


def without_names(grades):
    """A copy of grades for the pages: ids instead of names, and no names of files."""
    learners = [learner_without_name(entry) for entry in grades["learners"]]
    return grades | {"ignored": [], "roster": None, "learners": learners}


def learner_without_name(entry):
    """A copy of a learner's entry, as `without_names` has it."""
    learner = copy.deepcopy(entry)
    name, learner["name"] = learner["name"], Path(learner["page"]).stem
    for lesson in learner["lessons"]:
        files = [lesson["file"], *(earlier["file"] for earlier in lesson["earlier"])]
        texts = [*filter(None, files), *([name] if len(name) >= _SHORTEST else [])]
        for holder, key in [(lesson, "reason"), *((finding, "text") for finding in lesson["findings"])]:
            for text in texts:
                holder[key] = holder[key].replace(text, "…")
        for file in (lesson, *lesson["earlier"]):
            file["file"] = ""
    return learner
