"""What is asked of a command, as a job: whatever is wrong with it is said before anything is solved."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from scene import Refused
from scene.reading import InvalidInput, text_of

from ..asked import Asked, located, named_cases
from ..library import ready
from ..suggest import known
from .job import Job


def cases(scene: Asked | Mapping[str, Asked] | None = None) -> Job:
    """The job of crosscheck. Raises InvalidInput, Refused."""
    from .cases import Cases

    try:
        return Cases(named_cases(scene))
    except Refused as error:
        if not isinstance(scene, str | Path):
            raise
        alone = "crosscheck plan says what each solver makes of it, and crosscheck animate shows motion in time"
        raise Refused(f"{error}. So {scene} cannot be compared; {alone}") from error


def study(study: Any, size: str) -> Job:
    """The job of conduct: of a name that comes with the package, else of a file. Raises InvalidInput."""
    from ..studies.catalogue import SIZES, STUDIES
    from .studies import Conducted

    known("size", size, SIZES)
    if study in STUDIES:
        return Conducted(study, STUDIES[study], size)
    try:
        path = located(study, "study")
    except InvalidInput as error:
        offered = ready()
        if not Path(study).exists() and str(study) not in offered:
            own = [name for name, each in offered.items() if each.kind == "study"]
            known("NAME", str(study), [*STUDIES, *own], str(error))
        raise
    return Conducted.stated(path.stem, text_of(path), size, str(path))


def paper(profiles: int) -> Job:
    """The job of reproduce. Raises InvalidInput."""
    from .paper import Paper

    if profiles < 3:
        raise InvalidInput(f"profiles = {profiles}: at least 3, as they are left out one at a time")
    return Paper(profiles)


def costs(names: Sequence[str], size: str) -> Job:
    """The job of weigh. Raises InvalidInput."""
    from ..workprecision.catalogue import INQUIRIES
    from ..workprecision.diagram import SIZES
    from .costs import Costs

    known("size", size, SIZES)
    for name in names:
        known("NAME", name, [*INQUIRIES, "all"])
    return Costs(tuple(INQUIRIES) if not names or "all" in names else tuple(names), size)


def hardcases(size: str) -> Job:
    """The job of examine. Raises InvalidInput."""
    from ..stability.hardcase import SIZES
    from .hardcases import HardCases

    known("size", size, SIZES)
    return HardCases(size)


def baseline(
    baseline: str | Path | None = None, quantities: Sequence[Any] | None = None, beginning: bool = False
) -> Job:
    """The job of regress. Raises InvalidInput.

    beginning : whether a file that is not there yet counts as empty
    """
    from ..accuracy import shipped
    from ..regression import SHIPPED, read_baseline, read_or_begin
    from .baseline import Baseline

    path = Path(baseline or SHIPPED)
    measured = tuple(shipped() if quantities is None else quantities)
    return Baseline(path, (read_or_begin if beginning else read_baseline)(path, measured), measured)
