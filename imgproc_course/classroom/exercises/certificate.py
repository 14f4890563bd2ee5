"""A certificate: a page with what a learner has passed, for the browser to print."""

import datetime as dt
from pathlib import Path

from ..course import TITLE
from .overview import overview

CERTIFICATE = "certificate.html"


class Certificate:
    """The page that was written; a notebook shows a link to it."""

    def __init__(self, path):
        self.path = path

    def __repr__(self):
        return f"{self.path.name} is written; open it in a browser, and print it there (Ctrl+P)"

    def _repr_html_(self):
        link = f'<a href="{self.path.name}" target="_blank">{self.path.name}</a>'
        return f"Written: {link}. Open it in the browser, and print it there (<b>Ctrl+P</b>)."


def certificate(name, folder=None):
    """Writes certificate.html beside the lessons: lessons with exercises that passed, points and date.

    Parameters
    ----------
    name : str, the learner's name as the page shows it
    folder : Path or str, with lessons and progress; if omitted, as in `overview`

    Returns
    -------
    Certificate, which a notebook shows as a link. ValueError: no name, no lessons, or nothing has passed
    """
    if not isinstance(name, str) or not name.strip():
        raise ValueError(f'name is {name!r}, expected your name as a text: certificate("Ada Lovelace")')
    lessons = [lesson for lesson in overview(folder).lessons if lesson.passed]
    if not lessons:
        raise ValueError("nothing has passed yet; run the checks of a lesson, then call certificate again")
    path = Path(folder or Path.cwd()) / CERTIFICATE
    path.write_text(_page(name.strip(), lessons), encoding="utf-8")
    return Certificate(path)


def _page(name, lessons):
    import jinja2  # only here: an import of 50 ms that no other cell needs

    template = Path(__file__).with_name(CERTIFICATE).read_text(encoding="utf-8")
    environment = jinja2.Environment(autoescape=True, undefined=jinja2.StrictUndefined)
    date = f"{dt.date.today():%d %B %Y}"
    return environment.from_string(template).render(title=TITLE, name=name, lessons=lessons, date=date)
