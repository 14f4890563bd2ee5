"""What a release still lacks: one line each; used by environment/release.

python release.py [CHECKOUT]
"""

import datetime as dt
import re
import subprocess
import sys
from pathlib import Path

from checkout import PLACEHOLDER, ROOT

PROJECTS = ("pyproject.toml", "nbclassroom/pyproject.toml")
ADDRESSED = (*PROJECTS, "README.md", "docs/index.md", "docs/learn/start.md")
PAGES = ("LICENSE", "README.md", "CONTRIBUTING.md", "docs/about/licence.md")
PAGES += tuple(f".github/{name}.md" for name in ("SUPPORT", "CODE_OF_CONDUCT", "SECURITY"))


def first(pattern, text):
    found = re.search(pattern, text, re.M)
    return found[1] if found else "none"


def missing(root, today):
    """One line for each thing that a release of the checkout lacks, with the remedy."""
    for name in PAGES:
        if not (root / name).is_file():
            yield f"{name} does not exist"
    if not list((root / ".github/ISSUE_TEMPLATE").glob("*.md")):
        yield ".github/ISSUE_TEMPLATE holds no template"
    if (root / "LICENSE").read_bytes() != (root / "nbclassroom/LICENSE").read_bytes():
        yield "nbclassroom/LICENSE is not LICENSE: copy it"
    texts = {name: (root / name).read_text("utf-8") for name in (*ADDRESSED, "CITATION.cff", "CHANGELOG.md")}
    version = first(r'^version = "(.*)"$', texts[PROJECTS[0]])
    date = f"{today:%Y-%m-%d}"
    heading = f"## {version}, {today.day} {today:%B %Y}"
    written = {
        PROJECTS[1]: (first(r'^version = "(.*)"$', texts[PROJECTS[1]]), version),
        "version in CITATION.cff": (first(r"^version: (.*)$", texts["CITATION.cff"]), version),
        "date-released in CITATION.cff": (first(r"^date-released: (.*)$", texts["CITATION.cff"]), date),
        "the first heading of CHANGELOG.md": (first(r"^(## .*)$", texts["CHANGELOG.md"]), heading),
    }
    for name, (now, right) in written.items():
        if now != right:
            yield f"{name}: {now!r}, expected {right!r}"
    files = [name for name in ADDRESSED if PLACEHOLDER in texts[name]]
    if files:
        yield f'{PLACEHOLDER} is still there: sed -i "s|{PLACEHOLDER}|ADDRESS|" {" ".join(files)}'
    yield from state_of_git(root, f"v{version}")


def state_of_git(root, tag):
    def git(*arguments):
        return subprocess.run(["git", "-C", root, *arguments], capture_output=True, text=True).stdout.strip()

    if git("status", "--porcelain"):
        yield "there are changes that are not committed"
    if git("tag", "--list", tag):
        yield f"the tag {tag} exists: raise the version"


def main(root):
    lines = list(missing(root, dt.date.today()))
    print("\n".join(lines))
    return bool(lines)


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT))
