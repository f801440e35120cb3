"""Comparisons as the commands ask for them: `crosscheck run`, `sweep` and `study`."""

from collections.abc import Sequence
from dataclasses import replace
from os.path import lexists
from pathlib import Path

from scene import Refused
from scene.files.reading import InvalidInput, text_of
from scene.printable import printable

from ...library.case import NotCompared, share_of
from ...library.lookup import SceneLike, SeveralScenes, located, named_cases
from ...library.ready import ready, studies
from ...models.table import ModelLike, listed
from ...solving.curve import refuse
from ...solving.folders import folders, slug
from ...solving.suggest import known
from .around import Around, for_interval
from .comparison import Comparison
from .study_file import SIZES, STUDIES, study_of
from .sweep import SweepSeries

ALL = "all"
ABOUT = (
    "The claims are those of Popov, Voll, Li, Chai and Popov, Sci. Rep. 4, 3750 (2014). Each is judged in one "
    "dimension and in three, on the same scenes. A claim holds if its whole interval of 95 % lies within the "
    "tolerance and fails if none of it does; otherwise, or where an error is unknown, it is undecided. The "
    "scatter is found by leaving out each surface in turn, at all points at once, and the interval is wider "
    "at both ends by the change on halving the grid."
)


def run(
    scene: SeveralScenes | None = None,
    models: Sequence[ModelLike] | None = None,
    reference: str | None = None,
    interval: float | str | None = None,
) -> Comparison:
    """Scenes with the curves around them: one, several files or by name, or the paper's two.

    Raises InvalidInput, Refused.
    """
    if isinstance(scene, Sequence) and not isinstance(scene, str) and len(scene) == 1:
        scene = scene[0]
    wanted = share_of("interval", interval)
    try:
        cases, chosen = named_cases(scene), listed(models)
        for case in cases.values():
            case.refuse()
        folders(cases, "case")
        cases = {name: for_interval(case, wanted or case.interval) for name, case in cases.items()}
        series = tuple(Around(name, case, chosen, reference, wanted) for name, case in cases.items())
        names = sorted({each.name for one in series for each in one.models})
        inputs = {
            "cases": {name: case.inputs for name, case in cases.items()},
            "interval": wanted,
            "models": names,
        }
        asked = Comparison(series, stated=inputs)
        asked.grids()
    except Refused as error:
        asked_for = scene if isinstance(scene, str | Path) else "scene"
        why = f"{asked_for}: {error}"
        if isinstance(error, NotCompared):
            raise NotCompared(f"{why}; crosscheck plan says what each solver makes of it") from error
        raise Refused(why) from error
    return asked


def sweep(scene: SceneLike, **given) -> Comparison:
    """Contacts of a scene at the stated speeds and loads or depths; given : see `SweepSeries.of`."""
    series = SweepSeries.of(scene, **given)
    wanted = {"draws": series.draws} if series.interval is None else {"interval": series.interval}
    inputs = {"speed": series.speeds, series.prescribed: series.values, **wanted}
    return Comparison((series,), "sweep", "A sweep in one and in three dimensions", stated=inputs)


def study(
    name: str | Path,
    size: str = "quick",
    models: Sequence[ModelLike] | None = None,
    reference: str | None = None,
    interval: float | str | None = None,
) -> Comparison:
    """The study of this name that comes with the package, all of them, or the study of a file.

    Raises InvalidInput, Refused.
    """
    known("size", size, SIZES)
    chosen, wanted = listed(models), share_of("interval", interval)
    source, title, about = None, "The laws of the paper in one and in three dimensions", ABOUT
    if name == ALL:
        asked = {f"{own}/": each for own, each in STUDIES.items()}
    else:
        if name not in STUDIES:
            path = _located(name)
            source, name = text_of(path), printable(path.stem)
        found = study_of(source, str(path)) if source is not None else STUDIES[str(name)]
        asked, title, about = {"": found}, found.title, found.about
    series = tuple(
        replace(
            each,
            name=f"{own}{each.name}",
            asked=chosen or each.asked,
            reference=reference or each.reference,
            interval=wanted or each.interval,
        )
        for own, found in asked.items()
        for each in found.series(size)
    )
    inputs = {"name": str(name), "size": size, "interval": wanted, "source": source}
    made = Comparison(series, "study", title, about, slug(f"{name}-{size}"), inputs)
    refuse(made.grids().values())
    return made


def _located(name: str | Path) -> Path:
    """File of a user's own study. Raises InvalidInput with the names that there are."""
    try:
        return located(name, "study")
    except InvalidInput as error:
        if not lexists(name) and str(name) not in ready():
            known("NAME", str(name), [*studies(), ALL], str(error))
        raise
