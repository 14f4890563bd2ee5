"""Skips what this machine cannot run."""

import shutil

import pytest


def pytest_runtest_setup(item):
    if item.get_closest_marker("sandbox") and not shutil.which("bwrap"):
        pytest.skip("bubblewrap is missing: sudo apt-get install bubblewrap")
