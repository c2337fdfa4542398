"""glTF files in the making: accessors over a buffer that stands in the file."""

import base64
import json
import struct

FLOAT, U8, U16, U32, I8, I16 = 5126, 5121, 5123, 5125, 5120, 5122
CODES = {FLOAT: "f", U8: "B", U16: "H", U32: "I", I8: "b", I16: "h"}
TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}

SQUARE = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]
SQUARE_CORNERS = [0, 1, 2, 2, 1, 3]


class Asset:
    """Rows become accessors, whose numbers come back; members of the root are its attributes."""

    def __init__(self, **root):
        self.root = {"asset": {"version": "2.0"}, "accessors": [], "bufferViews": [], **root}
        self.bytes = b""

    def view(self, content, **more):
        self.bytes += bytes(-len(self.bytes) % 4)
        self.root["bufferViews"].append(
            {"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(content), **more})
        self.bytes += content
        return len(self.root["bufferViews"]) - 1

    def accessor(self, rows, component=FLOAT, **more):
        rows = [row if isinstance(row, (list, tuple)) else [row] for row in rows]
        flat = [x for row in rows for x in row]
        view = self.view(struct.pack(f"<{len(flat)}{CODES[component]}", *flat))
        self.root["accessors"].append({"bufferView": view, "componentType": component, "count": len(rows),
                                       "type": TYPES[len(rows[0])], **more})
        return len(self.root["accessors"]) - 1

    def positions(self, rows):
        rows = [[struct.unpack("f", struct.pack("f", x))[0] for x in row] for row in rows]
        bounds = {"min": [min(c) for c in zip(*rows)], "max": [max(c) for c in zip(*rows)]}
        return self.accessor(rows, **bounds)

    def mesh(self, positions, corners, **attributes):
        """A mesh of one primitive; attributes are accessors by name."""
        primitive = {"attributes": {"POSITION": self.positions(positions), **attributes},
                     "indices": self.accessor(corners, U16)}
        self.root.setdefault("meshes", []).append({"primitives": [primitive]})
        return len(self.root["meshes"]) - 1

    def square(self, **attributes):
        return self.mesh(SQUARE, SQUARE_CORNERS, **attributes)

    def scene(self, *nodes):
        """All nodes; those that are no children are the scene's."""
        children = {c for node in nodes for c in node.get("children", [])}
        self.root.update(nodes=list(nodes), scene=0,
                         scenes=[{"nodes": [i for i in range(len(nodes)) if i not in children]}])
        return self

    def text(self):
        root = dict(self.root)
        if self.bytes:
            uri = "data:application/octet-stream;base64," + base64.b64encode(self.bytes).decode()
            root["buffers"] = [{"byteLength": len(self.bytes), "uri": uri}]
        return json.dumps({key: value for key, value in root.items() if value != []}, indent=1)


def obj_lines(text, keyword):
    """The words of all lines of an OBJ that begin with the keyword."""
    lines = (line.split() for line in text.decode().splitlines())
    return [line[1:] for line in lines if line and line[0] == keyword]


def obj_rows(text, keyword):
    return [[float(x) for x in line] for line in obj_lines(text, keyword)]


def obj_triangles(text):
    """Positions of the corners of each face."""
    positions = obj_rows(text, "v")
    return [[positions[int(corner.split("/")[0]) - 1] for corner in face] for face in obj_lines(text, "f")]


def glb_parts(content):
    """The JSON and the buffer of a .glb."""
    length = struct.unpack("<I", content[12:16])[0]
    return json.loads(content[20:20 + length]), content[28 + length:]


def glb_rows(content, accessor):
    """The elements of an accessor of a .glb that this program wrote."""
    root, buffer = glb_parts(content)
    a = root["accessors"][accessor]
    view = root["bufferViews"][a["bufferView"]]
    width = {name: count for count, name in TYPES.items()}[a["type"]]
    code = CODES[a["componentType"]]
    stride = view.get("byteStride", width * struct.calcsize(code))
    start = view.get("byteOffset", 0) + a.get("byteOffset", 0)
    return [list(struct.unpack_from(f"<{width}{code}", buffer, start + i * stride)) for i in range(a["count"])]
