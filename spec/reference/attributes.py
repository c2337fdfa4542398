"""The attributes of a wedge among others (compact.md 7.3)."""

from cells import BOUND
from run import Models, ScaledNumberModel, SymbolModel, half_steps, length, toward_zero
from squares import Square

AXES = range(3)
MOST_NEIGHBOURS = 16
MOST_FACES = 64
MOST_LIKELY = 15


def bounded(cell):
    """The cell nearest to a number."""
    return max(-BOUND + 1, min(BOUND - 1, cell))


def distance(p, q):
    return half_steps(4 * ((p[0] - q[0]) ** 2 + (p[1] - q[1]) ** 2))


class WedgeSurroundings:
    """Neighbours of a wedge and the faces that show it."""

    def __init__(self, place):
        self.place = place  # the position of its vertex
        self.neighbours = []
        self.faces = []  # the arms of the corners that follow and precede

    def add_neighbour(self, wedge):
        if wedge not in self.neighbours and len(self.neighbours) < MOST_NEIGHBOURS:
            self.neighbours.append(wedge)

    def add_face(self, following, preceding, place=None):
        """Both are positions; place is that of q, if it is not the wedge's."""
        place = place or self.place
        self.faces.append([[there[k] - place[k] for k in AXES] for there in (following, preceding)])

    def normal(self):
        total = [0, 0, 0]
        for a, b in self.faces[:MOST_FACES]:
            for k in AXES:
                i, j = (k + 1) % 3, (k + 2) % 3
                total[k] += a[i] * b[j] - a[j] * b[i]
        excess = max(length(max(map(abs, total))) - 24, 0)
        return [c >> excess for c in total]


class Plane:
    def __init__(self, arms, up):
        self.c = len(arms)
        axes = ((up + 1) % 3, (up + 2) % 3)
        sides = [[arm[axis] for arm in arms] for axis in axes]
        excess = max(length(max([abs(x) for side in sides for x in side], default=0)) - 9, 0)
        sides = [[x >> excess for x in side] for side in sides]
        means = [toward_zero(sum(side), self.c or 1) for side in sides]
        alpha, beta = means
        self.a, self.b = ([x - mean for x in side] for side, mean in zip(sides, means))
        aa, bb = sum(x * x for x in self.a), sum(x * x for x in self.b)
        r = (aa + bb) // 32 + 1
        aa, bb, ab = aa + r, bb + r, sum(x * y for x, y in zip(self.a, self.b))
        d = aa * bb - ab * ab
        places = list(zip(self.a, self.b))
        self.share = [(1 << 14) // self.c
                      + toward_zero(((ab * beta - bb * alpha) * a + (ab * alpha - aa * beta) * b) << 14, d)
                      for a, b in places]
        self.slope_a = [toward_zero((bb * a - ab * b) << 14, d) for a, b in places]
        self.slope_b = [toward_zero((aa * b - ab * a) << 14, d) for a, b in places]

    def read(self, values):
        """(guess, miss) for what the neighbours have."""
        if not values:
            return 0, 0
        f = [value - values[0] for value in values]
        guess = values[0] + ((total(self.share, f) + (1 << 13)) >> 14)
        along_a, along_b = total(self.slope_a, f), total(self.slope_b, f)
        mean = toward_zero(sum(f), self.c)
        miss = 0
        for i in range(self.c):
            off = f[i] - mean - ((along_a * self.a[i] + along_b * self.b[i]) >> 14)
            miss += max(-1 << 28, min(1 << 28, off)) ** 2
        return guess, miss // self.c


def total(a, b):
    return sum(x * y for x, y in zip(a, b))


class AttributeModels:
    """Of a mesh, from its base on."""

    def __init__(self, attributes):
        self.same = Models(SymbolModel)
        self.before = [0] * attributes
        self.distances = [[0, 0, 0] for _ in range(attributes)]
        self.cell = Models(ScaledNumberModel)


class AttributeReader:
    """Reads the cells of wedges."""

    def __init__(self, layout, models, run):
        self.layout = layout  # for each attribute (columns, bits of a square or None)
        self.models, self.run = models, run

    def read(self, around, siblings, cells_of, position_of):
        """The cells of a wedge; siblings in their order, all by their numbers."""
        near = around.neighbours
        arms = [[position_of(wedge)[k] - around.place[k] for k in AXES] for wedge in near]
        normal = around.normal()
        plane = Plane(arms, max(AXES, key=lambda k: abs(normal[k])))
        out = []
        for number, (columns, bits) in enumerate(self.layout):
            these = range(len(out), len(out) + columns)
            known = self.read_same(number, these, siblings, near, cells_of)
            if known is not None:
                out += known
                continue
            rest = these
            if bits is not None:
                points = [cells_of(wedge)[these[0] : these[0] + 2] for wedge in near]
                out += self.read_direction(number, these[0], Square(bits), points, plane, normal)
                rest = these[2:]
            for k in rest:
                guess, miss = plane.read([cells_of(wedge)[k] for wedge in near])
                number_read = self.models.cell[k].read(self.run, half_steps(4 * miss))
                out.append(bounded(bounded(guess) + number_read))
        return tuple(out)

    def read_same(self, number, these, siblings, near, cells_of):
        """The cells of the attribute, if another wedge has them."""
        likely = []

        def add(wedges):
            for wedge in wedges:
                cells = [cells_of(wedge)[k] for k in these]
                if cells not in likely and len(likely) < MOST_LIKELY:
                    likely.append(cells)

        add(siblings)
        of_siblings = len(likely)
        add(near)
        if not likely:
            return None
        context = (number, min(of_siblings, 3), alike(len(likely) - of_siblings, len(near)),
                   self.models.before[number])
        symbol = self.models.same[context].read(self.run)
        self.models.before[number] = 0 if symbol == 15 else 1 if symbol < of_siblings else 2
        return likely[symbol] if symbol < len(likely) else None

    def read_direction(self, number, k, square, points, plane, normal):
        units = [square.short_unit(square.placed(*point)) for point in points]
        g = [plane.read([unit[axis] for unit in units])[0] for axis in AXES]
        first = square.near(normal if any(normal) else g)
        second = square.near(g) if any(g) else first
        both = [x + y for x, y in zip(square.short_unit(first), g)]
        guesses = [first, second, square.near(both)]
        distances = self.models.distances[number]
        best = distances.index(min(distances))
        turns = abs(guesses[best][0]) + abs(guesses[best][1]) > square.m
        if turns:
            guesses = [square.turned(point) for point in guesses]
        size = distance(guesses[0], guesses[1])
        u, v = (guesses[best][i] + self.models.cell[k + i].read(self.run, size) for i in (0, 1))
        point = square.placed(u, v)
        for i in range(3):
            distances[i] += (256 * distance(point, guesses[i]) - distances[i]) >> 5
        return square.turned(point) if turns else point


def alike(d, c):
    """How far c neighbours agree, of which d are likely wedges."""
    if d == 0:
        return 0
    if d == c:
        return 1
    return 2 if 2 * d > c else 3 if d > 1 else 4
