"""Samples of figures that commands left, to five digits: python tests/compare/plots/collect.py FOLDER..."""

import json
import shutil
import sys
from dataclasses import asdict
from pathlib import Path

from compare.report import csvfiles, manifest
from compare.solving.folders import FORMAT

HERE = Path(__file__).parent


def collect(folders):
    """Keep the tables of the smallest figure of each function in a folder named by it, and the manifest of all."""
    path = HERE / manifest.NAME
    entries = {entry["name"]: entry for entry in json.loads(path.read_text())["plots"]} if path.exists() else {}
    found = {}
    for folder in folders:
        for path_of, left in manifest.folders(folder):
            for plot in left.plots:
                place = path_of / plot.name[: plot.name.rfind("/") + 1]
                files = [place / f"{name}.csv" for name in plot.tables]
                found.setdefault((plot.module, plot.function), []).append((sum(map(_size, files)), files, plot))
    for (module, function), plots in found.items():
        _, files, plot = min(plots, key=lambda each: each[0])
        name = f"{module.rpartition('.')[2]}-{function}"
        shutil.rmtree(HERE / name, ignore_errors=True)
        (HERE / name).mkdir()
        for file in files:
            csvfiles.read(file).to_csv(HERE / name / file.name, index=False, na_rep="nan", float_format="%.5g")
        entries[f"{name}/plot"] = asdict(plot) | {"name": f"{name}/plot"}
    content = {"format": FORMAT, "command": "run", "inputs": {}, "solved": ""}
    content["plots"] = list(entries.values())
    path.write_text(json.dumps(content, indent=1, ensure_ascii=False) + "\n")


def _size(file):
    return file.stat().st_size


if __name__ == "__main__":
    collect(sys.argv[1:])
