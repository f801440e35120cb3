"""What the writer of results takes, and that it comes back."""

import numpy as np
import pytest

from compare import netcdf, results


def test_lengths_that_disagree_along_a_dimension_are_refused():
    variables = {name: netcdf.Variable(("x",), np.zeros(n)) for n, name in enumerate("abc", 2)}
    with pytest.raises(ValueError, match="b has 3 along x, where others have 2"):
        netcdf.encoded(netcdf.Group(variables))


def test_many_attributes_in_any_letters_come_back(tmp_path):
    """More than eight, from which on HDF5 keeps them otherwise."""
    attributes = {f"name {k}": f"µ {k} " * (k * 100 + 1) for k in range(20)}
    path = tmp_path / "file.nc"
    path.write_bytes(
        netcdf.encoded(netcdf.Group({"x": netcdf.Variable((), np.array(1.0), attributes)}, attributes))
    )
    found = results.load(path)
    assert found.attrs == found.x.attrs == attributes
