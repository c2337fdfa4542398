"""The decoder from the text alone reads what the program wrote and refuses what it must."""

import pathlib
import re
import sys
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "spec/reference"))

import model  # noqa: E402
import reference  # noqa: E402

DATA = SOURCE / "tests/data"
EXEMPT = {"C-033", "C-035"}  # of the container's page, by D-020


def clauses_to_refuse():
    """Those that D-020 lists, those of the compact profile, and the container's but the exempt."""
    page = (SOURCE / "spec/container.md").read_text()
    demand = re.search(r"\[D-020\](.*?)It MAY leave", page, re.DOTALL)[1]
    out = set(re.findall(r"\[(C-\d+)\][^\[]*?MUST", page)) - EXEMPT
    out |= set(re.findall(r"\[(K-\d+)\]", (SOURCE / "spec/compact.md").read_text()))
    for letter, first, last in re.findall(r"\b([MSV])-(\d+)(?: to [MSV]-(\d+))?", demand):
        out |= {f"{letter}-{n:03}" for n in range(int(first), int(last or first) + 1)}
    return out


def invalid_files():
    """(clause, file) for each file of rules.md."""
    page = (SOURCE / "spec/rules.md").read_text()
    for row in page.splitlines():
        clause = re.search(r"\[([A-Z]-\d+)\]", row)
        if row.startswith("| PS") and clause:
            for name in re.findall(r"`(PS\w+\.pstrip)`", row):
                yield clause[1], DATA / "invalid" / name


class Reference(unittest.TestCase):
    def test_decodes_valid_files_to_their_digests(self):
        compared = 0
        files = sorted(DATA.glob("valid/*.pstrip")) + sorted(DATA.glob("golden/*.pstrip"))
        self.assertGreaterEqual(len(files), 9)
        for path in files:
            with self.subTest(path.name):
                file = reference.File(path.read_bytes())
                for number in range(len(file.meshes)):
                    verdict = reference.comparison(file, number)
                    self.assertNotEqual(verdict, "differs")
                    compared += verdict == "agrees"
        self.assertGreaterEqual(compared, 4)

    def test_decodes_each_prefix_of_packets(self):
        data = (DATA / "golden/example.pstrip").read_bytes()
        packets = reference.File(data).header.packets
        self.assertGreater(packets, 0)
        for count in range(packets):
            file = reference.File(data, count)
            self.assertEqual(len(file.decoder.states[0].position), file.rows[count].vertices)
            self.assertEqual(reference.comparison(file, 0), "none")

    def test_refuses_what_a_decoder_must_refuse(self):
        demanded = clauses_to_refuse()
        self.assertGreater(len(demanded), 80)
        refused = 0
        for clause, path in invalid_files():
            if clause not in demanded:
                continue
            with self.subTest(path.name):
                with self.assertRaises(model.Violation) as caught:
                    reference.File(path.read_bytes())
                refused += caught.exception.clause == clause
        self.assertGreater(refused, 80)

    def test_says_truncated_of_a_file_that_ends_early(self):
        data = (DATA / "golden/example.pstrip").read_bytes()
        for length in range(len(data)):
            with self.subTest(length), self.assertRaises(model.Violation) as caught:
                reference.File(data[:length])
            self.assertEqual(caught.exception.answer, "truncated")


if __name__ == "__main__":
    unittest.main()
