"""The judge: one scene answered in one and in three dimensions. The command `crosscheck X` is `compare.X` here.

run : solve scenes in both, or by other models, compare, and write a report
trust : what the 1D answer to a scene is worth, without solving anything rough
sweep : solve a scene at every speed and load in both, as a Dataset; friction_plot draws it
study : ask the claims of the paper of many contacts
paper : simulate the paper again in one dimension
workprecision : what accuracy costs in time
stability : the named hard cases, each with its law
verify : a code of contact of your own against what it must hold
regress : quantities against what is stored; `check` and `update` do so in a test of your own
mastercurve, topography : friction that you measured, a surface that you measured
plan : what would be simulated of a scene, and what that costs
load, export : what a command left, as xarray has it, as CSV, for ParaView, as figures for a journal
draw : the contact in 3D and the row of springs; of a program also the forces in time
scenes, new, schema : scenes and studies to begin with, a copy of one of them, and what may stand in it
Persson : his theory of rough contact and friction, as published and with its later factor
CorrectedMDR : one dimension, corrected to three by the trust map, where the map knows how
FrictionLaw : friction in three dimensions from the spectrum, with an interval
solve : a study of your own, derived from `Study`, with ParameterGrid, Claim, Finding and Judgement
InvalidInput, Refused : before anything is solved, of what cannot be read, and of what no solver can do
SolveError, OutOfMemory : of an answer that cannot be had; Doubtful and UncertainFriction are warnings

Each returns what was found and prints nothing: printed, that is what the command prints; in a notebook it shows
tables, and its `figures`. Nothing is imported until it is used.
"""

import logging

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
logging.getLogger(__name__).addHandler(logging.NullHandler())
