"""Directions as points of a square (compact.md 3)."""

import math


def with_sign(x, y):
    """s(x, y)."""
    return -y if x < 0 else y


class Square:
    """The points that directions of some bits have (compact.md 3)."""

    def __init__(self, bits):
        self.bits = bits
        self.m = (1 << (bits - 1)) - 1

    def placed(self, u, v):
        u, v = (max(-self.m, min(self.m, c)) for c in (u, v))
        if abs(v) == self.m:
            u = abs(u)
        if abs(u) == self.m:
            v = abs(v)
        return u, v

    def vector(self, u, v):
        z = self.m - abs(u) - abs(v)
        if z >= 0:
            return u, v, z
        return with_sign(u, self.m - abs(v)), with_sign(v, self.m - abs(u)), z

    def unit(self, point):
        vector = [c << (16 - self.bits) for c in self.vector(*point)]
        size = math.isqrt(sum(c * c for c in vector) << 32)
        return [with_sign(c, ((abs(c) << 40) + size // 2) // size) for c in vector]

    def short_unit(self, point):
        return [c >> 9 for c in self.unit(point)]

    def near(self, vector):
        total = sum(map(abs, vector))
        if total == 0:
            return 0, 0
        x, y, z = vector
        u, v = (with_sign(c, (2 * abs(c) * self.m + total) // (2 * total)) for c in (x, y))
        if z >= 0:
            return self.placed(u, v)
        return self.placed(with_sign(x, self.m - abs(v)), with_sign(y, self.m - abs(u)))

    def turned(self, point):
        u, v = point
        return self.placed(with_sign(u, self.m - abs(v)), with_sign(v, self.m - abs(u)))
