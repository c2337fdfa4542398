"""What the program leaves behind: on the disk, on the terminal and in a pipe."""

import os
import signal
import subprocess
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

    def run_on_terminal(self, arguments, extra):
        ours, theirs = os.openpty()
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
                                (("validate", name), 3), (("validate", ESCAPE), 2),
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

    def test_converting_onto_itself(self):
        self.run_program("convert", "-q", "tube.obj", "same.glb")
        before = self.read("same.glb")
        self.run_program("convert", "-q", "same.glb", "same.glb")
        self.assertEqual(self.read("same.glb"), before)


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
