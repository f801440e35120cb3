"""Files of a scene and of a study that many tests start from."""

HEAD = """
title = "Mine"
about = "What I ask."
"""
SHARED = """
speeds = ["50 mm/s", 0.1, 0.2]
loads = { least = "0.5 N", greatest = 2, count = 4 }
surfaces = 2
profiles = 3
"""
TABLES = """
[indenter]
type = "sphere"
radius = "10 mm"
[elastomer]
type = "kelvin"
modulus = "1 MPa"
relaxation_time = "1 ms"
[roughness]
type = "self-affine"
hurst = 0.2
rms_height = "50 um"
longest = "10 mm"
shortest = "2 mm"
seed = 1
[bem]
points = 32
[mdr]
points = 400
"""

SCENE = """
[indenter]
type = "sphere"
radius = 1e-2
[elastomer]
type = "kelvin"
modulus = 1e6
relaxation_time = 1e-3
[motion]
type = "slide"
speed = 0.1
load = 1.0
[roughness]
type = "self-affine"
hurst = 0.2
rms_height = 1e-6
longest = 1e-2
shortest = 1e-3
seed = 5
"""
# Few contacts, each on few points.
SMALL = """
[study]
speeds = [0.1, 1.0]
pressing = [0.5, 2.0]
load_speeds = [0.1]
depths = [1.0]
surfaces = 2
profiles = 2
[bem]
points = 32
[mdr]
points = 1000
"""
