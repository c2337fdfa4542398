"""The wedges, groups and attributes that a split brings (compact.md 7)."""

import itertools

import model
from attributes import WedgeSurroundings
from model import require
from run import BitModel, Models, SymbolModel, length
from stars import next_corner, previous_corner

MOST_LOOKED_AT = 64  # wedges of a vertex
MOST_LIKELY = 15
NOTHING = (None, None, None)


class WedgeModels:
    """Of a mesh, for all its packets."""

    def __init__(self):
        self.regular, self.reassigned = Models(BitModel), Models(BitModel)
        self.new_wedges, self.taken, self.unseen = SymbolModel(), SymbolModel(), SymbolModel()
        self.as_new, self.as_kept = Models(BitModel), Models(BitModel)
        self.of_parent, self.of_third = Models(SymbolModel), Models(SymbolModel)
        self.of_added = SymbolModel()
        self.group = BitModel()


class WedgeLists:
    """The wedges of each vertex, the one that came last first, and how many corners show each."""

    def __init__(self, state):
        self.of_vertex = [[] for _ in state.position]
        self.uses = [0] * len(state.vertex_of)
        for wedge, vertex in enumerate(state.vertex_of):
            self.of_vertex[vertex].insert(0, wedge)
        for wedge in state.map:
            self.uses[wedge] += 1

    def first(self, vertex):
        return self.of_vertex[vertex][:MOST_LOOKED_AT]

    def has_spare(self, vertex):
        """Whether a vertex has a wedge that nothing shows."""
        return any(self.uses[wedge] == 0 for wedge in self.first(vertex))

    def go_over(self, wedge, p, q):
        self.of_vertex[p].remove(wedge)
        self.of_vertex[q].insert(0, wedge)

    def come(self, vertex, wedges):
        """New wedges of a vertex, after those that went over to it."""
        for wedge in wedges:
            self.of_vertex[vertex].insert(0, wedge)


class SplitWedges:
    """Reads what follows one split in the run."""

    def __init__(self, mesh, state, stars, lists, models, split, positions, attributes):
        self.mesh, self.state, self.stars, self.lists = mesh, state, stars, lists
        self.models, self.run, self.split = models, attributes.run, split
        self.of_q, other = positions
        self.of_p = other or state.position[split.p]
        self.w = len(state.vertex_of)  # wedges before the record
        self.new = 0  # new wedges so far
        self.reassigned = []
        self.before = {corner: state.map[corner] for corner in split.moved}
        self.shown = dict(self.before)  # after the split
        self.after = {}  # of each source the wedge after the split
        self.face_wedges = []  # (p, q, third) of each face added
        self.lists.of_vertex.append([])
        self.read_wedges()
        self.lists.come(self.split.q, range(self.w, self.w + self.new))
        self.groups = self.read_groups()
        self.cells = self.read_attributes(attributes)

    # Wedges, 7.1.

    def read_wedges(self):
        if self.mesh.single_wedges:
            self.add_new_wedge()
            self.shown = {corner: self.w for corner in self.split.moved}
            for face in self.split.faces:
                self.face_wedges.append((self.split.p, self.w, face.third))
            return
        sources = list(dict.fromkeys(self.before.values()))
        n = min(len(sources), 3)
        regular = bool(self.models.regular[n].read(self.run))
        if regular:
            self.read_regular(sources, n)
        else:
            self.read_not_regular()
        for corner in reversed(self.split.moved):
            self.after[self.before[corner]] = self.shown[corner]
        self.sources = sources
        for face in self.split.faces:
            self.face_wedges.append(self.read_face(face, regular))
        for corner in self.split.moved:
            self.lists.uses[self.before[corner]] -= 1
            self.lists.uses[self.shown[corner]] += 1
        if regular:
            unseen = self.models.unseen.read_count(self.run, 31)
            require(unseen <= self.mesh.wedges - self.w - self.new, "K-006")
            for _ in range(unseen):
                self.add_new_wedge()

    def add_new_wedge(self):
        require(self.w + self.new < self.mesh.wedges, "K-006")
        self.lists.uses.append(0)
        self.new += 1

    def moved_uses(self, wedge):
        return sum(before == wedge for before in self.before.values())

    def stays(self, wedge):
        """Whether more corners show a wedge than those that moved."""
        return self.lists.uses[wedge] > self.moved_uses(wedge)

    def reassign(self, wedge):
        require(wedge < self.w and self.state.vertex_of[wedge] == self.split.p, "K-008")
        require(not self.stays(wedge) and wedge not in self.reassigned, "K-008")
        self.reassigned.append(wedge)
        self.lists.go_over(wedge, self.split.p, self.split.q)

    def read_regular(self, sources, n):
        for source in sources:
            several = self.moved_uses(source) > 1
            if not self.stays(source) and self.models.reassigned[n, several].read(self.run):
                self.reassign(source)
                continue
            for corner in self.split.moved:
                if self.before[corner] == source:
                    self.shown[corner] = self.w + self.new
            self.add_new_wedge()

    def read_not_regular(self):
        new = self.models.new_wedges.read_count(self.run, 31)
        require(new <= self.mesh.wedges - self.w, "K-006")
        for _ in range(new):
            self.add_new_wedge()
        for _ in range(self.models.taken.read_count(self.run, 31)):
            self.reassign(self.run.raw(length(self.w)))
        for corner in self.split.moved:
            i = self.run.raw(length(new))
            require(i <= new, "K-008")
            if i < new:
                self.shown[corner] = self.w + i
            else:
                require(self.before[corner] in self.reassigned, "K-008")

    def corner_beyond(self, corners, third, before):
        """The first corner with the third vertex before it, or behind; else the other way."""
        sides = (self.stars.before, self.stars.behind)
        for side in sides if before else sides[::-1]:
            for corner in corners:
                if side(corner) == third:
                    return corner
        return None

    def corner_beyond_new(self, face):
        return self.corner_beyond(self.split.moved, face.third, before=face.forward)

    def corner_beyond_kept(self, face):
        return self.corner_beyond(self.split.kept, face.third, before=not face.forward)

    def wedge_at(self, corner, third):
        """The wedge of the third vertex in the face of a corner."""
        for other in (next_corner(corner), previous_corner(corner)):
            if self.stars.vertex_of_corner[other] == third:
                return self.state.map[other]

    def guess_as_new(self, face):
        """(p, q, third) by the face beyond the edge from q; None where it says nothing."""
        corner = self.corner_beyond_new(face)
        if corner is None:
            return NOTHING
        source = self.before[corner]
        p = None if source in self.reassigned else source
        return p, self.shown[corner], self.wedge_at(corner, face.third)

    def guess_as_kept(self, face, regular):
        """The same by the face beyond the edge from p."""
        corner = self.corner_beyond_kept(face)
        if corner is None:
            return NOTHING
        source = self.state.map[corner]
        return source, self.new_wedge_from(source, regular), self.wedge_at(corner, face.third)

    def new_wedge_from(self, source, regular):
        """The new wedge that comes from a wedge of p, else in a regular record the next one."""
        after = self.after.get(source)
        if after is not None and after >= self.w:
            return after
        return self.next_new_wedge() if regular else None

    def next_new_wedge(self):
        return self.w + self.new

    def read_face(self, face, regular):
        """The wedges of p, q and the third vertex of a face added."""
        as_new, as_kept = self.guess_as_new(face), self.guess_as_kept(face, regular)
        if as_new[0] is None:
            as_new = (as_kept[0], *as_new[1:])
        p, q, third = self.choose_wedges(face, as_new, as_kept, regular)
        if regular and q == self.next_new_wedge():
            self.add_new_wedge()
        self.check_face(face, p, q, third)
        for wedge in (p, q, third):
            self.lists.uses[wedge] += 1
        return p, q, third

    def choose_wedges(self, face, as_new, as_kept, regular):
        new_complete, kept_complete = None not in as_new, None not in as_kept
        agree = 0
        if new_complete:
            agree = 1 if as_new == as_kept else 2
        spare_of_p = self.lists.has_spare(self.split.p)
        spare_of_third = self.lists.has_spare(face.third)
        context = (agree, spare_of_p, spare_of_third)
        if new_complete and self.models.as_new[context].read(self.run):
            return as_new
        if kept_complete and agree != 1 and self.models.as_kept[context].read(self.run):
            return as_kept
        end = self.w + self.new + regular
        p = self.read_place(self.models.of_parent[spare_of_p],
                            self.likely(self.split.p, (as_new[0], as_kept[0]), None), end)
        require(p < self.w, "K-008")
        third = self.read_place(self.models.of_third[spare_of_third],
                                self.likely(face.third, (as_new[2], as_kept[2]), p), end)
        added = [self.new_wedge_from(p, regular), as_new[1]]
        if regular:
            added.append(self.next_new_wedge())
        added += [self.after[source] for source in self.sources]
        q = self.read_place(self.models.of_added, without_repeats(added), end)
        return p, q, third

    def likely(self, vertex, guessed, like):
        """The wedges that one of a vertex is likely to be."""
        def distance(wedge):
            if like is None:
                return 0
            cells = self.state.attributes[0]
            return sum(abs(a - b) for a, b in zip(cells[wedge], cells[like]))

        listed = sorted(self.lists.first(vertex),
                        key=lambda wedge: (self.lists.uses[wedge] > 0, distance(wedge)))
        return without_repeats([*guessed, *listed])

    def read_place(self, symbols, likely, end):
        """A place in a list, or a number when it is past it."""
        symbol = symbols.read(self.run)
        return likely[symbol] if symbol < len(likely) else self.run.raw(length(end))

    def check_face(self, face, p, q, third):
        """K-008: each wedge is one of its vertex."""
        require(max(p, third) < self.w and q < self.w + self.new, "K-008")
        require(self.state.vertex_of[p] == self.split.p and p not in self.reassigned, "K-008")
        require(q >= self.w or q in self.reassigned, "K-008")
        require(self.state.vertex_of[third] == face.third, "K-008")

    # Groups, 7.2.

    def read_groups(self):
        if len(self.mesh.groups) == 1:
            return []
        return [self.read_group(face) for face in self.split.faces]

    def read_group(self, face):
        corner = self.corner_beyond_new(face)
        if corner is None:
            corner = self.corner_beyond_kept(face)
        if self.models.group.read(self.run):
            return 0 if corner is None else self.state.triangle_group[corner // 3]
        group = self.run.raw(length(len(self.mesh.groups) - 1))
        require(group < len(self.mesh.groups), "M-019")
        return group

    # Attributes, 7.3.

    def read_attributes(self, attributes):
        """The cells of each new wedge."""
        rows = {}
        listed = self.lists.first(self.split.q)

        def cells_of(wedge):
            return rows[wedge] if wedge >= self.w else self.state.attributes[0][wedge]

        for wedge in range(self.w, self.w + self.new):
            siblings = [other for other in listed if other < wedge]
            rows[wedge] = attributes.read(self.surroundings(wedge), siblings, cells_of,
                                          self.position_of)
        return list(rows.values())

    def position_of(self, wedge):
        vertex = self.state.vertex_of[wedge]
        return self.of_p if vertex == self.split.p else self.state.position[vertex]

    def surroundings(self, wedge):
        """The faces in which the new vertex shows a wedge, and the wedges at their other corners."""
        out = WedgeSurroundings(self.of_q)
        for corner in self.split.moved:
            if self.shown[corner] == wedge:
                self.add_face(out, *(self.state.map[other] for other in
                                     (next_corner(corner), previous_corner(corner))))
        for face, (p, q, third) in zip(self.split.faces, self.face_wedges):
            if q == wedge:
                self.add_face(out, *((third, p) if face.forward else (p, third)))
        if not out.neighbours:
            for corner in self.split.kept[:1]:
                out.add_neighbour(self.state.map[corner])
        return out

    def add_face(self, surroundings, following, preceding):
        surroundings.add_neighbour(following)
        surroundings.add_neighbour(preceding)
        surroundings.add_face(self.position_of(following), self.position_of(preceding))

    def record(self, position, parent_position):
        """The record of the split (compact.md 2)."""
        record = model.Record(self.split.p, position, parent_position, self.reassigned)
        for i, cells in enumerate(self.cells):
            offsets = sorted(c for c, wedge in self.shown.items() if wedge == self.w + i)
            record.new_wedges.append(model.NewWedge([cells], offsets))
        for face, (p, q, third) in zip(self.split.faces, self.face_wedges):
            record.new_corners += [p, q, third] if face.forward else [p, third, q]
        record.new_groups = self.groups
        return record


def without_repeats(wedges):
    """Those that there are, each once, and only as many as a symbol can name."""
    there = (wedge for wedge in dict.fromkeys(wedges) if wedge is not None)
    return list(itertools.islice(there, MOST_LIKELY))
