"""What the program leaves behind: on the disk, on the terminal and in a pipe."""

import fcntl
import os
import re
import signal
import struct
import subprocess
import termios
import time
import unittest

from support import FORMATS, GOLDEN, PROGRAM, ProgramTest, bumpy_grid

ESCAPE = "\x1b[31mred"


class Output(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write_tube()
        self.write("good.pstrip", GOLDEN.read_bytes())

    def files(self):
        return sorted(path.name for path in self.folder.iterdir())

    def test_quiet_says_nothing_but_findings(self):
        runs = [(("convert", "tube.obj", "out.pm"), b""),
                (("extract", "good.pstrip", "out.ply"), b""),
                (("validate", "good.pstrip"), b"good.pstrip: valid\n"),
                (("inspect", "good.pstrip"), None), (("stripify", "tube.obj"), None),
                (("compare", "tube.obj", "tube.obj"), None)]
        for arguments, out in runs:
            for quiet in (("-q", *arguments), (*arguments, "--quiet")):
                run = self.run_program(*quiet)
                self.assertEqual(run.err, "", run)
                if out is not None:
                    self.assertEqual(run.out, out)
                else:
                    self.assertNotEqual(run.out, b"")
        # Errors are said all the same.
        self.assertIn("missing.ply", self.run_program("-q", "convert", "missing.ply", "out.ply",
                                                      code=2).err)

    def test_no_control_characters_in_a_pipe(self):
        broken = self.write("broken.pstrip", GOLDEN.read_bytes()[:-30]).name
        for arguments, code in ((("convert", "tube.obj", "out.pstrip"), 0),
                                (("validate", "good.pstrip", broken), 3),
                                (("inspect", "good.pstrip"), 0), (("stripify", "tube.obj"), 0),
                                (("compare", "tube.obj", "good.pstrip"), 7),
                                (("extract", broken, "out.ply"), 0)):
            run = self.run_program(*arguments, code=code)
            for text in (run.out.decode(), run.err):
                self.assertFalse([c for c in text if ord(c) < 32 and c != "\n"], run)

    def test_terminal_shows_progress_and_color_unless_told_not_to(self):
        for arguments, extra, wanted in (
                (("convert", "tube.obj", "out.pstrip"), {}, [b"simplify"]),
                (("-q", "convert", "tube.obj", "out.pstrip"), {}, []),
                (("validate", "good.pstrip"), {}, [b"\x1b[32mvalid\x1b[0m"]),
                (("validate", "good.pstrip"), {"NO_COLOR": "1"}, [b"good.pstrip: valid"])):
            code, shown = self.run_on_terminal(arguments, extra)
            self.assertEqual(code, 0)
            for text in wanted:
                self.assertIn(text, shown)
            if not wanted:
                self.assertEqual(shown, b"")
            if "NO_COLOR" in extra:
                self.assertNotIn(b"\x1b", shown)

    def test_progress_keeps_within_the_terminal(self):
        for columns in (20, 40, 80):
            for arguments in (("convert", "tube.obj", "out.pstrip"), ("stripify", "tube.obj"),
                              ("compare", "tube.obj", "tube.obj"),
                              ("stripify", "--compare", "tube.obj")):
                code, shown = self.run_on_terminal(arguments, {}, columns)
                self.assertEqual(code, 0)
                bars = re.findall(r"\r\x1b\[K([^\r\n]*)(?=\r\x1b)", shown.decode())
                self.assertTrue(any("%" in bar for bar in bars), (arguments, shown))
                self.assertLess(max(map(len, bars)), columns)
                # What is printed begins on a line that was cleared.
                after = shown.decode().split("\r\x1b[K")[-1]
                self.assertNotIn("%", after.splitlines()[0])

    def test_tables_fit_eighty_columns(self):
        self.write("grid.obj", bumpy_grid(200))
        self.run_program("convert", "-q", "grid.obj", "grid.pstrip")
        for arguments in (("inspect", "grid.pstrip"), ("inspect", "grid.obj"), ("stripify", "grid.obj"),
                          ("stripify", "--compare", "grid.obj", "--time-limit", "0.2"),
                          ("compare", "grid.obj", "grid.pstrip", "--level", "0", "--samples", "1k")):
            run = self.run_program(*arguments, code=7 if arguments[0] == "compare" else 0)
            for line in (run.out.decode() + run.err).splitlines():
                self.assertLessEqual(len(line), 80, line)

    def test_progress_moves_and_shows_the_time_left(self):
        long_search = ("--strip-effort", "4000000000", "--time-limit", "1.5")
        _, shown = self.run_on_terminal(("stripify", "tube.obj", *long_search), {})
        self.assertGreater(len(set(re.findall(rb"best[^\r]*", shown))), 1)
        self.assertIn(b" 0:01", shown)
        _, shown = self.run_on_terminal(("stripify", "--compare", "tube.obj", "tube.obj",
                                         "--algorithm", "best", *long_search), {})
        self.assertRegex(shown, rb"0:0\d, 0:0\d left")

    def run_on_terminal(self, arguments, extra, columns=80):
        ours, theirs = os.openpty()
        fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
        environment = {k: v for k, v in os.environ.items() if k != "NO_COLOR"} | extra
        process = subprocess.Popen([PROGRAM, *arguments], cwd=self.folder, stdin=theirs,
                                   stdout=theirs, stderr=theirs, env=environment)
        os.close(theirs)
        shown = b""
        while True:
            try:
                piece = os.read(ours, 65536)
            except OSError:  # how Linux says that the other end is closed
                break
            if not piece:
                break
            shown += piece
        os.close(ours)
        return process.wait(timeout=120), shown

    def test_names_are_escaped(self):
        name = ESCAPE + ".obj"
        self.write(name, f"v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl {ESCAPE}\nf 1 2 3\n")
        self.write("plain.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        self.write("red.ply", f"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                   f"property float y\nproperty float z\nproperty float {ESCAPE}\nend_header\n"
                   "0 0 0 1\n")
        for arguments, code in ((("inspect", name), 0), (("stripify", name), 0),
                                (("convert", name, ESCAPE + ".pm"), 0),
                                (("validate", name), 5), (("validate", ESCAPE), 2),
                                (("inspect", "red.ply"), 0),
                                (("compare", "red.ply", "plain.obj"), 7),
                                (("convert", name, f"{ESCAPE}/x.ply"), 2),
                                (("convert", name, "out." + ESCAPE), 1),
                                (("validate", "--explain", ESCAPE), 1),
                                (("validate", "good.pstrip", "--ignore", ESCAPE), 1)):
            run = self.run_program(*arguments, code=code)
            self.assertNotIn("\x1b", run.out.decode() + run.err, run)
            self.assertIn("red", run.out.decode() + run.err, run)
        self.assertIn("\\x1b[31mred.obj", self.run_program("inspect", name).out.decode())

    def test_failed_write_leaves_what_was_there(self):
        self.write("out.obj", "old")
        (self.folder / "out.mtl").mkdir()
        self.run_program("convert", "tube.obj", "out.obj", code=2)
        self.assertEqual(self.read("out.obj"), b"old")
        (self.folder / "out.bin").mkdir()
        before = self.files()
        self.run_program("convert", "tube.obj", "out.gltf", code=2)
        self.assertEqual(self.files(), before)

    def test_full_device(self):
        with open("/dev/full", "wb") as full:
            for arguments in (("inspect", "good.pstrip"), ("validate", "good.pstrip"),
                              ("compare", "tube.obj", "tube.obj"), ("stripify", "tube.obj"),
                              *(("convert", "tube.obj", "-", "--to", f) for f in FORMATS)):
                done = subprocess.run([PROGRAM, *arguments], cwd=self.folder, stdout=full,
                                      stderr=subprocess.PIPE, timeout=60)
                self.assertEqual(done.returncode, 2, arguments)
                self.assertIn(b"standard output", done.stderr)

    def test_converting_onto_itself_takes_force(self):
        self.run_program("convert", "-q", "tube.obj", "same.glb")
        before = self.read("same.glb")
        self.run_program("convert", "-q", "same.glb", "same.glb", code=1)
        self.run_program("convert", "-q", "same.glb", "same.glb", "--force")
        self.assertEqual(self.read("same.glb"), before)

    def test_inputs_are_never_outputs(self):
        self.run_program("convert", "-q", "tube.obj", "one.ply")
        self.run_program("convert", "-q", "tube.obj", "two.ply", "--attributes", "none")
        before = self.read("two.ply")
        self.run_program("stripify", "one.ply", "two.ply", code=1)
        self.assertEqual(self.read("two.ply"), before)

    def test_stripify_takes_an_output_that_is_not_there_yet(self):
        self.run_program("stripify", "tube.obj", "strips.glb")
        before = self.read("strips.glb")
        self.run_program("stripify", "tube.obj", "strips.glb", code=1)
        self.assertEqual(self.read("strips.glb"), before)

    def test_companions_that_were_not_named_stay(self):
        for target, companion in (("out.gltf", "out.bin"), ("out.obj", "out.mtl")):
            self.write(companion, "mine")
            commands = (["convert", "tube.obj", target], ["stripify", "tube.obj", "-o", target])
            for command in commands:
                run = self.run_program(*command, code=2)
                self.assertIn(f"(at {companion})\n--force replaces it.\n", run.err)
                self.assertEqual(self.read(companion), b"mine")
                self.assertFalse((self.folder / target).exists())
            self.run_program(*commands[0], "--force")
            self.assertNotEqual(self.read(companion), b"mine")
            self.run_program(*commands[0])  # the same bytes again replace nothing
        self.run_program("extract", "good.pstrip", "out.gltf", code=2)

    def test_every_file_that_was_written_is_listed(self):
        run = self.run_program("convert", "tube.obj", "out.gltf")
        self.assertRegex(run.err, r"tube.obj \(.*\) -> out.gltf \(.*\), out.bin \(.*\)\n")
        run = self.run_program("extract", "good.pstrip", "level.obj")
        self.assertRegex(run.err, r"wrote level.obj \(.*\)")
        run = self.run_program("stripify", "tube.obj", "-o", "strips.obj")
        self.assertRegex(run.err, r"wrote strips.obj \(.*\), strips.mtl \(.*\)\n")


class Interrupt(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("grid.obj", bumpy_grid(200))  # 80,000 triangles
        self.before = self.files()

    def files(self):
        return sorted(path.name for path in self.folder.iterdir())

    def start(self, target):
        return subprocess.Popen([PROGRAM, "convert", "-q", "grid.obj", target], cwd=self.folder,
                                stderr=subprocess.PIPE)

    def finish(self, process):
        _, err = process.communicate(timeout=120)
        self.assertNotIn(b"Sanitizer", err)
        return process.returncode

    def test_at_any_time(self):
        start = time.monotonic()
        self.assertEqual(self.finish(self.start("whole.pstrip")), 0)
        seconds = time.monotonic() - start
        whole = self.read("whole.pstrip")
        (self.folder / "whole.pstrip").unlink()
        stopped = 0
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            for share in (0.2, 0.5, 0.9):
                process = self.start("out.pstrip")
                time.sleep(share * seconds)
                process.send_signal(number)
                code = self.finish(process)
                self.assertIn(code, (0, -number))
                stopped += code != 0
                # The signal may come late: after the work, or between the rename and the exit.
                if code == 0 or "out.pstrip" in self.files():
                    self.assertEqual(self.read("out.pstrip"), whole)
                    (self.folder / "out.pstrip").unlink()
                self.assertEqual(self.files(), self.before)
        self.assertGreater(stopped, 0)

    def test_while_a_file_is_written(self):
        caught = 0
        for _ in range(20):
            process = self.start("out.pstripx")
            while process.poll() is None:
                new = set(self.files()) - set(self.before)
                if not new:
                    continue
                process.send_signal(signal.SIGSTOP)
                caught += "out.pstripx" not in self.files()
                process.send_signal(signal.SIGINT)
                process.send_signal(signal.SIGCONT)
                break
            code = self.finish(process)
            self.assertIn(code, (0, -signal.SIGINT))
            left = set(self.files()) - set(self.before)
            self.assertLessEqual(left, {"out.pstripx"}, "no temporary file")
            if left:
                (self.folder / "out.pstripx").unlink()
            if caught:
                break
        self.assertGreater(caught, 0)


if __name__ == "__main__":
    unittest.main()
