"""Columns of tables of moduli, with the names that people give them; here alone they are listed."""

from collections.abc import Mapping

from .columns import Column
from .quantities import COMPLIANCE, HERTZ, KELVIN, MODULUS, RADIAN, RADIAN_PER_SECOND, SECOND

# A modulus by its symbols and words in shear and in tension, {M} and {kind}, and names that leave this open.
KINDS: Mapping[str, tuple[str, str, tuple[str, ...]]] = {
    "shear": ("G", "J", ("shear",)),
    "tensile": ("E", "D", ("tensile", "young's", "flexural", "bending")),
}
OPEN = ""
MODULI: Mapping[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "storage": (
        (
            *(
                "{M}'",
                "{M}p",
                "{M} p",
                "{M}1",
                "{M} 1",
                "{M} prime",
                "{M}prime",
                "Re({M}*)",
                "Re {M}*",
                "{M} storage",
                "{M} stor",
                "{M} real",
            ),
            *("storage modulus {M}'", "{M}' storage modulus", "{kind} storage modulus", "storage {kind} modulus"),
        ),
        ("storage modulus", "storage", "storage mod", "elastic modulus", "real modulus"),
    ),
    "loss": (
        (
            *(
                "{M}''",
                "{M}pp",
                "{M} pp",
                "{M}2",
                "{M} 2",
                "{M} double prime",
                "{M} dprime",
                "{M}doubleprime",
                "{M}dprime",
                "Im({M}*)",
                "Im {M}*",
                "{M} loss",
                "{M} imag",
            ),
            *("loss modulus {M}''", "{M}'' loss modulus", "{kind} loss modulus", "loss {kind} modulus"),
        ),
        ("loss modulus", "loss", "loss mod", "viscous modulus", "imaginary modulus"),
    ),
    "magnitude": (
        (
            *("|{M}*|", "{M}*", "|{M}|", "{M} star", "{M}star", "abs({M}*)", "{M} abs", "{M} complex"),
            *("complex modulus |{M}*|", "complex modulus {M}*", "|{M}*| complex modulus"),
            *("complex {kind} modulus", "{kind} complex modulus", "dynamic {kind} modulus"),
        ),
        ("complex modulus", "dynamic modulus", "absolute modulus", "modulus magnitude", "|M*|"),
    ),
    "relaxation": (
        (
            *(
                "{M}(t)",
                "{M}",
                "{M}r",
                "{M} r",
                "{M} rel",
                "{M} relax",
                "relaxation modulus {M}(t)",
                "{kind} modulus",
            ),
            *("relaxation modulus {M}", "{kind} relaxation modulus"),
        ),
        ("relaxation modulus", "stress relaxation modulus", "modulus"),
    ),
    "creep": (
        (
            *("{J}(t)", "{J}", "creep compliance {J}(t)", "creep compliance {J}", "{kind} creep compliance"),
            *("{kind} compliance", "compliance {J}(t)", "compliance {J}"),
        ),
        ("creep compliance", "compliance"),
    ),
}
_TIMES_SHIFT = tuple(
    form.replace("a", name)
    for name in ("aT", "a_T", "a(T)")
    for form in ("a {}", "{} a", "a*{}", "{}*a", "a·{}", "{}·a")
)
_SHIFT = (*("aT", "a_T", "a(T)", "shift factor", "shift", "shift factor aT", "shift factor a_T"),)


def _reduced(*names):
    return tuple(
        form.format(name)
        for name in names
        for form in (*_TIMES_SHIFT, "reduced {}", "shifted {}", "red. {}", "{} red")
    )


_FREQUENCY = ("f", "freq", "frequency", "freq.", "test frequency", "oscillation frequency", "frequency f")
_ANGULAR = (
    *("omega", "ω", "w", "angular frequency", "ang. frequency", "ang frequency", "ang. freq.", "ang freq"),
    *("circular frequency", "angular freq", "angular frequency ω", "angular frequency omega", "frequency ω"),
)
FREQUENCY = Column("frequency", _FREQUENCY, (HERTZ, RADIAN_PER_SECOND), optional=True)
ANGULAR = Column("angular frequency", _ANGULAR, (RADIAN_PER_SECOND,), optional=True)
REDUCED = Column("reduced frequency", _reduced(*_FREQUENCY), (HERTZ, RADIAN_PER_SECOND), optional=True)
REDUCED_ANGULAR = Column("reduced angular frequency", _reduced(*_ANGULAR), (RADIAN_PER_SECOND,), optional=True)
TIME = Column("time", ("t", "time", "time t", "elapsed time", "test time", "creep time"), (SECOND,), optional=True)
TEMPERATURE = Column(
    "temperature",
    ("T", "temp", "temp.", "temperature", "temperature T", "sample temperature", "temperature sample", "ϑ"),
    (KELVIN,),
    optional=True,
)
SHIFT = Column("shift factor", (*_SHIFT, "horizontal shift factor", "x shift factor"), optional=True)
TAN = Column(
    "tan delta",
    (
        *(
            "tan delta",
            "tandelta",
            "tan δ",
            "tanδ",
            "tan(δ)",
            "tan(delta)",
            "tan d",
            "tanD",
            "tan(d)",
            "tan phi",
            "tan(φ)",
        ),
        *("tan", "damping factor", "loss factor", "loss tangent", "damping", "loss factor tan delta"),
    ),
    optional=True,
)
PHASE = Column(
    "phase",
    (
        *("phase", "phase angle", "phase shift", "phase lag", "loss angle", "delta", "δ", "φ", "phi"),
        *("phase angle δ", "phase angle delta", "phase angle φ", "phase shift angle", "phase shift δ"),
    ),
    (RADIAN,),
    optional=True,
)


def modulus(quantity: str, kind: str) -> Column:
    """The column of a quantity of `MODULI`, in shear, in tension, or OPEN."""
    told, left_open = MODULI[quantity]
    units = (COMPLIANCE if quantity == "creep" else MODULUS,)
    if kind == OPEN:
        return Column(quantity, left_open, units, optional=True)
    symbol, compliance, words = KINDS[kind]
    called = [each.format(M=symbol, J=compliance, kind=word) for each in told for word in words]
    return Column(f"{quantity}, {kind}", tuple(dict.fromkeys(called)), units, optional=True)


COLUMNS = (
    *(FREQUENCY, ANGULAR, REDUCED, REDUCED_ANGULAR, TIME, TEMPERATURE, SHIFT, TAN, PHASE),
    *(modulus(quantity, kind) for quantity in MODULI for kind in (*KINDS, OPEN)),
)
