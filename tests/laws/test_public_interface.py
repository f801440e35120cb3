"""What a person meets in Python: signatures that can be read, paths as text, errors where they are caught."""

import builtins
import inspect
import re
import sys
from pathlib import Path

import pytest

import bem3d
import compare
import mdr1d
import scene
from scene.signatures import readable

# Letters of the longest signature, of `compare.topography`, which has an argument for each option.
LONGEST = 580
RAISED = re.compile(r"\b(?:[Rr]aises|[Ww]arns)((?:,? (?:or |and |its )?[A-Z]\w+)+)")


def members():
    """Public functions, classes and their public methods, by name."""
    for package in (scene, mdr1d, bem3d, compare):
        for name in package.__all__:
            owner = getattr(package, name)
            if inspect.isfunction(owner) or inspect.isclass(owner):
                yield f"{package.__name__}.{name}", owner
            for below, method in inspect.getmembers(owner if inspect.isclass(owner) else None, inspect.isroutine):
                home = getattr(method, "__module__", None) or ""
                ours = callable(method) and home.startswith(package.__name__)
                if ours and not below.startswith("_"):
                    yield f"{package.__name__}.{name}.{below}", method


MEMBERS = dict(members())
ERRORS = {name for name, each in MEMBERS.items() if inspect.isclass(each) and issubclass(each, Exception)}
SIGNED = {name: each for name, each in MEMBERS.items() if name not in ERRORS}


def test_every_signature_can_be_read():
    signatures = {name: str(inspect.signature(each)) for name, each in SIGNED.items()}
    assert len(signatures) > 50
    assert {name: each for name, each in signatures.items() if len(each) > LONGEST or "Validator" in each} == {}


def test_a_signature_says_what_the_source_says():
    assert str(inspect.signature(scene.Sphere)) == "(radius: Length, type: Literal['sphere'] = 'sphere') -> None"
    assert "roughness: Roughness | None = None" in str(inspect.signature(scene.Scene))
    assert "bem: BEM = BEM(...)" in str(inspect.signature(compare.Case))

    def given(path: Path, most: int = 3) -> list[Path]: ...

    assert str(inspect.signature(readable(given))) == "(path: Path, most: int = 3) -> list[Path]"


def takes_paths_alone(function):
    """Names of parameters of a function that are paths and no text."""
    parameters = inspect.signature(function).parameters.values()
    return [
        each.name
        for each in parameters
        if re.search(r"\bPath\b", str(each.annotation)) and not re.search(r"\bstr\b", str(each.annotation))
    ]


def test_a_path_may_be_text():
    functions = {name: each for name, each in MEMBERS.items() if not inspect.isclass(each)}
    assert {name: found for name, each in functions.items() if (found := takes_paths_alone(each))} == {}


def raised(docstring):
    """Names of the errors and warnings that a docstring says."""
    found = RAISED.findall(" ".join((docstring or "").split()))
    return {name for names in found for name in re.findall(r"[A-Z]\w+", names)}


def test_names_of_errors_are_read_from_docstrings():
    assert raised("Raises Refused before,\n    SolveError after. Warns Doubtful and KeyError.") == {
        "Refused",
        "Doubtful",
        "KeyError",
    }


def test_whatever_is_raised_can_be_caught_by_a_name_of_the_package():
    named = {name: raised(inspect.getdoc(each)) for name, each in MEMBERS.items()}
    assert any(named.values())
    places = {name: (builtins, scene, sys.modules[name.partition(".")[0]]) for name in named}
    unnamed = {
        name: error
        for name, errors in named.items()
        for error in errors
        if not any(hasattr(place, error) for place in places[name])
    }
    assert unnamed == {}


@pytest.mark.parametrize("error", ["InvalidInput", "Refused", "SolveError", "OutOfMemory", "Doubtful"])
def test_the_judge_raises_the_errors_of_a_scene(error):
    assert getattr(compare, error) is getattr(scene, error)
