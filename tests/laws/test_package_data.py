"""What is installed: every file that a package reads is one of those that go into the wheel."""

import tomllib
from fnmatch import fnmatch
from pathlib import Path

import pytest

from compare.solving.digest import shipped

ROOT = Path(__file__).parents[2]
SETUP = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["setuptools"]
PACKAGES = ("scene", "mdr1d", "bem3d", "compare")


def installed(path):
    """Whether a file is data of the innermost package that it lies in, and that package is found."""
    folder = next(each for each in path.parents if (each / "__init__.py").exists())
    package = ".".join(folder.relative_to(ROOT).parts)
    data = SETUP["package-data"]
    patterns = [*data["*"], *data.get(package, ())]
    found = any(fnmatch(package, pattern) for pattern in SETUP["packages"]["find"]["include"])
    name = path.relative_to(folder)
    return found and any(name.match(each) and len(name.parts) == len(Path(each).parts) for each in patterns)


@pytest.mark.parametrize("package", PACKAGES)
def test_every_file_that_is_no_code_is_installed(package):
    """So a checkout has the digest of its wheel."""
    data = [each for each in shipped(ROOT / package).values() if each.suffix != ".py"]
    assert ROOT / package / "py.typed" in data
    assert [each for each in data if not installed(each)] == []


@pytest.mark.parametrize("name", ["compare/library/scenes/a.png", "scene/notes.md", "compare/library/a/b.toml"])
def test_a_file_of_another_kind_or_folder_is_not(name):
    assert not installed(ROOT / name)
