"""The binary variant: chunks, headers, index and what strips cannot say (spec/container.md)."""

import dataclasses
import struct
import zlib

import model
from model import NONE, require

SIGNATURE = bytes.fromhex("8A5053540D0A1A0A")  # container.md 1

# container.md 4. C-016 says more of those that share a rank.
ORDER = [
    {b"PSHD"}, {b"sCNE"}, {b"mTRL"}, {b"MESH"}, {b"PIDX"}, {b"BASE"}, {b"PCKT"},
    {b"FINE", b"fACE", b"wELD", b"oRDP", b"dGST"}, {b"iMGE"}, {b"fRGN"}, {b"PEND"},
]
RANK = {name: rank for rank, names in enumerate(ORDER) for name in names}


class Payload:
    """The fields of a payload, read one after the other (container.md, types in the tables)."""

    def __init__(self, data):
        self.data = data
        self.at = 0

    def take(self, count):
        require(count <= len(self.data) - self.at, "C-020")
        self.at += count
        return self.data[self.at - count : self.at]

    def number(self, code):
        return struct.unpack("<" + code, self.take(struct.calcsize("<" + code)))[0]

    def u8(self):
        return self.number("B")

    def u16(self):
        return self.number("H")

    def u32(self):
        return self.number("I")

    def u64(self):
        return self.number("Q")

    def varint(self, bits=32):
        value = at = 0
        while True:
            byte = self.u8()
            value |= (byte & 127) << at
            at += 7
            if byte < 128:
                break
            require(at < bits, "C-020")
        require(value < 1 << bits and (byte or at == 7), "C-020")
        return value

    def folded(self):
        value = self.varint()
        return -(value >> 1) - 1 if value & 1 else value >> 1

    def one_of(self, count):
        """A byte with a list of values, 0 to count - 1."""
        value = self.u8()
        require(value < count, "C-023")
        return value

    def zeros(self, count, clause="C-021"):
        require(not any(self.take(count)), clause)

    def string(self):
        return self.take(self.u32())

    def align(self):
        self.zeros(-self.at % 8, "C-022")

    def u32s(self, count):
        """u32[count], aligned."""
        numbers = list(struct.unpack(f"<{count}I", self.take(4 * count)))
        self.align()
        return numbers

    def elements(self, count, form):
        """element[count], aligned; each is kept as its bytes."""
        size = form.element_bytes()
        data = self.take(count * size)
        self.align()
        return [data[i * size : (i + 1) * size] for i in range(count)]

    def packed(self, count, bits):
        """A packed array, aligned (container.md 8.2)."""
        data = self.take((count * bits + 7) // 8)
        row = int.from_bytes(data, "little")
        require(row >> (count * bits) == 0, "C-066")
        self.align()
        # Bit by bit from a string: shifting the whole row for each number would be quadratic.
        digits = bin(row)[2:].zfill(count * bits)[::-1]
        return [int("0" + digits[i * bits : (i + 1) * bits][::-1], 2) for i in range(count)]

    def rest(self):
        return self.take(len(self.data) - self.at)

    def end(self):
        require(self.at == len(self.data), "C-020")


@dataclasses.dataclass
class Chunk:
    type: bytes
    offset: int  # of the type, from the start of the file
    bytes: int  # of the whole chunk
    payload: bytes


def read_chunks(data):
    """All chunks of a file, their CRCs checked (container.md 1 and 2)."""
    require(data[:8] == SIGNATURE[: len(data)], "C-001")
    chunks = []
    at = 8
    while not chunks or chunks[-1].type != b"PEND":
        if len(data) - at < 8:
            raise model.Violation("truncated", "D-010")
        name, n = struct.unpack_from("<4sI", data, at)
        require(name.isalpha() and name.isascii(), "C-002")
        require(name[2:3].isupper(), "C-003")
        require(n <= 2147483647, "C-004")
        k = (4 - n) % 8
        if 12 + n + k > len(data) - at:
            raise model.Violation("truncated", "D-010")
        require(not any(data[at + 8 + n : at + 8 + n + k]), "C-005")
        (crc,) = struct.unpack_from("<I", data, at + 8 + n + k)
        require(crc == zlib.crc32(data[at : at + 8 + n + k]), "C-006")
        chunks.append(Chunk(name, at, 12 + n + k, data[at + 8 : at + 8 + n]))
        at += 12 + n + k
    require(at == len(data), "C-017")
    require(not chunks[-1].payload, "C-018")
    return chunks


def check_order(chunks):
    """Which chunks there are, and in which order (container.md 4)."""
    require(chunks[0].type == b"PSHD", "C-010")
    rank = 0
    for chunk in chunks:
        if chunk.type not in RANK:
            if chunk.type[:1].isupper():
                raise model.Violation("unsupported", "C-007")
            continue
        require(RANK[chunk.type] >= rank, "C-011")
        rank = RANK[chunk.type]
    for name in (b"PSHD", b"sCNE", b"mTRL", b"PIDX", b"PEND"):
        count = sum(chunk.type == name for chunk in chunks)
        require(count <= 1, "C-012")
        require(count == 1 or name in (b"sCNE", b"mTRL"), "C-011")


@dataclasses.dataclass
class Header:
    profile: int
    meshes: int
    packets: int
    totals: list  # vertices, wedges, triangles, strips, map_entries, faces
    vsplits: int
    base_end: int
    file_bytes: int


def read_pshd(chunk):
    """container.md 5.1."""
    payload = Payload(chunk.payload)
    if payload.u16() != 1:
        raise model.Violation("unsupported", "C-030")
    payload.u16()  # version_minor, D-050
    profile = payload.u8()
    if profile > 1:
        raise model.Violation("unsupported", "C-031")
    require(payload.u8() <= 3, "C-023")  # conformance
    if payload.u16() != 0:
        raise model.Violation("unsupported", "C-032")
    meshes, packets = payload.u32(), payload.u32()
    totals = [payload.u64() for _ in range(6)]
    payload.u64()  # decoder_memory
    header = Header(profile, meshes, packets, totals, payload.u64(), payload.u64(), payload.u64())
    payload.end()
    return header


def read_format(payload):
    """container.md 5.2, format."""
    form = model.Format(payload.string(), payload.u8(), payload.u8(), payload.one_of(2))
    payload.zeros(1)
    require(form.type < 8, "M-003")
    require(form.count != 0, "M-004")
    return form


def read_group(payload):
    """container.md 5.2, group."""
    name, material, kind = payload.string(), payload.u32(), payload.one_of(3)
    payload.zeros(3)
    return model.Group(name, material, kind, payload.u32())


def read_compact_fields(payload, mesh):
    """container.md 5.2, the last fields of MESH in the compact profile."""
    step, exact = payload.number("f"), payload.one_of(2)
    mesh.effort = payload.one_of(2)
    payload.zeros(2)
    mesh.grid = model.Grid(step, exact, [payload.number("q") for _ in range(3)])


def read_mesh(chunk, profile, materials):
    """container.md 5.2, with the counts of model.md."""
    payload = Payload(chunk.payload)
    mesh = model.Mesh(payload.string())
    mesh.encoding = payload.one_of(3)
    mesh.placement = payload.one_of(2)
    mesh.single_wedges = payload.one_of(2)
    payload.zeros(1)
    mesh.position = read_format(payload)
    count = payload.u32()
    require(count <= 1024, "M-006")
    mesh.wedge_attributes = [read_format(payload) for _ in range(count)]
    count = payload.u32()
    require(count <= 1024, "M-006")
    mesh.face_attributes = [read_format(payload) for _ in range(count)]
    mesh.groups = [read_group(payload) for _ in range(payload.u32())]
    for name in ("vertices", "wedges", "triangles", "strips", "map_entries", "vsplits", "faces",
                 "base_vertices", "base_wedges"):
        setattr(mesh, name, payload.u32())
    if profile == 1:
        read_compact_fields(payload, mesh)
    payload.end()
    model.check_counts(mesh, materials)
    return mesh


@dataclasses.dataclass
class Row:
    offset: int
    bytes: int
    mesh: int
    vsplits: int
    vertices: int
    triangles: int
    strips: int
    error: float
    one_sided_error: float


def read_pidx(chunk, meshes):
    """container.md 6."""
    payload = Payload(chunk.payload)
    rows = []
    last = {}  # the row before of a mesh
    end = chunk.offset + chunk.bytes
    while payload.at < len(payload.data):
        size = payload.varint(33)
        offset = end + (payload.varint(63) + 1 if size & 1 else 0)
        end = offset + (size >> 1)
        number, vsplits = len(rows), 0
        if number >= len(meshes):
            number = 0 if len(meshes) == 1 else payload.varint()
            vsplits = payload.varint()
        require(number < len(meshes), "C-042")
        mesh, before = meshes[number], last.get(number)
        vertices = before.vertices + vsplits if before else mesh.base_vertices
        surplus = (before.triangles - 2 * before.vertices if before else 0) + payload.folded()
        triangles = (surplus + 2 * vertices) % 2**32
        strips = triangles
        if mesh.encoding != model.TRIANGLES:
            strips = ((before.strips if before else 0) + payload.folded()) % 2**32
        error = payload.take(4)
        bits = (int.from_bytes(error, "little") - payload.varint()) % 2**32
        one_sided = struct.unpack("<f", bits.to_bytes(4, "little"))[0]
        last[number] = Row(offset, size >> 1, number, vsplits, vertices, triangles, strips,
                           struct.unpack("<f", error)[0], one_sided)
        rows.append(last[number])
    return rows


def read_face(chunk, meshes):
    """container.md 8.1 and model.md 6: (mesh, face table)."""
    payload = Payload(chunk.payload)
    number, n, corners, replaced = (payload.u32() for _ in range(4))
    require(number < len(meshes), "C-060")
    mesh = meshes[number]
    table = model.FaceTable()
    table.first = payload.u32s(n + 1) if n else [0]
    table.corners = payload.u32s(corners)
    table.group = payload.u32s(n)
    table.replaced_first = payload.u32s(n + 1) if n else [0]
    table.replaced = payload.u32s(replaced)
    table.attributes = [payload.elements(mesh.faces, form) for form in mesh.face_attributes]
    payload.end()
    model.check_face_table(mesh, table)
    return number, table


def read_weld(chunk, meshes):
    """container.md 8.4: (mesh, welding)."""
    payload = Payload(chunk.payload)
    number = payload.u32()
    require(number < len(meshes), "C-072")
    mesh = meshes[number]
    welding = mesh.welding = model.Welding(payload.u32(), payload.u32())
    welded, corners, numbered, moved = (payload.u32() for _ in range(4))
    widths = [payload.u8() for _ in range(4)]
    model.check_welding_counts(mesh, welding, (welded, corners, numbered, moved))
    for name, count, bits in zip(("skip", "more", "corner", "vertex"),
                                 (welded, welded, corners, numbered), widths):
        numbers = payload.packed(count, bits)
        require(max(numbers, default=0).bit_length() == bits, "C-073")
        setattr(welding, name, numbers)
    welding.moved = payload.u32s(moved)
    welding.moved_position = payload.elements(moved, mesh.position)
    payload.end()
    return number, welding


def read_ordp(chunk, meshes):
    """container.md 8.2: (mesh, original order)."""
    payload = Payload(chunk.payload)
    number, rotation_bits = payload.u32(), payload.u8()
    payload.zeros(3)
    require(number < len(meshes), "C-062")
    require(rotation_bits <= 32, "C-065")
    mesh = meshes[number]
    order = model.Order()
    vertices, wedges = mesh.decoded_counts()
    order.vertex = payload.packed(vertices, max(vertices - 1, 0).bit_length())
    if mesh.welding or not mesh.single_wedges:
        order.wedge = payload.packed(wedges, max(wedges - 1, 0).bit_length())
    order.face = payload.packed(mesh.faces, max(mesh.faces - 1, 0).bit_length())
    order.rotation = payload.packed(mesh.faces, rotation_bits)
    payload.end()
    require(max(order.rotation, default=0).bit_length() == rotation_bits, "C-065")
    return number, order


def read_dgst(chunk, meshes):
    """container.md 8.3: (mesh, digest)."""
    payload = Payload(chunk.payload)
    number, algorithm, digest = payload.u32(), payload.u32(), payload.take(32)
    payload.end()
    require(number < len(meshes), "C-063")
    if algorithm != 1:
        raise model.Violation("unsupported", "C-064")
    return number, digest


def check_scene(chunk, meshes):
    """sCNE (container.md 9): the decoded meshes do not depend on it."""
    payload = Payload(chunk.payload)
    payload.string()
    payload.one_of(2)  # texture_origin
    payload.zeros(3)
    for node in range(payload.u32()):
        payload.string()
        parent = payload.u32()
        require(parent == NONE or parent < node, "M-050")
        payload.take(16 * 8)
        for _ in range(payload.u32()):
            require(payload.u32() < meshes, "M-051")
    payload.end()


def read_materials(chunk):
    """mTRL (container.md 9): (number of materials, of each image whether it is embedded)."""
    payload = Payload(chunk.payload)
    materials = payload.u32()
    images_of_maps = []
    for _ in range(materials):
        payload.string()
        payload.take((4 + 3 + 1 + 1 + 1) * 8)
        payload.one_of(3)  # alpha_mode
        payload.one_of(2)
        payload.zeros(2)
        roles = []
        for _ in range(payload.u32()):
            roles.append(payload.one_of(8))
            payload.zeros(3)
            images_of_maps.append(payload.u32())
            payload.take(4 + (1 + 2 + 2 + 1) * 8)
        require(all(a < b for a, b in zip(roles, roles[1:])), "M-054")
    embedded = []
    for _ in range(payload.u32()):
        for _ in range(3):
            payload.string()
        embedded.append(payload.one_of(2))
        payload.zeros(3)
    payload.end()
    require(all(i < len(embedded) for i in images_of_maps), "M-052")
    return materials, embedded


def check_images(chunks, embedded):
    """iMGE (container.md 9)."""
    images = []
    for chunk in chunks:
        payload = Payload(chunk.payload)
        image = payload.u32()
        require(image < len(embedded) and embedded[image] and payload.rest(), "C-070")
        require(not images or images[-1] < image, "C-016")
        images.append(image)
    require(len(images) == sum(embedded), "C-071")


def check_foreign(chunk):
    """fRGN (container.md 9)."""
    Payload(chunk.payload).string()
