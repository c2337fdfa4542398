"""Batches with the effort small (compact.md 6.6)."""

import tables
from geometry import (AXES, Surroundings, added, chord_class, cross, dot, exponential, number_of,
                      predictions, reciprocal)
from model import OPTIMAL
from run import SHARES, BitModel, Models, half_steps, length, read_second_and_third
from stars import ABSENT

MOST_ODDS = 2047
MOST_SIDE = 15
MOST_WEIGHT = 32767
ENDS, NEAR, FAR, LENGTH, FACES, TURNS, BENDS, ANGLES, TO_ENDS, INNER, NEAREST, FARTHEST, AREAS, \
    SIZES = range(14)
PASSED = 2
RECENT = 1


def within(x, low, high):
    return min(max(x, low), high)


def probability(odds):
    """L(o)."""
    i, part = divmod(odds + 2048, 128)
    knots = tables.knots()
    return (knots[i] * (128 - part) + knots[i + 1] * part + 64) // 128


def odds_of_probabilities():
    """S(p) for p from 0 to 4095."""
    odds = -MOST_ODDS
    for p in range(4096):
        while odds < MOST_ODDS and probability(odds) < 8 * p + 4:
            odds += 1
        yield odds


ODDS = list(odds_of_probabilities())


class Counter:
    def __init__(self):
        self.z, self.m = 1 << 15, 0

    def odds(self):
        return ODDS[self.z >> 4] * (256 * self.m // (self.m + 2)) >> 8

    def learn(self, bit, guess):
        if self.m == 0:
            self.z = within(2 * guess, 64, 65535 - 64)
        r = (1 << 17) // (2 * self.m + 6)
        self.z += ((65535 if bit else 0) - self.z) * r >> 16
        self.m = min(self.m + 1, 120)


class Mixer:
    """Weights for each of two circumstances."""

    def __init__(self, counters):
        self.weights = [Models(lambda: [20480] * (counters + 1)) for _ in range(2)]

    def read(self, run, counters, *circumstances):
        odds = [counter.odds() for counter in counters] + [256]
        weights = [self.weights[k][circumstances[k]] for k in range(2)]
        sums = [within(dot(w, odds) >> 16, -MOST_ODDS, MOST_ODDS) for w in weights]
        guess = probability(sum(sums) >> 1)
        bit = int(run.share() >= SHARES - guess)
        run.take(*((SHARES - guess, guess) if bit else (0, SHARES - guess)))
        for w, total in zip(weights, sums):
            off = 3 * ((SHARES if bit else 0) - probability(total))
            w[:] = [within(weight + ((o * off + (1 << 13)) >> 14), -1 << 20, 1 << 20)
                    for weight, o in zip(w, odds)]
        for counter in counters:
            counter.learn(bit, guess)
        return bit


class MixedNumber:
    """The mixed number model."""

    def __init__(self):
        self.lengths = [Models(Counter) for _ in range(4)]
        self.mixer = Mixer(4)
        self.bits = [Models(lambda: [BitModel() for _ in range(3)]) for _ in range(2)]
        self.signs = [Models(Counter) for _ in range(2)]
        self.sign_mixer = Mixer(2)

    def read(self, run, guesses, shape, sign=None):
        """A guess is a size and a circumstance; sign two circumstances."""
        sizes = [size for size, _ in guesses]

        def relative(size, l):
            return within(4 * l + 40 - size, 0, 63)

        def longer(than):
            counters = [self.lengths[i][circumstance, min(than, 2), relative(size, than)]
                        for i, (size, circumstance) in enumerate(guesses)]
            return self.mixer.read(run, counters, relative(sizes[0], than), shape)

        l = within(sizes[0] // 4 - 1, 0, 29)
        if longer(l):
            l += 1
            while l < 30 and longer(l):
                l += 1
        else:
            while l > 0 and not longer(l - 1):
                l -= 1
        if l == 0:
            return 0
        h = relative(sizes[0], l)
        magnitude = read_second_and_third(run, l, self.bits[l == 2][h])
        others = max(l - 3, 0)
        magnitude = magnitude << others | run.raw(others)
        if sign is None:
            negative = run.raw(1)
        else:
            counters = [self.signs[i][sign[i], h] for i in range(2)]
            negative = self.sign_mixer.read(run, counters, 0, h)
        return -magnitude if negative else magnitude


class Trace:
    """What is kept of a vertex."""

    def __init__(self):
        self.batch, self.off = 0, 0


class MixedModels:
    def __init__(self, placement):
        self.placement = placement
        self.batch = 0
        self.lengths = []  # mean lengths of the rings in this batch
        self.usual = 0
        self.traces = Models(Trace)
        self.splits = [Models(Counter) for _ in range(5)]
        self.splits_mixer = Mixer(5)
        self.long_form = Models(BitModel)
        self.weights = Models(int)
        for kind, row in enumerate(tables.chord_weights(placement)):
            for number, weight in enumerate(row):
                self.weights[kind, number] = 2 * weight
        self.along = [MixedNumber(), MixedNumber()]
        self.above = MixedNumber()

    def start_batch(self):
        self.batch += 1
        self.usual = sum(self.lengths) // len(self.lengths) if self.lengths else 0
        self.lengths = []

    def follow(self, vertex, new):
        """What a split tells of its vertices."""
        self.traces[vertex].batch = self.traces[new].batch = self.batch
        self.traces[new].off = self.traces[vertex].off

    def read_flag(self, run, vertex, decoder, in_rings):
        """Whether a vertex splits."""
        ring = decoder.stars.ring(vertex)
        mean = off_centre = passed = 0
        if ring is not None:
            around = Surroundings(ring, vertex, decoder.state.position)
            mean = around.mean
            there = [place.vertex for place in ring.places if place.vertex is not ABSENT]
            total = added(around.arms)
            off_centre = within(half_steps(dot(total, total)) - half_steps(len(there)**2) - mean
                                + 20, 0, 31)
            passed = min(sum(decoder.turns.of(v) == PASSED for v in there), 7)
        recent = int(decoder.turns.of(vertex) == RECENT)
        faces = min(len(decoder.stars.star[vertex]), 15)
        split = min(in_rings.get(vertex, 0), 7)
        age = min(self.batch - self.traces[vertex].batch, 15)
        size = within(mean - self.usual + 12, 0, 23)
        bent = within(decoder.steps.height_errors.get(vertex, 0) - mean + 20, 0, 39)
        keys = [(recent, faces, split), (faces, size), (age, split, passed), (off_centre, faces),
                (bent, size)]
        counters = [models[key] for models, key in zip(self.splits, keys)]
        bit = self.splits_mixer.read(run, counters, (recent, faces), (split, passed))
        self.lengths.append(mean)
        return bit

    def read_chord(self, run, around, stars, turns):
        """The places (i, j) of the chord; None: long form."""
        if around is None or self.long_form[around.ring.open].read(run):
            return None
        return MixedChords(self, around, stars, turns).read(run)

    def step_reader(self, around, vertex, i, j, bent):
        return MixedStep(self, around, vertex, i, j, bent)


def bend(a, b):
    """Of two normals."""
    def reduced(n):
        shift = max(max(length(abs(x)) for x in n) - 15, 0)
        return [x >> shift for x in n]
    a, b = reduced(a), reduced(b)
    if dot(a, b) < 0:
        return 22
    product = cross(a, b)
    sine = half_steps(dot(product, product)) - half_steps(dot(a, a)) - half_steps(dot(b, b))
    return within((3 * sine >> 2) + 21, 0, 21)


def difference(a, b):
    return [x - y for x, y in zip(a, b)]


class MixedChords:
    """All chords of a ring."""

    def __init__(self, models, around, stars, turns):
        self.models, self.around = models, around
        self.stars, self.turns = stars, turns
        self.s = around.s
        self.see_faces()
        self.at_ends = [self.see_place(i) for i in range(self.s)]
        optimal = models.placement == OPTIMAL
        self.most_side = min(self.s // 2 if optimal else self.s - 1, MOST_SIDE)
        self.starts = {side: side if optimal and 2 * side == self.s else self.s
                       for side in range(1, self.most_side + 1)}
        self.seen = {}
        self.sums = {}
        for side, starts in self.starts.items():
            for i in range(starts):
                classes = self.see_chord(i, side)
                self.seen[side, i] = classes
                ends = self.at_ends[i] + self.at_ends[(i + side) % self.s]
                self.sums[side, i] = sum(models.weights[key] for key in classes + ends)

    def see_faces(self):
        arms, places = self.around.arms, self.around.places
        normals = [cross(arms[i], arms[(i + 1) % self.s]) if places[i].corner is not None
                   else [0, 0, 0] for i in range(self.s)]
        shift = max(max(length(abs(x)) for normal in normals for x in normal) - 24, 0)
        self.normals = [[x >> shift for x in normal] for normal in normals]
        self.bends = [bend(self.normals[i - 1], self.normals[i])
                      if places[i].corner is not None and places[i - 1].corner is not None else 23
                      for i in range(self.s)]

    def see_place(self, i):
        """(kind, class) of an end there."""
        around = self.around
        a = difference(around.arms[i - 1], around.arms[i])
        b = difference(around.arms[(i + 1) % self.s], around.arms[i])
        c = dot(a, b)
        off = within(2 * half_steps(abs(c)) - half_steps(dot(a, a)) - half_steps(dot(b, b)) + 11,
                     0, 11)
        out = [(BENDS, self.bends[i]), (ANGLES, 11 + off if c < 0 else 11 - off)]
        vertex = around.places[i].vertex
        if vertex is ABSENT:
            return out + [(ENDS, 23), (FACES, 23), (TURNS, 23)]
        return out + [(ENDS, min(chord_class(around.lengths[i], around.mean), 22)),
                      (FACES, min(len(self.stars.star[vertex]), 22)),
                      (TURNS, self.turns.of(vertex))]

    def see_chord(self, i, side):
        around, mean = self.around, self.around.mean
        j = (i + side) % self.s
        near, far = around.side(i, j), around.side(j, i)
        out = []
        for kind, of in ((NEAR, near), (FAR, far)):
            size = half_steps(dot(of.sum, of.sum)) - half_steps(of.count**2)
            out.append((kind, chord_class(size, mean)))
        lengths = (2 * near.lengths * (reciprocal(near.count) + 1) >> 16) - 4
        out.append((LENGTH, chord_class(lengths, 2 * mean)))
        inside = [self.bends[(i + d) % self.s] for d in range(1, side)]
        out.append((INNER, sum(inside) // len(inside) if inside else 23))
        part = added(self.normals[(i + d) % self.s] for d in range(side))
        whole = added(self.normals)
        area = half_steps(dot(part, part)) - half_steps(dot(whole, whole)) + 20
        out.append((AREAS, (within(area, 0, 23), min(side, 7))))
        out.append((SIZES, (min(self.s, 23), side)))
        return out + self.see_distances(i, j, side)

    def see_distances(self, i, j, side):
        around = self.around
        expected = [x + (1 << 15) >> 16 for x in
                    predictions(self.models.placement, around, i, j)[0]]

        def square(place):
            off = difference(expected, around.arms[place])
            return dot(off, off)

        def class_of(number):
            return chord_class(half_steps(number), around.mean)

        out = []
        for place in (i, j):
            absent = around.places[place].vertex is ABSENT
            out.append((TO_ENDS, 23 if absent else min(class_of(square(place)), 22)))
        squares = [square((i + d) % self.s) for d in range(side + 1)]
        return out + [(NEAREST, class_of(min(squares))), (FARTHEST, class_of(max(squares)))]

    def read(self, run):
        best = max(self.sums.values())
        weights = {key: exponential(best - b >> 1) for key, b in self.sums.items()}
        side, _ = run.choice([sum(weights[side, i] for i in range(starts))
                              for side, starts in self.starts.items()])
        side += 1
        of_side = [self.sums[side, i] for i in range(self.starts[side])]
        i, _ = run.choice([exponential(max(of_side) - b >> 1) for b in of_side])
        self.learn(weights, (side, i))
        j = (i + side) % self.s
        places = self.around.places
        if self.starts[side] != self.s and number_of(places[i]) > number_of(places[j]):
            i, j = j, i
        return i, j

    def learn(self, weights, chosen):
        scale = (1 << 30) // sum(weights.values())
        at_place = [0] * self.s
        for key, weight in weights.items():
            side, i = key
            d = (SHARES if key == chosen else 0) - (weight * scale >> 15)
            self.change(self.seen[key], d)
            at_place[i] += d
            at_place[(i + side) % self.s] += d
        for classes, d in zip(self.at_ends, at_place):
            self.change(classes, d)

    def change(self, classes, d):
        for key in classes:
            self.models.weights[key] = within(self.models.weights[key] + ((d + (1 << 8)) >> 9),
                                              -MOST_WEIGHT, MOST_WEIGHT)


class MixedStep:
    """Reads the components of a step."""

    def __init__(self, models, around, vertex, i, j, bent):
        self.models, self.vertex = models, vertex
        side = (j - i) % around.s
        self.shape = (min(side, 5), min(around.s - side, 5))
        self.mean, self.bent = around.mean, bent
        near = around.side(i, j)
        self.centre = [x * reciprocal(near.count + 1) >> 16 for x in near.sum]
        offs = [models.traces[place.vertex].off for place in around.places
                if place.vertex is not ABSENT]
        self.off = sum(offs) // len(offs)
        self.first_class = 0
        self.squares = 0

    def read_along(self, run, nth, axis, guess, size):
        x = within(self.centre[axis] - guess, -1 << 30, 1 << 30)
        other = min(max(half_steps(x * x) + 14 - size, 0) // 3, 7)
        guesses = [(size, 0), (self.off + 4, 0), (size, self.shape), (size, other)]
        sign = (other + (8 if x < 0 else 0), self.first_class)
        d = self.models.along[nth].read(run, guesses, self.shape, sign)
        if nth == 0:
            self.first_class = 2 * within(half_steps(4 * d * d) - size + 8, 0, 31) + (d < 0)
        self.squares += d * d
        return d

    def read_above(self, run):
        size, along = (self.mean + self.bent) // 2, half_steps(2 * self.squares)
        guesses = [(size, 0), (self.bent, 0),
                   (size, within(self.bent - self.mean + 36, 0, 47) // 3),
                   (self.bent, within(along - self.mean + 16, 0, 31) // 2)]
        trace = self.models.traces[self.vertex]
        trace.off = (trace.off + along + 1) // 2
        return self.models.above.read(run, guesses, self.shape)
