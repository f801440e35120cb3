"""The share S(x) fitted to the rough planes of results/law/planes.csv, and its errors on planes held out.

python docs/measure/share.py   writes compare/models/law/share.csv, and prints the misfits
"""

from collections.abc import Iterator

import numpy as np
import pandas
from pandas import DataFrame
from planes import HELD_OUT, PAGE
from scipy.optimize import least_squares
from tables import stored

from compare.models.law.parts import FITTED, Share, coefficients

BOOTSTRAPS, SEED = 200, 36
FLOOR = 0.02  # of the misfit of a plane, below which one counts no more than another
PLACES = (5e-3, 0.015), (0.015, 0.03), (0.03, 0.07), (0.07, 0.15), (0.15, 0.3), (0.3, 0.6), (0.6, 1.2), (1.2, 3.0)


def planes() -> DataFrame:
    """Planes with their share on ever finer grids: what those with a finer one differ by is alike for all."""
    found = pandas.read_csv(PAGE.with_suffix(".csv"))
    one = np.ones(len(found))
    columns = np.stack([one, found["lossy"], np.log(found["x"])], axis=1)
    seen = found["friction_finer"].notna().to_numpy()
    change = columns @ np.linalg.lstsq(columns[seen], found["friction_finer"][seen], rcond=None)[0]
    # Halving the pixel once more changes half as much again, and so on.
    return found.assign(share=found["share"] * (1 + 2 * change), finer=change, one=one)


def fitted(found: DataFrame, names: list[tuple[str, str]], start: np.ndarray) -> np.ndarray:
    """Coefficients that fit most planes best: those that lie far off hardly count."""
    weight = 1 / np.hypot(found["error"], FLOOR).to_numpy()

    def misfit(values):
        return weight * np.log(share(found, names, values) / found["share"].to_numpy())

    return least_squares(misfit, start, loss="cauchy").x


def share(found: DataFrame, names: list[tuple[str, str]], values: np.ndarray) -> np.ndarray:
    """S of each plane."""
    return Share.summed(dict(zip(names, values, strict=True)), found)(found["x"].to_numpy())


def misfits(found: DataFrame, names: list[tuple[str, str]], values: np.ndarray) -> Iterator[dict]:
    """Misfit of planes held out by their pressure: median, nine in ten, and the standard error of the planes."""
    off = np.abs(np.log(share(found, names, values) / found["share"].to_numpy()))
    for low, high in PLACES:
        own = found["x"].between(low, high).to_numpy()
        yield {
            "from": low,
            "to": high,
            "planes": int(own.sum()),
            "median": float(np.median(off[own])),
            "nine in ten": float(np.quantile(off[own], 0.9)),
            "error": float(np.median(found["error"][own])),
        }


def main() -> None:
    """Fit, with intervals of 95 % by drawing planes anew, and hold it against the planes held out."""
    found, names = planes(), list(coefficients())
    held = found["plane"] % HELD_OUT == 0
    learned = found[~held]
    best = fitted(learned, names, np.array(list(coefficients().values())))
    rng, own = np.random.default_rng(SEED), learned["plane"].unique()
    groups = dict(list(learned.groupby("plane")))
    drawn = np.array(
        [
            fitted(pandas.concat([groups[k] for k in rng.choice(own, own.size)]), names, best)
            for _ in range(BOOTSTRAPS)
        ]
    )
    low, high = np.quantile(drawn, [0.025, 0.975], axis=0)
    told = [
        (to, times, f"{v:.4g}", f"{a:.4g}", f"{b:.4g}")
        for (to, times), v, a, b in zip(names, best, low, high, strict=True)
    ]
    stored(FITTED, DataFrame(told, columns=["to", "times", "value", "low", "high"]))
    table = DataFrame(misfits(found[held], names, best))
    stored(PAGE.with_name("share.csv"), table)
    print(table.to_string())


if __name__ == "__main__":
    main()
