"""The file of results: what is written comes back, and anything else is refused before HDF5 sees it."""

from math import inf, nan

import numpy as np
import pytest
import xarray

from compare.solving import netcdf
from scene.files.reading import InvalidInput

WORDS = np.array([f"{'é' * (k % 5)}{k} µm " for k in range(600)])
OF_ALL_KINDS = xarray.Dataset(
    {
        "holds": (("x", "nameless"), np.eye(2, 3, dtype=bool), {"long_name": "a truth"}),
        "long": ("nameless_too", np.linspace(0, 1, 1000), {"units": "m"}),
        "single": ("x", np.array([nan, inf], "f4")),
        "large": ("x", np.array([1, 2**64 - 1], "u8")),
        "time": ("x", [1.0, 2.0], {"units": "s"}),
        "whole": ((), 3),
        "name": ((), "µm"),
        "reason": ("x", ["", "none at all "]),
        "empty": ("x", ["", ""]),
        "words": ("nameless_three", WORDS),
        "none": ("nothing", np.zeros(0)),
    },
    {"x": [1.0, 2.0], "kind": ("x", ["a", "b"]), "another": ("nameless", [1, 2, 3]), "y": ["ä", "bb"]},
    {"solver": "BEM", "comment": "", "größe": "é", "count": 3, "low": 0.1},
)


def test_results_come_back_as_they_were_and_xarray_opens_them(tmp_path):
    one = OF_ALL_KINDS.isel(x=[1], drop=True)
    tree = xarray.DataTree.from_dict(
        {"/": xarray.Dataset(attrs={"title": "all"}), "/a": OF_ALL_KINDS, "/b/c": one}
    )
    file = netcdf.packed(tree)
    assert netcdf.packed(tree) == file
    (tmp_path / netcdf.NAME).write_bytes(file)
    again = netcdf.load(tmp_path)
    with xarray.open_datatree(tmp_path / netcdf.NAME, engine="h5netcdf") as opened:
        xarray.testing.assert_identical(again, opened)
    assert again.attrs.pop("source").startswith("mdr-bem-crosscheck")
    assert "source" not in tree.attrs
    xarray.testing.assert_identical(again, tree)
    for node in tree.subtree:
        for name, variable in node.variables.items():
            found = again[node.path].variables[name]
            assert found.dtype == (object if variable.dtype.kind == "U" else variable.dtype), name


def test_long_numbers_and_texts_are_compressed():
    long = xarray.Dataset({"zero": ("x", np.zeros(10**5)), "status": ("x", np.full(10**5, "solved"))})
    assert len(netcdf.packed(xarray.DataTree(long))) < long.nbytes / 50


@pytest.mark.parametrize("foreign", [object(), {"a": 1}, print], ids=["object", "dictionary", "function"])
def test_nothing_but_numbers_and_texts_is_written(foreign):
    for dataset in (xarray.Dataset(attrs={"a": foreign}), xarray.Dataset({"a": ("x", np.array([foreign]))})):
        with pytest.raises((TypeError, ValueError)):
            netcdf.packed(xarray.DataTree(dataset))


def refused(path, why):
    """Whether a file of results is refused by its name, with the reason."""
    with pytest.raises(InvalidInput, match=rf"results\.nc: {why}"):
        netcdf.load(path)


def test_every_changed_or_shortened_file_is_refused_before_hdf5_sees_it(tmp_path, monkeypatch):
    monkeypatch.setattr(xarray, "load_datatree", None)
    path = tmp_path / netcdf.NAME
    whole = netcdf.packed(xarray.DataTree(OF_ALL_KINDS))
    random = np.random.default_rng(1)
    damaged = [whole + b" ", whole + whole[-64:], b"", b"x" * 100]
    for place in random.integers(len(whole), size=100):
        changed = bytearray(whole)
        changed[place] ^= 1 << random.integers(8)
        damaged += [bytes(changed), whole[:place], whole[:place] + whole[place + 1 :]]
    for file in damaged:
        path.write_bytes(file)
        refused(path, "is not a file of results, or is damaged")


def test_a_file_of_another_program_or_version_is_refused_with_the_reason(tmp_path):
    path = tmp_path / netcdf.NAME
    OF_ALL_KINDS.to_netcdf(path, engine="h5netcdf")
    refused(path, "is not a file of results, or is damaged: it has no checksum at its end")
    image = path.read_bytes() + b"crosscheck format 1 "
    path.write_bytes(image + netcdf.checksum(image))
    refused(path, "was written by another version of this program")


def test_a_folder_without_results_is_named(tmp_path):
    with pytest.raises(InvalidInput, match="no command has left results"):
        netcdf.load(tmp_path)
    with pytest.raises(InvalidInput, match="no such file"):
        netcdf.load(tmp_path / "nowhere")
