"""Numbers and the cells that they lie in (compact.md 3)."""

import math
import struct

from model import require
from run import length
from squares import Square

BOUND = 1 << 23  # a cell is within, not at, ± this

I8, U8, I16, U16, I32, U32, F32, F64 = range(8)  # type of a format
INTEGER_CODES = "bBhHiI"
DIRECTIONS = 1 << 13  # + N: directions of N bits


class FloatCells:
    """Floats in cells of 2^e."""

    def __init__(self, kind, e, exact):
        self.size, self.mantissa, self.lowest, most = {
            F32: (32, 24, -149, 105), F64: (64, 53, -1074, 1001)}[kind]
        require(self.lowest <= e <= most, "K-002")
        self.e = e
        self.exact = exact

    def left(self, c):
        """How many bits the cell leaves."""
        if self.exact:
            return 0
        if c == 0:
            return self.size
        return max(min(self.mantissa - length(abs(c)), self.e - self.lowest), 0)

    def number(self, c, rest=None):
        """The bytes of the number in cell c; rest is what is left of it, None before FINE."""
        bits = self.left(c)
        if c == 0:
            return (rest or 0).to_bytes(self.size // 8, "little")
        if rest is None:
            rest = 1 << (bits - 1) if bits else 0
        return self.encoded(c < 0, abs(c) << bits | rest, self.e - bits)

    def encoded(self, negative, m, exponent):
        """m × 2^exponent as IEEE 754, exact."""
        # A mantissa of full length has its leading one dropped; a denormal one has exponent 0.
        shift = min(self.mantissa - length(m), exponent - self.lowest)
        m <<= shift
        biased = exponent - shift - self.lowest + 1
        if m < 1 << (self.mantissa - 1):
            biased = 0
        sign = int(negative) << (self.size - 1)
        row = sign | biased << (self.mantissa - 1) | m % (1 << (self.mantissa - 1))
        return row.to_bytes(self.size // 8, "little")


class IntegerCells:
    """Integers in cells of 2^e."""

    def __init__(self, kind, e, exact):
        require(0 <= e <= (9 if kind in (I32, U32) else 0), "K-002")
        self.code = INTEGER_CODES[kind]
        self.e = e
        self.exact = exact

    def left(self, c):
        return 0 if self.exact else self.e

    def number(self, c, rest=None):
        bits = self.left(c)
        if rest is None:
            rest = 1 << (bits - 1) if bits else 0
        size = struct.calcsize(self.code)
        return (((c << self.e) + rest) % (1 << 8 * size)).to_bytes(size, "little")


class GridPoints:
    """One axis of positions on the points of an exact grid."""

    exact = True

    def __init__(self, origin, step):
        self.origin = origin
        self.step = step

    def left(self, c):
        return 0

    def number(self, c, rest=None):
        # Python's floats are f64; struct rounds to f32 to nearest, ties to even, but for infinity.
        product = float(self.origin + c) * self.step
        try:
            return struct.pack("<f", product)
        except OverflowError:
            return struct.pack("<f", math.copysign(math.inf, product))


class DirectionComponent:
    """One component of a direction, whose cell is a point of a square."""

    exact = True

    def __init__(self, square, axis):
        self.square = square
        self.axis = axis

    def left(self, point):
        return 0

    def number(self, point, rest=None):
        unit = self.square.unit(self.square.placed(*point))
        return struct.pack("<f", unit[self.axis] / (1 << 24))


class AttributeCells:
    """The cells of a wedge attribute; `number` is that of the field in BASE."""

    def __init__(self, form, number):
        self.bits = number - DIRECTIONS if number >= DIRECTIONS else None  # of a direction
        if self.bits is not None:
            require(form.type == F32 and form.count in (3, 4) and 4 <= self.bits <= 16, "K-002")
            square = Square(self.bits)
            self.kinds = [DirectionComponent(square, axis) for axis in range(3)]
            self.kinds += [FloatCells(F32, 0, True)] * (form.count - 3)
            self.columns = form.count - 1
            return
        z, exact = divmod(number, 2)
        e = z // 2 if z % 2 == 0 else -(z + 1) // 2
        kind = FloatCells if form.type in (F32, F64) else IntegerCells
        self.kinds = [kind(form.type, e, bool(exact))] * form.count
        self.columns = form.count

    def by_component(self, row):
        """(kind, cell) of each component."""
        if self.bits is not None:
            row = [row[:2]] * 3 + list(row[2:])
        return zip(self.kinds, row)


def exponent_of(step):
    """e with 2^e = step, or None."""
    numerator, denominator = step.as_integer_ratio()
    if numerator & (numerator - 1):
        return None
    return length(numerator) - length(denominator)


def of_positions(form, grid):
    """The cells of each axis by the grid of the mesh (M-061)."""
    if grid.step == 0:
        require(form.type in (I8, U8, I16, U16), "M-061")
        return [IntegerCells(form.type, 0, True)] * 3
    require(0 < grid.step < float("inf"), "M-061")
    if form.type in (I32, U32):
        e = exponent_of(grid.step)
        require(e is not None and 0 <= e <= 9 and not any(grid.origin), "M-061")
        require(bool(grid.exact) == (e == 0), "M-061")
        return [IntegerCells(form.type, e, e == 0)] * 3
    if grid.exact:
        require(form.type == F32, "M-061")
        require(all(abs(origin) <= 1 << 29 for origin in grid.origin), "M-061")
        return [GridPoints(origin, grid.step) for origin in grid.origin]
    require(form.type in (F32, F64) and not any(grid.origin), "M-061")
    e = exponent_of(grid.step)
    require(e is not None, "M-061")
    return [FloatCells(form.type, e, False)] * 3
