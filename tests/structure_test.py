"""The size of classes and functions, and that the documents name what is there."""

import collections
import dataclasses
import pathlib
import re
import subprocess
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[1]
PRODUCT = ("core", "codecs", "formats", "converters", "validators", "include", "web", "cli")

# Lines with code on them; comments do not count. Of a class also those of its members elsewhere.
MOST_CLASS_LINES = 350
MOST_FUNCTION_LINES = 70

LITERAL = re.compile(
    r"""//[^\n]*|/\*.*?\*/          # comments
      | R"(\w*)\(.*?\)\1"          # raw strings
      | "(?:\\.|[^"\\\n])*"       # strings
      | (?<!\w)'(?:\\.|[^'\\\n])+'  # characters, not the marks between digits
      | ^[ \t]*\#(?:[^\n]*\\\n)*[^\n]*  # directives""",
    re.DOTALL | re.MULTILINE | re.VERBOSE,
)
CLASS = re.compile(
    r"\b(?:class|struct|union)\s+(?:alignas\([^)]*\)\s*)?((?:\w+::)*\w+)(?:<[^{]*>)?"
    r"(?:\s+final)?\s*(?::[^{]*)?$",
    re.DOTALL,
)
FUNCTION = re.compile(r"([~\w:]+(?:\s*operator\s*[^\s(]+)?)\s*\(")
BEFORE_FUNCTION = re.compile(
    r"^\s*(?:template\s*<.*?>\s*(?=[\w\[]))?(?:\[\[\w+\]\]\s*)?(?:requires[^;{]*?\)\s+)?", re.DOTALL
)
# A brace that initializes stands after a member of a constructor's list, an = or a return.
INITIALIZER = re.compile(
    r"(?:[)}]\s*[:,]\s*[\w:]+(?:<[^<>]*>)?|,\s*[\w:]+|=|return|\bconst \w+)\s*$"
)


@dataclasses.dataclass
class Block:
    kind: str  # namespace, class, function, initializer, other
    name: str
    file: pathlib.Path
    first: int  # line
    begin: int  # character
    lines: int = 0  # that have code


def without_literals(text):
    """The text with comments, strings and directives blank, lines kept."""
    return LITERAL.sub(lambda m: re.sub(r"[^\n]", " ", m[0]), text)


def kind_of(header, outer):
    """What a brace opens, by the text before it and the block that it stands in."""
    if outer in ("function", "other", "initializer"):
        return "other", ""
    if re.search(r"\bnamespace\b|\bextern\b\s*$", header):
        return "namespace", ""
    if re.search(r"\benum\b", header):
        return "other", ""
    if match := CLASS.search(header):
        return "class", match[1]
    match = FUNCTION.search(BEFORE_FUNCTION.sub("", header))
    if match and not INITIALIZER.search(header):
        return "function", match[1].strip()
    return "initializer", ""


def blocks_of(path):
    text = without_literals(path.read_text())
    stack, out, start = [], [], 0
    for match in re.finditer(r"[{};]", text):
        at, sign = match.start(), match[0]
        if sign == "{":
            header = text[start:at]
            kind, name = kind_of(header, stack[-1].kind if stack else "namespace")
            begin = start + len(header) - len(header.lstrip())
            stack.append(Block(kind, name, path, text.count("\n", 0, begin) + 1, begin))
            if kind != "initializer":
                start = at + 1
            continue
        if sign == "}" and stack:
            block = stack.pop()
            block.lines = sum(bool(line.strip()) for line in text[block.begin : at].split("\n")) + 1
            if block.kind in ("class", "function"):
                out.append(block)
            if block.kind == "initializer":
                continue
        if not stack or stack[-1].kind != "initializer":
            start = at + 1
    return out


def product_blocks():
    for folder in PRODUCT:
        for path in sorted((SOURCE / folder).rglob("*")):
            if path.suffix in (".h", ".cpp"):
                yield from blocks_of(path)


def class_lines():
    """Lines of each class: its body, and members defined outside it in the same folder."""
    blocks = list(product_blocks())
    out = collections.Counter()
    for block in blocks:
        if block.kind == "class":
            out[block.file.parent, block.name.split("::")[-1]] += block.lines
    for block in blocks:
        if block.kind == "function" and "::" in block.name:
            owner = (block.file.parent, block.name.split("::")[-2])
            if owner in out:
                out[owner] += block.lines
    return out


class Size(unittest.TestCase):
    def test_of_functions_is_bounded(self):
        functions = [b for b in product_blocks() if b.kind == "function"]
        self.assertGreater(len(functions), 2000)
        long = [
            f"{b.file.relative_to(SOURCE)}:{b.first} {b.name}: {b.lines} lines"
            for b in functions
            if b.lines > MOST_FUNCTION_LINES
        ]
        self.assertEqual(long, [])

    def test_of_classes_is_bounded(self):
        counted = class_lines()
        self.assertGreater(len(counted), 300)
        long = [
            f"{folder.relative_to(SOURCE)} {name}: {lines} lines"
            for (folder, name), lines in counted.items()
            if lines > MOST_CLASS_LINES
        ]
        self.assertEqual(long, [])


def cmake_names():
    """Targets and tests, as the CMake files name them."""
    text = "\n".join(p.read_text() for p in SOURCE.rglob("CMakeLists.txt") if "build" not in p.parts)
    return set(re.findall(r"[\w.]+", text))


class Documents(unittest.TestCase):
    PAGES = ("ARCHITECTURE.md", "CONTRIBUTING.md")
    # What is built or installed, or a folder that a reader may have.
    NOT_IN_TREE = re.compile(r"^(\.\./|build/|include/|/|\$)")

    PATH = re.compile(r"[\w.-]+(?:/[\w.{},-]*)+(?: --?\w.*)?|[\w-]+\.(?:md|py|h|cpp|txt)")

    def words(self, page):
        """What stands in backticks on a page, code blocks aside."""
        text = re.sub(r"^```.*?^```", "", (SOURCE / page).read_text(), flags=re.DOTALL | re.MULTILINE)
        return re.findall(r"`([^`\n]+)`", text)

    def test_name_paths_that_are_there(self):
        for page in self.PAGES:
            paths = [
                w.split()[0]
                for w in self.words(page)
                if self.PATH.fullmatch(w) and "NAME" not in w and w != "v/vt/vn"
            ]
            self.assertGreater(len(paths), 5, page)
            for path in paths:
                if not self.NOT_IN_TREE.match(path):
                    self.assertTrue((SOURCE / path).exists(), f"{page} names {path}")

    def test_name_targets_that_are_there(self):
        names = cmake_names()
        for page in self.PAGES:
            for word in self.words(page):
                if re.fullmatch(r"pstrips_\w+|(?:validators|formats|codecs|converters|core|cli)\.[\w.]+", word):
                    self.assertIn(word, names, page)

    def test_link_to_files_that_are_there(self):
        for page in [*SOURCE.glob("*.md"), *SOURCE.glob("spec/*.md"), *SOURCE.glob("tests/**/README.md")]:
            for link in re.findall(r"\]\(([^)#\s]+)", page.read_text()):
                if "://" not in link and not link.isidentifier():  # an argument of a C++ lambda
                    self.assertTrue((page.parent / link).exists(), f"{page} links to {link}")

    def test_show_the_folders_as_they_are(self):
        check = subprocess.run([SOURCE / "scripts/draw-folders", "--check"], capture_output=True, text=True)
        self.assertEqual(check.returncode, 0, check.stderr)

    def test_show_commands_that_are_there(self):
        text = (SOURCE / "README.md").read_text()
        sources = "\n".join(p.read_text() for p in sorted((SOURCE / "cli").glob("*.cpp")))
        commands = set(re.findall(r'add_subcommand\("(\w+)"', sources))
        self.assertGreater(len(commands), 5)
        self.assertEqual(set(re.findall(r"^\| `pstrips (\w+)", text, re.MULTILINE)), commands)
        section = text.split("## The program")[1].split("\n## ")[0]
        options = set(re.findall(r"(?<![\w-])(--[a-z][a-z-]+)", section))
        self.assertGreater(len(options), 10)
        for option in options - {"--help"}:
            self.assertRegex(sources, rf"{option}(?![\w-])", "README.md")


if __name__ == "__main__":
    unittest.main()
