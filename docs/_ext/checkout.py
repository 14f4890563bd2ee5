"""What the site says of its checkout: version, date, and the address of the repository."""

import re
import subprocess
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PLACEHOLDER = "URL-OF-THIS-REPOSITORY"  # in the sources, for the address that git knows
LEARN_IT = re.compile(rf"^For `{PLACEHOLDER}`.*\n\n", re.M)


def git(*arguments):
    """What git prints in the checkout; "" outside of a repository."""
    command = ["git", "-C", ROOT, *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False).stdout.strip()


def address_of(remote):
    """The web address of a repository, without a password; None of a remote that is a folder."""
    server = r"(?:\w+://)?(?:[^@/]+@)?([\w.-]+\.\w+)(?::\d+)?[:/]"
    found = re.fullmatch(server + r"(.+?)(?:\.git)?/?", remote)
    return f"https://{found[1]}/{found[2]}" if found and not remote.startswith((".", "file:")) else None


def with_address(text, address):
    """A text with the address of the repository, if there is one, in place of PLACEHOLDER."""
    return LEARN_IT.sub("", text).replace(PLACEHOLDER, address) if address else text


def facts():
    """What each page of the site says of the checkout, as the names of docs/_templates/page.html."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    return {
        "course_version": project["version"],
        "course_date": git("log", "-1", "--format=%cd, commit %h", "--date=format:%-d %B %Y"),
        "course_address": address_of(git("remote", "get-url", "origin")),
    }
