"""The tables of spec/compact-tables.md are those that the program starts from."""

import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(sys.argv.pop(1)) if len(sys.argv) > 1 else pathlib.Path(__file__).parents[1]
CODE = ROOT / "formats/pstrip/payload/compact"
TABLES = {
    "chord_weights.h": ["kSubsetChords", "kOptimalChords"],
    "step_weights.h": ["kSubsetWeights", "kOptimalWeights"],
}


def numbers(text):
    return [int(n) for n in re.findall(r"-?\d+", text)]


def table_of_code(file, name):
    match = re.search(re.escape(name) + r"\s*=\s*(.*?);", (CODE / file).read_text(), re.S)
    return numbers(match.group(1))


def blocks_of_page():
    return re.findall(r"```\n(.*?)```", (ROOT / "spec/compact-tables.md").read_text(), re.S)


class SpecTablesTest(unittest.TestCase):
    def test_chord_weights(self):
        blocks = blocks_of_page()
        for name, block in zip(TABLES["chord_weights.h"], blocks[:2]):
            self.assertEqual(numbers(block), table_of_code("chord_weights.h", name), name)
            self.assertEqual(len(numbers(block)), 6 * 24)

    def test_step_weights(self):
        blocks = blocks_of_page()
        for name, block in zip(TABLES["step_weights.h"], blocks[2:4]):
            rows = [numbers(line) for line in block.splitlines()]
            self.assertEqual([r[:2] for r in rows],
                             [[i, j] for i in range(1, 7) for j in range(1, 7)])
            self.assertEqual([n for r in rows for n in r[2:]],
                             table_of_code("step_weights.h", name), name)

    def test_open_rings(self):
        code = (CODE / "step_weights.h").read_text()
        match = re.search(r"kOpenSubsetWeights = (.*?),\s*kOpenOptimalWeights = (.*?);", code, re.S)
        rows = [numbers(line) for line in blocks_of_page()[4].splitlines()]
        self.assertEqual(rows, [numbers(match.group(1)), numbers(match.group(2))])

    def test_knots(self):
        code = (CODE / "mixed_bit.h").read_text()
        match = re.search(r"kKnots = \{(.*?)\};", code, re.S)
        self.assertEqual(numbers(blocks_of_page()[5]), numbers(match.group(1)))


if __name__ == "__main__":
    unittest.main()
