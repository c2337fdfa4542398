"""Help: what fits a terminal, what comes first, and that its words are explained."""

import re
import unittest

from support import GOLDEN, ProgramTest

COMMANDS = ("convert", "validate", "inspect", "extract", "compare", "stripify")
RULE = "A file that you did not name, or that is an input, is never replaced without --force."
# Words that no dictionary explains as they are meant here.
UNUSUAL = ("ACMR", "attribute", "base", "corner", "diagonal", "dual edge", "error bound",
           "Hausdorff distance", "index map", "level", "offset", "packet", "primitive", "profile",
           "qem", "RMS", "strip", "swap", "tunnel", "vsplit", "wedge")


class Help(ProgramTest):
    def help_of(self, *arguments):
        return self.run_program(*arguments).out.decode()

    def glossary(self):
        """Words, in the order in which help explains them."""
        words = self.help_of("--help-all").split("\nWords:\n")[1].split("\n\n")[0]
        return re.findall(r"^  (\S.*?)  +\S", words, re.MULTILINE)

    def test_eighty_columns(self):
        for command in ((), *((name,) for name in COMMANDS)):
            for option in ("--help", "--help-all"):
                for line in self.help_of(*command, option).splitlines():
                    self.assertLessEqual(len(line), 80, line)

    def test_rule_and_exit_codes_are_said(self):
        for command in ((), *((name,) for name in COMMANDS)):
            text = " ".join(self.help_of(*command, "--help").split())
            self.assertIn(RULE, text)
            self.assertIn("Exit codes: 0 ok, 1 command line", text)

    def test_everyday_options_come_first(self):
        for command, everyday, rare in (("convert", "--base", "--tunnel-length"),
                                        ("inspect", "--format", "--max-memory"),
                                        ("stripify", "--strip-effort", "--strip-price")):
            short, long = self.help_of(command, "--help"), self.help_of(command, "--help-all")
            self.assertIn(everyday, short)
            self.assertNotIn(rare, short)
            self.assertLess(long.index(everyday), long.index(rare))

    def test_every_unusual_word_is_explained_once(self):
        words = self.glossary()
        self.assertEqual(words, sorted(set(words), key=str.lower))
        self.assertLessEqual(set(UNUSUAL), set(words))
        for command in COMMANDS:
            self.assertIn("\nWords:\n", self.help_of(command, "--help-all"))

    def test_every_explained_word_is_used(self):
        self.write_tube()
        self.write("good.pstrip", GOLDEN.read_bytes())
        used = "".join(self.help_of(name, "--help-all").split("\nWords:\n")[0] for name in COMMANDS)
        used += self.help_of("inspect", "good.pstrip") + self.help_of("stripify", "tube.obj")
        used += self.run_program("compare", "tube.obj", "good.pstrip", code=7).out.decode()
        used = " ".join(used.split())
        for word in self.glossary():
            self.assertIn(word, used)


if __name__ == "__main__":
    unittest.main()
