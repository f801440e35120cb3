"""What files of the packages import, by their source."""

import ast
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[1]
PACKAGES = ("scene", "mdr1d", "bem3d", "compare")
FILES = sorted(path for package in PACKAGES for path in (ROOT / package).rglob("*.py"))


@cache
def parsed(path):
    """Every node of a file, and those that are there for types alone."""
    nodes = list(ast.walk(ast.parse(path.read_text(encoding="utf-8"))))
    tests = [each for each in nodes if isinstance(each, ast.If) and isinstance(each.test, ast.Name)]
    guards = [each for each in tests if each.test.id == "TYPE_CHECKING"]
    return nodes, {id(below) for guard in guards for each in guard.body for below in ast.walk(each)}


@cache
def imported(path, types=True, root=ROOT):
    """Absolute names of what a file imports anywhere in it. types : those of annotations alone included"""
    nodes, for_types = parsed(path)
    names = set()
    for node in nodes:
        if id(node) in for_types and not types:
            continue
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            parts = path.relative_to(root).with_suffix("").parts
            base = ".".join(parts[: len(parts) - node.level]) if node.level else ""
            name = ".".join(filter(None, (base, node.module)))
            names |= {below if is_module(below := f"{name}.{alias.name}") else name for alias in node.names}
    return names


@cache
def is_module(name):
    place = ROOT.joinpath(*name.split("."))
    return place.with_suffix(".py").exists() or (place / "__init__.py").exists()


@cache
def used(path):
    """Files of ours that a file imports when it runs."""
    names = imported(path, types=False)
    return {each for each in FILES if module(each) in names} - {path, ROOT / "compare" / "__init__.py"}


def module(path):
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" and len(parts) > 2 else parts)
