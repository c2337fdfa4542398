"""BASE and PCKT of the plain profile (container.md 7)."""

import container
import model
from container import Payload
from model import TRIANGLES, require


class Decoder:
    """Decodes the chunks of the meshes of a file, each with its own state."""

    def __init__(self, meshes):
        self.meshes = meshes
        self.states = []

    def read_base(self, chunk):
        """container.md 7.1."""
        payload = Payload(chunk.payload)
        number, vertices, wedges, m = (payload.u32() for _ in range(4))
        require(number == len(self.states) and number < len(self.meshes), "C-050")
        mesh = self.meshes[number]
        require((vertices, wedges) == (mesh.base_vertices, mesh.base_wedges), "C-051")
        if mesh.encoding == TRIANGLES:
            require(m <= mesh.map_entries, "C-051")
            require(m % 3 == 0, "S-005")
        else:
            require(m == mesh.map_entries, "C-051")
        state = model.State(position=payload.elements(vertices, mesh.position),
                            vertex_of=list(range(wedges)) if mesh.single_wedges
                            else payload.u32s(wedges),
                            attributes=[payload.elements(wedges, form)
                                        for form in mesh.wedge_attributes],
                            map=payload.u32s(m))
        if mesh.lists_groups():
            state.triangle_group = payload.u32s(m // 3)
        payload.end()
        model.check_base(mesh, state)
        self.states.append(state)
        return number

    def read_pckt(self, chunk):
        """container.md 7.2: applies the records and returns the number of the mesh."""
        payload = Payload(chunk.payload)
        number, first_vsplit, n, new_wedges, reassigned, map_offsets = (
            payload.u32() for _ in range(6))
        require(number < len(self.meshes), "C-055")
        mesh, state = self.meshes[number], self.states[number]
        grows = mesh.encoding == TRIANGLES
        triangles = 0
        if grows:
            triangles = payload.u32()
            payload.zeros(4)
        require(first_vsplit == state.vsplits, "M-020")
        require(0 < n <= mesh.vsplits - first_vsplit, "M-022" if n == 0 else "M-021")
        if mesh.single_wedges:
            require(new_wedges == n and reassigned == 0, "C-058")
        fields = Fields()
        fields.parent = payload.u32s(n)
        fields.wedges = [1] * n if mesh.single_wedges else payload.u32s(n)
        fields.reassigned = [0] * n if mesh.single_wedges else payload.u32s(n)
        fields.wedge_offset_counts = payload.u32s(new_wedges)
        fields.triangles = payload.u32s(n) if grows else [0] * n
        fields.position = payload.elements(n, mesh.position)
        optimal = mesh.placement == model.OPTIMAL
        fields.parent_position = payload.elements(n, mesh.position) if optimal else [None] * n
        fields.attributes = [payload.elements(new_wedges, form) for form in mesh.wedge_attributes]
        fields.reassigned_wedges = payload.u32s(reassigned)
        fields.map_offsets = payload.u32s(map_offsets)
        fields.new_corners = payload.u32s(3 * triangles) if grows else []
        fields.triangle_group = payload.u32s(triangles) if mesh.lists_groups() else []
        payload.end()
        require(sum(fields.wedges) == new_wedges, "C-056")
        require(sum(fields.reassigned) == reassigned, "C-056")
        require(sum(fields.wedge_offset_counts) == map_offsets, "C-057")
        require(sum(fields.triangles) == triangles, "C-059")
        require(len(state.vertex_of) + new_wedges <= mesh.wedges, "M-015")
        require(len(state.map) + 3 * triangles <= mesh.map_entries, "M-016")
        for record in fields.records():
            model.apply_record(mesh, state, record)
        return number

    def read_fine(self, _chunk, _meshes):
        """FINE is known in the compact profile alone."""
        raise model.Violation("unsupported", "C-007")

    def read_face(self, chunk, meshes):
        return container.read_face(chunk, meshes)

    def check_fine(self):
        """There is none to be missed."""

    def level(self, number):
        """The state of a mesh with its elements as bytes."""
        return self.states[number]


class Fields:
    """The arrays of a PCKT."""

    def records(self):
        """Record by record; what belongs to one follows that of the record before it."""
        w = c = p = t = 0
        for k, parent in enumerate(self.parent):
            record = model.Record(parent, self.position[k], self.parent_position[k])
            record.reassigned = self.reassigned_wedges[c : c + self.reassigned[k]]
            c += self.reassigned[k]
            for _ in range(self.wedges[k]):
                offsets = self.map_offsets[p : p + self.wedge_offset_counts[w]]
                record.new_wedges.append(
                    model.NewWedge([elements[w] for elements in self.attributes], offsets))
                p += self.wedge_offset_counts[w]
                w += 1
            record.new_corners = self.new_corners[3 * t : 3 * (t + self.triangles[k])]
            record.new_groups = self.triangle_group[t : t + self.triangles[k]]
            t += self.triangles[k]
            yield record
