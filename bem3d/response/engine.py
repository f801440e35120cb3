"""Engines, which transform arrays: the only door to the Fourier transforms.

A plane of ny x nx values is convolved as rows, then columns, then rows again. Rows of zeros that pad a plane
are never transformed, and columns go block by block, forward, through the symbol and back, while in the cache.
"""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from math import prod
from typing import Literal

import numpy as np

Library = Literal["ducc0", "fftw"]
SMALL = 2**16  # points of a padded plane that is transformed at once: half a megabyte
BLOCK = 32  # lines transformed at a time: half a megabyte at 512 points, padded
SHARED = 128  # lines at a time of each of several threads: they wait less for one another


@dataclass(frozen=True)
class Engine:
    """library : ducc0 or fftw
    threads : that share the blocks of a product
    precision : of the transforms; everything else is computed in double
    """

    library: Library = "ducc0"
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

    def product(self, symbol, shape, padded):
        """The product with a symbol in Fourier space: callable, plane (ny, nx) -> plane, `out` optional.

        symbol : (my//2+1, mx//2+1), real or complex, unnormalized; even in q_y
        shape, padded : (ny, nx) and (my, mx); my = 1 multiplies row by row
        """
        if self.library == "ducc0" and shape[0] <= padded[0] and prod(padded) <= SMALL:
            return SmallPlane(symbol, shape, padded, self)
        return Blocked(symbol, shape, padded, self)

    def pair(self, symbols, shape, padded):
        """The product of two planes with a symmetric matrix of symbols: callable, (2, ny, nx) -> (2, ny, nx).

        symbols : xx, xy, yy (my//2+1, mx//2+1), real, unnormalized; xx and yy even in q_y, xy odd
        shape, padded : as in `product`, my > 1
        """
        return BlockedPair(symbols, shape, padded, self)

    def symmetric(self, kernel, padded, parity=1):
        """Real symbol (my//2+1, mx//2+1) of a kernel (ny, nx) at 0, 1, ... pixels aside and downstream.

        parity : in y as in x, 1 of what is even and -1 of what is odd
        """
        import ducc0

        (ny, nx), (transform, zeros) = kernel.shape, ((ducc0.fft.dct, 0) if parity == 1 else (ducc0.fft.dst, 1))
        symbol = np.zeros([size // 2 + 1 for size in padded])
        symbol[:ny, :nx] = parity * kernel
        inside = symbol[tuple(slice(zeros, size - zeros) for size in symbol.shape)]
        transform(inside, type=1, axes=[axis for axis in (0, 1) if padded[axis] > 1], out=inside)
        return symbol

    def transformed(self, kernel, padded):
        """Symbol (my//2+1, mx//2+1) of a kernel (ny, mx), even in y, rows y = 0..ny-1."""
        (ny, mx), my = kernel.shape, padded[0]
        rows, columns = _DOUBLE.lines(ny, mx, real=True), _DOUBLE.lines(mx // 2 + 1, my, real=False)
        waves = np.empty((ny, mx // 2 + 1), complex)
        for block in _DOUBLE.blocks(ny):
            waves[block] = rows.forward(kernel[block])
        symbol = np.empty((my // 2 + 1, mx // 2 + 1), complex)
        for block in _DOUBLE.blocks(mx // 2 + 1):
            whole = np.zeros((waves[:, block].shape[1], my), complex)
            whole[:, :ny] = waves[:, block].T
            whole[:, my - ny + 1 :] = whole[:, ny - 1 : 0 : -1]
            symbol[:, block] = columns.forward(whole)[:, : my // 2 + 1].T
        return symbol

    def lines(self, count, length, real):
        """Transforms of a block of `count` lines at a time, of `length` points."""
        block = self.blocks(count)[0]
        return {"ducc0": _Ducc, "fftw": _Fftw}[self.library](block.stop, length, self, real)

    def blocks(self, count):
        """Slices of as many lines as a thread takes at a time."""
        size = BLOCK if self.threads == 1 else SHARED
        return [slice(start, min(start + size, count)) for start in range(0, count, size)]

    def good_size(self, least: int) -> int:
        """An even length of quick transforms, at least `least`."""
        size = 2 * -(-least // 2)
        while _remainder(size // 2) > 1:
            size += 2
        return size


_DOUBLE = Engine()


def _remainder(size):
    """Factor of a number that is left without its factors 2, 3 and 5."""
    for factor in (2, 3, 5):
        while size % factor == 0:
            size //= factor
    return size


class SmallPlane:
    """The product with one symbol, of a plane that stays in the cache: one transform each way, by ducc0."""

    def __init__(self, symbol, shape, padded, engine):
        import ducc0  # on demand, as each library is

        self.shape, self._padded, self._fft = shape, padded, ducc0.fft
        rows = np.minimum(np.arange(padded[0]), padded[0] - np.arange(padded[0]))
        kind = engine.real if np.isrealobj(symbol) else engine.complex
        self._symbol = (symbol[rows] / prod(padded)).astype(kind)
        self._points, self._image = np.zeros(padded, engine.real), np.empty(padded, engine.real)
        self._waves = np.empty((padded[0], padded[1] // 2 + 1), engine.complex)

    def __call__(self, plane, out=None):
        """The product (ny, nx)."""
        (ny, nx), waves, image = self.shape, self._waves, self._image
        self._points[:ny, :nx] = plane
        self._fft.r2c(self._points, axes=(0, 1), out=waves)
        waves *= self._symbol
        self._fft.c2r(waves, axes=(0, 1), lastsize=self._padded[1], forward=False, out=image)
        if out is None:
            return image[:ny, :nx].astype(float)
        out[:] = image[:ny, :nx]
        return out


class _ByBlocks:
    """Planes through symbols row by row and column by column, each block of columns while it is in the cache.

    planes : how many at a time
    """

    def __init__(self, symbols, planes, shape, padded, engine):
        self.shape, self._padded = shape, padded
        ny, (my, mx) = shape[0], padded
        width = mx // 2 + 1
        self._symbols = [self._laid_out(symbol, engine) for symbol in symbols]
        self._waves = [_staggered(ny, width, engine.complex) for _ in range(planes)]
        self._engine = engine
        self._pool = ThreadPoolExecutor(engine.threads) if engine.threads > 1 else None
        self._rows = [engine.lines(ny, mx, real=True) for _ in range(engine.threads)]
        self._columns = [
            [engine.lines(width, my, real=False) for _ in range(planes)] if my > 1 else []
            for _ in range(engine.threads)
        ]

    def _laid_out(self, symbol, engine):
        """Along columns, and with what transforms there and back multiply by."""
        kind = engine.real if np.isrealobj(symbol) else engine.complex
        return np.ascontiguousarray((symbol / np.prod(self._padded)).T.astype(kind))

    def _shared(self, count, lines, work):
        """work(block, lines) on all blocks of so many lines; each thread has lines of its own."""

        def of_one(thread):
            for block in self._engine.blocks(count)[thread :: self._engine.threads]:
                work(block, lines[thread])

        if self._pool is None:
            of_one(0)
        else:
            list(self._pool.map(of_one, range(self._engine.threads)))

    def _along_rows(self, plane, waves):
        def forward(rows, lines):
            waves[rows] = lines.forward(plane[rows])

        self._shared(self.shape[0], self._rows, forward)

    def _back_along_rows(self, waves, out):
        def backward(rows, lines):
            out[rows] = lines.backward(waves[rows])[:, : self.shape[1]]

        self._shared(self.shape[0], self._rows, backward)


class Blocked(_ByBlocks):
    """The product with one symbol."""

    def __init__(self, symbol, shape, padded, engine):
        super().__init__([symbol], 1, shape, padded, engine)

    def __call__(self, plane, out=None):
        """The product (ny, nx)."""
        (waves,), out = self._waves, np.empty(self.shape) if out is None else out
        self._along_rows(plane, waves)
        if self._padded[0] > 1:
            self._through_columns()
        else:
            waves *= self._symbols[0].T
        self._back_along_rows(waves, out)
        return out

    def _through_columns(self):
        ny, half = self.shape[0], self._padded[0] // 2 + 1
        mirrored = self._padded[0] - half  # rows of q_y < 0
        (waves,) = self._waves

        def through(columns, lines):
            symbol, (lines,) = self._symbols[0][columns], lines
            block = lines.forward(waves[:, columns].T)
            block[:, :half] *= symbol
            block[:, half:] *= symbol[:, mirrored:0:-1]
            waves[:, columns] = lines.backward(block)[:, :ny].T

        self._shared(waves.shape[1], self._columns, through)


class BlockedPair(_ByBlocks):
    """The product of two planes with a matrix of symbols: four transforms of half a plane, and not eight."""

    def __init__(self, symbols, shape, padded, engine):
        super().__init__(symbols, 2, shape, padded, engine)

    def __call__(self, planes, out=None):
        """The product (2, ny, nx)."""
        out = np.empty((2, *self.shape)) if out is None else out
        for plane, waves in zip(planes, self._waves, strict=True):
            self._along_rows(plane, waves)
        self._through_columns()
        for waves, image in zip(self._waves, out, strict=True):
            self._back_along_rows(waves, image)
        return out

    def _through_columns(self):
        ny, half = self.shape[0], self._padded[0] // 2 + 1
        mirrored = slice(self._padded[0] - half, 0, -1)  # rows of q_y < 0

        def through(columns, lines):
            blocks = [of.forward(waves[:, columns].T) for of, waves in zip(lines, self._waves, strict=True)]
            xx, xy, yy = (symbol[columns] for symbol in self._symbols)
            for part, rows, sign in ((slice(half), slice(half), 1), (slice(half, None), mirrored, -1)):
                x, y = (block[:, part] for block in blocks)
                across = sign * xy[:, rows]
                x[:], y[:] = xx[:, rows] * x + across * y, across * x + yy[:, rows] * y
            for block, of, waves in zip(blocks, lines, self._waves, strict=True):
                waves[:, columns] = of.backward(block)[:, :ny].T

        self._shared(self._waves[0].shape[1], self._columns, through)


def _staggered(count, length, kind):
    """Rows a little wider than needed: of a power of two, all would share the same lines of the cache."""
    return np.zeros((count, length + 8), kind)[:, :length]


class _Ducc:
    """`count` lines of `length` points by ducc0, which plans nothing."""

    def __init__(self, count, length, engine, real):
        import ducc0  # on demand, as each library is

        self._fft = ducc0.fft
        self._real, self._length = real, length
        self._points = _staggered(count, length, engine.real if real else engine.complex)
        self._waves = _staggered(count, length // 2 + 1, engine.complex) if real else self._points

    def forward(self, values):
        """Waves of lines of values, zeros behind them."""
        count, given = values.shape
        points, waves = self._points[:count], self._waves[:count]
        points[:, :given], points[:, given:] = values, 0
        transform = self._fft.r2c if self._real else self._fft.c2c
        return transform(points, axes=(1,), forward=True, out=waves)

    def backward(self, waves):
        """Points of lines of waves, unnormalized."""
        points = self._points[: len(waves)]
        options = {"axes": (1,), "forward": False, "out": points}
        if self._real:
            return self._fft.c2r(waves, lastsize=self._length, **options)
        return self._fft.c2c(waves, **options)


class _Fftw:
    """`count` lines of `length` points by FFTW, which plans each length once and then remembers it."""

    def __init__(self, count, length, engine, real):
        import pyfftw as fftw

        self._points = fftw.zeros_aligned((count, length), engine.real if real else engine.complex)
        self._waves = fftw.empty_aligned((count, length // 2 + 1), engine.complex) if real else self._points
        plan = {"axes": (1,), "flags": ("FFTW_MEASURE", "FFTW_DESTROY_INPUT")}
        self._forward = fftw.FFTW(self._points, self._waves, **plan)
        self._backward = fftw.FFTW(self._waves, self._points, direction="FFTW_BACKWARD", **plan)

    def forward(self, values):
        """Waves of lines of values, zeros behind them."""
        count, given = values.shape
        self._points[:count, :given], self._points[:count, given:] = values, 0
        self._forward.execute()
        return self._waves[:count]

    def backward(self, waves):
        """Points of lines of waves, unnormalized."""
        if not np.may_share_memory(waves, self._waves):
            self._waves[: len(waves)] = waves
        self._backward.execute()
        return self._points[: len(waves)]
