"""What a file means: counts, records, triangles, faces, digest (model.md, strips.md, vsplit.md)."""

import dataclasses
import hashlib
import struct

NONE = 0xFFFFFFFF
MOST = 0xFFFFFF00  # M-001

RESTART = 0xFFFFFFFF
SYMBOLS = {0xFFFFFFFB: -2, 0xFFFFFFFC: -1, 0xFFFFFFFD: 1, 0xFFFFFFFE: 2}  # strips.md 2

NAIVE, OFFSET, TRIANGLES = 0, 1, 2  # encoding of MESH
OPTIMAL = 1  # placement of MESH
SMALL = 1  # effort of MESH
POLYGONS = 0  # kind of a group

COMPONENT_BYTES = [1, 1, 2, 2, 4, 4, 4, 8]  # by the type of a format


class Violation(Exception):
    """An answer of container.md 11 and the clause that is broken."""

    def __init__(self, answer, clause):
        super().__init__(f"{answer} [{clause}]")
        self.answer = answer
        self.clause = clause


def require(condition, clause):
    if not condition:
        raise Violation("corrupt", clause)


@dataclasses.dataclass
class Format:
    """An attribute (model.md 3)."""

    semantic: bytes
    type: int
    count: int
    normalized: int

    def element_bytes(self):
        return self.count * COMPONENT_BYTES[self.type]

    def bytes(self):
        """As in container.md 5.2."""
        head = struct.pack("<I", len(self.semantic)) + self.semantic
        return head + bytes([self.type, self.count, self.normalized, 0])


@dataclasses.dataclass
class Group:
    name: bytes
    material: int
    kind: int
    map_entries: int


@dataclasses.dataclass
class Grid:
    """Where positions lie in the compact profile (compact.md 3)."""

    step: float
    exact: int
    origin: list


@dataclasses.dataclass
class Mesh:
    """What MESH says."""

    name: bytes
    encoding: int = NAIVE
    placement: int = 0
    effort: int = 0
    single_wedges: int = 0
    position: Format = None
    wedge_attributes: list = None
    face_attributes: list = None
    groups: list = None
    vertices: int = 0
    wedges: int = 0
    triangles: int = 0
    strips: int = 0
    map_entries: int = 0
    vsplits: int = 0
    faces: int = 0
    base_vertices: int = 0
    base_wedges: int = 0
    grid: Grid = None
    explicit_corners: int = 0
    welding: object = None

    def decoded_counts(self):
        """Vertices and wedges of the decoded mesh (model.md 11)."""
        mesh = self.welding or self
        return mesh.vertices, mesh.wedges

    def lists_groups(self):
        """Whether there is a triangle_group (model.md 4)."""
        return self.encoding == TRIANGLES and len(self.groups) > 1


@dataclasses.dataclass
class FaceTable:
    """model.md 6. Face i has corners[first[i]:first[i + 1]] and replaces likewise."""

    first: list = None
    corners: list = None
    group: list = None
    replaced_first: list = None
    replaced: list = None
    attributes: list = None


@dataclasses.dataclass
class Welding:
    """model.md 11."""

    vertices: int
    wedges: int
    skip: list = None
    more: list = None
    corner: list = None
    vertex: list = None
    moved: list = None
    moved_position: list = None


@dataclasses.dataclass
class Order:
    """model.md 7."""

    vertex: list = None
    wedge: list = None
    face: list = None
    rotation: list = None


@dataclasses.dataclass
class NewWedge:
    attributes: list  # one element for each wedge attribute
    map_offsets: list


@dataclasses.dataclass
class Record:
    """vsplit.md 1. new_corners has three for each new triangle, new_groups one."""

    parent: int
    position: object
    parent_position: object = None
    reassigned: list = dataclasses.field(default_factory=list)
    new_wedges: list = dataclasses.field(default_factory=list)
    new_corners: list = dataclasses.field(default_factory=list)
    new_groups: list = dataclasses.field(default_factory=list)


@dataclasses.dataclass
class State:
    """A mesh at a level (vsplit.md 2)."""

    position: list
    vertex_of: list
    attributes: list  # for each wedge attribute a list with an element for each wedge
    map: list
    triangle_group: list = dataclasses.field(default_factory=list)
    vsplits: int = 0  # records applied


def check_counts(mesh, materials):
    """model.md 2 to 4, what MESH alone can break."""
    counts = (mesh.vertices, mesh.wedges, mesh.triangles, mesh.strips, mesh.map_entries, mesh.faces)
    require(max(counts) <= MOST, "M-001")
    if mesh.single_wedges:
        require(mesh.wedges == mesh.vertices, "M-002")
        require(mesh.base_wedges == mesh.base_vertices, "M-002")
    require(mesh.groups, "M-007")
    for group in mesh.groups:
        require(group.material == NONE or group.material < materials, "M-008")
        require(group.kind == POLYGONS or group.map_entries == 0, "M-010")
    require(sum(group.map_entries for group in mesh.groups) == mesh.map_entries, "M-009")
    require(mesh.base_vertices <= mesh.vertices and mesh.base_wedges <= mesh.wedges, "M-011")
    require(mesh.vsplits == mesh.vertices - mesh.base_vertices, "M-012")
    require(max(mesh.triangles, mesh.strips) <= mesh.map_entries, "M-013")
    if mesh.encoding == TRIANGLES:
        require(mesh.map_entries == 3 * mesh.triangles, "M-018")


def check_base(mesh, state):
    """The base against MESH (model.md 4, strips.md 1 to 3)."""
    require(all(vertex < mesh.base_vertices for vertex in state.vertex_of), "M-014")
    require(len(set(state.vertex_of)) == mesh.base_vertices, "M-017")
    require(all(group < len(mesh.groups) for group in state.triangle_group), "M-019")
    for entry in state.map:
        if entry in SYMBOLS:
            require(mesh.encoding == OFFSET, "S-002")
        else:
            require(entry == RESTART or entry < mesh.base_wedges, "S-001")
    if mesh.encoding == TRIANGLES:
        require(RESTART not in state.map and len(state.map) % 3 == 0, "S-005")
        check_triangles(state, 0)
    else:
        check_strips_of_groups(mesh, state.map)
    resolve(state.map)


def check_strips_of_groups(mesh, entries):
    """strips.md 1: a strip does not go from one group into the next."""
    begin = 0
    for group in mesh.groups:
        if group.map_entries and begin:
            require(entries[begin - 1] == RESTART, "S-004")
        begin += group.map_entries


def check_triangles(state, first):
    """strips.md 1: from entry first on each three entries have three vertices."""
    for i in range(first, len(state.map), 3):
        require(len({state.vertex_of[wedge] for wedge in state.map[i : i + 3]}) == 3, "S-006")


def resolve(entries):
    """The map with the wedge at the end of its chain for each symbol (strips.md 3)."""
    strip_of = []
    strip = 0
    for entry in entries:
        strip_of.append(strip)
        strip += entry == RESTART
    resolved = list(entries)
    for i, entry in enumerate(entries):
        chain = []
        at = i
        while resolved[at] in SYMBOLS:
            # A chain longer than its map goes in a circle.
            require(len(chain) < len(entries), "S-003")
            chain.append(at)
            at += SYMBOLS[resolved[at]]
            require(0 <= at < len(entries) and strip_of[at] == strip_of[i], "S-003")
        require(not chain or resolved[at] != RESTART, "S-003")
        for place in chain:
            resolved[place] = resolved[at]
    return resolved


def strips(mesh, entries):
    """(first entry, end) of each strip of a map (strips.md 1)."""
    if mesh.encoding == TRIANGLES:
        return [(i, i + 3) for i in range(0, len(entries), 3)]
    out = []
    begin = 0
    for i, entry in enumerate(entries):
        if entry == RESTART:
            out.append((begin, i))
            begin = i + 1
    out.append((begin, len(entries)))
    return out


def triangles(mesh, state):
    """strips.md 4: (corners, entry) of each triangle of the map, and how many strips show one."""
    resolved = resolve(state.map)
    shown = []
    strips_shown = 0
    for begin, end in strips(mesh, resolved):
        before = len(shown)
        for i in range(begin, end - 2):
            a, b, c = resolved[i : i + 3]
            if len({state.vertex_of[a], state.vertex_of[b], state.vertex_of[c]}) == 3:
                shown.append(((a, b, c) if (i - begin) % 2 == 0 else (b, a, c), i))
        strips_shown += len(shown) > before
    return shown, strips_shown


def check_record(mesh, state, record):
    """The preconditions of vsplit.md 3, but for V-014, which needs the map resolved."""
    v = len(state.position)
    w = len(state.vertex_of)
    parent = record.parent
    require(parent <= v, "V-001")
    offsets = [p for wedge in record.new_wedges for p in wedge.map_offsets]
    if parent == v:
        require(not record.reassigned, "V-002")
        require(not offsets and not record.new_corners, "V-003")
        if mesh.placement == OPTIMAL:
            require(record.parent_position == record.position, "V-015")
    if mesh.single_wedges:
        require(len(record.new_wedges) == 1 and not record.reassigned, "V-004")
    require(record.new_wedges or record.reassigned, "V-005")
    for wedge in record.reassigned:
        require(wedge < w, "V-007")
        require(state.vertex_of[wedge] == parent, "V-008")
    require(len(set(record.reassigned)) == len(record.reassigned), "V-008")
    require(len(set(offsets)) == len(offsets), "V-013")
    for p in offsets:
        require(p < len(state.map), "V-010")
        require(state.map[p] != RESTART, "V-011")
    for wedge in record.new_wedges:
        require(wedge.map_offsets == sorted(wedge.map_offsets), "V-012")
    require(all(corner < w + len(record.new_wedges) for corner in record.new_corners), "V-016")
    require(all(group < len(mesh.groups) for group in record.new_groups), "M-019")


def apply_record(mesh, state, record):
    """The steps of vsplit.md 3."""
    check_record(mesh, state, record)
    v = len(state.position)
    state.position.append(record.position)
    if mesh.placement == OPTIMAL:
        state.position[record.parent] = record.parent_position
    for wedge in record.reassigned:
        state.vertex_of[wedge] = v
    for wedge in record.new_wedges:
        w = len(state.vertex_of)
        state.vertex_of.append(v)
        for elements, element in zip(state.attributes, wedge.attributes):
            elements.append(element)
        for p in wedge.map_offsets:
            state.map[p] = w
    state.map += record.new_corners
    state.triangle_group += record.new_groups
    state.vsplits += 1
    if record.new_corners:
        check_triangles(state, len(state.map) - len(record.new_corners))


def check_full(mesh, state):
    """A mesh after its last record against MESH (model.md 4)."""
    require(state.vsplits == mesh.vsplits, "M-021")
    require(len(state.vertex_of) == mesh.wedges, "M-015")
    require(len(set(state.vertex_of)) == mesh.vertices, "V-006")
    shown, strips_shown = triangles(mesh, state)
    require(len(shown) == mesh.triangles, "M-016")
    require(strips_shown == mesh.strips, "M-016")
    if mesh.lists_groups():
        for number, group in enumerate(mesh.groups):
            require(group.map_entries == 3 * state.triangle_group.count(number), "M-060")


def check_face_table(mesh, table):
    """model.md 6."""
    for first, count, clause in ((table.first, len(table.corners), "M-030"),
                                 (table.replaced_first, len(table.replaced), "M-038")):
        require(first[0] == 0 and first == sorted(first) and first[-1] == count, clause)
    require(all(corner < mesh.wedges for corner in table.corners), "M-031")
    require(all(group < len(mesh.groups) for group in table.group), "M-032")
    require(all(triangle < mesh.triangles for triangle in table.replaced), "M-033")
    require(len(set(table.replaced)) == len(table.replaced), "M-034")
    require(mesh.faces == mesh.triangles - len(table.replaced) + len(table.group), "M-036")


@dataclasses.dataclass
class Face:
    corners: tuple  # wedges
    group: int


def triangle_groups(mesh, state, shown):
    """The group of each triangle shown (model.md 4)."""
    if mesh.encoding == TRIANGLES:
        # Every triangle of such a map is shown (S-006).
        return state.triangle_group or [0] * len(shown)
    out = []
    number, end = 0, mesh.groups[0].map_entries
    for _, entry in shown:
        while entry >= end:
            number += 1
            end += mesh.groups[number].map_entries
        out.append(number)
    return out


def faces(mesh, state, table):
    """The faces of the decoded mesh (model.md 6); table is None at levels but the last."""
    shown, _ = triangles(mesh, state)
    groups = triangle_groups(mesh, state, shown)
    if table is None:
        return [Face(corners, group) for (corners, _), group in zip(shown, groups)]
    for face, group in enumerate(table.group):
        for t in table.replaced[table.replaced_first[face] : table.replaced_first[face + 1]]:
            require(groups[t] == group, "M-035")
    replaced = set(table.replaced)
    out = [Face(corners, group) for t, ((corners, _), group) in enumerate(zip(shown, groups))
           if t not in replaced]
    for face, group in enumerate(table.group):
        out.append(Face(table.corners[table.first[face] : table.first[face + 1]], group))
    return out


def check_orders(mesh, order, decoded):
    """model.md 7."""
    vertices, wedges = mesh.decoded_counts()
    for numbers, count, clause in ((order.vertex, vertices, "M-040"),
                                   (order.face, mesh.faces, "M-042"),
                                   (order.wedge, wedges, "M-041")):
        if numbers is not None:
            require(sorted(numbers) == list(range(count)), clause)
    for rotation, face in zip(order.rotation, decoded):
        require(rotation < max(len(face.corners), 1), "M-043")


@dataclasses.dataclass
class Decoded:
    """What a digest is of: a mesh after the face table and the welding."""

    position: list
    vertex_of: list
    attributes: list
    faces: list


def check_welding_counts(mesh, welding, lengths):
    """M-047, before lists of those lengths are read."""
    corners = 3 * mesh.triangles + mesh.explicit_corners
    welded, cornered, numbered, moved = lengths
    require(0 < welding.wedges <= mesh.wedges + corners, "M-047")
    require(welding.vertices <= welding.wedges and welded <= mesh.wedges, "M-047")
    require(cornered <= corners and numbered <= welding.wedges, "M-047")
    require(moved <= welding.vertices, "M-047")


def copies_of_wedges(wedges, welding):
    """How many decoded wedges each wedge stands for."""
    require(len(welding.skip) == len(welding.more), "M-046")
    copies = [1] * wedges
    at = -1
    for skip, more in zip(welding.skip, welding.more):
        at += skip + 1
        require(at < wedges, "M-046")
        copies[at] = more + 2
    require(sum(copies) == welding.wedges, "M-046")
    return copies


def part_corners(decoded, copies, welding):
    """The faces with decoded wedges."""
    first = [0]
    for count in copies:
        first.append(first[-1] + count)
    named = [0 if count > 1 else 1 for count in copies]
    numbers = iter(welding.corner)

    def part(wedge):
        if copies[wedge] == 1:
            return first[wedge]
        number = next(numbers, None)
        require(number is not None and number <= named[wedge], "M-046")
        if number > 0:
            return first[wedge] + number - 1
        if named[wedge] < copies[wedge]:
            named[wedge] += 1
            return first[wedge] + named[wedge] - 1
        return first[wedge] + copies[wedge] - 1

    out = [Face(tuple(part(wedge) for wedge in face.corners), face.group) for face in decoded]
    require(next(numbers, None) is None and named == copies, "M-046")
    return out


def part_vertices(vertex_of, owner, welding):
    """The vertex of each decoded wedge, and the welded vertex of each decoded vertex."""
    welded = [vertex_of[wedge] for wedge in owner]
    shares = [0] * (max(welded, default=-1) + 1)
    for vertex in welded:
        shares[vertex] += 1
    there = [[] for _ in shares]
    vertices, vertex_from = [], []
    numbers = iter(welding.vertex)
    for vertex in welded:
        number = next(numbers, None) if shares[vertex] > 1 else 0
        require(number is not None and number <= len(there[vertex]), "M-046")
        if number == 0:
            there[vertex].append(len(vertex_from))
            vertex_from.append(vertex)
        vertices.append(there[vertex][number - 1])
    require(next(numbers, None) is None and len(vertex_from) == welding.vertices, "M-046")
    return vertices, vertex_from


def unweld(mesh, state, decoded):
    """The decoded mesh (model.md 11)."""
    welding = mesh.welding
    if welding is None:
        return Decoded(state.position, state.vertex_of, state.attributes, decoded)
    copies = copies_of_wedges(len(state.vertex_of), welding)
    owner = [wedge for wedge, count in enumerate(copies) for _ in range(count)]
    faces_there = part_corners(decoded, copies, welding)
    vertex_of, vertex_from = part_vertices(state.vertex_of, owner, welding)
    position = [state.position[vertex] for vertex in vertex_from]
    require(welding.moved == sorted(set(welding.moved)), "M-046")
    for vertex, place in zip(welding.moved, welding.moved_position):
        require(vertex < len(position), "M-046")
        position[vertex] = place
    attributes = [[elements[wedge] for wedge in owner] for elements in state.attributes]
    return Decoded(position, vertex_of, attributes, faces_there)


def u32s(numbers):
    return struct.pack(f"<{len(numbers)}I", *numbers)


def digest(mesh, state, face_attributes):
    """The SHA-256 of model.md 8. state: a Decoded; face_attributes: elements, one list each."""
    decoded = state.faces
    corners = [corner for face in decoded for corner in face.corners]
    sha = hashlib.sha256(b"PSTMESH1")
    sha.update(u32s([len(state.position), len(state.vertex_of), len(decoded), len(corners),
                     len(mesh.wedge_attributes), len(face_attributes)]))
    sha.update(mesh.position.bytes() + b"".join(state.position))
    sha.update(u32s(state.vertex_of))
    for form, elements in zip(mesh.wedge_attributes, state.attributes):
        sha.update(form.bytes() + b"".join(elements))
    sha.update(u32s([len(face.corners) for face in decoded]))
    sha.update(u32s(corners))
    sha.update(u32s([face.group for face in decoded]))
    for form, elements in zip(mesh.face_attributes, face_attributes):
        sha.update(form.bytes() + b"".join(elements))
    return sha.digest()
