"""What axe-core finds on a page: texts without contrast, controls without a name, images without a text."""

from axe_playwright_python.sync_playwright import Axe

COLOR_RULES = ["color-contrast", "link-in-text-block"]
SEVERE = ("serious", "critical")
JUPYTERLABS_OWN = ".jp-InternalAnchorLink"  # the ¶ of a heading, which appears below the mouse


def violations(page, selector="body", *, only_colors=False, impacts=SEVERE):
    """One line for each element of a Playwright page, below `selector`, that some learners cannot use.

    only_colors: of a page that has been looked at, and has other colors now; impacts: None for every finding.
    """
    # JupyterLab's body is 0 pixels high and hides what overflows, though its children cover the window. For
    # axe-core 4.12 all text in it is then hidden. Can go when test_gray_text_is_found passes without it.
    # Not a style element: the security policy of a learner's page refuses it.
    page.evaluate("document.body.style.minHeight = '100vh'")
    results = Axe().run(
        page,
        context={"include": [[selector]], "exclude": [[JUPYTERLABS_OWN]]},
        options={"resultTypes": ["violations"]} | ({"runOnly": COLOR_RULES} if only_colors else {}),
    )
    return [
        f"{violation['id']}: {node['html'][:200]}"
        for violation in results.response["violations"]
        if impacts is None or violation["impact"] in impacts
        for node in violation["nodes"]
    ]
