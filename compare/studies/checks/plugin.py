"""Plugin for pytest: the fixture `mdr_accuracy`. Nothing of the package is imported before it is used."""

import os
import re

import pytest


def pytest_addoption(parser):
    """Option --mdr-regen."""
    about = "Store numbers of mdr_accuracy.regression that moved, and fail: look at the files, and run again."
    parser.getgroup("crosscheck").addoption("--mdr-regen", action="store_true", help=about)


@pytest.fixture
def mdr_accuracy(request, tmp_path_factory):
    """Accuracy of 1D on a scene: `check` against 3D, and `regression` against a file next to the test."""
    from .accuracy import MDRAccuracy

    cache = getattr(request.config, "cache", None)  # absent with -p no:cacheprovider
    folder = cache.mkdir("crosscheck") if cache else tmp_path_factory.getbasetemp() / "crosscheck"
    test = re.sub(r"[^\w.-]+", "-", request.node.name).strip("-")
    return MDRAccuracy(
        folder=folder / os.environ.get("PYTEST_XDIST_WORKER", "main"),
        file=request.path.with_suffix("") / f"{test}.toml",
        test_folder=request.path.parent,
        rewrite=request.config.getoption("--mdr-regen"),
    )
