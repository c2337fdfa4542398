"""Stars and rings (compact.md 2)."""

import dataclasses

ABSENT = None
MOST_CORNERS = 62


@dataclasses.dataclass
class Place:
    vertex: int  # or ABSENT
    corner: int = None  # or none


@dataclasses.dataclass
class Ring:
    places: list
    open: bool


@dataclasses.dataclass
class AddedFace:
    """A face that a split adds: (p, q, third) when it is forward, else (p, third, q)."""

    first_corner: int
    third: int
    forward: bool

    def corner_of_new(self):
        return self.first_corner + (1 if self.forward else 2)

    def corner_of_third(self):
        return self.first_corner + (2 if self.forward else 1)


@dataclasses.dataclass
class Split:
    """The vertex p and the new one q, and whose the corners are after the split."""

    p: int
    q: int
    moved: list  # corners given to q, in the order in which it was given them
    kept: list  # corners given to p
    faces: list
    step: list = None


class Stars:
    def __init__(self, vertices):
        self.star = [[] for _ in range(vertices)]  # the front is at 0
        self.vertex_of_corner = []

    def behind(self, corner):
        """The vertex behind a corner in its face."""
        return self.vertex_of_corner[next_corner(corner)]

    def before(self, corner):
        return self.vertex_of_corner[previous_corner(corner)]

    def add_face(self, vertices):
        for vertex in vertices:
            self.star[vertex].insert(0, len(self.vertex_of_corner))
            self.vertex_of_corner.append(vertex)

    def give(self, corner, vertex):
        self.star[vertex].insert(0, corner)
        self.vertex_of_corner[corner] = vertex

    def ring(self, vertex):
        """The ring of a vertex, or None."""
        star = self.star[vertex]
        if not 0 < len(star) <= MOST_CORNERS:
            return None
        corner_by_u = {self.behind(corner): corner for corner in star}
        ws = {self.before(corner) for corner in star}
        if len(corner_by_u) < len(star) or len(ws) < len(star):
            return None
        ends = [w for w in ws if w not in corner_by_u]
        if len(ends) > 1:
            return None
        is_open = len(ends) == 1
        corner = star[0]
        if is_open:
            corner = next(c for c in star if self.behind(c) not in ws)
        places = []
        while corner is not None and len(places) < len(star):
            places.append(Place(self.behind(corner), corner))
            corner = corner_by_u.get(self.before(corner))
        if is_open:
            if corner is not None or len(places) < len(star):
                return None
            places += [Place(ends[0]), Place(ABSENT)]
        elif len({place.corner for place in places}) < len(star):
            return None
        return Ring(places, is_open)

    def neighbours(self, vertex):
        """Behind and before each corner, each once."""
        out = []
        for corner in self.star[vertex]:
            for neighbour in (self.behind(corner), self.before(corner)):
                if neighbour not in out:
                    out.append(neighbour)
        return out

    def new_vertex(self):
        self.star.append([])
        return len(self.star) - 1

    def add_face_of_split(self, split, third, forward):
        split.faces.append(AddedFace(len(self.vertex_of_corner), third, forward))
        pair = (split.q, third) if forward else (third, split.q)
        self.add_face((split.p, *pair))

    def split_chord(self, vertex, places, i, j):
        """A split along the chord from place i to place j."""
        new = self.new_vertex()
        self.star[vertex] = []
        split = Split(vertex, new, [], [], [])
        for side, begin, end in ((split.moved, i, j), (split.kept, j, i)):
            at = begin
            while at != end:
                if places[at].corner is not None:
                    side.append(places[at].corner)
                at = (at + 1) % len(places)
        self.give_sides(split)
        if places[i].vertex is not ABSENT:
            self.add_face_of_split(split, places[i].vertex, forward=False)
        if places[j].vertex is not ABSENT:
            self.add_face_of_split(split, places[j].vertex, forward=True)
        return split

    def split_star(self, vertex, moves):
        """A split in the long form, without its faces; moves: which corners go to the new one."""
        new = self.new_vertex()
        star, self.star[vertex] = self.star[vertex], []
        split = Split(vertex, new, [], [], [])
        for corner, move in zip(star, moves):
            (split.moved if move else split.kept).append(corner)
        self.give_sides(split)
        return split

    def give_sides(self, split):
        for corner in split.moved:
            self.give(corner, split.q)
        for corner in split.kept:
            self.give(corner, split.p)


def next_corner(corner):
    return corner - corner % 3 + (corner + 1) % 3


def previous_corner(corner):
    return corner - corner % 3 + (corner + 2) % 3
