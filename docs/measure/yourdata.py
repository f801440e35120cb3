"""The pages on data of one's own: files as instruments write them, made up, and what commands print of them.

`python docs/measure/yourdata.py` writes the files again, and below each command of the pages what it prints.
"""

import re
import shlex
from collections.abc import Iterator
from contextlib import chdir
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from typer.testing import CliRunner

from compare.cli.app import app
from scene import Prony

FOLDER = Path(__file__).parents[1] / "howto" / "yourdata"
# The rubber: shear modulus at rest [MPa], branches a decade apart, and how their times shift with temperature.
REST, MODULI, TIMES = 1.1, (0.6, 0.9, 1.4, 2.2, 3.4, 5.0, 7.0), 10.0 ** np.arange(-6, 1)[::-1]
REFERENCE, C1, C2 = 20.0, 8.9, 145.0  # [°C], [1], [K]
# Friction is one function of the load [N] times this power of the speed [mm/s] at the reference temperature.
BY_SPEED = -0.6


def shift(celsius):
    """a_T of the rubber, 1 at REFERENCE."""
    return 10 ** (-C1 * (celsius - REFERENCE) / (C2 + celsius - REFERENCE))


def comma(number, form):
    """A number with a decimal comma."""
    return format(number, form).replace(".", ",")


def rheometer() -> str:
    """Storage and loss modulus in shear at four temperatures: metadata, a line of units, decimal commas, tabs."""
    noise = np.random.default_rng(1)
    solid = Prony(1e6 * REST, 1e6 * np.array(MODULI), TIMES)
    lines = [
        *("Filename\ttread 7 frequency sweep.tri", "Instrument name\tRheometer 2", "Operator\tA. N. Other"),
        *("Sample name\ttread compound, batch 7", "Geometry name\t8 mm parallel plate", "Gap\t1,85 mm", ""),
        *("[step]", "Frequency sweep - 1"),
        "Frequency\tTemperature\tStorage modulus\tLoss modulus\tTan(delta)\tOscillation strain",
        "Hz\t°C\tMPa\tMPa\t\t%",
    ]
    for celsius in (0, 20, 40, 60):
        for frequency in np.geomspace(0.1, 50, 10):
            modulus = solid.complex_modulus(2 * np.pi * frequency * shift(celsius)) / 1e6
            storage, loss = np.array([modulus.real, modulus.imag]) * (1 + 0.01 * noise.standard_normal(2))
            row = ((frequency, ".4g"), (celsius + 0.05 * noise.standard_normal(), ".2f"), (storage, ".4f"))
            row = *row, (loss, ".4f"), (loss / storage, ".4f"), (0.1, ".3f")
            lines.append("\t".join(comma(*cell) for cell in row))
    return "\n".join(lines) + "\n"


def rough(shape, side, hurst, rms, rolloff, seed):
    """Periodic self-affine heights of a shape, of a rms, flat above a wavelength `rolloff`, over a side."""
    noise = np.random.default_rng(seed).standard_normal(shape)
    waves = np.meshgrid(*(np.fft.fftfreq(n, side / n) for n in shape), indexing="ij")
    q = np.sqrt(sum(np.square(each) for each in waves))
    q = np.where(q, np.maximum(q, 1 / rolloff), np.inf)
    heights = np.fft.ifftn(np.fft.fftn(noise) * q ** (-hurst - len(shape) / 2)).real
    return rms * heights / heights.std()


def gwyddion() -> str:
    """A map of 48 x 48 heights as Gwyddion exports text, on a tilt, with seven pixels that were not measured."""
    rows = columns = 48
    heights = rough((rows, columns), 50e-6, 0.8, 0.30e-6, 15e-6, seed=2)
    heights += 1.2e-6 * np.linspace(-1, 1, columns)[None, :] + 0.4e-6 * np.linspace(-1, 1, rows)[:, None]
    cells = [[f"{height:.4e}" for height in row] for row in heights]
    for row, column in ((11, 30), (11, 31), (12, 30), (12, 31), (13, 31), (35, 7), (36, 7)):
        cells[row][column] = "nan"
    heading = ["# Channel: Topography", "# Width: 50.00 µm", "# Height: 50.00 µm", "# Value units: m"]
    return "\n".join([*heading, *("\t".join(row) for row in cells)]) + "\n"


def stylus() -> str:
    """A line of 800 heights over 4 mm, as a stylus writes it, on a tilt."""
    count = 800
    heights = rough((2 * count,), 8e-3, 0.75, 2.6e-6, 0.8e-3, seed=3)[:count]
    places = np.arange(count) * 5e-3  # [mm]
    heading = ["Profile of batch 7, ground", "Tip radius: 2 µm, cut-off: none", "X [mm];Z [µm]"]
    rows = [f"{comma(x, '.3f')};{comma(1e6 * z + 1.5 * x, '.3f')}" for x, z in zip(places, heights, strict=True)]
    return "\n".join([*heading, *rows]) + "\n"


def tribometer() -> str:
    """Friction force at three temperatures, five speeds and four loads, three times, loads and speeds as met."""
    noise = np.random.default_rng(4)
    lines = ['Run;"Temperature [°C]";"Speed [mm/s]";"Normal force [N]";"Friction force [N]";Remark']
    for celsius in (10, 25, 40):
        for speed in (0.1, 0.3, 1.0, 3.0, 10.0):
            for load in (2.0, 5.0, 10.0, 20.0):
                for _ in range(3):
                    met = np.array([speed, load]) * (1 + 0.003 * noise.standard_normal(2))
                    shifted = met[1] * (shift(celsius) * met[0]) ** BY_SPEED
                    force = met[1] * 0.9 / np.sqrt(1 + (shifted / 4) ** 0.8) * (1 + 0.01 * noise.standard_normal())
                    row = (
                        len(lines),
                        f"{celsius + 0.1 * noise.standard_normal():.1f}",
                        *(f"{x:.4g}" for x in met),
                    )
                    lines.append(";".join(map(str, (*row, f"{force:.4g}", ""))))
    return "\n".join(lines) + "\n"


FILES = {
    "rheometer.txt": rheometer,
    "map.txt": gwyddion,
    "profile.csv": stylus,
    "tribometer.csv": tribometer,
}


BLOCK = re.compile(r"^```(toml|sh|text)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
NAMED = re.compile(r"# (\w+\.toml)\n")  # first line of a file that a page shows
HEAD = " | head -"


def printed(page: Path) -> Iterator[tuple[str, re.Match]]:
    """What each command of a page prints among the files of all, and the block that shows it."""
    command = None
    with TemporaryDirectory() as folder, chdir(folder):
        for name in FILES:
            Path(name).write_bytes((FOLDER / name).read_bytes())
        for block in BLOCK.finditer(page.read_text(encoding="utf-8")):
            kind, text = block.groups()
            if kind == "toml" and (named := NAMED.match(text)):
                Path(named[1]).write_text(text, encoding="utf-8")
            elif kind == "text" and command:
                yield _output(command), block
            command = text.strip() if kind == "sh" else None


def _output(command):
    """Lines that a command prints, of it alone or through `head`."""
    asked, _, most = command.partition(HEAD)
    program, *arguments = shlex.split(asked)
    assert program == "crosscheck", command
    # Pages and figures change nothing of it, and take seconds.
    arguments += ["--no-report"] * (arguments[0] in ("mastercurve", "topography"))
    lines = CliRunner().invoke(app, arguments).output.splitlines(keepends=True)
    return "".join(lines[: int(most)] if most else lines)


def main() -> None:
    """Write the files, and what the commands print."""
    for name, make in FILES.items():
        (FOLDER / name).write_text(make(), encoding="utf-8")
    for page in sorted(FOLDER.glob("*.md")):
        text = page.read_text(encoding="utf-8")
        for output, block in reversed(list(printed(page))):
            text = f"{text[: block.start(2)]}{output.rstrip()}\n{text[block.end(2) :]}"
        page.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
