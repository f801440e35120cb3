"""Sheets of numbers: whatever their dialect they are read as they were written, or refused."""

import numpy as np
import pytest
from random_tables import CALLED, draw

from scene.columns import Column, chosen, joined, sheet_of
from scene.quantities import HERTZ, PASCAL
from scene.sheet import read_sheets

WANTED = [
    Column(name, CALLED[name], (HERTZ,) if name == "frequency" else (PASCAL,))
    for name in ("frequency", "storage", "loss")
]
ROUNDING = 4e-16  # of one product


def read(path):
    found, _ = chosen(joined(read_sheets(path)), WANTED, [each.field for each in WANTED])
    return {name: each.numbers for name, each in found.items()}


def outcomes(path, seeds):
    """How many tables were read, refused, and read although they were damaged. Fails for other numbers."""
    counted = {"read": 0, "refused": 0, "damaged and read": 0}
    for seed in seeds:
        drawn = draw(seed)
        path.write_bytes(drawn.content)
        try:
            found = read(path)
        except ValueError:
            counted["refused"] += 1
            continue
        counted["read"] += 1
        for name, numbers in drawn.columns.items():
            assert found[name].shape == numbers.shape, (seed, name)
            np.testing.assert_allclose(found[name], numbers, rtol=ROUNDING, err_msg=f"seed {seed}, {name}")
        path.write_bytes(drawn.damaged)
        try:
            read(path)
        except ValueError:
            continue
        counted["damaged and read"] += 1
    return counted


def test_a_table_in_any_dialect_is_read_as_it_was_written_or_refused(tmp_path):
    counted = outcomes(tmp_path / "table.txt", range(300))
    assert counted["read"] > 180
    assert not counted["damaged and read"]


@pytest.mark.slow
def test_five_thousand_tables_in_any_dialect_are_read_as_they_were_written_or_refused(tmp_path):
    counted = outcomes(tmp_path / "table.txt", range(1000, 6000))
    assert counted["read"] > 3000
    assert not counted["damaged and read"]
