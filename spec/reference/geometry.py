"""Which chord splits a ring, and where the new vertex lies (compact.md 6.2 and 6.3)."""

import dataclasses

import tables
from cells import BOUND
from model import OPTIMAL, require
from run import Models, ScaledNumberModel, SymbolModel, half_steps, length, toward_zero
from stars import ABSENT

AXES = range(3)
CLOSED, OPEN, NO_RING = range(3)
LONG_FORM = 15
MOST_WEIGHT = 16383


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def added(vectors):
    return [sum(components) for components in zip([0, 0, 0], *vectors)]


def reciprocal(c):
    """R(c)."""
    return (1 << 16) // c


def chord_class(x, y):
    """k(x, y)."""
    return min(max(x - y + 20, 0), tables.CLASSES - 1)


def exponential(y):
    """P(y)."""
    q, z = y >> 11, (1 << 11) - y % (1 << 11)
    if q > 15:
        return 0
    return ((1 << 15) + (z * (21547 + (z * 11221 >> 11)) >> 11)) >> (q + 1)


@dataclasses.dataclass
class Side:
    """The places from one end of a chord to the other, absent ones aside."""

    sum: list  # of arms
    count: int
    lengths: int  # sum


class Surroundings:
    """What the neighbours of a vertex say: arms and their means."""

    def __init__(self, ring, vertex, position):
        self.ring = ring
        self.places = ring.places
        self.s = len(ring.places)
        centre = position[vertex]
        self.arms = [[0, 0, 0] if place.vertex is ABSENT
                     else [position[place.vertex][k] - centre[k] for k in AXES]
                     for place in ring.places]
        self.lengths = [half_steps(dot(arm, arm)) for arm in self.arms]
        n = half_steps(sum(place.vertex is not ABSENT for place in ring.places))
        self.mean = max(half_steps(sum(dot(arm, arm) for arm in self.arms)) - n, 0)

    def side(self, i, j):
        """From place i to place j."""
        places = [(i + d) % self.s for d in range((j - i) % self.s + 1)]
        there = [place for place in places if self.places[place].vertex is not ABSENT]
        return Side(added(self.arms[place] for place in there), len(there),
                    sum(self.lengths[place] for place in there))


class Chords:
    """The chord of a split and the weights by which it is chosen (compact.md 6.2)."""

    def __init__(self, placement):
        self.placement = placement
        self.span = Models(SymbolModel)
        self.weights = tables.chord_weights(placement)

    def read_chord(self, run, around, stars, turns):
        """The places (i, j) of the chord; None: long form. Without a ring around is None."""
        kind, s = NO_RING, 0
        if around is not None:
            kind, s = OPEN if around.ring.open else CLOSED, around.s
        n = self.span[kind, min(s, 23)].read(run)
        if n == LONG_FORM or n + 1 >= s:
            return None
        half = self.placement == OPTIMAL and 2 * (n + 1) == s
        chords = [(i, (i + n + 1) % s) for i in range(s // 2 if half else s)]
        chosen, shares = self.choose(run, around, stars, turns, chords)
        i, j = chords[chosen]
        if half and number_of(around.places[i]) > number_of(around.places[j]):
            i, j = j, i
        return i, j

    def choose(self, run, around, stars, turns, chords):
        at_ends = [self.classes_at_end(around, stars, turns, place) for place in range(around.s)]
        of_sides = [self.classes_of_sides(around, i, j) for i, j in chords]
        sums = []
        for (i, j), classes in zip(chords, of_sides):
            nine = classes + at_ends[i] + at_ends[j]
            sums.append(sum(self.weights[kind][number] for kind, number in nine))
        best = max(sums)
        chosen, shares = run.choice([exponential(best - b) for b in sums])
        self.learn(chords, of_sides, at_ends, chosen, shares)
        return chosen, shares

    def classes_at_end(self, around, stars, turns, place):
        """(kind, class) of kinds 0, 4 and 5."""
        vertex = around.places[place].vertex
        if vertex is ABSENT:
            return [(0, 23), (4, 23), (5, 23)]
        return [(0, min(chord_class(around.lengths[place], around.mean), 22)),
                (4, min(len(stars.star[vertex]), 22)),
                (5, turns.of(vertex))]

    def classes_of_sides(self, around, i, j):
        """(kind, class) of kinds 1, 2 and 3."""
        near, far = around.side(i, j), around.side(j, i)
        out = []
        for kind, side in ((1, near), (2, far)):
            size = half_steps(dot(side.sum, side.sum)) - half_steps(side.count**2)
            out.append((kind, chord_class(size, around.mean)))
        mean = (2 * near.lengths * (reciprocal(near.count) + 1) >> 16) - 4
        return out + [(3, chord_class(mean, 2 * around.mean))]

    def learn(self, chords, of_sides, at_ends, chosen, shares):
        """*Learning*."""
        at_place = [0] * len(at_ends)
        for c, (i, j) in enumerate(chords):
            d = ((1 << 15) if c == chosen else 0) - shares[c]
            at_place[i] += d
            at_place[j] += d
            self.change(of_sides[c], d)
        for classes, d in zip(at_ends, at_place):
            self.change(classes, d)

    def change(self, classes, d):
        for kind, number in classes:
            weight = self.weights[kind][number] + ((d + (1 << 8)) >> 9)
            self.weights[kind][number] = min(max(weight, -MOST_WEIGHT), MOST_WEIGHT)


def number_of(place):
    return float("inf") if place.vertex is ABSENT else place.vertex


class Spread:
    """How far the near side's places and the vertex itself lie apart along two axes."""

    def __init__(self, around, i, j, after, before):
        near = around.side(i, j)
        places = [(i + d) % around.s for d in range((j - i) % around.s + 1)]
        self.n = near.count + 1

        def moment(k, m):
            products = sum(around.arms[place][k] * around.arms[place][m] for place in places)
            return self.n * products - near.sum[k] * near.sum[m]

        a, b, c = moment(after, after), moment(after, before), moment(before, before)
        self.first = self.size(a, 0)
        r = max(length(max(a, c)) - 40, 0)
        a, b, c = a >> r, b >> r, c >> r
        self.slope = min(max(toward_zero(179 * b, max(a, 1)), -4096), 4096)
        self.second = self.size(max(c - (self.slope * b >> 8), 1), r)

    def size(self, square, r):
        return max(half_steps(square) + 2 * r - half_steps(self.n**2), 0)


def predictions(placement, around, i, j):
    """t and g."""
    near, far = around.side(i, j), around.side(j, i)
    ends = [place for place in (i, j) if around.places[place].vertex is not ABSENT]
    sums = [(added(around.arms[place] for place in ends), len(ends)),
            (near.sum, near.count), (far.sum, far.count)]
    means = [[component * reciprocal(c) >> 12 for component in total] for total, c in sums]
    places = (j - i) % around.s
    weights = tables.step_weights(placement, places, around.s - places, around.ring.open)
    t = [sum(weights[m] * means[m][k] for m in range(3)) for k in AXES]
    g = [sum(weights[3 + m] * means[m][k] for m in range(3)) >> 12 for k in AXES]
    return t, g


class Steps:
    """The step from the other vertex to the new one (compact.md 6.3)."""

    def __init__(self, placement):
        self.placement = placement
        self.models = [ScaledNumberModel() for _ in range(3)]
        self.height_errors = {}  # of vertices; 0 where there is none

    def read(self, run, around, vertex, new, i, j, mixed=None):
        """mixed: the models of the effort small."""
        bent = self.error_around(around)
        reader = mixed.step_reader(around, vertex, i, j, bent) if mixed else None

        def off(nth, axis, guess, size):
            if reader:
                return reader.read_along(run, nth, axis, guess, size)
            return self.models[nth].read(run, size)

        t, g = predictions(self.placement, around, i, j)
        plain = [(t[k] + (1 << 15)) >> 16 for k in AXES]
        normal, up = self.normal(around, i, j)
        after, before = (up + 1) % 3, (up + 2) % 3
        step = [0, 0, 0]
        spread = Spread(around, i, j, after, before)
        first = off(0, after, plain[after], spread.first)
        step[after] = plain[after] + first
        guess = plain[before] + ((spread.slope * first + 128) >> 8)
        step[before] = guess + off(1, before, guess, spread.second)
        h = plain[up]
        if normal[up] != 0:
            y = dot(normal, g) - 16 * (normal[after] * step[after] + normal[before] * step[before])
            half = 8 * normal[up]
            h = toward_zero(y + half if y >= 0 else y - half, 16 * normal[up])
            if abs(h) >= BOUND:
                h = 0
        d = (reader.read_above(run) if reader
             else self.models[2].read(run, (around.mean + bent) // 2))
        step[up] = h + d
        error = (self.height_errors.get(vertex, 0) + half_steps(4 * d * d) + 1) // 2
        self.height_errors[vertex] = self.height_errors[new] = error
        return step

    def start_with_error_of(self, vertex, new):
        """In the long form the height error of the vertex stays."""
        self.height_errors[new] = self.height_errors.get(vertex, 0)

    def normal(self, around, i, j):
        """The normal, turned and reduced, and the axis up."""
        places = range(around.s)
        if self.placement != OPTIMAL:
            places = [(i + d) % around.s for d in range((j - i) % around.s)]
        normal = added(cross(around.arms[place], around.arms[(place + 1) % around.s])
                       for place in places if around.places[place].corner is not None)
        up = max(AXES, key=lambda k: abs(normal[k]))
        if normal[up] < 0:
            normal = [-component for component in normal]
        excess = max(length(normal[up]) - 15, 0)
        return [component >> excess for component in normal], up

    def error_around(self, around):
        errors = [self.height_errors.get(place.vertex, 0) for place in around.places
                  if place.vertex is not ABSENT]
        return sum(errors) // len(errors)


def place_split(placement, position, vertex, step):
    """(position of the new vertex, of the other one after the split), K-007."""
    require(all(abs(component) <= 2 * (BOUND - 1) for component in step), "K-007")
    other = position[vertex]
    if placement == OPTIMAL:
        other = tuple(other[k] - (step[k] >> 1) for k in AXES)
    new = tuple(other[k] + step[k] for k in AXES)
    require(all(abs(c) < BOUND for c in (*other, *new)), "K-007")
    return new, other
