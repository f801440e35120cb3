"""What the measured pages share: solving what is not solved yet, with a bar, and the tables of a page."""

import re
from pathlib import Path

import numpy as np
from pandas import DataFrame
from scipy.stats import binomtest

from compare.solving.cost import work_of
from compare.solving.folders import lock
from compare.solving.runner import sweep
from compare.solving.store import Store
from compare.solving.task import SceneTask, draws_of
from compare.solving.terminal import Shown
from compare.statistics.jackknife import mean_ratio

RESULTS = Path(__file__).parents[1] / "results"


def table(header, rows):
    """A Markdown table; columns are named in the header, separated by |."""
    names = header.split("|")
    return "\n".join(f"| {' | '.join(row)} |" for row in (names, ["---"] * len(names), *rows))


def cells(form, rows):
    """Cells of rows of a table: a format with names of columns in braces, separated by |."""
    return (form.format_map(row).split("|") for row in DataFrame(rows).to_dict("records"))


def stored(path, rows):
    """Write a table, or its rows, with every digit."""
    DataFrame(rows).to_csv(path, index=False, na_rep="nan")


def finding(found, claim, where, model):
    """The row on a claim in a place, of one model."""
    return found.query("claim == @claim and where == @where and model == @model").squeeze()


def order(points, errors):
    """Observed order: slope of error against points, in logarithms, over all of them."""
    return -np.polyfit(np.log(points), np.log(errors), 1)[0]


def limit(values):
    """Limit of numbers on grids of half the pixel each, at the order of the last three, NaN if they have none."""
    first, second = np.diff(values[-3:])
    ratio = first / second if second else np.nan
    return values[-1] + second / (ratio - 1) if ratio > 1 else np.nan


def of_count(held, tried):
    """Interval of 95 % of a share, from how many of those tried it held for (Clopper and Pearson)."""
    return np.array(binomtest(held, tried).proportion_ci())


def errors_of(logs):
    """Error that half and nine in ten of logarithms of answer over truth stay below, and how many are known."""
    off = 100 * np.abs(np.expm1(logs.dropna()))
    shown = (f"{float(f'{each:.2g}'):g}" for each in off.quantile([0.5, 0.9]))
    return f"{' / '.join(shown)} % ({len(off)})" if len(off) else ""


def share_of(held):
    """Share of those that held, with its interval of 95 %."""
    low, high = 100 * of_count(int(held.sum()), len(held))
    return f"{100 * held.mean():.0f} % ({low:.0f} to {high:.0f})"


def example(page):
    """The example in Python of a page that has one."""
    (code,) = re.findall(r"^```python\n(.*?)^```", page.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)
    return code


def fill(page, parts):
    """Write texts between two comments of a page, by the name of the first comment."""
    text = page.read_text(encoding="utf-8")
    for name, part in parts.items():
        before, after = re.split(rf"(?<=<!-- {name} -->\n).*?(?=<!-- end -->)", text, flags=re.DOTALL)
        text = f"{before}{part.strip()}\n{after}"
    page.write_text(text, encoding="utf-8")


def friction(rows):
    """Mean friction force over mean normal force of those with an answer."""
    return mean_ratio(*np.transpose([(each.friction_force, each.normal_force) for each in rows]))


def task(solver, scene, draws=1):
    """Scene on the first of its surfaces or profiles."""
    return SceneTask(solver, draws_of(scene, draws), work=draws * work_of(solver, scene))


def solved(page, tasks, workers=None, fresh=False):
    """Answers of tasks; what has been solved once lies in the folder `solved` next to the numbers of the page."""
    store = Store(page.with_suffix("") / "solved")
    with lock([store.folder], print), Shown() as shown, shown.solving() as progress:
        return sweep(tasks, store, workers, progress, fresh=fresh).outcomes
