"""README.md for an index of packages: relative links lead to the repository, or are words where it has no address.

The address is `Repository` of `[project.urls]` in pyproject.toml.
"""

import re
import tomllib
from pathlib import Path

from setuptools import setup

LINK = re.compile(r"\[([^]]*)\]\((?!\w+:|#)([^)]+)\)")
PICTURE = re.compile(r"!\[[^]]*\]\([^)]+\)\s+(?:\*[^*]+\*\s+)?")  # with its caption


def readme(text: str, address: str) -> str:
    """Text whose relative links start at an address; without one links are words, and pictures are left out."""
    return LINK.sub(rf"[\1]({address}/\2)", text) if address else LINK.sub(r"\1", PICTURE.sub("", text))


if __name__ == "__main__":
    project = tomllib.loads(Path("pyproject.toml").read_text(encoding="utf-8"))["project"]
    text = readme(Path("README.md").read_text(encoding="utf-8"), project.get("urls", {}).get("Repository", ""))
    setup(long_description=text, long_description_content_type="text/markdown")
