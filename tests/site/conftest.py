"""The site, built once, without a network."""

import sys
from pathlib import Path

import pytest
from built_site import built_site

sys.path.append(str(Path(__file__).parents[2] / "docs/_ext"))


@pytest.fixture(scope="package")
def built(tmp_path_factory):
    """(what the build printed, the folder of the pages)."""
    return built_site(tmp_path_factory)
