"""The surface of a drawing as one page that a browser turns and enlarges, offline: by plotly, an extra."""

import re
from collections.abc import Mapping
from importlib.util import find_spec
from typing import Any

import numpy as np

from scene import Refused

from ...report.page import Plot
from ...report.plots import touching
from ...report.plots.prefixes import prefixed
from ...report.render.html import POLICY, digest
from .figure import SURFACE

NAME = "surface.html"
EXTRA = 'pip install "mdr-bem-crosscheck[interactive]"'
FREE = "rgb(226,222,206)"  # of the surface where nothing presses
LONGEST = 1.8  # side of the surface, in units of plotly


def refuse() -> None:
    """Raise Refused where plotly is not installed."""
    if find_spec("plotly") is None:
        raise Refused(f"interactive: the page is made by plotly, which is not installed: {EXTRA}")


def text(plot: Plot) -> str:
    """The surface of a plot of `plots.draw` as an HTML file that needs nothing else."""
    return _page(plot.tables[SURFACE], plot.options)


def _page(table, options: Mapping[str, Any]) -> str:
    from plotly import graph_objects

    fields = {name: touching.unstacked(table, "y", "x", name) for name in ("displacement", "pressure", "gap")}
    x, y = (getattr(fields["gap"], name).to_numpy() for name in ("columns", "index"))
    (along, x_unit), (high, z_unit), (up, pascal) = (
        prefixed([*x, *y], "m"),
        prefixed(fields["displacement"], "m"),
        prefixed(options["highest"], "Pa"),
    )
    surface = graph_objects.Surface(
        x=along * x,
        y=along * y,
        z=-high * fields["displacement"].to_numpy(),
        surfacecolor=up * fields["pressure"].to_numpy(),
        customdata=high * fields["gap"].to_numpy(),
        cmin=0.0,
        cmax=up * options["highest"],
        colorscale=[
            [0.0, FREE],
            [0.01, FREE],
            [0.02, "#fde725"],
            [0.33, "#35b779"],
            [0.66, "#31688e"],
            [1.0, "#440154"],
        ],
        colorbar={"title": f"pressure [{pascal}]"},
        hovertemplate=(
            f"x %{{x:.4g}} {x_unit}, y %{{y:.4g}} {x_unit}<br>height %{{z:.4g}} {z_unit}<br>"
            f"pressure %{{surfacecolor:.4g}} {pascal}<br>gap %{{customdata:.4g}} {z_unit}<extra></extra>"
        ),
    )
    wide, deep = x[-1] - x[0], y[-1] - y[0]
    tall = options["enlarged"] * np.ptp(fields["displacement"].to_numpy())
    unit = max(wide, deep) / LONGEST
    slides = {1: ", indenter slides along −x", -1: ", indenter slides along +x"}.get(options["sliding"], "")
    layout = {
        "title": f"Deformed surface, heights × {options['enlarged']:g}{slides}",
        "scene": {
            "xaxis_title": f"x [{x_unit}]",
            "yaxis_title": f"y [{x_unit}]",
            "zaxis": {"title": f"height [{z_unit}]", "nticks": 3},
            "camera": {"eye": {"x": 0.6, "y": -1.5, "z": 1.1}},
            "aspectmode": "manual",
            "aspectratio": {"x": wide / unit, "y": deep / unit, "z": tall / unit},
        },
    }
    page = graph_objects.Figure(surface, layout).to_html(include_plotlyjs=True, default_height="95vh")
    scripts = " ".join(map(digest, re.findall(r"<script[^>]*>(.*?)</script>", page, re.DOTALL)))
    policy = f"{POLICY} blob:; style-src 'unsafe-inline'; script-src {scripts}"
    return page.replace("<head>", f'<head><meta http-equiv="Content-Security-Policy" content="{policy}">', 1)
