"""BASE, PCKT, FINE and fACE of the compact profile (compact.md)."""

import cells
import compact_base
import compact_faces
import model
from attributes import AttributeModels, AttributeReader, WedgeSurroundings
from cells import BOUND
from container import Payload
from compact_wedges import SplitWedges, WedgeLists, WedgeModels
from mixed import MixedModels
from geometry import AXES, Chords, Steps, Surroundings, place_split
from model import OPTIMAL, SMALL, require
from run import BitModel, Models, NumberModel, Run, SymbolModel, length, read_varint
from stars import ABSENT, Stars

WAITS, RECENT, PASSED, SPLIT = range(4)
BATCH = 0  # kind of a PCKT
MOST_COMPONENTS = 1024


class Turns:
    """Where vertices stand in a batch."""

    def __init__(self):
        self.recent, self.passed, self.split = set(), set(), set()

    def start(self):
        """A batch."""
        self.recent, self.passed, self.split = self.split, set(), set()

    def of(self, vertex):
        """The class of kind 5 of compact.md 6.2."""
        if vertex in self.split:
            return SPLIT
        if vertex in self.passed:
            return PASSED
        return RECENT if vertex in self.recent else WAITS


class MeshDecoder:
    """What a decoder keeps for a mesh. Elements of its state are cells until they are asked for."""

    def __init__(self, mesh, payload):
        self.mesh = mesh
        require(mesh.encoding == model.TRIANGLES, "C-052")
        require(mesh.position.count == 3, "M-061")
        components = sum(form.count for form in mesh.wedge_attributes)
        require(components <= MOST_COMPONENTS, "K-001")
        self.position_cells = cells.of_positions(mesh.position, mesh.grid)
        self.state = self.read_base(payload)
        model.check_base(mesh, self.state)
        self.stars = Stars(mesh.base_vertices)
        for first in range(0, len(self.state.map), 3):
            self.stars.add_face([self.state.vertex_of[wedge]
                                 for wedge in self.state.map[first : first + 3]])
        self.order = list(range(mesh.base_vertices))
        self.turns = Turns()
        self.mixed = MixedModels(mesh.placement) if mesh.effort == SMALL else None
        self.visited = 0  # by all batches
        self.splits = Models(BitModel)
        self.chords = Chords(mesh.placement)
        self.steps = Steps(mesh.placement)
        self.moves, self.added_faces = BitModel(), SymbolModel()
        self.long_steps = [NumberModel() for _ in AXES]
        self.own_steps, self.own_wedges = [NumberModel() for _ in AXES], SymbolModel()
        self.own_position = (0, 0, 0)
        self.wedge_models = WedgeModels()
        self.wedge_lists = WedgeLists(self.state)
        self.fine = None

    def read_base(self, payload):
        """compact.md 5, after the number of the mesh."""
        mesh = self.mesh
        vertices, wedges, map_entries = (read_varint(payload) for _ in range(3))
        require((vertices, wedges) == (mesh.base_vertices, mesh.base_wedges), "C-051")
        require(map_entries <= mesh.map_entries, "C-051")
        require(map_entries % 3 == 0, "S-005")
        self.wedge_cells = []  # of each attribute
        for form in mesh.wedge_attributes:
            self.wedge_cells.append(cells.AttributeCells(form, read_varint(payload, 1 << 14)))
        self.layout = [(these.columns, these.bits) for these in self.wedge_cells]
        self.attribute_models = AttributeModels(len(self.layout))
        base = compact_base.read(mesh, map_entries, self, payload.rest())
        return model.State(base.position, base.vertex_of, [base.wedges], base.map,
                           base.triangle_group)

    # Batches, compact.md 6.1.

    def read_batch(self, run):
        order, self.order = self.order, []
        self.turns.start()
        if self.mixed:
            self.mixed.start_batch()
        in_rings = {}  # how many splits of this batch had a vertex in their ring
        self.visited += len(order)
        if self.visited > 256 * self.mesh.vertices + (1 << 20):
            raise model.Violation("over limit", "D-043")
        for vertex in order:
            self.order.append(vertex)
            context = (self.turns.of(vertex) == RECENT, min(len(self.stars.star[vertex]), 15),
                       min(in_rings.get(vertex, 0), 7))
            if self.mixed:
                splits = self.mixed.read_flag(run, vertex, self, in_rings)
            else:
                splits = self.splits[context].read(run)
            if splits:
                new = len(self.state.position)
                require(new < self.mesh.vertices, "K-006")
                ring = self.read_split(run, vertex)
                for place in ring.places if ring else []:
                    if place.vertex is not ABSENT:
                        in_rings[place.vertex] = in_rings.get(place.vertex, 0) + 1
                self.order.append(new)
                self.turns.split |= {vertex, new}
                if self.mixed:
                    self.mixed.follow(vertex, new)
            self.turns.passed.add(vertex)

    def read_split(self, run, vertex):
        """Reads and applies a split; returns the ring before it, or None."""
        ring = self.stars.ring(vertex)
        around = Surroundings(ring, vertex, self.state.position) if ring else None
        chord = (self.mixed or self.chords).read_chord(run, around, self.stars, self.turns)
        if chord:
            split = self.stars.split_chord(vertex, ring.places, *chord)
            split.step = self.steps.read(run, around, vertex, split.q, *chord, self.mixed)
        else:
            split = self.read_long_form(run, vertex)
        placement = self.mesh.placement
        new, other = place_split(placement, self.state.position, vertex, split.step)
        entries = len(self.state.map) + 3 * len(split.faces)
        require(entries <= self.mesh.map_entries, "K-006")
        wedges = SplitWedges(self.mesh, self.state, self.stars, self.wedge_lists,
                             self.wedge_models, split, (new, other),
                             self.attributes(run))
        self.apply(wedges.record(new, other if placement == OPTIMAL else None))
        return ring

    def attributes(self, run):
        return AttributeReader(self.layout, self.attribute_models, run)

    def read_long_form(self, run, vertex):
        """compact.md 6.4."""
        neighbours = self.stars.neighbours(vertex)
        moves = [self.moves.read(run) for _ in self.stars.star[vertex]]
        faces = self.added_faces.read_count(run, 28)
        require(faces <= self.mesh.triangles, "K-006")
        vertices = len(self.state.position)
        split = self.stars.split_star(vertex, moves)
        for _ in range(faces):
            forward = bool(run.raw(1))
            third = run.raw(length(len(neighbours)))
            if third < len(neighbours):
                third = neighbours[third]
            else:
                third = run.raw(length(vertices))
            require(third < vertices and third != vertex, "K-009")
            self.stars.add_face_of_split(split, third, forward)
        split.step = [self.long_steps[k].read(run) for k in AXES]
        self.steps.start_with_error_of(vertex, split.q)
        return split

    def apply(self, record):
        require(len(self.state.vertex_of) + len(record.new_wedges) <= self.mesh.wedges, "K-006")
        model.apply_record(self.mesh, self.state, record)

    def read_own(self, run, count):
        """Vertices that come from no other (compact.md 6.5)."""
        for _ in range(count):
            position = tuple(self.own_position[k] + self.own_steps[k].read(run) for k in AXES)
            require(all(abs(c) < BOUND for c in position), "K-007")
            self.own_position = position
            parent_position = position if self.mesh.placement == OPTIMAL else None
            record = model.Record(self.stars.new_vertex(), position, parent_position)
            wedges = 1 if self.mesh.single_wedges else self.own_wedges.read_count(run, 31)
            require(wedges <= self.mesh.wedges - len(self.state.vertex_of), "K-006")
            self.wedge_lists.of_vertex.append([])
            before = len(self.state.vertex_of) - 1
            rows = list(self.state.attributes[0])
            for wedge in range(before + 1, before + 1 + wedges):
                self.wedge_lists.uses.append(0)
                around = WedgeSurroundings(position)
                if before >= 0:
                    around.add_neighbour(before)
                siblings = range(wedge - 1, before, -1)[:64]
                rows.append(self.attributes(run).read(
                    around, siblings, rows.__getitem__,
                    lambda wedge: self.state.position[self.state.vertex_of[wedge]]))
                record.new_wedges.append(model.NewWedge([rows[-1]], []))
            self.wedge_lists.come(record.parent, range(before + 1, before + 1 + wedges))
            self.apply(record)

    # FINE, compact.md 8.

    def all_numbers(self):
        """(cells, cell) of each number in the order of FINE."""
        for position in self.state.position:
            yield from zip(self.position_cells, position)
        first = 0
        for these in self.wedge_cells:
            for wedge in self.state.attributes[0]:
                yield from these.by_component(wedge[first : first + these.columns])
            first += these.columns

    def numbers(self, rests=None):
        """The bytes of each number in the order of FINE."""
        out = []
        at = 0
        for kind, cell in self.all_numbers():
            if rests is None:
                out.append(kind.number(cell))
                continue
            bits = kind.left(cell)
            out.append(kind.number(cell, rests.number(at, bits)))
            at += bits
        return out

    def read_fine(self, data):
        bits = sum(kind.left(cell) for kind, cell in self.all_numbers())
        require(len(data) == (bits + 7) // 8, "C-069")
        rests = Bits(data)
        require(rests.number(bits, -bits % 8) == 0, "C-069")
        self.fine = self.numbers(rests)

    def check_fine(self):
        kinds = self.position_cells + [kind for these in self.wedge_cells for kind in these.kinds]
        exact = all(kind.exact for kind in kinds)
        require((self.fine is None) == exact, "C-068")

    def level(self):
        """The state with its elements as bytes."""
        numbers = iter(self.fine or self.numbers())
        state = self.state
        position = [take(numbers, 3) for _ in state.position]
        attributes = [[take(numbers, form.count) for _ in state.vertex_of]
                      for form in self.mesh.wedge_attributes]
        return model.State(position, state.vertex_of, attributes, state.map, state.triangle_group,
                           state.vsplits)


def take(numbers, count):
    return b"".join(next(numbers) for _ in range(count))


class Bits:
    """A row of bits, the lowest of the first byte first."""

    def __init__(self, data):
        self.data = data

    def number(self, at, bits):
        row = self.data[at // 8 : (at + bits + 7) // 8]
        return int.from_bytes(row, "little") >> (at % 8) & ((1 << bits) - 1)


class Decoder:
    """Decodes the chunks of the meshes of a file."""

    def __init__(self, meshes):
        self.meshes = meshes
        self.decoders = []

    @property
    def states(self):
        return [decoder.state for decoder in self.decoders]

    def read_base(self, chunk):
        payload = Payload(chunk.payload)
        number = read_varint(payload)
        require(number == len(self.decoders) and number < len(self.meshes), "C-050")
        self.decoders.append(MeshDecoder(self.meshes[number], payload))
        return number

    def read_pckt(self, chunk):
        """compact.md 6."""
        payload = Payload(chunk.payload)
        number, first_vsplit = read_varint(payload), read_varint(payload)
        vsplits, kind = divmod(read_varint(payload, 1 << 33), 2)
        require(number < len(self.meshes), "C-055")
        decoder = self.decoders[number]
        state = decoder.state
        require(first_vsplit == state.vsplits, "M-020")
        require(0 < vsplits <= decoder.mesh.vsplits - first_vsplit, "K-006")
        run = Run(payload.rest())
        if kind == BATCH:
            decoder.read_batch(run)
        else:
            decoder.read_own(run, vsplits)
        run.end()
        require(state.vsplits == first_vsplit + vsplits, "K-006")
        return number

    def read_fine(self, chunk, meshes):
        payload = Payload(chunk.payload)
        number = payload.u32()
        require(number < len(meshes), "C-067")
        self.decoders[number].read_fine(payload.rest())
        return number, None

    def read_face(self, chunk, meshes):
        payload = Payload(chunk.payload)
        number = payload.varint()
        require(number < len(meshes), "C-060")
        table = compact_faces.read(meshes[number], self.decoders[number].state, payload)
        model.check_face_table(meshes[number], table)
        return number, table

    def check_fine(self):
        """At the end of a file."""
        for decoder in self.decoders:
            decoder.check_fine()

    def level(self, number):
        """The state of a mesh with its elements as bytes."""
        return self.decoders[number].level()
