#!/usr/bin/env python3
"""Decodes files of progressive strips and compares the digest of each mesh with that in the file.

reference.py [--packets N] FILE...

prints a line for each mesh: file, mesh, vertices, wedges, faces, digest and whether that of the
file agrees, differs or is none. With --packets only the first N packets of each file are applied;
nothing is compared unless these are all. Ends with 1 when a digest differs or a file is not valid.
"""

import argparse
import pathlib
import sys

import compact
import container
import model
import plain
from model import require


class File:
    """A file decoded up to a packet."""

    def __init__(self, data, packets=None):
        chunks = container.read_chunks(data)
        container.check_order(chunks)
        self.chunks = chunks
        self.header = container.read_pshd(chunks[0])
        require(self.header.file_bytes == len(data), "C-037")
        materials, embedded = 0, []
        for chunk in self.named(b"sCNE"):
            container.check_scene(chunk, self.header.meshes)
        for chunk in self.named(b"mTRL"):
            materials, embedded = container.read_materials(chunk)
        self.meshes = [container.read_mesh(chunk, self.header.profile, materials)
                       for chunk in self.named(b"MESH")]
        self.check_totals()
        self.rows = container.read_pidx(self.named(b"PIDX")[0], self.meshes)
        self.check_rows()
        self.decode(packets)
        container.check_images(self.named(b"iMGE"), embedded)
        for chunk in self.named(b"fRGN"):
            container.check_foreign(chunk)

    def named(self, name):
        return [chunk for chunk in self.chunks if chunk.type == name]

    def check_totals(self):
        """container.md 4 and 5.1: what PSHD says of the file."""
        require(len(self.meshes) == self.header.meshes, "C-013")
        require(len(self.named(b"BASE")) == self.header.meshes, "C-014")
        require(len(self.named(b"PCKT")) == self.header.packets, "C-015")
        names = ("vertices", "wedges", "triangles", "strips", "map_entries", "faces")
        for name, total in zip(names, self.header.totals):
            require(sum(getattr(mesh, name) for mesh in self.meshes) == total, "C-034")
        require(sum(mesh.vsplits for mesh in self.meshes) == self.header.vsplits, "C-034")
        last = (self.named(b"BASE") or self.named(b"PIDX"))[-1]
        require(self.header.base_end == last.offset + last.bytes, "C-036")

    def check_rows(self):
        """container.md 6 and the bounds of model.md 5."""
        geometry = self.named(b"BASE") + self.named(b"PCKT")
        require(len(self.rows) == len(geometry), "C-040")
        bounds = {}
        for row, chunk in zip(self.rows, geometry):
            require((row.offset, row.bytes) == (chunk.offset, chunk.bytes), "C-041")
            errors = (row.error, row.one_sided_error)
            require(all(0 <= error < float("inf") for error in errors), "M-026")
            before = bounds.get(row.mesh, errors)
            require(errors[0] <= before[0] and errors[1] <= before[1], "M-027")
            require(row.one_sided_error <= row.error, "M-029")
            bounds[row.mesh] = errors

    def check_row(self, row, number, vsplits_before):
        """A row against the level that its chunk brought (C-042, M-023 to M-025)."""
        mesh, state = self.meshes[number], self.decoder.states[number]
        require((row.mesh, row.vsplits) == (number, state.vsplits - vsplits_before), "C-042")
        require(row.vertices == len(state.position), "M-023")
        shown, strips_shown = model.triangles(mesh, state)
        require(row.triangles == len(shown), "M-024")
        require(row.strips == strips_shown, "M-025")

    def decode(self, packets):
        """BASE, PCKT and all that follows, up to a number of packets."""
        profile = compact if self.header.profile == 1 else plain
        self.decoder = profile.Decoder(self.meshes)
        rows = iter(self.rows)
        for chunk in self.named(b"BASE"):
            self.check_row(next(rows), self.decoder.read_base(chunk), 0)
        for chunk in self.named(b"PCKT")[:packets]:
            row = next(rows)
            require(row.mesh < len(self.meshes), "C-042")
            before = self.decoder.states[row.mesh].vsplits
            self.check_row(row, self.decoder.read_pckt(chunk), before)
        self.whole = packets is None or packets >= self.header.packets
        self.tables, self.digests = {}, {}
        if not self.whole:
            return
        for mesh, state in zip(self.meshes, self.decoder.states):
            model.check_full(mesh, state)
        self.read_rest()

    def read_rest(self):
        """FINE, fACE, wELD, oRDP and dGST (container.md 8, C-016)."""
        before = (-1, -1)
        readers = {b"FINE": self.decoder.read_fine, b"fACE": self.decoder.read_face,
                   b"wELD": container.read_weld, b"oRDP": container.read_ordp,
                   b"dGST": container.read_dgst}
        orders = {}
        results = {b"FINE": {}, b"fACE": self.tables, b"wELD": {}, b"oRDP": orders,
                   b"dGST": self.digests}
        for chunk in self.chunks:
            if chunk.type in readers:
                number, result = readers[chunk.type](chunk, self.meshes)
                place = (number, list(readers).index(chunk.type))
                require(before < place, "C-016")
                before = place
                results[chunk.type][number] = result
                if chunk.type == b"fACE":
                    self.meshes[number].explicit_corners = len(result.corners)
        self.decoder.check_fine()
        for number, mesh in enumerate(self.meshes):
            table = self.tables.get(number)
            has_more = mesh.face_attributes or (table and table.group)
            require(bool(table) == bool(has_more), "C-061")
            require(table or mesh.faces == mesh.triangles, "M-036")
        for number, order in orders.items():
            model.check_orders(self.meshes[number], order, self.faces(number))

    def faces(self, number):
        state = self.decoder.states[number]
        return model.faces(self.meshes[number], state, self.tables.get(number))

    def digest(self, number):
        """Of the level that was decoded; face attributes are those of full resolution."""
        table = self.tables.get(number)
        return model.digest(self.meshes[number], self.decoded(number),
                            table.attributes if table else [])

    def decoded(self, number):
        """The decoded mesh; of a level the welded one."""
        return model.unweld(self.meshes[number], self.decoder.level(number), self.faces(number))


def comparison(file, number):
    if number not in file.digests:
        return "none"
    return "agrees" if file.digests[number] == file.digest(number) else "differs"


def report(path, packets):
    """Prints the lines of a file; whether there was nothing wrong."""
    file = File(path.read_bytes(), packets)
    good = True
    for number in range(len(file.meshes)):
        decoded = file.decoded(number)
        verdict = comparison(file, number)
        print(path, number, len(decoded.position), len(decoded.vertex_of), len(decoded.faces),
              file.digest(number).hex(), verdict)
        good = good and verdict != "differs"
    return good


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", metavar="FILE", nargs="+", type=pathlib.Path)
    parser.add_argument("--packets", metavar="N", type=int, help="apply only the first N packets")
    arguments = parser.parse_args()
    good = True
    for path in arguments.files:
        try:
            good = report(path, arguments.packets) and good
        except model.Violation as violation:
            print(path, violation)
            good = False
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
