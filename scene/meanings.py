"""What people call the fields of a scene, and what they state instead: names answered by their meaning."""

from collections import defaultdict
from collections.abc import Collection, Iterator
from dataclasses import dataclass

_SHEAR = (
    "moduli are shear moduli, G = E / (2 (1 + poisson_ratio)): a third of E at poisson_ratio = 0.5; fields with "
    "youngs_ in their names take E"
)
_FLANK = "angle is the one between the flank and the flat surface"

# A field, and other names of the same quantity.
_SAME = {
    "modulus": "G shear_modulus",
    "youngs_modulus": "E E0 E_0 young youngs young_modulus elastic_modulus tensile_modulus e_modulus",
    "poisson_ratio": "nu poisson poissons_ratio",
    "relaxation_time": "tau relax_time retardation_time",
    "relaxation_times": "tau taus tau_i tau_k times",
    "g": "alpha alphas alpha_i gamma_i",
    "tau": "taus tau_i tau_k times",
    "rubbery_modulus": "relaxed_modulus static_modulus equilibrium_modulus long_term_modulus",
    "equilibrium_modulus": "modulus_at_rest relaxed_modulus static_modulus rubbery_modulus long_term_modulus",
    "glassy_modulus": "unrelaxed_modulus instantaneous_modulus",
    "table": "file path data",
    "file": "table path data map",
    "radius": "R r tip_radius radius_of_curvature",
    "exponent": "n alpha beta power order",
    "speed": "v V velocity sliding_speed sliding_velocity",
    "speeds": "v V velocity velocities",
    "load": "F FN F_N force normal_force normal_load",
    "depth": "d delta indentation indentation_depth penetration",
    "pressure": "p nominal_pressure mean_pressure normal_stress",
    "duration": "t time",
    "frequency": "f",
    "hurst": "H hurst_exponent",
    "rms_height": "rms h_rms hrms Sq Rq h0 h_0 sigma rms_roughness",
    "rms_slope": "Sdq rms_gradient root_mean_square_slope root_mean_square_gradient",
    "longest": "L lambda_max lambda_l wavelength_max max_wavelength longest_wavelength",
    "shortest": "lambda_min lambda_s wavelength_min min_wavelength shortest_wavelength",
    "rolloff": "lambda_r rolloff_wavelength roll_off_wavelength",
    "wavelength": "lambda L period pitch",
    "seed": "random_state random_seed rng",
    "pixel": "dx pixel_size spacing resolution",
    "thickness": "h t d height",
    "temperature": "T temp",
    "reference": "T0 T_0 T_ref Tref T_r reference_temperature",
    "activation_energy": "Ea E_a Q",
    "coefficient": "mu cof friction friction_coefficient",
    "conductivity": "k lambda kappa thermal_conductivity",
    "points": "n N nx grid grid_points samples resolution nodes",
    "extent": "L length size width",
    "surfaces": "samples realizations realisations",
}

# A field, other quantities from which it follows or with which it is confused, and what to do with them.
_OTHER = (
    (
        "rubbery_modulus equilibrium_modulus",
        "E E0 E_0 E_inf young youngs youngs_modulus young_modulus elastic_modulus tensile_modulus e_modulus",
        _SHEAR,
    ),
    (
        "modulus rubbery_modulus equilibrium_modulus",
        "E_star reduced_modulus effective_modulus plane_strain_modulus indentation_modulus contact_modulus",
        "moduli are shear moduli, G = E* (1 - poisson_ratio) / 2: a fourth of E* at poisson_ratio = 0.5",
    ),
    (
        "modulus rubbery_modulus equilibrium_modulus",
        "stiffness k spring_constant hardness shore shore_a",
        "a solid is stated by its shear modulus [Pa]; the stiffness [N/m] of a contact follows from it",
    ),
    ("modulus", "mu", "modulus is the shear modulus, a coefficient of friction is that of [interface]"),
    ("modulus", "J compliance", "modulus is the shear modulus, 1 over the compliance in shear"),
    (
        "modulus",
        "G0 G_0 G_inf ginf",
        "modulus is the shear modulus at rest, once all has relaxed: books differ in what they call G0 and G_inf",
    ),
    (
        "rubbery_modulus",
        "modulus G G0 G_0 G_inf ginf shear_modulus",
        "rubbery_modulus is the shear modulus at rest, glassy_modulus that at once: books differ in what they "
        "call G0 and G_inf",
    ),
    (
        "equilibrium_modulus",
        "modulus G G0 G_0 G_inf ginf shear_modulus",
        "equilibrium_modulus is the shear modulus at rest, without the branches: books differ in what they call "
        "G0 and G_inf",
    ),
    ("poisson_ratio", "K bulk_modulus", "poisson_ratio = (3 K - 2 G) / (6 K + 2 G), with G the shear modulus"),
    (
        "glassy_modulus",
        "viscosity eta",
        "a viscosity has no field: relaxation_time = viscosity / (glassy_modulus - rubbery_modulus)",
    ),
    (
        "lowest_frequency",
        "viscosity eta",
        "a springpot has no viscosity: relaxation_time and exponent state it",
    ),
    ("relaxation_time", "viscosity eta", "a viscosity has no field: relaxation_time = viscosity / modulus"),
    (
        "relaxation_times",
        "viscosity viscosities eta",
        "a viscosity has no field: relaxation_time = viscosity / modulus",
    ),
    ("g", "g_i gi g_k gk", "g takes shares of the instantaneous modulus, moduli takes shear moduli [Pa]"),
    ("relaxation_times", "beta betas beta_i", "beta are rates of decay: relaxation_times = 1 / beta"),
    (
        "modulus",
        "viscosity eta",
        'an elastic solid has no viscosity: type = "kelvin" has relaxation_time = viscosity / modulus',
    ),
    (
        "glassy_modulus",
        "retardation_time",
        "relaxation_time is at constant strain: retardation_time * rubbery_modulus / glassy_modulus",
    ),
    ("relaxation_times", "retardation_times compliances", 'these state a solid of type = "kelvin-chain"'),
    ("retardation_times", "relaxation_times moduli", 'these state a solid of type = "prony"'),
    (
        "poisson_ratio",
        "tan_delta loss_factor loss_tangent storage_modulus loss_modulus",
        'moduli measured against the frequency state a solid of type = "tabulated"',
    ),
    (
        "poisson_ratio",
        "T temp temperature",
        'temperature has a table: [temperature], type = "wlf" or "arrhenius", with temperature and reference',
    ),
    ("radius", "diameter D", "radius is half of the diameter"),
    ("radius", "curvature", "radius = 1 / curvature"),
    ("angle", "theta cone_angle flank_angle", _FLANK),
    ("angle", "half_angle semi_angle half_apex_angle alpha", f"{_FLANK}: 90 deg less the half angle of the cone"),
    ("angle", "opening_angle apex_angle included_angle", f"{_FLANK}: 90 deg less half of the opening angle"),
    ("load", "mass m weight", "load is a force: the weight of 1 kg is 9.81 N"),
    ("speed", "rpm omega", "speed is that of sliding: angular speed [rad/s] times the radius of the track"),
    ("frequency", "omega angular_frequency", "frequency [Hz] = omega / (2 pi)"),
    (
        "rms_height",
        "Ra Sa mean_roughness average_roughness",
        "rms_height is the root mean square, Sq or Rq; where heights are normally distributed, 1.25 Ra",
    ),
    (
        "rms_height",
        "Rz Sz Rt Rmax peak_to_valley",
        "rms_height is the root mean square, Sq or Rq, which is less",
    ),
    (
        "rms_slope",
        "Rdq line_slope profile_slope",
        "rms_slope is that of the full gradient, Sdq: of an isotropic surface the root of 2 times Rdq",
    ),
    ("amplitude", "Rz Sz Rt height peak_to_valley", "amplitude is half of the height from valley to peak"),
    ("amplitude", "rms h_rms Sq Rq rms_height", "amplitude is the height of a crest above the mean, not an rms"),
    ("hurst", "D fractal_dimension", "hurst = 3 - D of a surface, 2 - D of a profile"),
    ("longest", "q0 q_0 q_min qmin q_l", "longest = 2 pi / q; where q is that of the roll-off, rolloff"),
    ("shortest", "q1 q_1 q_max qmax q_s", "shortest = 2 pi / q"),
    ("rolloff", "q_r qr q_rolloff", "rolloff = 2 pi / q"),
    ("wavelength", "q k wave_number wavenumber", "wavelength = 2 pi / q"),
    ("pixel", "width size extent scan_size field_of_view", "pixel is the width of the map over its columns"),
    (
        "reference",
        "Tg T_g",
        "reference is where the elastomer, c1 and c2 are stated: Tg, if it is there",
    ),
    ("points", "dx pixel pixel_size spacing", "points = extent / pixel"),
)

# Types, and other names of the same.
_TYPES = {
    "sphere": "ball paraboloid",
    "plane": "flat",
    "elastic": "hooke hookean linear-elastic",
    "kelvin": "kelvin-voigt voigt",
    "standard-linear-solid": "sls zener standard-solid three-element",
    "prony": "generalized-maxwell generalised-maxwell wiechert",
    "fractional": "springpot",
    "tabulated": "table measured dma",
    "topography": "measured map scan",
    "self-affine": "fractal",
}


@dataclass(frozen=True)
class Meaning:
    """What a name means.

    fields : that have the quantity, or from which they follow, of one table or another
    says : what to do; empty where the quantity is the same
    """

    fields: tuple[str, ...]
    says: str = ""

    def field(self, table: Collection[str]) -> str | None:
        """Its field in a table of such names; None where it has none."""
        return next((field for field in self.fields if field in table), None)


def meanings(name: str) -> tuple[Meaning, ...]:
    """What a name may mean in one table or another."""
    return _MEANINGS.get(_plain(name), ())


def meaning(name: str, table: Collection[str]) -> Meaning | None:
    """What a name means in a table of such names; None where that is unknown, and of a name that the table has."""
    return None if _plain(name) in table else next((each for each in meanings(name) if each.field(table)), None)


def type_meant(name: str, known: Collection[str]) -> str | None:
    """The one of the known types that is called so; None where none is."""
    plain = name.lower().replace("_", "-").replace(" ", "-")
    return next((each for each in known if plain in _TYPES.get(each, "").split()), None)


def rows() -> Iterator[tuple[Meaning, tuple[str, ...]]]:
    """Meanings, each with its names; of two that suit a table the first counts."""
    for fields, names, says in _OTHER:
        yield Meaning(tuple(fields.split()), says), tuple(names.split())
    for field, names in _SAME.items():
        yield Meaning((field,)), tuple(names.split())


def _plain(name):
    """One spelling of a name; a single letter keeps its case."""
    plain = name.replace("'s", "s").replace("-", "_").replace(" ", "_")
    return plain if len(plain) == 1 else plain.lower()


def _by_name():
    found = defaultdict(tuple)
    for each, names in rows():
        for name in map(_plain, names):
            found[name] += (each,)
    return dict(found)


_MEANINGS = _by_name()
