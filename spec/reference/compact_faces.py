"""fACE in the compact profile (compact.md 11, pairs of 9)."""

import collections

import model
from run import BitModel, Models, NumberModel, Run, SymbolModel, length


def pairs_of(corners, groups):
    """The half-edge that each is paired with, or None (compact.md 9, all triangles in map order)."""
    opposite = [None] * len(corners)
    last = {}  # between two wedges
    for h, start in enumerate(corners):
        end = corners[next_of(h)]
        g = last.get(frozenset((start, end)))
        if g is not None and opposite[g] is None and corners[g] == end and (
                groups[g // 3] == groups[h // 3]):
            opposite[g], opposite[h] = h, g
        last[frozenset((start, end))] = h
    return opposite


def next_of(h):
    return h - 2 if h % 3 == 2 else h + 1


class Joins:
    """The bits of the run that say which neighbours are of one polygon."""

    def __init__(self, run, opposite):
        self.run = run
        self.opposite = opposite
        count = len(opposite) // 3
        self.joined = [False] * len(opposite)
        self.joins = [0] * count
        self.open = [sum(h is not None for h in opposite[3 * t : 3 * t + 3]) for t in range(count)]
        self.polygon = [[t] for t in range(count)]  # the list is the same for all triangles in it
        self.models = Models(BitModel)
        self.reached = [False] * count
        self.visited = [False] * count
        for t in range(count):
            if not self.reached[t]:
                self.visit_from(t)

    def visit_from(self, seed):
        self.reached[seed] = True
        queue = collections.deque([seed])
        while queue:
            t = queue.popleft()
            for h in range(3 * t, 3 * t + 3):
                if self.opposite[h] is None or self.visited[self.opposite[h] // 3]:
                    continue
                u = self.opposite[h] // 3
                self.read(h, t, u)
                if not self.reached[u]:
                    self.reached[u] = True
                    queue.append(u)
            self.visited[t] = True

    def read(self, h, t, u):
        if self.polygon[t] is not self.polygon[u]:
            context = (min(self.joins[t], 2), min(self.joins[u], 2), self.open[t], self.open[u])
            if self.models[context].read(self.run):
                self.join(h, t, u)
        self.open[t] -= 1
        self.open[u] -= 1

    def join(self, h, t, u):
        self.joined[h] = self.joined[self.opposite[h]] = True
        self.joins[t] += 1
        self.joins[u] += 1
        self.polygon[t] += self.polygon[u]
        for other in self.polygon[u]:
            self.polygon[other] = self.polygon[t]

    def boundary(self, triangles):
        """The half-edges around a polygon."""
        start = min(h for t in triangles for h in range(3 * t, 3 * t + 3) if not self.joined[h])
        out = []
        h = start
        while not out or h != start:
            out.append(h)
            h = next_of(h)
            while self.joined[h]:
                h = next_of(self.opposite[h])
        return out


class Listed:
    """Faces that are listed."""

    def __init__(self, run, groups):
        self.run = run
        self.groups = groups
        self.corners, self.replaced = SymbolModel(), SymbolModel()
        self.same_group = BitModel()
        self.numbers = {"corner": NumberModel(), "triangle": NumberModel()}
        self.last = {"corner": 0, "triangle": 0, "group": 0}

    def read_number(self, kind):
        if self.run.raw(1):
            self.last[kind] = self.run.raw(32)
        else:
            self.last[kind] = (self.last[kind] + self.numbers[kind].read(self.run)) % 2**32
        return self.last[kind]

    def read(self):
        """A face: corners, group, triangles that it replaces."""
        corners = [self.read_number("corner")
                   for _ in range(self.corners.read_count(self.run, 31))]
        if self.groups > 1 and not self.same_group.read(self.run):
            self.last["group"] = self.run.raw(length(self.groups - 1))
        count = self.replaced.read_count(self.run, 31) + 1 if self.run.raw(1) else 0
        return corners, self.last["group"], [self.read_number("triangle") for _ in range(count)]


def append_face(table, corners, group, triangles):
    table.corners += corners
    table.group.append(group)
    table.replaced += triangles
    table.first.append(len(table.corners))
    table.replaced_first.append(len(table.replaced))


def read(mesh, state, payload):
    """The face table, after the number of the mesh."""
    table = model.FaceTable([0], [], [], [0], [], [])
    listed = payload.varint()
    for form in mesh.face_attributes:
        size = form.element_bytes()
        table.attributes.append([payload.take(size) for _ in range(mesh.faces)])
    run = Run(payload.rest())
    groups = state.triangle_group or [0] * (len(state.map) // 3)
    joins = Joins(run, pairs_of(state.map, groups))
    for t, polygon in enumerate(joins.polygon):
        if len(polygon) > 1 and min(polygon) == t:
            corners = [state.map[h] for h in joins.boundary(polygon)]
            append_face(table, corners, groups[t], sorted(polygon))
    faces = Listed(run, len(mesh.groups))
    for _ in range(listed):
        append_face(table, *faces.read())
    run.end()
    return table
