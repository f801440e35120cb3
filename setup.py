"""README.md for an index of packages: relative links lead to the repository, or are words where it has no address.

The address is `Repository` of `[project.urls]` in pyproject.toml.
"""

import re
import tomllib
from pathlib import Path

from setuptools import setup

LINK = re.compile(r"(!?)\[([^]]*)\]\((?!\w+:|#)([^)]+)\)")


def readme(text: str, address: str) -> str:
    """Text whose relative links start at an address; pictures without one are left out, other links are words."""
    return LINK.sub(rf"\1[\2]({address}/\3)" if address else lambda link: "" if link[1] else link[2], text)


if __name__ == "__main__":
    project = tomllib.loads(Path("pyproject.toml").read_text(encoding="utf-8"))["project"]
    text = readme(Path("README.md").read_text(encoding="utf-8"), project.get("urls", {}).get("Repository", ""))
    setup(long_description=text, long_description_content_type="text/markdown")
