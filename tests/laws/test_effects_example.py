"""The example of how to add an effect, run as it stands on its page, and held against what is known without it."""

import contextlib
import io
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from invented_answers import FEW, obeying
from maps import refused

from bem3d import BEM
from compare.studies.comparison.claims import CLAIMS
from compare.studies.comparison.measures import ROWS
from compare.studies.plan import planned
from scene import Kelvin, Layer, Refused, Slide, Sphere

PAGE = Path(__file__).parents[2] / "docs" / "howto" / "extending.md"


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    """Names of the page, all its code run from top to bottom, and what it printed. Its claim is left out after."""
    code = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    names, printed = {"__name__": "extending"}, io.StringIO()
    with contextlib.redirect_stdout(printed), contextlib.chdir(tmp_path_factory.mktemp("extending")):
        for block in code:
            exec(compile(block, str(PAGE), "exec"), names)
    coated = replace(names["bare"], coating=names["Coating"](1e-9))
    yield names | {"printed": printed.getvalue().splitlines(), "coated": coated}
    ROWS.remove(next(row for row in ROWS if row.id == "mine.fastest"))
    del CLAIMS["mine.fastest"]


def test_the_page_prints_what_it_says(page):
    stiff, soft, applications, left_out = page["printed"]
    assert float(stiff) == pytest.approx(1, rel=1e-6)
    # the elastomer yields by about a / (c E*) = 3.5e-3 of what the springs do, and the force goes as the square
    assert float(soft) == pytest.approx(1, rel=1e-2)
    assert float(soft) < 1
    assert max(map(float, applications.split())) < 60
    assert left_out == "nothing is built for it"


@pytest.mark.parametrize(("friction", "verdict"), [(0.4, "holds"), (0.6, "fails")])
def test_the_claim_of_the_page_is_judged_of_both_models(page, friction, verdict):
    findings = obeying(lambda load, speed: friction + 0 * load * speed, FEW).judge().findings
    found = {each.dimension: each.verdict for each in findings if each.claim.id == "mine.fastest"}
    assert found == {"1D": verdict, "3D": verdict}


def test_a_scene_without_the_part_is_answered_to_the_last_digit(page):
    scene = page["CoatedScene"](Sphere(10e-3), Kelvin(1e6, 1e-3), Slide(speed=0.1, load=1.0))
    with_line, without = (solver(points=32).solve(scene) for solver in (page["CoatedBEM"], BEM))
    assert np.array_equal(with_line.fields["pressure"], without.fields["pressure"])
    assert with_line.friction_force == without.friction_force


def test_who_has_no_line_refuses_by_name(page):
    for solver, change in (
        ("CoatedMDR", {}),
        ("CoatedBEM", {"motion": Slide(speed=0.1, load=1.0)}),
        ("CoatedBEM", {"layer": Layer(thickness=1e-3)}),
    ):
        refused("coating = Coating", page[solver]().solve, replace(page["coated"], **change), error=Refused)


def test_a_plan_has_the_part_where_it_is(page):
    plan = page["CoatedBEM"]().plan(page["coated"])
    assert plan.terms["coating"] == "Coating(compliance=1e-09)"
    assert "coating" not in plan.left_out
    assert plan.operator_applications.value is None
    assert "what Coating takes was not measured" in plan.operator_applications.why
    assert "springs on a half-space are no foundation" in planned(page["CoatedMDR"](), page["coated"])
