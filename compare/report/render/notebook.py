"""A page as a part of a notebook: its answer, findings and tables; figures are shown by `Report.figures`."""

from html import escape
from pathlib import Path

from ..page import Page
from . import html


def fragment(page: Page, path: Path | None = None) -> str:
    """The page; path : of its file, named at the end."""
    where = f"<p>Page: <code>{escape(str(path.resolve()))}</code></p>" if path else ""
    return html.fragment(page) + where
