#!/usr/bin/env python3
"""Makes the models of this folder, all from formulas: make_models.py [FOLDER]

With --check it writes nothing and says which files differ from what it would write.
"""

import base64
import io
import itertools
import json
import math
import pathlib
import random
import struct
import sys
import zlib

# ---- surfaces: (positions, faces), faces counter-clockwise seen from outside


def implicit_surface(inside, cells, box):
    """Marching tetrahedra over a cube of `cells`³ cells; `inside` is positive inside the body.

    Every cell is cut into six tetrahedra around one diagonal, so that neighbours agree and the
    surface of a body within the box is closed.
    """
    step = 2 * box / cells
    # A tetrahedron walks from one end of the diagonal to the other, one axis after the other.
    unit = [(1, 0, 0), (0, 1, 0), (0, 0, 1)]
    add = lambda p, q: tuple(a + b for a, b in zip(p, q))
    axes = list(itertools.permutations(range(3)))
    tets = [((0, 0, 0), unit[a], add(unit[a], unit[b]), (1, 1, 1)) for a, b, _ in axes]
    value = {
        n: inside(*(x * step - box for x in n)) for n in itertools.product(range(cells + 1), repeat=3)
    }
    positions, faces, vertex = [], [], {}

    def crossing(a, b):
        key = (min(a, b), max(a, b))
        if key not in vertex:
            a, b = key
            t = min(max(value[a] / (value[a] - value[b]), 0.1), 0.9)
            vertex[key] = len(positions)
            positions.append(tuple((p + t * (q - p)) * step - box for p, q in zip(a, b)))
        return vertex[key]

    for cell in itertools.product(range(cells), repeat=3):
        for tet, order in zip(tets, axes):
            nodes = [add(cell, corner) for corner in tet]
            if permutation_sign(order) < 0:
                nodes[0], nodes[1] = nodes[1], nodes[0]
            within = [k for k in range(4) if value[nodes[k]] > 0]
            faces.extend(tetrahedron_faces(nodes, within, crossing))
    return positions, faces


def tetrahedron_faces(nodes, within, crossing):
    """The triangles that part the nodes `within` from the others."""
    outside = [k for k in range(4) if k not in within]
    if not within or not outside:
        return []
    if len(within) == 2:
        a, b = within
        c, d = outside
        ring = [crossing(nodes[i], nodes[j]) for i, j in ((a, c), (a, d), (b, d), (b, c))]
        flip = permutation_sign((a, b, c, d)) < 0
    else:
        apex, base = (within, outside) if len(within) == 1 else (outside, within)
        ring = [crossing(nodes[apex[0]], nodes[k]) for k in base]
        flip = (permutation_sign((apex[0], *base)) < 0) != (len(within) == 3)
    if flip:
        ring.reverse()
    return [(ring[0], ring[k], ring[k + 1]) for k in range(1, len(ring) - 1)]


def permutation_sign(p):
    return -1 if sum(p[i] > p[j] for i in range(len(p)) for j in range(i + 1, len(p))) % 2 else 1


def double_ring(cells):
    """Two rings grown together: closed, genus 2."""

    def inside(x, y, z):
        ring = lambda cx: (math.hypot(x - cx, y) - 0.62) ** 2 + z * z
        return 0.012 - ring(-0.62) * ring(0.62)

    return implicit_surface(inside, cells, 1.6)


def terrain():
    """A height field with holes and a ragged rim, its diagonals laid at random."""
    n, rng = 40, random.Random(1)
    height = lambda x, y: 0.3 * math.sin(5 * x) * math.cos(4 * y) + 0.05 * math.sin(23 * x + 17 * y)
    positions = []
    for i, j in itertools.product(range(n + 1), repeat=2):
        x, y = (i + 0.3 * rng.random()) / n, (j + 0.3 * rng.random()) / n
        positions.append((x, y, height(x, y)))
    faces = []
    for i, j in itertools.product(range(n), repeat=2):
        a, b = i * (n + 1) + j, (i + 1) * (n + 1) + j
        c, d = b + 1, a + 1
        faces += [(a, b, c), (a, c, d)] if rng.random() < 0.5 else [(a, b, d), (b, c, d)]
    holes = ((0.3, 0.3, 0.01), (0.7, 0.6, 0.02))
    hole = lambda x, y: any((x - u) ** 2 + (y - v) ** 2 < r for u, v, r in holes)
    faces = [f for f in faces if not hole(*positions[f[0]][:2]) and rng.random() > 0.004]
    return positions, faces


def grid(columns, rows, point, closed_columns=False, closed_rows=False):
    """Quads over a grid of points."""
    across, along = columns + (not closed_columns), rows + (not closed_rows)
    positions = [point(i, j) for i in range(across) for j in range(along)]
    at = lambda i, j: (i % across) * along + j % along
    faces = [
        (at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1))
        for i in range(columns)
        for j in range(rows)
    ]
    return positions, faces


def torus_point(u, v, small=0.4):
    r = 1 + small * math.cos(v)
    return r * math.cos(u), r * math.sin(u), small * math.sin(v)


def quad_torus(columns, rows):
    turn = 2 * math.pi
    return grid(columns, rows, lambda i, j: torus_point(turn * i / columns, turn * j / rows), True, True)


def moebius():
    """A one-sided band: no winding suits all its quads."""
    columns, rows = 40, 4

    def point(i, j):
        u, v = 2 * math.pi * i / columns, 0.5 * (j / rows - 0.5)
        r = 1 + v * math.cos(u / 2)
        return r * math.cos(u), r * math.sin(u), v * math.sin(u / 2)

    positions, faces = grid(columns - 1, rows, point)
    last = (columns - 1) * (rows + 1)
    for j in range(rows):
        faces.append((last + j, rows - j, rows - j - 1, last + j + 1))
    return positions, faces


def catmull_clark(positions, faces):
    """One step: n-gons become n quads; borders are not treated."""
    mean = lambda points: tuple(sum(c) / len(points) for c in zip(*points))
    edges, around = {}, {}
    for f, face in enumerate(faces):
        for a, b in zip(face, face[1:] + face[:1]):
            edges.setdefault((min(a, b), max(a, b)), []).append(f)
            around.setdefault(a, []).append(f)
    middle = [mean([positions[v] for v in face]) for face in faces]
    out, edge_vertex = [], {}
    for v, p in enumerate(positions):
        n = len(around[v])
        of_faces = mean([middle[f] for f in around[v]])
        of_edges = mean([mean([positions[a], positions[b]]) for a, b in edges if v in (a, b)])
        out.append(tuple((f + 2 * e + (n - 3) * x) / n for f, e, x in zip(of_faces, of_edges, p)))
    for (a, b), fs in edges.items():
        edge_vertex[a, b] = len(out)
        out.append(mean([positions[a], positions[b]] + [middle[f] for f in fs]))
    first = len(out)
    out += middle
    side = lambda a, b: edge_vertex[min(a, b), max(a, b)]
    quads = [
        (face[k], side(face[k], face[(k + 1) % len(face)]), first + f, side(face[k - 1], face[k]))
        for f, face in enumerate(faces)
        for k in range(len(face))
    ]
    return out, quads


def frame():
    """A cube with a tunnel through each of two pairs of sides, of quads: genus 3 when smooth."""
    solid = set(itertools.product(range(3), repeat=3))
    solid -= {(1, 1, k) for k in range(3)} | {(1, k, 1) for k in range(3)}
    positions, faces, index = [], [], {}

    def vertex(p):
        if p not in index:
            index[p] = len(positions)
            positions.append(tuple(float(x) for x in p))
        return index[p]

    for cell in sorted(solid):
        for axis, sign in itertools.product(range(3), (0, 1)):
            other = list(cell)
            other[axis] += 2 * sign - 1
            if tuple(other) in solid:
                continue
            u, v = (axis + 1) % 3, (axis + 2) % 3
            ring = []
            for du, dv in ((0, 0), (1, 0), (1, 1), (0, 1)):
                p = list(cell)
                p[axis] += sign
                p[u] += du
                p[v] += dv
                ring.append(vertex(tuple(p)))
            faces.append(tuple(ring if sign else ring[::-1]))
    return positions, faces


def smooth_frame():
    positions, faces = frame()
    for _ in range(2):
        positions, faces = catmull_clark(positions, faces)
    return positions, faces


def dual(positions, faces):
    """A polygon a vertex, a vertex a face: mixed polygon sizes from an irregular mesh."""
    mean = lambda points: tuple(sum(c) / len(points) for c in zip(*points))
    follows = {}
    for f, face in enumerate(faces):
        for k, v in enumerate(face):
            follows.setdefault(v, {})[face[k - 1]] = (f, face[(k + 1) % len(face)])
    out = []
    for v in sorted(follows):
        start = at = min(follows[v])
        ring = []
        while True:
            f, at = follows[v][at]
            ring.append(f)
            if at == start:
                break
        out.append(tuple(ring[::-1]))
    return [mean([positions[v] for v in face]) for face in faces], [f for f in out if len(f) > 2]


def non_manifold():
    """Sheets at a common edge, bodies at a common vertex, faces twice and turned, a lone vertex."""
    positions, faces = [], []

    def add(mesh):
        first = len(positions)
        positions.extend(mesh[0])
        faces.extend(tuple(first + v for v in face) for face in mesh[1])
        return first

    n = 12
    spine = [(0.0, 0.0, k / n) for k in range(n + 1)]
    positions.extend(spine)
    for sheet in range(5):
        angle = 2 * math.pi * sheet / 5
        columns = [list(range(n + 1))]
        for r in range(1, 7):
            first = len(positions)
            x, y = r / 6 * math.cos(angle), r / 6 * math.sin(angle)
            positions.extend((x, y, k / n) for k in range(n + 1))
            columns.append(list(range(first, first + n + 1)))
        for left, right in zip(columns, columns[1:]):
            for k in range(n):
                faces += [(left[k], right[k], right[k + 1]), (left[k], right[k + 1], left[k + 1])]
    for sign in (-1, 1):  # two cones, tip to tip at one vertex of the spine
        first, turn = len(positions), 2 * math.pi / 9
        for k in range(9):
            positions.append((0.4 * math.cos(turn * k), 0.4 * math.sin(turn * k), 1 + sign * 0.4))
            faces.append((n, first + k, first + (k + 1) % 9)[::sign])
    torus_positions, quads = quad_torus(9, 6)
    first = add(([tuple(c + 3 for c in p) for p in torus_positions], triangulated(quads)))
    faces += [faces[-1], faces[-2][::-1], (first, first, first + 1)]
    positions.append((9.0, 9.0, 9.0))
    return positions, faces


def soup():
    """Triangles between random vertices, many of them at the same edges."""
    rng = random.Random(7)
    positions = [tuple(rng.random() for _ in range(3)) for _ in range(60)]
    faces = [tuple(rng.randrange(60) for _ in range(3)) for _ in range(400)]
    return positions, faces


def triangulated(faces):
    return [(f[0], f[k], f[k + 1]) for f in faces for k in range(1, len(f) - 1)]


# ---- a sphere in six charts: (positions, normals, uvs, triangles over all three)


def charted_sphere(n):
    """A cube blown up to a bumpy sphere; each side has a chart of its own, two sides are mirrored."""
    positions, uvs, corners, index = [], [], [], {}
    for side in range(6):
        axis, sign = side % 3, 1 if side < 3 else -1
        grid_index = {}
        for i, j in itertools.product(range(n + 1), repeat=2):
            p = [0, 0, 0]
            p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3] = sign * n, 2 * i - n, sign * (2 * j - n)
            key = tuple(p)
            if key not in index:
                index[key] = len(positions)
                positions.append(bumpy(p))
            u = (n - i if side in (1, 4) else i) / n
            uvs.append(((side % 3 + 0.05 + 0.9 * u) / 3, (side // 3 + 0.05 + 0.9 * j / n) / 2))
            grid_index[i, j] = (index[key], len(uvs) - 1)
        for i, j in itertools.product(range(n), repeat=2):
            quad = [grid_index[i + a, j + b] for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
            corners += [quad[0], quad[1], quad[2], quad[0], quad[2], quad[3]]
    normals = smooth_normals(positions, [c[0] for c in corners])
    return positions, normals, uvs, corners


def bumpy(p):
    length = math.sqrt(sum(x * x for x in p))
    d = [x / length for x in p]
    r = 1 + 0.12 * math.sin(4 * d[0]) * math.sin(5 * d[1] + 1) * math.cos(3 * d[2])
    return tuple(r * x for x in d)


def smooth_normals(positions, corners):
    sums = [[0.0] * 3 for _ in positions]
    for a, b, c in zip(corners[0::3], corners[1::3], corners[2::3]):
        u = [q - p for p, q in zip(positions[a], positions[b])]
        v = [q - p for p, q in zip(positions[a], positions[c])]
        n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        for k in (a, b, c):
            for axis in range(3):
                sums[k][axis] += n[axis]
    return [tuple(x / (math.sqrt(sum(y * y for y in s)) or 1) for x in s) for s in sums]


# ---- files


def checker_png():
    """8 by 8 squares in two colours; stored, not deflated, so that every zlib writes the same."""
    size, colours = 16, (b"\x30\x60\xa0", b"\xd8\x70\x30")
    rows = b"".join(
        b"\0" + b"".join(colours[(x // 2 + y // 2) % 2] for x in range(size)) for y in range(size)
    )
    head = struct.pack(">IIBBBBB", size, size, 8, 2, 0, 0, 0)
    chunks = ((b"IHDR", head), (b"IDAT", zlib.compress(rows, 0)), (b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
        for kind, body in chunks
    )


def ply(positions, faces, form="binary_little_endian", number="float", extra=(), values=()):
    head = ["ply", f"format {form} 1.0", "comment made by make_models.py"]
    head += [f"element vertex {len(positions)}"]
    head += [f"property {number} {axis}" for axis in "xyz"] + [f"property {t} {name}" for t, name in extra]
    if faces is not None:
        head += [f"element face {len(faces)}", "property list uchar int vertex_indices"]
    out = io.BytesIO()
    out.write(("\n".join(head + ["end_header"]) + "\n").encode())
    values = values or [()] * len(positions)
    if form == "ascii":
        for p, more in zip(positions, values):
            out.write((" ".join([f"{x:.6g}" for x in p] + [str(m) for m in more]) + "\n").encode())
        for face in faces or ():
            out.write((" ".join(map(str, (len(face), *face))) + "\n").encode())
    else:
        order = "<" if form.endswith("little_endian") else ">"
        letters = {"float": "f", "double": "d", "uchar": "B"}
        row = order + letters[number] * 3 + "".join(letters[t] for t, _ in extra)
        for p, more in zip(positions, values):
            out.write(struct.pack(row, *p, *more))
        for face in faces or ():
            out.write(struct.pack(f"{order}B{len(face)}i", len(face), *face))
    return out.getvalue()


def tristrips_ply(columns, rows):
    positions, _ = quad_torus(columns, rows)
    strips = []
    for i in range(columns):
        for j in range(rows + 1):
            strips += [((i + 1) % columns) * rows + j % rows, i * rows + j % rows]
        strips.append(-1)
    head = ["ply", "format ascii 1.0", f"element vertex {len(positions)}"]
    head += [f"property float {axis}" for axis in "xyz"]
    head += ["element tristrips 1", "property list int int vertex_indices", "end_header"]
    body = [" ".join(f"{x:.6g}" for x in p) for p in positions]
    body += [" ".join(map(str, [len(strips)] + strips))]
    return ("\n".join(head + body) + "\n").encode()


def obj(positions, faces, normals=None):
    lines = ["# made by make_models.py", "o surface"]
    lines += [f"v {x:.6g} {y:.6g} {z:.6g}" for x, y, z in positions]
    if normals:
        lines += [f"vn {x:.4f} {y:.4f} {z:.4f}" for x, y, z in normals]
    corner = (lambda v: f"{v + 1}//{v + 1}") if normals else (lambda v: str(v + 1))
    lines += ["f " + " ".join(corner(v) for v in face) for face in faces]
    return ("\n".join(lines) + "\n").encode()


def charted_obj(n):
    positions, normals, uvs, corners = charted_sphere(n)
    lines = ["# made by make_models.py", "mtllib charts.mtl", "o sphere"]
    lines += [f"v {x:.6g} {y:.6g} {z:.6g}" for x, y, z in positions]
    lines += [f"vt {u:.6g} {v:.6g}" for u, v in uvs]
    lines += [f"vn {x:.4f} {y:.4f} {z:.4f}" for x, y, z in normals]
    lines += ["usemtl checker"]
    word = lambda c: f"{c[0] + 1}/{c[1] + 1}/{c[0] + 1}"
    triangles = zip(corners[0::3], corners[1::3], corners[2::3])
    lines += [f"f {word(a)} {word(b)} {word(c)}" for a, b, c in triangles]
    return ("\n".join(lines) + "\n").encode()


def curves_obj():
    """Polylines, points, a free curve's worth of groups, and one triangle among them."""
    lines = ["# made by make_models.py", "g spirals"]
    count = 0
    for s in range(3):
        for k in range(40):
            u = k / 6
            lines.append(f"v {u * math.cos(u + 2 * s):.6g} {u * math.sin(u + 2 * s):.6g} {s}")
        lines.append("l " + " ".join(str(count + k + 1) for k in range(40)))
        count += 40
    lines += ["g marks", "p 1 41 81", "p -1", "g face", "f 1 41 81"]
    return ("\n".join(lines) + "\n").encode()


class Gltf:
    """A glTF asset of one buffer in the making."""

    def __init__(self):
        self.json = {"asset": {"version": "2.0", "generator": "make_models.py"}}
        self.buffer = b""

    def add(self, key, value):
        self.json.setdefault(key, []).append(value)
        return len(self.json[key]) - 1

    def view(self, data):
        self.buffer += b"\0" * (-len(self.buffer) % 4)
        span = {"buffer": 0, "byteOffset": len(self.buffer), "byteLength": len(data)}
        view = self.add("bufferViews", span)
        self.buffer += data
        return view

    def accessor(self, rows, letter, kind, bounds=False, **more):
        component = {"f": 5126, "H": 5123, "B": 5121}[letter]
        flat = [x for row in rows for x in row]
        data = struct.pack(f"<{len(flat)}{letter}", *flat)
        out = {"bufferView": self.view(data), "componentType": component, "count": len(rows)}
        out |= {"type": kind, **more}
        if bounds:
            rounded = list(struct.unpack(f"<{len(flat)}{letter}", data))
            width = len(rows[0])
            out["min"] = [min(rounded[k::width]) for k in range(width)]
            out["max"] = [max(rounded[k::width]) for k in range(width)]
        return self.add("accessors", out)

    def positions(self, rows):
        return self.accessor(rows, "f", "VEC3", bounds=True)

    def indices(self, values):
        return self.accessor([(v,) for v in values], "H", "SCALAR")

    def text(self, name):
        self.json["buffers"] = [{"uri": name, "byteLength": len(self.buffer)}]
        return (json.dumps(self.json, indent=1) + "\n").encode()

    def binary(self):
        self.buffer += b"\0" * (-len(self.buffer) % 4)
        self.json["buffers"] = [{"byteLength": len(self.buffer)}]
        text = json.dumps(self.json, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        chunks = struct.pack("<I4s", len(text), b"JSON") + text
        chunks += struct.pack("<I4s", len(self.buffer), b"BIN\0") + self.buffer
        return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def charted_primitive(asset, n):
    """The charted sphere with a glTF vertex for each pair of position and texture coordinate."""
    positions, normals, uvs, corners = charted_sphere(n)
    vertex = {}
    for corner in corners:
        vertex.setdefault(corner, len(vertex))
    attributes = {
        "POSITION": asset.positions([positions[p] for p, _ in vertex]),
        "NORMAL": asset.accessor([normals[p] for p, _ in vertex], "f", "VEC3"),
        "TEXCOORD_0": asset.accessor([uvs[t] for _, t in vertex], "f", "VEC2"),
    }
    return {"attributes": attributes, "indices": asset.indices([vertex[c] for c in corners])}


def checker_material(asset, image):
    texture = asset.add("textures", {"source": asset.add("images", image)})
    look = {"baseColorTexture": {"index": texture}}
    return asset.add("materials", {"name": "checker", "pbrMetallicRoughness": look})


def charts_glb():
    asset = Gltf()
    primitive = charted_primitive(asset, 11)
    image = {"bufferView": asset.view(checker_png()), "mimeType": "image/png"}
    primitive["material"] = checker_material(asset, image)
    mesh = asset.add("meshes", {"name": "sphere", "primitives": [primitive]})
    asset.add("scenes", {"nodes": [asset.add("nodes", {"mesh": mesh})]})
    return asset.binary()


def instances_gltf():
    """Two meshes, five nodes in three depths: a mesh several times, turned, scaled and mirrored."""
    asset = Gltf()
    sphere = charted_primitive(asset, 5)
    sphere["material"] = checker_material(asset, {"uri": "charts.png"})
    torus_positions, quads = quad_torus(16, 8)
    red = {"name": "red", "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1]}}
    ring = {
        "attributes": {"POSITION": asset.positions(torus_positions)},
        "indices": asset.indices([v for f in triangulated(quads) for v in f]),
        "material": asset.add("materials", red),
    }
    meshes = [
        asset.add("meshes", {"name": "sphere", "primitives": [sphere]}),
        asset.add("meshes", {"name": "ring", "primitives": [ring]}),
    ]
    half = round(math.sqrt(0.5), 7)
    smaller = [0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, 0, 3, 0, 1]
    for node in (
        {"name": "root", "children": [1, 2, 3]},
        {"name": "left", "mesh": meshes[0], "translation": [-2, 0, 0]},
        {"name": "right", "mesh": meshes[0], "translation": [2, 0, 0], "scale": [-1, 1, 1]},
        {"name": "arm", "rotation": [half, 0, 0, half], "children": [4, 5]},
        {"name": "ring", "mesh": meshes[1], "scale": [2, 2, 2]},
        {"name": "small ring", "mesh": meshes[1], "matrix": smaller},
    ):
        asset.add("nodes", node)
    asset.add("scenes", {"name": "all", "nodes": [0]})
    asset.json["scene"] = 0
    return asset.text("instances.bin"), asset.buffer


def skinned_glb():
    """A tube that bends at two joints, with a morph target and an animation of both."""
    asset = Gltf()
    columns, rows = 12, 16
    turn = lambda i: 2 * math.pi * i / columns
    point = lambda i, j: (0.3 * math.cos(turn(i)), 0.3 * math.sin(turn(i)), 2 * j / rows)
    positions, quads = grid(columns, rows, point, True)
    upper = [min(max(z - 0.5, 0), 1) for _, _, z in positions]
    primitive = {
        "attributes": {
            "POSITION": asset.positions(positions),
            "NORMAL": asset.accessor([(x / 0.3, y / 0.3, 0) for x, y, _ in positions], "f", "VEC3"),
            "JOINTS_0": asset.accessor([(0, 1, 0, 0)] * len(positions), "B", "VEC4"),
            "WEIGHTS_0": asset.accessor([(1 - t, t, 0, 0) for t in upper], "f", "VEC4"),
        },
        "indices": asset.indices([v for f in triangulated(quads) for v in f]),
        "targets": [{"POSITION": asset.positions([(x / 2, y / 2, 0.0) for x, y, _ in positions])}],
    }
    mesh = asset.add("meshes", {"name": "tube", "primitives": [primitive], "weights": [0]})
    identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0]
    inverse = asset.accessor([(*identity, 0, 1), (*identity, -1, 1)], "f", "MAT4")
    asset.add("nodes", {"name": "tube", "mesh": mesh, "skin": 0})
    asset.add("nodes", {"name": "lower", "children": [2]})
    asset.add("nodes", {"name": "upper", "translation": [0, 0, 1]})
    asset.add("skins", {"joints": [1, 2], "skeleton": 1, "inverseBindMatrices": inverse})
    times = asset.accessor([(0,), (1,)], "f", "SCALAR", bounds=True)
    bend = asset.accessor([(0, 0, 0, 1), (0.5, 0, 0, 0.8660254)], "f", "VEC4")
    swell = asset.accessor([(0,), (1,)], "f", "SCALAR")
    asset.add("animations", {
        "samplers": [{"input": times, "output": bend}, {"input": times, "output": swell}],
        "channels": [{"sampler": 0, "target": {"node": 2, "path": "rotation"}},
                     {"sampler": 1, "target": {"node": 0, "path": "weights"}}]})
    asset.add("scenes", {"nodes": [0, 1]})
    return asset.binary()


def lines_glb():
    """Points, lines, a line strip and a loop beside a triangle fan: all kinds of primitive."""
    asset = Gltf()
    ring = [(math.cos(2 * math.pi * k / 24), math.sin(2 * math.pi * k / 24), 0.0) for k in range(24)]
    colours = [(10 * k, 255 - 10 * k, 128, 255) for k in range(25)]
    shared = {"POSITION": asset.positions(ring + [(0.0, 0.0, 0.5)]),
              "COLOR_0": asset.accessor(colours, "B", "VEC4", normalized=True)}
    fan = asset.indices([24, *range(24), 0])
    segments = asset.indices([v for k in range(12) for v in (k, 23 - k)])
    strip = asset.indices(list(range(0, 24, 3)))
    primitives = [{"attributes": shared, "mode": 0}]
    for mode, indices in ((1, segments), (3, strip), (2, strip), (6, fan)):
        primitives.append({"attributes": shared, "mode": mode, "indices": indices})
    mesh = asset.add("meshes", {"primitives": primitives})
    asset.add("scenes", {"nodes": [asset.add("nodes", {"mesh": mesh})]})
    return asset.binary()


def scan():
    """Points of a bumpy sphere with colours, as a scanner gives them."""
    rng = random.Random(3)
    points, colours = [], []
    for _ in range(800):
        points.append(bumpy([rng.gauss(0, 1) for _ in range(3)]))
        colours.append(tuple(rng.randrange(256) for _ in range(3)))
    return points, colours


def broken_gltf():
    """An accessor that reaches beyond its buffer view."""
    asset = Gltf()
    triangle = {"attributes": {"POSITION": asset.positions([(0, 0, 0), (1, 0, 0), (0, 1, 0)])}}
    asset.add("meshes", {"primitives": [triangle]})
    asset.json["accessors"][0]["count"] = 4
    data = base64.b64encode(asset.buffer).decode()
    return asset.text("data:application/octet-stream;base64," + data)


def shuffled(positions, faces):
    rng = random.Random(5)
    order = list(range(len(positions)))
    rng.shuffle(order)
    out = [None] * len(positions)
    for old, new in enumerate(order):
        out[new] = positions[old]
    faces = [tuple(order[v] for v in f) for f in faces]
    rng.shuffle(faces)
    return out, faces


def all_files():
    ring, land = double_ring(26), shuffled(*terrain())
    cage = smooth_frame()
    torus = quad_torus(40, 25)
    cells = dual(*shuffled(*double_ring(14)))
    points, colours = scan()
    instances, instances_buffer = instances_gltf()
    ring_ply = ply(*ring)
    rgb = [("uchar", "red"), ("uchar", "green"), ("uchar", "blue")]
    red = [(k % 256, 40, 90) for k in range(len(torus[0]))]
    small = quad_torus(12, 7)
    triangles = [v for f in triangulated(cells[1]) for v in f]
    return {
        "surfaces/double_ring.ply": ring_ply,
        "surfaces/terrain.ply": ply(*land, form="binary_big_endian"),
        "surfaces/non_manifold.ply": ply(*non_manifold(), form="ascii"),
        "surfaces/soup.obj": obj(*soup()),
        "surfaces/double.ply": ply(small[0], triangulated(small[1]), number="double"),
        "surfaces/tristrips.ply": tristrips_ply(14, 9),
        "polygons/frame.obj": obj(*cage),
        "polygons/torus.ply": ply(*torus, extra=rgb, values=red),
        "polygons/moebius.obj": obj(*moebius()),
        "polygons/cells.obj": obj(*cells, smooth_normals(cells[0], triangles)),
        "textured/charts.obj": charted_obj(8),
        "textured/charts.mtl": b"newmtl checker\nKd 1 1 1\nmap_Kd charts.png\n",
        "textured/charts.png": checker_png(),
        "textured/charts.glb": charts_glb(),
        "scenes/instances.gltf": instances,
        "scenes/instances.bin": instances_buffer,
        "scenes/charts.png": checker_png(),
        "scenes/skinned.glb": skinned_glb(),
        "scenes/lines.glb": lines_glb(),
        "points/scan.ply": ply(points, None, extra=rgb, values=colours),
        "points/curves.obj": curves_obj(),
        "broken/cut.ply": ply(*quad_torus(6, 5))[:-30],
        "broken/index.obj": obj([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2), (1, 2, 7)]),
        "broken/accessor.gltf": broken_gltf(),
    }


def main():
    arguments = [a for a in sys.argv[1:] if a != "--check"]
    folder = pathlib.Path(arguments[0]) if arguments else pathlib.Path(__file__).parent
    files = all_files()
    if "--check" in sys.argv:
        same = lambda path, data: path.is_file() and path.read_bytes() == data
        different = [name for name, data in files.items() if not same(folder / name, data)]
        for name in different:
            print(f"{name}: not what make_models.py makes")
        return bool(different)
    for name, data in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(data)
    return 0


if __name__ == "__main__":
    sys.exit(main())
