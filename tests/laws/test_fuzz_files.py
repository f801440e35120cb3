"""Files spoilt at random: what is read is what it should be, or is refused in words that a terminal can show.

Up to a thousand files of each kind, see `damage`. A hang is a failure too, and so is memory beyond all measure.
"""

import tomllib
import warnings
from importlib.resources import files
from io import BytesIO

import numpy as np
import pytest
from damage import TRIES, as_toml, bounded, fuzz, spoilt, trees, unshowable
from hypothesis import strategies as st

import compare
from compare.library.lookup import case_of, named_cases
from compare.studies.comparison import asked
from compare.studies.mastercurve.study import Mastercurve
from compare.studies.plan import planned
from compare.studies.topography.study import Map
from scene import Doubtful, Refused, SolveError
from scene.files.reading import InvalidInput

pytestmark = pytest.mark.slow
SCENES = [
    path.read_bytes()
    for path in sorted((files("compare.library") / "scenes").iterdir(), key=str)
    if path.is_file()
]
STUDIES = [path.read_bytes() for path in sorted((files("compare.library") / "studies").iterdir(), key=str)]


def reading(read, path, *documented):
    """What comes of a file, None where it is refused as documented: InvalidInput names it, others need not."""
    with bounded():
        try:
            return read(path)
        except (InvalidInput, *documented) as error:
            refused = error
    wrong = unshowable(str(refused), path if isinstance(refused, InvalidInput) else "")
    assert not wrong, f"{wrong}: {str(refused)[:2000]!r}"
    return None


@pytest.fixture(scope="module")
def spoil(tmp_path_factory):
    """Writes a spoilt file of a name."""
    folder = tmp_path_factory.mktemp("spoilt")

    def written(name, content):
        (folder / name).write_bytes(content)
        return folder / name

    return written


@pytest.fixture(autouse=True)
def _beside_nothing(tmp_path, monkeypatch):
    """Relative paths in a spoilt file lead to an empty folder."""
    monkeypatch.chdir(tmp_path)


def _parsed(contents):
    return [tomllib.loads(content.decode()) for content in contents]


def either(contents):
    """Of files in TOML: trees that are changed, and bytes."""
    return trees(_parsed(contents)).map(as_toml) | spoilt(contents)


def read_and_plan(path, with_trust):
    """A scene as it is compared; once it can be read, what each solver would do, or also what 1D is worth."""
    case = case_of(path)
    if with_trust:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", Doubtful)  # random heights have slopes that differ along x and y
            compare.plan(case)
    else:
        for solver in (case.mdr, case.bem):
            planned(solver, case.scene)
    case.refuse()
    return case


seldom = st.integers(0, 9).map(lambda one: one == 9)  # trust solves the smooth contact


@pytest.mark.parametrize("spoiling", ["trees", "bytes"])
def test_a_scene_is_read_and_planned_or_refused(spoil, spoiling):
    strategy = trees(_parsed(SCENES)).map(as_toml) if spoiling == "trees" else spoilt(SCENES)

    def law(content, with_trust):
        reading(lambda path: read_and_plan(path, with_trust), spoil("scene.toml", content), Refused, SolveError)

    fuzz(law, strategy, seldom, tries=TRIES // 2)


def test_a_study_is_read_or_refused(spoil):
    law = lambda content: reading(asked.study, spoil("study.toml", content), Refused, SolveError)  # noqa: E731
    fuzz(law, either(STUDIES), tries=TRIES // 2)


OMEGA = np.geomspace(0.1, 1e4, 12)
MODULI = 1e6 + 9e6 * (1j * OMEGA / 100) / (1 + 1j * OMEGA / 100)
LOSS = "frequency, storage, loss\n" + "".join(
    f"{omega:.6g}, {each.real:.6g}, {each.imag:.6g}\n" for omega, each in zip(OMEGA, MODULI, strict=True)
)
FRICTION = "mu,F_N,v\n" + "".join(
    f"{(1 + load / speed) ** -0.6:.6g},{load:g},{speed:g}\n"
    for speed in (0.01, 0.1, 1.0)
    for load in (1, 3, 10, 30)
)
TABULATED = """
indenter = {{type = "sphere", radius = "10 mm"}}
elastomer = {{type = "tabulated", table = "{}", frequency_unit = "Hz", kind = "shear"}}
motion = {{type = "slide", speed = "0.1 m/s", load = "1 N"}}
"""


def test_a_table_of_moduli_is_read_or_refused(spoil):
    def law(content):
        table = spoil("loss.csv", content)
        reading(named_cases, spoil("tabulated.toml", TABULATED.format(table).encode()), Refused)

    fuzz(law, spoilt([LOSS.encode()]), tries=TRIES // 3)


def test_a_table_of_friction_is_read_or_refused(spoil):
    fuzz(
        lambda content: reading(Mastercurve.of, spoil("friction.csv", content)),
        spoilt([FRICTION.encode()]),
        tries=TRIES // 3,
    )


def _bytes(write, *given, **named):
    file = BytesIO()
    write(file, *given, **named)
    return file.getvalue()


HEIGHTS = 1e-6 * np.random.default_rng(1).standard_normal((8, 6))
MAPS = {
    "npy": [_bytes(np.save, each) for each in (HEIGHTS, HEIGHTS.astype("f4"), np.arange(64).reshape(8, 8))],
    "npz": [
        _bytes(np.savez, heights=HEIGHTS),
        _bytes(np.savez_compressed, heights=HEIGHTS),
    ],
    "csv": [_bytes(np.savetxt, HEIGHTS, delimiter=";"), _bytes(np.savetxt, HEIGHTS[:5, :5])],
}  # fmt: skip
MAPPED = """
indenter = {{type = "sphere", radius = "10 mm"}}
elastomer = {{type = "kelvin", modulus = "1 MPa", relaxation_time = "1 ms"}}
motion = {{type = "slide", speed = "0.1 m/s", load = "1 N"}}
roughness = {{type = "topography", file = "{}", unit = "m", pixel = "10 um"}}
"""


@pytest.mark.parametrize("kind", MAPS)
def test_a_map_of_heights_is_read_or_refused(spoil, kind):
    def law(content, in_scene, with_trust):
        path = spoil(f"map.{kind}", content)
        if in_scene:
            reading(
                lambda path: read_and_plan(path, with_trust),
                spoil("mapped.toml", MAPPED.format(path).encode()),
                Refused,
                SolveError,
            )
        else:
            reading(lambda path: Map.of(path, pixel=1e-5, unit="m"), path)

    fuzz(law, spoilt(MAPS[kind]), st.booleans(), seldom, tries=TRIES // len(MAPS))
