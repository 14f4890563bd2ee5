"""The site from its files, in a browser: for everybody, in both themes, on a phone, without a network."""

import sys
from pathlib import Path
from urllib.parse import unquote, urlsplit

import pytest
from jupyter_page import ROOT, SCREENSHOTS

sys.path.append(str(ROOT / "tests"))
from accessibility import COLOR_RULES
from axe_playwright_python.sync_playwright import Axe
from built_site import built_site

pytestmark = pytest.mark.browser

PAGES = (
    "index.html",
    "learn/index.html",
    "lessons/06_noise_removal.html",
    "lessons/11_drive_the_robot.html",
    "reference/imaging.html",
    "about/measured.html",
    "search.html",
    "404.html",
)
# The tags of boxes that are narrower than what they hold, and whether they scroll.
SCROLLED_BY = """() => {
    const boxes = [...document.querySelectorAll("article pre, article div.table-wrapper")];
    const narrow = boxes.filter(box => box.scrollWidth > box.clientWidth);
    const moves = box => { box.scrollLeft = 20; return box.scrollLeft > 0; };
    const result = {};
    for (const box of narrow) {
        const tag = box.localName;
        result[tag] = (result[tag] ?? true) && moves(box);
    }
    return result;
}"""
# The elements that end outside the window, and that no box of their own scrolls.
WIDER_THAN_THE_WINDOW = """() => [...document.querySelectorAll("article *")].filter(element => {
    const box = element.parentElement.closest("pre, .table-wrapper, .cell_output, div.math");
    return !box && element.getBoundingClientRect().right > document.documentElement.clientWidth + 1;
}).map(element => element.outerHTML.slice(0, 100))"""
# Loads every image, also those far below, and returns the addresses of those that cannot be shown.
BROKEN_IMAGES = """async () => {
    const images = [...document.images];
    for (const image of images) image.loading = "eager";
    const shown = await Promise.all(images.map(image => image.decode().then(() => true, () => false)));
    return images.filter((_, number) => !shown[number]).map(image => image.src);
}"""


@pytest.fixture(scope="module")
def site(browser, tmp_path_factory):
    """A function that opens a page of the site, and what the pages asked for and complained about."""
    _, pages = built_site(tmp_path_factory)
    contexts, asked = [], []

    def open_page(name, *, width=1280, theme="light"):
        context = browser.new_context(viewport={"width": width, "height": 900}, color_scheme=theme)
        contexts.append(context)
        page = context.new_page()
        page.on("request", lambda request: asked.append(request.url))
        page.on("pageerror", lambda error: asked.append(f"error: {error}"))
        page.goto(f"file://{pages}/{name}")
        return page

    yield open_page, asked
    for context in contexts:
        context.close()


@pytest.mark.parametrize(("width", "theme"), [(390, "light"), (1280, "light"), (1280, "dark")])
@pytest.mark.parametrize("name", PAGES)
def test_everybody_can_use_a_page(site, name, width, theme):
    page = site[0](name, width=width, theme=theme)
    page.evaluate("document.querySelectorAll('details').forEach(each => each.open = true)")
    # What opens fades in: until then its text is pale.
    page.evaluate("Promise.all(document.getAnimations().map(animation => animation.finished))")
    rules = {"runOnly": COLOR_RULES} if theme == "dark" else {}  # a theme changes nothing else
    found = Axe().run(page, options={"resultTypes": ["violations"]} | rules).response["violations"]
    SCREENSHOTS.mkdir(exist_ok=True)
    file = f"site_{name.partition('.')[0].replace('/', '_')}_{width}_{theme}.png"
    page.screenshot(path=SCREENSHOTS / file)
    assert [f"{each['id']}: {node['html'][:200]}" for each in found for node in each["nodes"]] == []
    assert page.evaluate("document.documentElement.scrollWidth") <= width


def test_every_image_is_shown_and_no_page_asks_another_host_or_fails(site):
    open_page, asked = site
    for name in PAGES:
        assert open_page(name).evaluate(BROKEN_IMAGES) == [], name
    assert len(asked) > 20
    assert [line for line in asked if not line.startswith(("file:", "data:"))] == []


def test_the_search_works_from_files_and_ranks_lessons_first(site):
    page = site[0]("search.html?q=hysteresis")
    page.get_by_role("link", name="The stages of Canny").first.wait_for()
    page = site[0]("search.html?q=grayscale")
    results = page.locator("#search-results li a")
    page.locator("#search-results li a[href^='teach/']").first.wait_for()  # the last ones to be listed
    addresses = [link.get_attribute("href") for link in results.all()]
    of_teachers = [number for number, address in enumerate(addresses) if address.startswith("teach/")]
    assert addresses[0].startswith("lessons/") and of_teachers[0] > 3, addresses


@pytest.mark.parametrize(
    ("word", "found"),
    [
        *((word, "learn/start.html") for word in ("install", "mac", "macOS", "Windows", "Docker")),
        ("tf", "robot/index.html"),
    ],
)
def test_the_search_finds_the_set_up_and_tf_among_the_first(site, word, found):
    page = site[0](f"search.html?q={word}")
    page.locator(f"#search-results li:nth-child(-n+3) a[href^='{found}']").wait_for()


@pytest.mark.parametrize(("width", "height"), [(390, 600), (768, 900), (1280, 650)])
def test_the_first_page_shows_where_to_begin(site, width, height):
    button = site[0]("index.html", width=width).get_by_role("link", name="Begin", exact=True)
    box = button.bounding_box()
    assert box["height"] >= 24 and box["y"] + box["height"] <= height
    button.click()
    assert button.page.url.endswith("learn/start.html")


def test_the_first_page_loads_at_most_a_megabyte(site):
    open_page, asked = site
    before = len(asked)
    page = open_page("index.html")
    assert page.evaluate(BROKEN_IMAGES) == []
    files = {Path(unquote(urlsplit(address).path)) for address in asked[before:]}
    assert len(files) > 10 and sum(path.stat().st_size for path in files) <= 1_000_000


@pytest.mark.parametrize("name", ["lessons/17_recognising_objects.html", "about/measured.html"])
def test_on_paper_nothing_is_cut_off(site, name):
    page = site[0](name, width=700)
    assert page.evaluate(SCROLLED_BY) != {}
    page.emulate_media(media="print")
    assert page.evaluate(SCROLLED_BY) == {}


def test_on_paper_results_are_open_and_the_skip_link_is_left_out(site):
    page = site[0]("lessons/06_noise_removal.html")
    closed = page.locator("details:not([open])")
    count = closed.count()
    page.evaluate("addEventListener('beforeprint', () => { window.printed = document.body.innerText; })")
    page.pdf()
    assert "One wrong pixel became three" in page.evaluate("window.printed")
    assert closed.count() == count > 10  # as before
    page.emulate_media(media="print")
    assert not page.locator(".skip-to-content").is_visible()


@pytest.mark.parametrize(("name", "tag"), [("lessons/04_grayscale.html", "pre"), ("teach/plans.html", "div")])
def test_on_a_phone_code_and_tables_scroll_inside_their_box(site, name, tag):
    page = site[0](name, width=390)
    scrolled = page.evaluate(SCROLLED_BY)
    assert tag in scrolled and all(scrolled.values()), scrolled
    assert page.evaluate(WIDER_THAN_THE_WINDOW) == []


def test_a_result_opens_with_one_click(site):
    page = site[0]("lessons/06_noise_removal.html")
    sentence = page.get_by_text("One wrong pixel became three")
    assert not sentence.is_visible()
    page.locator("details.course-reveal", has=sentence).locator("summary").first.click()
    sentence.wait_for()
