"""Looks at the built site: every link has a target, no page loads from another host, headers, the size.

python check.py build/site/html
"""

import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

LIMIT = 25_000_000  # bytes
# What a browser loads without a click.
LOADED = {("script", "src"), ("img", "src"), ("link", "href"), ("iframe", "src"), ("source", "srcset")}


class Page(HTMLParser):
    """The links of a page, what it loads, and its anchors."""

    def __init__(self, path):
        super().__init__()
        self.links, self.loaded, self.anchors, self.without_text = [], [], set(), []
        self.empty_headers, self._in_header = 0, None
        self.feed(path.read_text("utf-8"))

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        if tag == "th":
            self._in_header = ""
        if "id" in values:
            self.anchors.add(values["id"])
        if tag == "img" and "alt" not in values:
            self.without_text.append(values.get("src", ""))
        for name in ("href", "src", "srcset"):
            if values.get(name):
                self.links.append(values[name])
                if (tag, name) in LOADED and values.get("rel") not in ("canonical", "license"):
                    self.loaded.append(values[name])

    def handle_data(self, data):
        if self._in_header is not None:
            self._in_header += data.strip()

    def handle_endtag(self, tag):
        if tag == "th":
            self.empty_headers += not self._in_header
            self._in_header = None


def findings(folder):
    """One line for each fault of the site."""
    pages = {path: Page(path) for path in sorted(folder.rglob("*.html"))}
    for path, page in pages.items():
        place = path.relative_to(folder)
        for link in dict.fromkeys(page.links):
            url = urlsplit(link)
            if url.scheme or url.netloc:
                if link in page.loaded and url.scheme != "data":
                    yield f"{place} loads {link}"
                continue
            target = (path.parent / unquote(url.path)).resolve() if url.path else path
            if target.is_dir():
                target /= "index.html"
            if not target.exists():
                yield f"{place} links to {link}, which does not exist"
            elif url.fragment and target in pages and unquote(url.fragment) not in pages[target].anchors:
                yield f"{place} links to {link}, which has no such anchor"
        if page.empty_headers:
            yield f"{place} has an empty header of a table"
        yield from (f"{place} has an image without alt: {source[:80]}" for source in page.without_text)
    for path in folder.rglob("*.css"):
        for address in re.findall(r"url\(['\"]?(https?:[^)'\"]*)", path.read_text("utf-8")):
            yield f"{path.relative_to(folder)} loads {address}"
    if size_of(folder) > LIMIT:
        yield f"the site has {size_of(folder) / 1e6:.1f} MB, more than {LIMIT / 1e6:.0f}"


def size_of(folder):
    return sum(path.stat().st_size for path in folder.rglob("*") if path.is_file())


def main(folder):
    lines = list(findings(folder.resolve()))
    print("\n".join(lines))
    print(f"{len(list(folder.rglob('*.html')))} pages, {size_of(folder) / 1e6:.1f} MB, {len(lines)} findings")
    return 1 if lines else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
