"""Numbered equations: `$$ ... \\tag{5a} $$` of the theory is a target, and "(5a)" in its text links to it.

"theory, Eq. 5a" links to it from every other page. Where the pages are read as they are, both remain plain text.
"""

import re
from pathlib import Path

PAGE = "explanation/theory"
TAG = re.compile(r"\\tag\{(\w+)\}")
# Formulas, code and links, in which nothing is linked; the first are numbered.
VERBATIM = re.compile(r"(\$\$.*?\$\$|^```.*?^```|`[^`]*`|\$[^$]*\$|\[[^]]*\]\([^)]*\))", re.DOTALL | re.MULTILINE)
HERE, ELSEWHERE = re.compile(r"\((\d+[a-z]?)\)"), re.compile(r"theory, Eqs?\. (\d+[a-z]?)")


def link(app, page, source):
    """Give every numbered equation of the theory its target, and link its number in the text of any page."""
    known = set(TAG.findall(Path(app.srcdir, f"{PAGE}.md").read_text(encoding="utf-8")))
    target = "#eq-{}" if page == PAGE else f"project:/{PAGE}.md#eq-{{}}"

    def linked(match):
        return f"[{match[0]}](<{target.format(match[1])}>)" if match[1] in known else match[0]

    parts = VERBATIM.split(source[0])
    parts[::2] = [(HERE if page == PAGE else ELSEWHERE).sub(linked, part) for part in parts[::2]]
    if page == PAGE:
        named = ["".join(f"(eq-{number})=\n" for number in TAG.findall(part)) for part in parts]
        parts = [name + part for name, part in zip(named, parts, strict=True)]
    source[0] = "".join(parts)


def setup(app):
    app.connect("source-read", link)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
