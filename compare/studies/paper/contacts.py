"""Fig. 1: the contact of the rough cone and the rough sphere."""

from collections.abc import Mapping
from dataclasses import fields

import numpy as np
import xarray
from pandas import DataFrame

from mdr1d import MDR
from scene import Cone, Regime
from scene.scales import elastic_contact

from ...comparison.curve import FINE, SOLVED, Curve
from ...solving.vocabulary import attributes
from . import parameters

AT_NODES = ("x", "profile", "displacement", "contact")


def contact_grid(shape: str) -> Curve:
    """The one contact of one shape, with its fields."""
    motion = parameters.CONTACT
    return Curve(
        scene=parameters.contact(shape),
        speeds=(motion.speed,),
        values=(float(motion.load or 0.0),),
        grids={"MDR": {FINE: MDR(points=parameters.POINTS)}},
        draws={"MDR": 1},
        keeps_fields=True,
    )


def with_nodes(dataset: xarray.Dataset, fields: Mapping[str, Mapping[str, np.ndarray]]) -> xarray.Dataset:
    """A contact with its fields at the nodes of the profile, none where it has no answer."""
    kept = fields.get("MDR", {})
    return dataset.assign(
        {name: ("node", np.asarray(kept[name], float), attributes(name)) for name in AT_NODES if kept}
    )


def contact_tables(contacts: Mapping[str, xarray.Dataset]) -> tuple[DataFrame, dict[str, DataFrame]]:
    """Parameters and numbers of each contact that has an answer, a row a shape, and its profile and surface."""
    rows, lines = [], {}
    for shape, dataset in contacts.items():
        at = dataset.isel(dict.fromkeys(set(dataset.dims) - {"node"}, 0))
        if str(at["status"].values) != SOLVED:
            continue
        scene = parameters.contact(shape)
        body, rough, relaxed = scene.indenter, scene.roughness, elastic_contact(scene)
        numbers = {name: float(at[name]) for name in ("depth_reached", "contact_length", "rms_slope")}
        regime = Regime(*(float(at[each.name]) for each in fields(Regime)))
        broken = [name for name, holds in regime.flags.items() if not holds]
        rows.append(
            {
                "shape": shape,
                "angle": body.angle if isinstance(body, Cone) else np.nan,
                "radius": np.nan if isinstance(body, Cone) else body.radius,
                "hurst": rough.hurst,
                "rms_height": rough.rms_height,
                "seed": rough.seed,
                "load": scene.motion.load,
                "speed": scene.motion.speed,
                "modulus": scene.elastomer.modulus,
                "relaxation_time": scene.elastomer.relaxation_time,
                "friction_coefficient": float(at["friction_force"] / at["normal_force"]),
                **numbers,
                "smooth_half_width": relaxed.radius,
                "smooth_depth": relaxed.depth,
                "conditions_broken": ", ".join(broken),
            }
        )
        lines[shape] = DataFrame(
            {
                "x": at["x"].values,
                "indenter": at["profile"].values - numbers["depth_reached"],
                "surface": -at["displacement"].values,
                "contact": at["contact"].values.astype(int),
            }
        )
    return DataFrame(rows), lines
