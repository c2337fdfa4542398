"""Who may include whom, and which folder a third-party header belongs to."""

import pathlib
import re
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[1]

MAY_INCLUDE = {
    "core": {"core"},
    "codecs": {"core", "codecs"},
    "formats": {"core", "formats"},
    "converters": {"core", "codecs", "formats", "converters"},
    "validators": {"core", "codecs", "formats", "validators"},
    # The public headers, and what sees nothing but them.
    "include": {"core", "codecs", "formats", "converters", "validators", "include"},
    "examples": {"include"},
    "web": {"core", "codecs", "formats", "converters", "web"},
    "cli": {"core", "codecs", "formats", "converters", "validators", "cli"},
}

# The folders whose .cpp files may include a library's headers: one, but for the libraries that read
# numbers and JSON wherever that is done.
THIRD_PARTY = {
    "CLI/": {"cli"},
    "draco/": {"formats/draco"},
    "fast_float/": {"formats/text"},
    "fmt/": {"cli"},
    "httplib.h": {"cli"},
    "meshoptimizer.h": {"formats/gltf"},
    "nlohmann/": {"cli", "formats/gltf"},
    "openssl/": {"formats/pstrip/payload"},
    "png.h": {"cli"},
    "tiny_gltf.h": {"formats/gltf"},
    "tinyxml2.h": {"formats/pstrip/xml"},
    "turbojpeg.h": {"cli"},
    "zlib.h": {"formats/pstrip/container", "examples"},
}
# Headers that cannot do without.
IN_HEADERS = {("core/result.h", "tl/"), ("formats/gltf/json.h", "nlohmann/")}

SYSTEM = {"fcntl.h", "unistd.h", "sys/ioctl.h", "sys/mman.h", "sys/stat.h"}

# An error's words and place are for people; what a program decides by is its code and its fault.
_ERROR = r"\berror(?:\(\))?(?:\.|->)"
DECIDES_BY_WORDS = re.compile(
    rf"{_ERROR}(?:message|path)\.(?:find|starts_with|ends_with|contains|compare|substr)\b"
    rf"|{_ERROR}message\s*[!=]=|[!=]=\s*\w*{_ERROR}message\b"
    rf"|\b(?:find|count|lower_bound|search|contains)\([^;]*{_ERROR}message\b"
)

INCLUDE = re.compile(r'^\s*#\s*include\s*(?:"([^"]+)"|<([^>]+)>)', re.MULTILINE)


def includes():
    """(file, quoted path or "", bracketed path or "") of the product's sources."""
    for folder in MAY_INCLUDE:
        for path in sorted((SOURCE / folder).rglob("*")):
            if path.suffix in (".h", ".cpp"):
                for quoted, bracketed in INCLUDE.findall(path.read_text()):
                    yield path.relative_to(SOURCE).as_posix(), quoted, bracketed


class Layering(unittest.TestCase):
    def test_there_is_something_to_check(self):
        folders = {file.split("/")[0] for file, _, _ in includes()}
        self.assertEqual(folders, set(MAY_INCLUDE))

    def test_our_headers_point_down(self):
        for file, quoted, _ in includes():
            if not quoted:
                continue
            path = f"include/{quoted}" if quoted.startswith("pstrips/") else quoted
            with self.subTest(file=file, includes=quoted):
                self.assertTrue((SOURCE / path).is_file(), "is not a path from the root")
                self.assertIn(path.split("/")[0], MAY_INCLUDE[file.split("/")[0]])

    def test_a_format_does_not_know_another(self):
        for file, quoted, _ in includes():
            if file.startswith("formats/") and quoted.startswith("formats/"):
                self.assertIn(quoted.split("/")[1], (file.split("/")[1], "text", "draco"), file)

    def test_third_party_headers_stay_in_their_folder(self):
        for file, _, bracketed in includes():
            # The standard library has neither folders nor extensions.
            if not bracketed or bracketed in SYSTEM or not re.search(r"[/.]", bracketed):
                continue
            library = bracketed.split("/")[0] + "/" if "/" in bracketed else bracketed
            if (file, library) in IN_HEADERS:
                continue
            with self.subTest(file=file, includes=bracketed):
                self.assertTrue(file.endswith(".cpp"), "a header of ours")
                folder = file.rsplit("/", 1)[0]
                self.assertIn(folder, THIRD_PARTY.get(library, ()))

    def test_nothing_depends_on_the_words_of_an_error(self):
        for old in (
            'if (error.message == "malformed XML") return',
            'error.path.ends_with("/@type") ? a : b',
            "std::ranges::find(kPhrases, error.message, &Phrase::message);",
            "read.error().message.starts_with(word)",
        ):
            self.assertRegex(old, DECIDES_BY_WORDS)
        for folder in MAY_INCLUDE:
            for path in sorted((SOURCE / folder).rglob("*.cpp")) + sorted((SOURCE / folder).rglob("*.h")):
                with self.subTest(file=path.relative_to(SOURCE).as_posix()):
                    self.assertIsNone(DECIDES_BY_WORDS.search(path.read_text()))


if __name__ == "__main__":
    unittest.main()
