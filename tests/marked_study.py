"""A study of solvers that leave a mark when they begin a solve."""

import hashlib
import json
import os
from dataclasses import dataclass, replace

from bem3d import BEM
from compare.cli.app import main
from compare.solving.curve import tasks_of
from compare.solving.task import SCENES
from compare.studies.comparison.rough import RoughSeries
from compare.studies.comparison.study_file import STUDIES, ReadyStudy
from compare.studies.paper.parameters import resolved
from mdr1d import MDR


def name(solver, scene):
    asked = solver.name, solver.points, SCENES.dump_python((scene,), mode="json")
    return hashlib.sha256(json.dumps(asked, sort_keys=True).encode()).hexdigest()


def mark(solver, scene):
    file = os.open(os.environ["MARKS"], os.O_WRONLY | os.O_APPEND | os.O_CREAT)
    os.write(file, (name(solver, scene) + "\n").encode())
    os.close(file)


@dataclass(frozen=True)
class MarkedMDR(MDR):
    def solve(self, scene):
        mark(self, scene)
        return super().solve(scene)


@dataclass(frozen=True)
class MarkedBEM(BEM):
    def solve(self, scene, *warm_start):
        mark(self, scene)
        return super().solve(scene, *warm_start)


def series():
    scene = resolved("sphere")
    scene = replace(scene, roughness=replace(scene.roughness, shortest=2e-3, seed=1))
    solvers = {"bem": MarkedBEM(points=32), "mdr": MarkedMDR(points=500)}
    return RoughSeries("s", "Sphere", scene, (0.05, 0.1), (5.0, 10.0, 20.0), surfaces=4, profiles=2, **solvers)


def tasks():
    return tasks_of(series().curves)


def names(task):
    """Marks that a task leaves: theories beside the models leave none."""
    contacts = [each for each in getattr(task, "contacts", (task,)) if hasattr(each.solver, "points")]
    return [name(each.solver, scene) for each in contacts for scene in each.scenes]


def command():
    """The command, in which the study of collapse is this one."""
    STUDIES["collapse"] = ReadyStudy("Tiny", "A few contacts.", lambda size: [series()])
    main()
