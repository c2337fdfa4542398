"""The run of BASE in the compact profile (compact.md 5)."""

import collections
import dataclasses
import itertools

import model
from attributes import WedgeSurroundings, bounded
from model import require
from run import BitModel, Models, NumberModel, Run, SymbolModel, length

AXES = range(3)


def next_of(elements):
    """The number of the first that has not come yet, or past the last."""
    return elements.index(None) if None in elements else len(elements)


def distance(a, b):
    """The sum of the differences, without their signs."""
    return sum(abs(a[k] - b[k]) for k in AXES)


@dataclasses.dataclass
class Corner:
    vertex: int
    wedge: int


@dataclasses.dataclass
class Gate:
    """An edge of the triangle behind it; each of the three is a corner of that triangle."""

    start: Corner
    end: Corner
    third: Corner

    def edge(self):
        return self.start.vertex, self.end.vertex


class BaseRun:
    """Decodes the run; the results are position, vertex_of, wedges, map and triangle_group."""

    def __init__(self, mesh, map_entries, attributes, run):
        self.mesh = mesh
        self.run = run
        self.attributes = attributes
        self.place, self.third = SymbolModel(), Models(SymbolModel)
        self.next, self.usual = BitModel(), BitModel()
        self.next_wedge, self.group = BitModel(), BitModel()
        self.near, self.far = NumberModel(), NumberModel()
        self.misses = [0, 0]
        self.triangles_at = collections.Counter()  # of each vertex so far
        self.queue = collections.deque()
        self.position = [None] * mesh.base_vertices  # None: has not come yet
        self.vertex_of = [None] * mesh.base_wedges
        self.wedges = [None] * mesh.base_wedges  # for each the cells of all attributes
        self.last_wedge = None  # that was coded
        self.wedges_of = [[] for _ in self.position]  # the last one first
        self.map = []
        self.triangle_group = []
        self.last_position = [0, 0, 0]
        self.last_shown = {}  # at a vertex
        for _ in range(map_entries // 3):
            self.read_triangle()
        self.read_rest()

    def read_triangle(self):
        """*A triangle*, its group and its gates."""
        place = self.place.read(self.run)
        while place == 1:
            require(self.queue, "K-005")
            self.queue.popleft()
            place = self.place.read(self.run)
        require(place == 2 or (place == 0 and self.queue), "K-005")
        corners = self.read_at_gate(self.queue[0]) if place == 0 else self.read_at_no_gate()
        require(len({corner.vertex for corner in corners}) == 3, "K-005")
        self.map += [corner.wedge for corner in corners]
        self.read_group()
        a, b, c = corners
        if place == 0:
            self.queue.popleft()
        self.add(Gate(b, c, a))
        self.add(Gate(c, a, b))
        if place == 2:
            self.add(Gate(a, b, c))
        self.triangles_at.update(corner.vertex for corner in corners)

    def add(self, gate):
        """*Gates*."""
        edges = [other.edge() for other in self.queue]
        if gate.edge()[::-1] in edges:
            del self.queue[edges.index(gate.edge()[::-1])]
        elif gate.edge() not in edges:
            self.queue.append(gate)

    def read_at_gate(self, gate):
        u, v = gate.start.vertex, gate.end.vertex
        first = self.read_corner(v, gate.end.wedge, [])
        second = self.read_corner(u, gate.start.wedge, [first])
        context = self.triangles_at[u] > 4, self.triangles_at[v] > 4
        symbol = self.third[context].read(self.run)
        likely = self.likely(gate)
        if symbol == 0:
            vertex = next_of(self.position)
        elif symbol <= len(likely):
            vertex = likely[symbol - 1]
        else:
            vertex = self.run.raw(length(self.mesh.base_vertices))
        return first, second, self.read_third_corner(vertex, gate, first, second)

    def read_at_no_gate(self):
        corners = []
        for _ in range(3):
            if self.next.read(self.run):
                vertex = next_of(self.position)
            else:
                vertex = self.run.raw(length(self.mesh.base_vertices))
            require(vertex < self.mesh.base_vertices, "K-005")
            if self.position[vertex] is None:
                self.read_position(vertex, self.far, self.last_position)
            corners.append(self.read_corner(vertex, self.last_shown.get(vertex), corners))
        return corners

    def likely(self, gate):
        """The vertices that the third one is likely to be."""
        u, v = gate.edge()
        edges = [other.edge() for other in self.queue]
        starts = sorted(start for start, end in edges if end == u)
        ends = sorted(end for start, end in edges if start == v)
        beside = [vertex for pair in itertools.zip_longest(starts, ends) for vertex in pair]
        others = [vertex for edge in edges[:32] for vertex in edge]
        expected = self.expected(gate)[self.better_guess()]
        others.sort(key=lambda vertex: distance(self.position[vertex], expected))
        out = []
        for vertex in beside + others:
            if vertex not in (u, v, None) and vertex not in out:
                out.append(vertex)
        return out[:14]

    def expected(self, gate):
        """*Where it is expected*: both guesses."""
        start, end, third = (self.position[corner.vertex]
                             for corner in (gate.start, gate.end, gate.third))
        sums = [start[k] + end[k] for k in AXES]
        return ([sums[k] - third[k] for k in AXES],
                [(3 * sums[k] - 2 * third[k]) // 4 for k in AXES])

    def better_guess(self):
        return 0 if self.misses[0] < self.misses[1] else 1

    def read_third_corner(self, vertex, gate, first, second):
        require(vertex < self.mesh.base_vertices, "K-005")
        if self.position[vertex] is None:
            guesses = self.expected(gate)
            self.read_position(vertex, self.near, guesses[self.better_guess()])
            self.misses = [m + distance(self.position[vertex], guess) - m // 8
                           for m, guess in zip(self.misses, guesses)]
        return self.read_corner(vertex, self.last_shown.get(vertex), [first, second], gate)

    def read_position(self, vertex, model, against):
        """A new vertex."""
        position = tuple(bounded(against[k] + model.read(self.run)) for k in AXES)
        self.position[vertex] = position
        self.last_position = position

    def read_corner(self, vertex, usual, before, gate=None):
        """*A corner*, but for its position: its wedge, whose attributes follow when it is new.

        before: the corners of the triangle before it; gate: that of a third corner"""
        wedge = self.read_wedge(vertex, usual)
        require(wedge < self.mesh.base_wedges, "K-005")
        if self.wedges[wedge] is None:
            self.read_new_wedge(wedge, vertex, self.surroundings(vertex, usual, before, gate))
        require(self.vertex_of[wedge] == vertex, "K-005")
        self.last_shown[vertex] = wedge
        return Corner(vertex, wedge)

    def read_wedge(self, vertex, usual):
        if self.mesh.single_wedges:
            return vertex
        if usual is not None and self.usual.read(self.run):
            return usual
        if self.next_wedge.read(self.run):
            return next_of(self.wedges)
        return self.run.raw(length(self.mesh.base_wedges))

    def surroundings(self, vertex, usual, before, gate):
        """What is there of the triangle, and the one behind the gate if it shows the same wedges."""
        out = WedgeSurroundings(self.position[vertex])
        for corner in before:
            out.add_neighbour(corner.wedge)
        if len(before) == 2:
            out.add_face(*(self.position[corner.vertex] for corner in before))
        if gate is not None and [c.wedge for c in before] == [gate.end.wedge, gate.start.wedge]:
            out.add_neighbour(gate.third.wedge)
            start, end, third = (self.position[corner.vertex]
                                 for corner in (gate.start, gate.end, gate.third))
            out.add_face(end, third, start)
        if not out.neighbours and usual is not None:
            out.add_neighbour(usual)
        self.add_last_wedge(out)
        return out

    def add_last_wedge(self, surroundings):
        if not surroundings.neighbours and self.last_wedge is not None:
            surroundings.add_neighbour(self.last_wedge)

    def read_new_wedge(self, wedge, vertex, surroundings):
        self.vertex_of[wedge] = vertex
        self.wedges[wedge] = self.attributes.read(
            surroundings, self.wedges_of[vertex][:64], self.wedges.__getitem__,
            lambda other: self.position[self.vertex_of[other]])
        self.wedges_of[vertex].insert(0, wedge)
        self.last_wedge = wedge

    def read_group(self):
        """*The group*."""
        groups = len(self.mesh.groups)
        if groups == 1:
            return
        before = self.triangle_group[-1] if self.triangle_group else 0
        if self.group.read(self.run):
            group = before
        else:
            group = self.run.raw(length(groups - 1))
            require(group < groups, "M-019")
        self.triangle_group.append(group)

    def read_rest(self):
        """Vertices and wedges that no triangle has."""
        while None in self.position:
            self.read_position(next_of(self.position), self.far, self.last_position)
        while None in self.wedges:
            wedge = vertex = next_of(self.wedges)
            if not self.mesh.single_wedges:
                vertex = self.run.raw(length(self.mesh.base_vertices))
                require(vertex < self.mesh.base_vertices, "K-005")
            around = WedgeSurroundings(self.position[vertex])
            self.add_last_wedge(around)
            self.read_new_wedge(wedge, vertex, around)
        self.run.end()


def read(mesh, map_entries, decoder, data):
    run = Run(data)
    return BaseRun(mesh, map_entries, decoder.attributes(run), run)
