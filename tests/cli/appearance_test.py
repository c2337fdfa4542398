"""What surfaces look like in another format: where images lie, materials, colours, image files."""

import json
import struct
import unittest
import zlib

from support import ProgramTest


def png(width=2, height=2):
    """An image of one colour."""

    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    rows = (b"\0" + b"\x80\x40\x20" * width) * height
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


class Glb:
    """The JSON of a .glb, and its buffer."""

    def __init__(self, data):
        length = struct.unpack_from("<I", data, 12)[0]
        self.json = json.loads(data[20:20 + length])
        self.bin = data[28 + length:]

    def floats(self, name, primitive=0):
        accessor = self.json["accessors"][self.json["meshes"][0]["primitives"][primitive]["attributes"][name]]
        width = {"VEC2": 2, "VEC3": 3, "VEC4": 4}[accessor["type"]]
        assert accessor["componentType"] == 5126
        view = self.json["bufferViews"][accessor["bufferView"]]
        at = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        stride = view.get("byteStride", 4 * width)
        return [struct.unpack_from(f"<{width}f", self.bin, at + i * stride) for i in range(accessor["count"])]

    def image(self, i=0):
        view = self.json["bufferViews"][self.json["images"][i]["bufferView"]]
        at = view.get("byteOffset", 0)
        return self.bin[at:at + view["byteLength"]]


def f32(x):
    return struct.unpack("<f", struct.pack("<f", x))[0]


TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
TEXTURED = "mtllib m.mtl\n" + TRIANGLE + "vt 0 0.25\nvt 1 0\nvt 0 1\nusemtl wood\nf 1/1 2/2 3/3\n"


class AppearanceTest(ProgramTest):
    def glb(self, source, *options):
        self.run_program("convert", "-q", "--force", source, "out.glb", *options)
        return Glb(self.read("out.glb"))

    def material(self, mtl, obj=TEXTURED, *options):
        """What glTF says of the first material."""
        self.write("m.mtl", mtl)
        self.write("m.obj", obj)
        return self.glb("m.obj", *options).json["materials"][0]


class TextureOrigin(AppearanceTest):
    def test_v_of_obj_grows_upwards_and_that_of_gltf_downwards(self):
        self.write("m.obj", TEXTURED)
        for source in ("m.obj", "m.pstrip", "m.pstripx", "m.ply"):
            if source != "m.obj":
                self.run_program("convert", "-q", "m.obj", source,
                                 *(() if source.endswith("ply") else ("--keep-order",)))
            self.assertEqual(self.glb(source).floats("TEXCOORD_0"), [(0, 0.75), (1, 1), (0, 0)], source)

    def test_v_turns_back_on_the_way_to_obj_and_ply(self):
        self.write("m.obj", TEXTURED)
        self.glb("m.obj")
        self.run_program("convert", "-q", "out.glb", "back.obj")
        self.assertEqual([line for line in self.read("back.obj").decode().splitlines() if line.startswith("vt")],
                         ["vt 0 0.25", "vt 1 0", "vt 0 1"])
        self.run_program("convert", "-q", "--ascii", "out.glb", "back.ply")
        rows = self.read("back.ply").decode().split("end_header\n")[1].splitlines()
        self.assertEqual([row.split()[3:5] for row in rows[:3]], [["0", "0.25"], ["1", "0"], ["0", "1"]])

    # 1 - (1 - v) is another float; the file keeps the source's numbers.
    def test_numbers_come_back_to_their_own_format(self):
        numbers = ["0.1", "0.3", "1e-09", "0.123456789012345", "-0.7", "17.3", "-0"]
        text = TRIANGLE + "".join(f"vt {n} {n}\n" for n in numbers)
        text += "".join(f"f 1/{i} 2/{i} 3/{i}\n" for i in range(1, len(numbers) + 1))
        self.write("m.obj", text)
        for middle in ("m.pstrip", "m.pstripx"):
            self.run_program("convert", "-q", "m.obj", middle, "--keep-order")
            self.run_program("convert", "-q", "--force", middle, "back.obj")
            self.assertEqual(self.read("back.obj").decode(), text)

    def test_gltf_returns_bit_for_bit_through_obj(self):
        numbers = [0.1, 0.3, 0.7, 0.999, 1 / 3, 0.01, 5.55, -0.2]
        self.write("m.obj", TRIANGLE + "".join(f"vt 0 {1 - n}\n" for n in numbers)
                   + "".join(f"f 1/{i} 2/{i} 3/{i}\n" for i in range(1, len(numbers) + 1)))
        self.run_program("convert", "-q", "m.obj", "first.glb")
        first = Glb(self.read("first.glb")).floats("TEXCOORD_0")
        self.assertEqual({v for _, v in first}, {f32(1 - float(str(1 - n))) for n in numbers})
        self.run_program("convert", "-q", "first.glb", "between.obj")
        self.assertEqual(self.glb("between.obj").floats("TEXCOORD_0"), first)
        # Short numbers, where there are some.
        self.assertLess(max(len(line) for line in self.read("between.obj").splitlines()), 24)

    def test_moved_maps_lie_where_they_lay(self):
        moved = self.material("newmtl wood\nmap_Kd -s 2 4 1 -o 0.25 0.5 maps/a.png\n")
        transform = moved["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]["KHR_texture_transform"]
        self.assertEqual(transform, {"offset": [0.25, 1 - 4 - 0.5], "scale": [2, 4]})
        # The same texel: v of OBJ is 0.25, so 4 * 0.25 + 0.5 from below.
        v = Glb(self.read("out.glb")).floats("TEXCOORD_0")[0][1]
        self.assertEqual(1 - (transform["offset"][1] + transform["scale"][1] * v), 4 * 0.25 + 0.5)
        self.assertIn("KHR_texture_transform", Glb(self.read("out.glb")).json["extensionsUsed"])
        self.run_program("convert", "-q", "--force", "out.glb", "back.obj")
        self.assertIn("map_Kd -o 0.25 0.5 -s 2 4 maps/a.png\n", self.read("back.mtl").decode())

    def test_compare_sees_one_model(self):
        self.write_tube()
        for target in ("glb", "ply", "obj"):
            self.run_program("convert", "-q", "--force", "tube.obj", f"a.{target}")
            self.run_program("convert", "-q", "--force", f"a.{target}", "b.glb")
            self.assertEqual(self.equivalence(f"a.{target}", "b.glb"), "exact", target)


class Materials(AppearanceTest):
    def test_factors(self):
        made = self.material("newmtl wood\nKd 0.2 0.4 1\nd 0.5\nKe 0.1 0.2 0.3\nNs 98\nKs 1 1 1\n")
        pbr = made["pbrMetallicRoughness"]
        self.assertEqual(pbr["baseColorFactor"], [0.2, 0.4, 1, 0.5])
        self.assertEqual(made["alphaMode"], "BLEND")
        self.assertEqual(made["emissiveFactor"], [0.1, 0.2, 0.3])
        self.assertEqual(pbr["metallicFactor"], 0)
        self.assertAlmostEqual(pbr["roughnessFactor"], (2 / 100) ** 0.5)

    def test_alpha(self):
        for words, alpha in (("d 0.25", 0.25), ("Tr 0.25", 0.75), ("d -halo 0.25", 0.25), ("D 0.25", 0.25),
                             ("TR 0.75", 0.25), ("d 0.5\nTr 0.1", 0.5), ("tr 0.1\nd 0.5", 0.5)):
            made = self.material(f"newmtl wood\n{words}\n")
            self.assertEqual(made["pbrMetallicRoughness"]["baseColorFactor"][3], alpha, words)
            self.assertEqual(made["alphaMode"], "BLEND", words)
        for words in ("d 1", "Tr 0", ""):
            self.assertNotIn("alphaMode", self.material(f"newmtl wood\n{words}\n"), words)

    def test_no_highlight_is_rough(self):
        for words in ("Ks 0 0 0\nNs 500", "illum 1\nNs 500", "illum 0\nNs 500", ""):
            made = self.material(f"newmtl wood\n{words}\n")
            self.assertEqual(made["pbrMetallicRoughness"]["roughnessFactor"], 1, words)

    def test_words_in_any_case(self):
        made = self.material("NewMtl wood\nkd 0.5 0.25 0.1\nKE 1 0 0\nMAP_KD maps/a.png\nPR 0.25\npm 1\n")
        pbr = made["pbrMetallicRoughness"]
        self.assertEqual(pbr["baseColorFactor"], [0.5, 0.25, 0.1, 1])
        self.assertEqual(made["emissiveFactor"], [1, 0, 0])
        self.assertEqual((pbr["roughnessFactor"], pbr["metallicFactor"]), (0.25, 1))
        self.assertIn("baseColorTexture", pbr)
        self.assertEqual(Glb(self.read("out.glb")).json["images"][0]["uri"], "maps/a.png")

    def test_maps(self):
        made = self.material("newmtl wood\nmap_Kd a.png\nmap_Ke b.png\nmap_Bump -bm 0.5 c.png\nmap_Pr d.png\n")
        pbr = made["pbrMetallicRoughness"]
        images = [i["uri"] for i in Glb(self.read("out.glb")).json["images"]]
        source = [t["source"] for t in Glb(self.read("out.glb")).json["textures"]]

        def file_of(texture):
            return images[source[texture["index"]]]

        self.assertEqual(file_of(pbr["baseColorTexture"]), "a.png")
        self.assertEqual(file_of(made["emissiveTexture"]), "b.png")
        self.assertEqual(made["emissiveFactor"], [1, 1, 1])
        self.assertEqual(file_of(made["normalTexture"]), "c.png")
        self.assertEqual(made["normalTexture"]["scale"], 0.5)
        self.assertEqual(file_of(pbr["metallicRoughnessTexture"]), "d.png")
        self.assertEqual((pbr["metallicFactor"], pbr["roughnessFactor"]), (0, 1))

    def test_what_gltf_cannot_say_is_said(self):
        self.write("m.mtl", "newmtl wood\nmap_Kd a.png\nmap_d b.png\nmap_Pm c.png\nmap_Pr d.png\n")
        self.write("m.obj", TEXTURED)
        run = self.run_program("convert", "m.obj", "out.glb")
        self.assertIn("opacity map", run.err)
        self.assertIn("metallic and roughness maps", run.err)
        self.assertEqual(Glb(self.read("out.glb")).json["materials"][0]["alphaMode"], "BLEND")

    def test_text_returns_as_it_was(self):
        mtl = "# mine\nNEWMTL wood\n  Kd 0.50 .25 1e-1\nd 0.5\nmap_Kd -s 2 2 2 maps/a.png\nrefl x.png\n"
        self.write("m.mtl", mtl)
        self.write("m.obj", TEXTURED)
        self.write("maps.txt", "")
        for middle in ("m.pstrip", "m.pstripx"):
            self.run_program("convert", "-q", "m.obj", middle)
            self.run_program("convert", "-q", "--force", middle, "back.obj")
            self.assertEqual(self.read("back.mtl").decode(), mtl)

    def test_gltf_materials_become_mtl(self):
        self.write("m.mtl", "newmtl wood\nmap_Kd maps/a.png\n")
        self.write("m.obj", TEXTURED)
        glb = self.glb("m.obj").json
        glb["materials"] = [{"name": "glass", "alphaMode": "BLEND", "emissiveFactor": [0.5, 0, 0],
                             "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 1, 0.5], "metallicFactor": 1,
                                                      "roughnessFactor": 0.5, "baseColorTexture": {"index": 0}},
                             "normalTexture": {"index": 0, "scale": 2}}]
        del glb["images"][0]
        glb["images"] = [{"uri": "maps/a%20b.png"}]
        glb["buffers"][0]["uri"] = "m.bin"
        self.write("m.bin", Glb(self.read("out.glb")).bin)
        self.write("m.gltf", json.dumps(glb))
        self.run_program("convert", "-q", "--force", "m.gltf", "back.obj")
        mtl = self.read("back.mtl").decode()
        for line in ("newmtl glass", "Kd 0.5 0.25 1", "d 0.5", "Ke 0.5 0 0", "Pm 1", "Pr 0.5", "Ks 0.5 0.25 1", "Ns 6",
                     "map_Kd maps/a b.png", "norm -bm 2 maps/a b.png"):
            self.assertIn(line + "\n", mtl)
        # And back again.
        made = self.glb("back.obj").json["materials"][0]
        self.assertEqual(made["pbrMetallicRoughness"]["baseColorFactor"], [0.5, 0.25, 1, 0.5])
        self.assertEqual((made["alphaMode"], made["normalTexture"]["scale"]), ("BLEND", 2))

    def test_no_image_without_texture_coordinates(self):
        self.write("m.mtl", "newmtl wood\nKd 0.5 0.5 0.5\nmap_Kd a.png\n")
        self.write("m.obj", "mtllib m.mtl\n" + TRIANGLE + "usemtl wood\nf 1 2 3\n")
        run = self.run_program("convert", "m.obj", "out.glb")
        self.assertIn("textures of material wood where a mesh has no coordinates", run.err)
        made = Glb(self.read("out.glb")).json
        primitive = made["meshes"][0]["primitives"][0]
        self.assertNotIn("baseColorTexture", made["materials"][primitive["material"]]["pbrMetallicRoughness"])

    def test_libraries_that_are_missing_are_said(self):
        self.write("m.obj", TEXTURED)
        run = self.run_program("inspect", "m.obj", code=0)
        run = self.run_program("convert", "m.obj", "out.glb")
        self.assertIn("material library m.mtl, which is not there", run.err)
        self.write("m.mtl", "newmtl Wood\n")
        run = self.run_program("convert", "--force", "m.obj", "out.glb")
        self.assertIn("material wood, which no library defines", run.err)

    def test_libraries_above_need_leave(self):
        (self.folder / "sub").mkdir()
        self.write("m.mtl", "newmtl wood\nKd 1 0 0\n")
        self.write("sub/m.obj", TEXTURED.replace("m.mtl", "../m.mtl"))
        run = self.run_program("convert", "sub/m.obj", "out.glb")
        self.assertIn("material library ../m.mtl, which is outside the model's folder", run.err)
        self.run_program("convert", "-q", "--force", "--allow-parent-paths", "sub/m.obj", "out.glb")
        made = Glb(self.read("out.glb")).json["materials"][0]
        self.assertEqual(made["pbrMetallicRoughness"]["baseColorFactor"], [1, 0, 0, 1])


class Colors(AppearanceTest):
    def test_without_a_colour_is_white(self):
        self.write("m.obj", "v 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        self.assertEqual(self.glb("m.obj").floats("COLOR_0"), [(1, 0, 0), (1, 1, 1), (1, 1, 1)])
        self.write("m.obj", "v 0 0 0 0 0 0 0.5\nv 1 0 0 1 0 0\nv 0 1 0\nf 1 2 3\n")
        self.assertEqual(self.glb("m.obj").floats("COLOR_0"), [(0, 0, 0, 0.5), (1, 0, 0, 1), (1, 1, 1, 1)])

    def test_up_to_255(self):
        for colors, wanted in ((("255 0 0", "0 51 0", "0 0 255"), [(1, 0, 0), (0, f32(0.2), 0), (0, 0, 1)]),
                               (("127.5 0 0", "0 255.0 0", "0 0 0"), [(0.5, 0, 0), (0, 1, 0), (0, 0, 0)]),
                               (("1.25 0 0", "0 -0.5 0", "0 0 1"), [(1, 0, 0), (0, 0, 0), (0, 0, 1)])):
            text = "".join(f"v {p} {c}\n" for p, c in zip(("0 0 0", "1 0 0", "0 1 0"), colors)) + "f 1 2 3\n"
            self.write("m.obj", text)
            self.assertEqual(self.glb("m.obj").floats("COLOR_0"), wanted)
            self.assertRegex(self.run_program("convert", "--force", "m.obj", "o.glb").err,
                             "colours of COLOR_0, divided by 255|COLOR_0 beyond 0 to 1, clamped")
            self.run_program("convert", "-q", "m.obj", "--force", "m.pstrip", "--keep-order")
            self.run_program("convert", "-q", "--force", "m.pstrip", "back.obj")
            self.assertEqual(self.equivalence("m.obj", "back.obj"), "exact")


class ObjAsOthersReadIt(AppearanceTest):
    def test_missing_vt_and_vn(self):
        for text, said in ((TRIANGLE + "f 1//1 2//2 3//3\n", "the vn of 3 corners"),
                           (TRIANGLE + "vt 0 0\nvn 0 0 1\nf 1/1/0 2/1/1 3/1/1\n", "the vn of 1 corners"),
                           (TRIANGLE + "vn 0 0 1\nf 1/1/1 2/2/1 3/3/1\n", "the vt of 3 corners"),
                           (TRIANGLE + "vt 0 0\nf 1/-1 2/-2 3/1\n", "the vt of 1 corners")):
            self.write("m.obj", text)
            run = self.run_program("convert", "--force", "m.obj", "out.glb")
            self.assertEqual(run.err.count(said), 1, run)
            self.assertEqual(self.run_program("inspect", "m.obj").err.count(said), 1)
            self.assertEqual(len(Glb(self.read("out.glb")).floats("POSITION")), 3)

    def test_names_that_end_in_a_backslash(self):
        points = TRIANGLE + "v 1 1 0\n"
        for text in ("o C:\\temp\\\n" + points + "f 1 2 3\nf 2 4 3\n",
                     points + "usemtl Lib\\Matte\\\nf 1 2 3\nf 2 4 3\n",
                     points + "g a\\\r\nf 1 2 3\r\nf 2 4 3\r\n"):
            self.write("m.obj", text)
            report = self.report("inspect", "m.obj")
            self.assertEqual((report["vertices"], report["faces"]), (4, 2), text)
            self.run_program("convert", "-q", "--force", "m.obj", "back.obj")
            self.assertEqual(self.equivalence("m.obj", "back.obj"), "exact")
        self.write("m.obj", points + "g one \\\n two\nf 1 2 \\\n4 3\n")
        self.run_program("convert", "-q", "--force", "m.obj", "back.obj")
        self.assertIn("g one two\nf 1 2 4 3\n", self.read("back.obj").decode())

    def test_objects_of_one_name_stay_two(self):
        text = "o Cube\n" + TRIANGLE + "f 1 2 3\no Cube\n" + TRIANGLE + "f 4 5 6\n"
        self.write("m.obj", text)
        for middle in ("b.obj", "m.pstrip"):
            self.run_program("convert", "-q", "m.obj", middle, *(("--keep-order",) if "pstrip" in middle else ()))
            self.run_program("convert", "-q", "--force", middle, "back.obj")
            self.assertEqual([line for line in self.read("back.obj").decode().splitlines() if line[0] in "of"],
                             ["o Cube", "f 1 2 3", "o Cube", "f 4 5 6"])

    def test_decimal_commas_are_named(self):
        self.write("m.obj", "v 0,5 1 2\n")
        self.assertIn("decimal comma", self.run_program("convert", "m.obj", "out.glb", code=3).err)


class ImageFiles(AppearanceTest):
    def setUp(self):
        super().setUp()
        for folder in ("maps", "elsewhere"):
            (self.folder / folder).mkdir()
        self.picture = png()
        self.write("maps/wood 1.png", self.picture)
        self.write("m.mtl", "newmtl wood\nKd 1 1 1\nmap_Kd maps/wood 1.png\n")
        self.write("m.obj", TEXTURED)

    def test_embedded_in_glb_and_pstrip(self):
        self.run_program("convert", "-q", "m.obj", "elsewhere/a.glb")
        made = Glb(self.read("elsewhere/a.glb"))
        self.assertEqual(made.image(), self.picture)
        self.assertEqual(made.json["images"][0]["mimeType"], "image/png")
        self.run_program("convert", "-q", "m.obj", "elsewhere/a.pstrip")
        self.assertIn(self.picture, self.read("elsewhere/a.pstrip"))
        (self.folder / "maps/wood 1.png").unlink()
        self.run_program("convert", "-q", "elsewhere/a.pstrip", "b.glb")
        self.assertEqual(Glb(self.read("b.glb")).image(), self.picture)

    def test_copied_beside_obj_ply_and_gltf(self):
        self.run_program("convert", "-q", "m.obj", "a.pstrip")
        self.run_program("convert", "-q", "m.obj", "a.glb")
        for source in ("m.obj", "a.pstrip"):
            for target, named in (("obj", "map_Kd maps/wood 1.png"), ("ply", "comment TextureFile maps/wood 1.png"),
                                  ("gltf", '"uri": "maps/wood%201.png"')):
                place = f"{source[0]}_{target}"
                (self.folder / place).mkdir()
                self.run_program("convert", "-q", source, f"{place}/x.{target}")
                self.assertEqual(self.read(f"{place}/maps/wood 1.png"), self.picture)
                file = "x.mtl" if target == "obj" else f"x.{target}"
                self.assertIn(named.encode(), self.read(f"{place}/{file}"))
        # An image that never had a name gets one.
        run = self.run_program("convert", "a.glb", "elsewhere/y.obj")
        self.assertEqual(self.read("elsewhere/y_1.png"), self.picture)
        self.assertIn("map_Kd y_1.png\n", self.read("elsewhere/y.mtl").decode())
        self.assertIn("y_1.png", run.err)

    def test_left_where_they_are(self):
        run = self.run_program("convert", "--textures", "reference", "m.obj", "elsewhere/a.glb")
        self.assertIn("texture maps/wood 1.png, which stays in the folder of the source", run.err)
        self.assertEqual(Glb(self.read("elsewhere/a.glb")).json["images"][0]["uri"], "maps/wood%201.png")
        run = self.run_program("convert", "--textures", "reference", "m.obj", "a.glb")
        self.assertNotIn("texture", run.err)
        self.run_program("convert", "-q", "--textures", "reference", "m.obj", "a.pstrip")
        self.assertNotIn(self.picture, self.read("a.pstrip"))

    def test_what_is_not_there_is_said(self):
        (self.folder / "maps/wood 1.png").unlink()
        run = self.run_program("convert", "m.obj", "a.glb")
        self.assertIn("texture maps/wood 1.png, which is not there", run.err)
        self.assertEqual(Glb(self.read("a.glb")).json["images"][0]["uri"], "maps/wood%201.png")

    def test_nothing_outside_the_folder_is_read(self):
        self.write("secret.png", b"secret" + self.picture)
        (self.folder / "in").mkdir()
        for name in ("../secret.png", str(self.folder / "secret.png"), "x/../../secret.png", "..\\secret.png",
                     "file:///etc/passwd", "https://example.org/a.png"):
            self.write("in/m.mtl", f"newmtl wood\nmap_Kd {name}\n")
            self.write("in/m.obj", TEXTURED)
            run = self.run_program("convert", "--force", "in/m.obj", "in/a.pstrip")
            self.assertIn("which is", run.err, name)
            self.assertNotIn(b"secret\x89", self.read("in/a.pstrip"))
        self.write("in/m.mtl", "newmtl wood\nmap_Kd ../secret.png\n")
        self.run_program("convert", "-q", "--force", "--allow-parent-paths", "in/m.obj", "in/a.pstrip")
        self.assertIn(b"secret\x89", self.read("in/a.pstrip"))

    def test_nothing_outside_the_folder_is_written(self):
        self.run_program("convert", "-q", "m.obj", "a.pstripx")
        text = self.read("a.pstripx").decode()
        for name in ("../evil.png", "/tmp/evil.png", "a/../../evil.png", "C:\\evil.png"):
            place = self.folder / "deep/down"
            place.mkdir(parents=True, exist_ok=True)
            written = name.replace("\\", "\\\\")
            self.write("b.pstripx", text.replace('uri="maps/wood 1.png"', f'uri="{written}"'))
            run = self.run_program("convert", "--force", "b.pstripx", "deep/down/x.obj")
            self.assertEqual(self.read("deep/down/evil.png"), self.picture)
            self.assertFalse((self.folder / "deep/evil.png").exists())
            self.assertIn("evil.png", run.err)
            self.assertIn("map_Kd evil.png\n", self.read("deep/down/x.mtl").decode())

    def test_others_files_stay(self):
        (self.folder / "elsewhere/maps").mkdir()
        self.write("elsewhere/maps/wood 1.png", b"another picture")
        self.run_program("convert", "-q", "m.obj", "elsewhere/a.obj", code=2)
        self.assertEqual(self.read("elsewhere/maps/wood 1.png"), b"another picture")
        self.assertFalse((self.folder / "elsewhere/a.obj").exists())
        self.run_program("convert", "-q", "--force", "m.obj", "elsewhere/a.obj")
        self.assertEqual(self.read("elsewhere/maps/wood 1.png"), self.picture)

    def test_names_are_decoded_once_and_encoded_once(self):
        self.run_program("convert", "-q", "--textures", "reference", "m.obj", "m.gltf")
        for uri, name in (("maps/a%20b.png", "maps/a b.png"), ("maps/100%25.png", "maps/100%.png"),
                          ("maps/50%.png", "maps/50%.png"), ("maps/%C3%A9.png", "maps/é.png")):
            self.write(name, self.picture)
            self.write("n.gltf", self.read("m.gltf").replace(b"maps/wood%201.png", uri.encode()))
            self.run_program("convert", "-q", "--force", "n.gltf", "elsewhere/n.obj")
            self.assertIn(f"map_Kd {name}\n", self.read("elsewhere/n.mtl").decode())
            self.assertEqual(self.read(f"elsewhere/{name}"), self.picture)
            self.run_program("convert", "-q", "--force", "n.gltf", "again.gltf")
            self.assertEqual(json.loads(self.read("again.gltf"))["images"][0]["uri"], uri)

    def test_options_that_do_nothing_are_refused(self):
        for target, mode in (("a.obj", "embed"), ("a.ply", "embed"), ("a.pstrip", "copy"), ("a.pm", "reference")):
            run = self.run_program("convert", "m.obj", target, "--textures", mode, code=1)
            self.assertIn("does nothing", run.err)


if __name__ == "__main__":
    unittest.main()
