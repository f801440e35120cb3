"""Products of planes with symbols in Fourier space, by blocks of lines that stay in the cache.

A plane of ny x nx values is transformed along rows, then along columns, and back. Rows of zeros that pad a plane
are never transformed, and columns go block by block, forward, through the symbol and back.
"""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from math import prod
from typing import Literal

import numpy as np
from scipy.fft import next_fast_len, rfft

from . import transforms

SMALL = 2**16  # points of a padded plane that is transformed at once: half a megabyte
POINTS = 2**15  # transformed at a time: half a megabyte of waves
BLOCK = 32  # lines at a time, or a multiple: ducc0 rounds those that are left over otherwise
SHARED = 128  # lines at a time of each of several threads: they wait less for one another


@dataclass(frozen=True)
class Engine:
    """Library, threads and precision with which planes are transformed.

    library : ducc0 or fftw
    threads : that share the blocks of a product
    precision : of the transforms; everything else is computed in double
    """

    library: transforms.Library = "ducc0"
    threads: int = 1
    precision: Literal["double", "single"] = "double"

    @property
    def real(self):
        """Number type of what is transformed."""
        return np.float64 if self.precision == "double" else np.float32

    @property
    def complex(self):
        """Number type of the transforms."""
        return np.complex128 if self.precision == "double" else np.complex64

    def product(self, symbols, shape, padded):
        """The product of a plane with a symbol, or of two with a symmetric matrix of symbols, see `Product`."""
        at_once = self.library == "ducc0" and len(symbols) == 1 and shape[0] <= padded[0] and prod(padded) <= SMALL
        return (SmallProduct if at_once else Product)(symbols, shape, padded, self)

    def symmetric(self, kernel, padded, parity=1):
        """Real symbol (my//2+1, mx//2+1) of a kernel (ny, nx) at 0, 1, ... pixels aside and downstream.

        parity : in y as in x, 1 of what is even and -1 of what is odd
        """
        (ny, nx), zeros = kernel.shape, 0 if parity == 1 else 1
        symbol = np.zeros([size // 2 + 1 for size in padded])
        symbol[:ny, :nx] = parity * kernel
        inside = symbol[tuple(slice(zeros, size - zeros) for size in symbol.shape)]
        transforms.transform_symmetric(inside, parity, [axis for axis in (0, 1) if padded[axis] > 1])
        return symbol

    def transformed(self, kernel, padded):
        """Symbol (my//2+1, mx//2+1) of a kernel (ny, mx), even in y, rows y = 0..ny-1."""
        symbol = np.zeros((padded[0] // 2 + 1, padded[1] // 2 + 1), complex)
        symbol[: len(kernel)] = rfft(kernel)
        if padded[0] > 1:
            transforms.transform_symmetric(symbol.view(float), 1, [0])
        return symbol

    def rows(self, count, length):
        """Transforms of as many of `count` rows, of `length` points, as a thread takes at a time."""
        return transforms.ROWS[self.library](self.blocks(count, length)[0].stop, length, self.real, self.complex)

    def columns(self, count, length):
        """Transforms of as many of `count` columns, of `length` points, as a thread takes at a time."""
        return transforms.COLUMNS[self.library](self.blocks(count, length)[0].stop, length, self.complex)

    def normalized(self, symbol, padded):
        """A symbol over the number of points, in the precision of the transforms and in their order in memory."""
        kind = self.real if np.isrealobj(symbol) else self.complex
        return (symbol / prod(padded)).astype(kind, order=transforms.ORDER[self.library])

    def blocks(self, count, length):
        """Slices of as many lines of `length` points as a thread takes at a time."""
        size = BLOCK if self.threads == 1 else SHARED
        if self.library == "ducc0":  # FFTW transforms a whole block each time, however few lines are left
            size = max(size, POINTS // length // BLOCK * BLOCK)
        return [slice(start, min(start + size, count)) for start in range(0, count, size)]

    def good_size(self, least: int) -> int:
        """An even length of quick transforms, at least `least`."""
        return 2 * next_fast_len(-(-least // 2), real=True)


class Product:
    """Planes times a symmetric matrix of symbols in Fourier space.

    symbols : (s,) for one plane, (xx, xy, yy) for two, unnormalized, (my//2+1, mx//2+1); real or complex; xy is
        odd in q_y, the others are even
    shape, padded : (ny, nx) of a plane and (my, mx) of its transform; my = 1, for one plane, transforms no columns
    """

    def __init__(self, symbols, shape, padded, engine):
        self.shape, self._padded, self._engine = shape, padded, engine
        self._symbols = [engine.normalized(symbol, padded) for symbol in symbols]
        (my, mx), planes = padded, range(1 if len(symbols) == 1 else 2)
        width, threads = mx // 2 + 1, range(engine.threads)
        self._waves = [transforms.spread_rows(shape[0], width, engine.complex) for _ in planes]
        self._rows = [engine.rows(shape[0], mx) for _ in threads]
        self._columns = [[engine.columns(width, my) for _ in planes] for _ in threads] if my > 1 else []
        self._pool = ThreadPoolExecutor(engine.threads) if engine.threads > 1 else None

    def __call__(self, planes, out=None):
        """The product with a plane (ny, nx), or with two (2, ny, nx)."""
        out = np.empty(planes.shape) if out is None else out
        given, images = ([each] if each.ndim == 2 else each for each in (planes, out))

        def forward(rows, block):
            for plane, waves in zip(given, self._waves, strict=True):
                rows.forward(plane[block], waves[block])

        def backward(rows, block):
            for waves, image in zip(self._waves, images, strict=True):
                rows.backward(waves[block], image[block])

        (my, mx), ny = self._padded, self.shape[0]
        self._share(self._engine.blocks(ny, mx), self._rows, forward)
        if self._columns:
            self._share(self._engine.blocks(mx // 2 + 1, my), self._columns, self._along_columns)
        else:
            self._waves[0] *= self._symbols[0]
        self._share(self._engine.blocks(ny, mx), self._rows, backward)
        return out

    def _share(self, blocks, transforms, work):
        """Call work(transforms, block) for all blocks of lines, each thread with its own transforms."""

        def run(thread):
            for block in blocks[thread :: self._engine.threads]:
                work(transforms[thread], block)

        if self._pool is None:
            run(0)
        else:
            list(self._pool.map(run, range(self._engine.threads)))

    def _along_columns(self, columns, block):
        """Multiply a block of columns by the symbols, while it is in the cache."""
        given, half = [waves[:, block] for waves in self._waves], self._padded[0] // 2 + 1
        waves = [each.forward(lines) for each, lines in zip(columns, given, strict=True)]
        mirrored = slice(self._padded[0] - half, 0, -1)  # rows of q_y < 0
        for part, rows, sign in ((slice(half), slice(half), 1), (slice(half, None), mirrored, -1)):
            if len(waves) == 1:
                waves[0][part] *= self._symbols[0][rows, block]
                continue
            (x, y), (xx, xy, yy) = (each[part] for each in waves), (each[rows, block] for each in self._symbols)
            across = sign * xy
            x[:], y[:] = xx * x + across * y, across * x + yy * y
        for each, transformed, lines in zip(columns, waves, given, strict=True):
            each.backward(transformed, lines)


class SmallProduct:
    """The product of a plane that stays in the cache: one transform each way, up to three times faster."""

    def __init__(self, symbols, shape, padded, engine):
        self.shape, (symbol,) = shape, symbols
        self._plane = transforms.Plane(padded, engine.real, engine.complex)
        rows = np.minimum(np.arange(padded[0]), padded[0] - np.arange(padded[0]))
        self._symbol = engine.normalized(symbol, padded)[rows]

    def __call__(self, plane, out=None):
        """The product with a plane (ny, nx)."""
        ny, nx = self.shape
        waves = self._plane.forward(plane)
        waves *= self._symbol
        image = self._plane.backward(waves)[:ny, :nx]
        if out is None:
            return image.astype(float)
        out[:] = image
        return out
