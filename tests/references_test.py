"""Citations resolve: papers in spec/references.md, pages and sections of spec/."""

import collections
import pathlib
import re
import subprocess
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[1]
REFERENCES = SOURCE / "spec" / "references.md"
CITING = {".h", ".cpp", ".md", ".py"}

# "[Kim04 §3.2; spec/vsplit.md §2]", on one line or two; not a link, an index or a list.
CITATION = re.compile(r"(?<![\w\])\[])\[([^\[\]]{3,300})\](?!\()")
# The name of an author or two and a year; and the standards, which have names of their own.
PAPER = re.compile(r"\b([A-Za-z]*[A-Z][a-z]+[A-Za-z]*\d\d[a-z]?)\b")
STANDARD = re.compile(r"^(PNG|glTF|FIPS\d+|RFC\d+|Wavefront\w+)\b")
PAGE = re.compile(r"\b(spec/[\w./]*\w)((?:,? ?§[\d.]*\d)*)")
COMMENT = re.compile(r"\n\s*(?:///?<?|#)?\s*")


def listed_keys():
    rows = re.findall(r"^\| ([^|]+) \| [^|]+ \|$", REFERENCES.read_text(), re.MULTILINE)
    return [key for key in rows if key != "key" and not set(key) <= {"-"}]


def citing_files():
    listed = subprocess.run(["git", "ls-files"], cwd=SOURCE, capture_output=True, text=True)
    names = listed.stdout.split() if listed.returncode == 0 else []
    paths = [SOURCE / n for n in names] or sorted(SOURCE.rglob("*"))
    generated = SOURCE / "build"
    return [
        p
        for p in paths
        if p.suffix in CITING and p.is_file() and p != REFERENCES and generated not in p.parents
        and p != pathlib.Path(__file__).resolve()
    ]


def citations():
    """(file, text) of all brackets that may cite."""
    for path in citing_files():
        for match in CITATION.finditer(path.read_text()):
            yield path.relative_to(SOURCE), COMMENT.sub(" ", match[1])


def keys_of(citation):
    for part in re.split(r"[;,] ", citation):
        yield from STANDARD.findall(part)
        yield from PAPER.findall(part)


def sections(page):
    """Numbers of the headings of a page: "## 5. Headers", "### 5.1 PSHD"."""
    return set(re.findall(r"^#+ (\d+(?:\.\d+)*)\.? ", page.read_text(), re.MULTILINE))


class References(unittest.TestCase):
    def test_list_every_key_once(self):
        twice = [key for key, n in collections.Counter(listed_keys()).items() if n > 1]
        self.assertEqual(twice, [])
        self.assertGreater(len(listed_keys()), 30)

    def test_have_what_is_cited(self):
        keys = set(listed_keys())
        unknown = [(str(f), key) for f, text in citations() for key in keys_of(text) if key not in keys]
        self.assertEqual(unknown, [])

    def test_are_all_cited(self):
        cited = {key for _, text in citations() for key in keys_of(text)}
        self.assertEqual(sorted(set(listed_keys()) - cited), [])


class Pages(unittest.TestCase):
    def test_have_the_sections_that_are_cited(self):
        missing = []
        for path, text in citations():
            for page, numbers in PAGE.findall(text):
                target = SOURCE / page
                if not target.exists():
                    missing.append((str(path), page))
                    continue
                for number in re.findall(r"§([\d.]*\d)", numbers):
                    if number not in sections(target):
                        missing.append((str(path), f"{page} §{number}"))
        self.assertEqual(missing, [])


if __name__ == "__main__":
    unittest.main()
