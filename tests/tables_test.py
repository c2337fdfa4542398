"""What is declared stands in its table: an addition that stopped halfway is found here."""

import dataclasses
import pathlib
import re
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[1]


@dataclasses.dataclass(frozen=True)
class Table:
    declared_in: str  # files
    declaration: str  # group 1 is the name
    listed_in: str  # a file
    least: int  # how many there are at least


TABLES = {
    "stripifiers": Table(
        "codecs/stripify/*.h",
        r"^Strips (\w+)\(const (?:Strip|Polygon)Input& input, const StripOptions& options\)",
        "codecs/stripify/stripify.cpp",
        20,
    ),
    "types of chunks": Table(
        "formats/pstrip/container/chunk_table.h",
        r"^inline constexpr ChunkType (k\w+Chunk) =",
        "formats/pstrip/container/chunk_table.h",
        13,
    ),
    "glTF extensions": Table(
        "formats/gltf/extensions/*.cpp",
        r"^(?:constinit )?const Extension (k\w+) =",
        "formats/gltf/extensions/extension.cpp",
        10,
    ),
    "commands": Table("cli/command.h", r"^Command (add_\w+)\(", "cli/main.cpp", 6),
}


class Tables(unittest.TestCase):
    def test_list_all_that_is_declared(self):
        for what, table in TABLES.items():
            with self.subTest(what):
                declared = {
                    name
                    for path in SOURCE.glob(table.declared_in)
                    for name in re.findall(table.declaration, path.read_text(), re.MULTILINE)
                }
                self.assertGreaterEqual(len(declared), table.least)
                # A declaration in the table's own file is no row.
                rows = re.sub(
                    table.declaration, "", (SOURCE / table.listed_in).read_text(), flags=re.MULTILINE
                )
                listed = set(re.findall(r"\w+", rows))
                self.assertEqual(sorted(declared - listed), [])

    def test_of_file_formats_has_every_format(self):
        header = (SOURCE / "converters/file_formats.h").read_text()
        formats = re.search(r"enum class FileFormat [^{]*\{([^}]*)\}", header)[1]
        table = (SOURCE / "converters/file_formats.cpp").read_text()
        rows = re.findall(r"\.format = FileFormat::(\w+)", table)
        self.assertEqual(re.findall(r"\w+", formats), rows)

    def test_of_rules_has_every_check(self):
        header = (SOURCE / "validators/checks.h").read_text()
        rules = (SOURCE / "validators/rules.cpp").read_text()
        declared = {
            name
            for names in re.findall(r"^Check ([^;]*);", header, re.MULTILINE)
            for name in re.findall(r"\w+", names)
        }
        self.assertGreater(len(declared), 40)
        self.assertEqual(sorted(declared - set(re.findall(r"\w+", rules))), [])

    def test_of_fuzz_targets_has_every_reader(self):
        fuzz = SOURCE / "tests/fuzz"
        targets = {p.name.removesuffix("_fuzz.cpp") for p in fuzz.glob("*_fuzz.cpp")}
        readers = set()
        for path in (SOURCE / "formats").rglob("*.h"):
            if re.search(r"^Result<.*> read_\w+\(ByteView (?:file|document)", path.read_text(), re.MULTILINE):
                pstrip = path.parent.name in ("container", "payload")
                readers.add("pstrip" if pstrip else path.parent.name)
        self.assertGreater(len(readers), 7)
        self.assertEqual(sorted(readers - targets), [])


if __name__ == "__main__":
    unittest.main()
