"""Generated meshes for stripifiers.py. A mesh is its vertices (x, y, z) and its triangles."""

import array
import math
import random
import sys


def torus(segments, sides=20):
    """The torus of [Vanecek05 §8.3]: every vertex has six triangles. As in tests/support."""
    vertices = []
    for i in range(segments):
        around = 2 * math.pi * i / segments
        for k in range(sides):
            tube = 2 * math.pi * k / sides
            radius = 2 + math.cos(tube)
            vertices.append((radius * math.cos(around), radius * math.sin(around), math.sin(tube)))
    triangles = []
    for i in range(segments):
        here, there = i * sides, (i + 1) % segments * sides
        for k in range(sides):
            a, b, c, d = here + k, there + k, here + (k + 1) % sides, there + (k + 1) % sides
            triangles += [(a, b, c), (b, d, c)]
    return vertices, triangles


def noisy_grid(side, share=0.25, seed=1):
    """side * side cells; the diagonals of that share of them lie the other way."""
    generator = random.Random(seed)
    row = side + 1
    vertices = [(x, y, 0.1 * math.sin(x) * math.cos(y)) for y in range(row) for x in range(row)]
    triangles = []
    for y in range(side):
        for a in range(y * row, y * row + side):
            b, c, d = a + 1, a + row + 1, a + row
            flipped = generator.random() < share
            triangles += [(a, b, d), (b, c, d)] if flipped else [(a, b, c), (a, c, d)]
    return vertices, triangles


class EdgeFlips:
    """Swaps random edges of `triangles`, in place, as [Vanecek05 §8.4] does."""

    def __init__(self, triangles, seed=1):
        self.triangles = triangles
        self.generator = random.Random(seed)
        self.beside = {}  # the triangle left of a directed edge
        for t, (a, b, c) in enumerate(triangles):
            self.beside.update({(a, b): t, (b, c): t, (c, a): t})

    def flip(self, count):
        while count > 0:
            count -= self._flip_one()

    def _flip_one(self):
        """Whether the edge drawn could be swapped: it has two sides, the new edge is new."""
        t = self.generator.randrange(len(self.triangles))
        corner = self.generator.randrange(3)
        a, b, c = (self.triangles[t][(corner + i) % 3] for i in range(3))
        u = self.beside.get((b, a))
        if u is None:
            return False
        d = next(v for v in self.triangles[u] if v not in (a, b))
        if (c, d) in self.beside or (d, c) in self.beside:
            return False
        del self.beside[a, b], self.beside[b, a]
        for triangle, corners in ((t, (c, a, d)), (u, (d, b, c))):
            self.triangles[triangle] = corners
            for i in range(3):
                self.beside[corners[i], corners[(i + 1) % 3]] = triangle
        return True


def read_obj(path):
    """Of a file that `pstrips convert --attributes none` wrote: positions and triangles alone."""
    vertices, triangles = [], []
    with open(path, encoding="utf-8") as lines:
        for line in lines:
            kind, *fields = line.split() or [""]
            if kind == "v":
                vertices.append(tuple(map(float, fields[:3])))
            elif kind == "f":
                triangles.append(tuple(int(f) - 1 for f in fields))
    return vertices, triangles


def quad_share(path):
    """How many of an OBJ file's faces have four corners, as a fraction."""
    faces = quads = 0
    with open(path, encoding="utf-8", errors="replace") as lines:
        for line in lines:
            if line.startswith("f "):
                faces += 1
                quads += len(line.split()) == 5
    return quads / faces if faces else 0


def write_ply(path, mesh):
    vertices, triangles = mesh
    coordinates = array.array("f", (x for vertex in vertices for x in vertex))
    corners = array.array("i", (c for triangle in triangles for c in triangle))
    if sys.byteorder == "big":
        coordinates.byteswap()
        corners.byteswap()
    indices = corners.tobytes()
    with open(path, "wb") as out:
        out.write(f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\n"
                  "property float x\nproperty float y\nproperty float z\n"
                  f"element face {len(triangles)}\nproperty list uchar int vertex_indices\n"
                  "end_header\n".encode())
        out.write(coordinates.tobytes())
        out.write(b"".join(b"\3" + indices[i:i + 12] for i in range(0, len(indices), 12)))
