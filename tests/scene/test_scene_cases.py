"""Tables of moduli as people bring them: read as they were made, once what differs is stated, or refused."""

import numpy as np
import pytest
from pydantic import ValidationError

from scene import StandardLinearSolid, Tabulated

SOLID = StandardLinearSolid(rubbery_modulus=1e6, glassy_modulus=1e7, relaxation_time=1e-2)
HERTZ = np.geomspace(1e-2, 1e3, 31)
OMEGA = 2 * np.pi * HERTZ
G = SOLID.complex_modulus(OMEGA)
WLF = {-10.0: 20.0, 0.0: 4.0, 20.0: 1.0, 40.0: 0.2}  # a_T by temperature [degC]


def table(heading, *columns, separator=","):
    rows = zip(*columns, strict=True)
    cells = (separator.join(each if isinstance(each, str) else f"{each:.12g}" for each in row) for row in rows)
    return "\n".join([heading, *cells]) + "\n"


MODULI = table("f [Hz],G' [MPa],G'' [MPa]", HERTZ, G.real / 1e6, G.imag / 1e6)
BARE = table("omega,G',G''", OMEGA, G.real, G.imag)
SPOKEN = table("# NR, 1.2 MPa, 0.3 MPa", HERTZ, G.real, G.imag, separator=" ")
HEADER = ["Filename\tsample.tri", "Instrument name\tDHR", "[step]", "Frequency sweep - 1"]
NAMES = "Angular frequency,Step time,Temperature,Stress (step),Storage modulus,Loss modulus,Tan(delta),Frequency"
EXPORT = table(
    "\n".join([*HEADER, NAMES.replace(",", "\t"), "rad/s,s,°C,MPa,MPa,MPa,,Hz".replace(",", "\t")]),
    *(OMEGA, np.arange(31), np.full(31, 25.01), np.zeros(31), G.real / 1e6, G.imag / 1e6, G.imag / G.real, HERTZ),
    separator="\t",
)
BOTH = [*G, *1.17 * G]
NAMED = table(
    "sample,f [Hz],G' [Pa],G'' [Pa]", ["NR"] * 31 + ["SBR"] * 31, [*HERTZ] * 2, np.real(BOTH), np.imag(BOTH)
)
BLOCKS = f"Sample A\n{MODULI}\nSample B\n{MODULI}"


def shifted(stiffer=lambda celsius: 1.0, **more):
    """Rows at four temperatures, with columns of factors."""
    rows = [
        (t, f, stiffer(t) * SOLID.complex_modulus(2 * np.pi * f * a)) for t, a in WLF.items() for f in HERTZ[5:26]
    ]
    names = ",".join(["T [degC]", "f [Hz]", "G' [Pa]", "G'' [Pa]", *more])
    factors = [[of(t) for t, _, _ in rows] for of in more.values()]
    return table(names, *zip(*((t, f, at.real, at.imag) for t, f, at in rows), strict=True), *factors)


def vertical(celsius):
    return (273.15 + celsius) / 293.15


CASES = {
    "units in the heading": (MODULI, {}, 1e6),
    "tension": (
        table("f (Hz),E' (Pa),E'' (Pa),tan delta", HERTZ, 3 * G.real, 3 * G.imag, G.imag / G.real),
        {},
        1e6,
    ),
    "modulus and phase": (
        table("f (Hz),|E*| (Pa),phase (deg)", HERTZ, 3 * np.abs(G), np.degrees(np.angle(G))),
        {},
        1e6,
    ),
    "cells in quotes": (BARE.replace(",", '","').replace("\n", '"\n"').join(['"', ""])[:-1], {}, 1e6),
    "viscosity and tan delta": (
        table(
            "Angular frequency [rad/s],Complex viscosity [Pa.s],Tan delta",
            OMEGA,
            np.abs(G) / OMEGA,
            G.imag / G.real,
        ),
        {},
        1e6,
    ),
    "a sweep of temperature": (
        table("T (C),E' (Pa),E'' (Pa)", HERTZ, G.real, G.imag),
        {},
        "a sweep of temperature is no table of moduli",
    ),
    "latin-1": ("T=25°C\n" + BARE, {}, "line 1: byte 0xb0 is not utf-8.*state encoding"),
    "latin-1, stated": (
        "T=25°C\n" + BARE,
        {"encoding": "cp1252", "skip": 1, "units": {"omega": "rad/s", "storage": "Pa", "loss": "Pa"}},
        1e6,
    ),
    "a comment with units": (SPOKEN, {}, "line 2: .* is no heading"),
    "a comment with units, stated": (
        SPOKEN,
        {
            "columns": {"frequency": 1, "storage": 2, "loss": 3},
            "units": {"frequency": "Hz", "storage": "Pa", "loss": "Pa"},
        },
        1e6,
    ),
    "an export of a rheometer": (EXPORT, {}, "line 5: .* has 8 cells, and line 1, .* has 2: state skip"),
    "an export of a rheometer, stated": (EXPORT, {"skip": 4}, 1e6),
    "a column of samples": (NAMED, {}, "column 'sample' has several values, 'NR' and 'SBR'.*state where"),
    "one of them": (NAMED, {"where": {"sample": "NR"}}, 1e6),
    "the other": (NAMED, {"where": {"sample": "SBR"}}, 1.17e6),
    "two blocks": (BLOCKS, {}, "line 2: .* line 36 is another heading: state rows"),
    "the first of two": (BLOCKS, {"skip": 1, "rows": 31}, 1e6),
    "shift factors of any name": (shifted(Shift_value=lambda t: np.log10(WLF[t])), {}, "column 'Shift_value' has"),
    "shift factors, stated": (
        shifted(Shift_value=lambda t: np.log10(WLF[t])),
        {"columns": {"log_a_T": "Shift_value"}},
        1e6,
    ),
    "vertical shifts": (shifted(vertical, aT=WLF.get, bT=vertical), {}, 1e6),
    "a workbook": ("PK\3\4", {}, "is a zip archive, as workbooks"),
}


@pytest.mark.parametrize(("text", "stated", "expected"), CASES.values(), ids=CASES)
def test_a_table_has_the_modulus_it_was_made_with_or_is_refused(tmp_path, text, stated, expected):
    path = tmp_path / "rubber.csv"
    path.write_text(text, encoding=stated.get("encoding", "cp1252" if "°C\nomega" in text else "utf-8"))
    given = {"kind": "shear", **stated}
    if "E'" in text or "E*" in text:
        given.pop("kind")
    if isinstance(expected, str):
        with pytest.raises(ValidationError, match=expected):
            Tabulated(table=path, **given)
        return
    found = Tabulated(table=path, **given)
    assert found.static_modulus == pytest.approx(expected, rel=5e-3)
    scale = expected / 1e6
    np.testing.assert_allclose(found.complex_modulus(OMEGA[6:25]), scale * G[6:25], rtol=1e-2)
