"""The picture of a contact in howto/figures.md: a smooth sphere that slides as fast as the elastomer remembers."""

import shutil
from pathlib import Path
from tempfile import TemporaryDirectory

import compare
from scene import Kelvin, Scene, Slide, Sphere

PICTURE = Path(__file__).parents[1] / "results" / "draw.png"
SCENE = Scene(Sphere(radius=10e-3), Kelvin(modulus=1e6, relaxation_time=1e-3), Slide(speed=1.0, load=1.0))


def main() -> None:
    """Solve, draw and copy the picture."""
    with TemporaryDirectory() as folder:
        compare.draw(SCENE, output=folder, workers=1)
        shutil.copy(Path(folder) / "draw.png", PICTURE)


if __name__ == "__main__":
    main()
