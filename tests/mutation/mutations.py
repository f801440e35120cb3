"""Mutations: small wrong changes of the solvers and statistics that the tests have to notice.

`python tests/mutation/mutations.py [--seed SEED] [--slow] [NUMBER ...]` draws sixty from the code as it stands.
The same seed and code give the same sixty. Each is applied in turn to a copy of the tree, whose tests run: those
about what is changed first, then all.
"""

import argparse
import ast
import copy
import os
import random
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[2]
PLACES = ("scene", "mdr1d", "bem3d", "compare/statistics")
KINDS = ("sign", "factor", "index", "boundary", "off by one", "dropped term")
SEED, EACH = 20261123, 10
SIGNS = {ast.Add: ast.Sub, ast.Sub: ast.Add}
FACTORS = {ast.Mult: ast.Div, ast.Div: ast.Mult}
BOUNDS = {ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt}

# Changes that no test can see, by their file, what stood there and what stands there then; and why.
EQUIVALENT = {
    ("bem3d/motion/marching.py", "1e-12", "(2e-12)"): "an overlap below rounding of the heights is none",
    (
        "bem3d/response/memory.py",
        "bound + 1",
        "(bound - 1)",
    ): "the nodes of the next band are exact to rounding at these columns too",
    ("bem3d/response/layer.py", "x + u", "(x - u)"): "the nodes lie evenly on both sides of the middle",
    (
        "bem3d/motion/marching.py",
        "wanted * grid.points * grid.rows <= KEPT",
        "(wanted * grid.points * grid.rows < KEPT)",
    ): "what is kept or evaluated again is the same number",
    ("scene/surfaces/profile.py", "1 - QUOTIENT", "(1)"): "the number is one of rounding",
    ("bem3d/response/convolution.py", "1 - 1e-9", "(1)"): "the number is one of rounding",
    (
        "mdr1d/ensemble.py",
        "farthest > MOST_NODES",
        "(farthest >= MOST_NODES)",
    ): "the number is a round one of order",
    ("mdr1d/element.py", "c > 0.0", "(c >= 0.0)"): "a profile that only meets the surface carries no force",
    (
        "compare/statistics/multilevel.py",
        "(high - low) / 2 + finding.grid <= wanted",
        "((high - low) / 2 + finding.grid < wanted)",
    ): "no interval is exactly as wide as wanted",
    (
        "scene/surfaces/measured.py",
        "np.hypot(along_y[:, None], along_x) * shortest > 1 + QUOTIENT",
        "(np.hypot(along_y[:, None], along_x) * shortest >= 1 + QUOTIENT)",
    ): "the number is one of rounding",
    ("mdr1d/steady.py", "u > 0.0", "(u >= 0.0)"): "at u = 0 both branches carry no displacement",
    (
        "mdr1d/kelvin.py",
        "t + step >= closest",
        "(t + step > closest)",
    ): "at the tie both branches return the same instant",
    ("bem3d/motion/upstream.py", "way > 0", "(way >= 0)"): "the loop around it runs only where the way is not 0",
    (
        "mdr1d/stepping.py",
        "solid.drag > 0.0",
        "(solid.drag >= 0.0)",
    ): "the bracket closes off the load only where a dashpot makes the force jump",
    (
        "mdr1d/ensemble.py",
        "2 * half[s] + 1",
        "(2 * half[s])",
    ): "the last node is a margin that no contact reaches",
    ("compare/statistics/commoncurve.py", "1e-12", "(2e-12)"): "singular values are of order one, or of rounding",
    (
        "bem3d/response/convolution.py",
        "kernels[0]",
        "(kernels[1])",
    ): "only the shape is read, and all kernels have one",
    ("mdr1d/element.py", "r[j] > 0.0", "(r[j] >= 0.0)"): "an element without a stretch relaxes without heat",
    (
        "bem3d/topography.py",
        "abs(along_x / along_y - 1) > SQUARE",
        "(abs(along_x / along_y - 1) >= SQUARE)",
    ): "the number is one of rounding",
    (
        "compare/studies/topography/spectra.py",
        "slope > STEEP",
        "(slope >= STEEP)",
    ): "the number is a round one of order",
    ("compare/statistics/eq23.py", "high < 0", "(high <= 0)"): "no interval ends at zero",
    ("mdr1d/element.py", "slope < 0.0", "(slope <= 0.0)"): "above a level profile the surface was left before",
    (
        "compare/studies/topography/powerlaw.py",
        "range(count)",
        "(range(count - 1))",
    ): "the last ring begins no band",
}


@dataclass(frozen=True)
class Mutation:
    """One wrong change: before, text : what stands at a line of a file, and what then stands there."""

    kind: str
    path: str
    line: int
    before: str
    text: str

    def applied(self, source: str) -> str:
        """The file with the change, at the place nearest to the line. Raises ValueError where `before` is gone."""
        places = [place for place in range(len(source)) if source.startswith(self.before, place)]
        if not places:
            raise ValueError(f"{self.path} has no {self.before!r} any more")
        start = min(places, key=lambda place: abs(source.count("\n", 0, place) + 1 - self.line))
        return source[:start] + self.text + source[start + len(self.before) :]


def changed(node):
    """Kinds of changes of an expression, and the expression after each."""
    if isinstance(node, ast.BinOp):
        if type(node.op) in SIGNS:
            yield "sign", ast.BinOp(node.left, SIGNS[type(node.op)](), node.right)
            if isinstance(node.right, ast.Constant) and node.right.value == 1:
                yield "off by one", node.left
            else:
                yield "dropped term", node.left
                yield "dropped term", node.right
        if type(node.op) in FACTORS:
            yield "factor", ast.BinOp(node.left, FACTORS[type(node.op)](), node.right)
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        yield "sign", node.operand
    elif isinstance(node, ast.Constant) and isinstance(node.value, float) and node.value:
        yield "factor", ast.Constant(2 * node.value)
    elif isinstance(node, ast.Compare) and len(node.ops) == 1 and type(node.ops[0]) in BOUNDS:
        yield "boundary", ast.Compare(node.left, [BOUNDS[type(node.ops[0])]()], node.comparators)
    elif isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "range":
        shorter = copy.deepcopy(node)
        place = 0 if len(node.args) == 1 else 1
        shorter.args[place] = ast.BinOp(shorter.args[place], ast.Sub(), ast.Constant(1))
        yield "off by one", shorter
    elif isinstance(node, ast.Subscript):
        other = copy.deepcopy(node)
        for part in ast.walk(other.slice):
            if isinstance(part, ast.Constant) and type(part.value) is int:
                part.value += 1
                yield "index", other
                return


def mutations(path):
    """Every change of a file, but for annotations, texts and messages."""
    source = path.read_text(encoding="utf-8")
    tree = ast.parse(source)
    skipped = set()
    for node in ast.walk(tree):
        dead = []
        if isinstance(node, ast.AnnAssign | ast.arg):
            dead = [node.annotation] if node.annotation else []
        elif isinstance(node, ast.FunctionDef):
            dead = [node.returns] if node.returns else []
        elif isinstance(node, ast.Raise | ast.JoinedStr | ast.Global):
            dead = [node]
        skipped |= {id(below) for each in dead for below in ast.walk(each)}
    for node in ast.walk(tree):
        if id(node) in skipped:
            continue
        if any(isinstance(below, ast.JoinedStr) for below in ast.walk(node)):
            continue
        for kind, after in changed(node):
            before = ast.get_source_segment(source, node)
            text = f"({ast.unparse(ast.fix_missing_locations(after))})"
            yield Mutation(kind, path.relative_to(ROOT).as_posix(), node.lineno, before, text)


def draw(seed, each=EACH):
    """Changes of each kind, `each` in number, the places in turn, no two of them on one line."""
    chance = random.Random(seed)
    every = [each for place in PLACES for path in sorted((ROOT / place).rglob("*.py")) for each in mutations(path)]
    chosen = []
    for kind in KINDS:
        for number in range(each):
            place = PLACES[number % len(PLACES)]
            lines = {(one.path, one.line) for one in chosen}
            fit = [
                one
                for one in every
                if one.kind == kind and one.path.startswith(f"{place}/") and (one.path, one.line) not in lines
            ]
            chosen.append(chance.choice(fit))
    return chosen


def near(mutation, root):
    """Test files about the place of a change, those with its name first."""
    package, word = mutation.path.partition("/")[0], Path(mutation.path).stem
    files = sorted((root / "tests").rglob("test_*.py"), key=lambda path: (word not in path.name, path.name))
    if package == "compare":
        return [str(path) for path in files if f".{word} import" in path.read_text() or word in path.name]
    return [str(path) for path in files if package in path.name]


def caught(mutation, root, slow):
    """Name of the first test that fails under a change in a copy of the tree; None if all pass."""
    place = root / mutation.path
    before = place.read_text(encoding="utf-8")
    place.write_text(mutation.applied(before), encoding="utf-8")
    try:
        # Loops that are compiled are shared by all changes, but for those of the changed package.
        environment = {**os.environ, "PYTHONPATH": str(root), "NUMBA_CACHE_DIR": str(root / "compiled")}
        marks, chosen = ["-m", "not hours"] if slow else [], near(mutation, root)
        for files in ([chosen] if chosen else []) + [[]]:
            command = [sys.executable, "-P", "-m", "pytest", "-x", "-q", "-p", "no:cacheprovider", *marks, *files]
            done = subprocess.run(command, cwd=root, env=environment, capture_output=True, text=True)
            if done.returncode:
                lines = [line for line in done.stdout.splitlines() if line.startswith(("FAILED", "ERROR"))]
                return lines[0] if lines else f"status {done.returncode}: {done.stdout[-300:]}{done.stderr[-300:]}"
        return None
    finally:
        place.write_text(before, encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("numbers", type=int, nargs="*", help="which of the sixty, from 0; all without any")
    parser.add_argument("--seed", type=int, default=SEED)
    parser.add_argument("--slow", action="store_true", help="with the tests that are marked slow")
    given = parser.parse_args()
    chosen = draw(given.seed)
    with tempfile.TemporaryDirectory() as name:
        left_out = shutil.ignore_patterns(".git", ".venv", "__pycache__", ".pytest_cache", "*.egg-info")
        root = Path(shutil.copytree(ROOT, Path(name) / "tree", ignore=left_out))
        for number in given.numbers or range(len(chosen)):
            one = chosen[number]
            print(f"{number:2d} {one.kind:12s} {one.path}:{one.line}: {one.before!r} -> {one.text!r}", flush=True)
            why = EQUIVALENT.get((one.path, one.before, one.text), "WHY?")
            print(f"   {caught(one, root, given.slow) or f'survives: {why}'}", flush=True)


if __name__ == "__main__":
    main()
