"""pstrips view: the server of the page, as a browser and as an attacker meet it."""

import http.client
import os
import pathlib
import shutil
import subprocess
import tempfile
import time
import unittest
import urllib.parse

from support import GOLDEN, PROGRAM


class View(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        # The program looks for its page beside itself, as installed.
        (self.folder / "bin").mkdir()
        self.program = self.folder / "bin/pstrips"
        shutil.copy(PROGRAM, self.program)
        page = self.folder / "share/pstrips/viewer"
        page.mkdir(parents=True)
        (page / "index.html").write_text("the page")

    def serve(self, *arguments):
        server = subprocess.Popen([self.program, "view", *map(str, arguments)], stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, text=True)
        def stop():
            server.kill()
            server.communicate()
        self.addCleanup(stop)
        address = urllib.parse.urlsplit(server.stdout.readline().strip())
        self.assertEqual(address.hostname, "127.0.0.1")
        return address

    def get(self, address, path, **headers):
        connection = http.client.HTTPConnection(address.netloc, timeout=30)
        self.addCleanup(connection.close)
        connection.request("GET", path, headers=headers)
        answer = connection.getresponse()
        return answer.status, answer.read(), answer.headers

    def test_serves_the_page_and_the_file_whole_and_in_ranges(self):
        address = self.serve(GOLDEN)
        whole = GOLDEN.read_bytes()
        path = "/" + urllib.parse.parse_qs(address.query)["url"][0]
        self.assertEqual(self.get(address, "/")[:2], (200, b"the page"))
        status, body, headers = self.get(address, path)
        self.assertEqual((status, body), (200, whole))
        self.assertEqual(headers["Content-Type"], "model/vnd.pstrips")
        self.assertEqual(self.get(address, path, Range="bytes=100-199")[:2], (206, whole[100:200]))
        self.assertEqual(self.get(address, path, Range="bytes=-10")[:2], (206, whole[-10:]))
        self.assertEqual(self.get(address, path, Range="bytes=100000-")[0], 416)

    def test_encodes_models(self):
        model = self.folder / "a model.obj"
        model.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        address = self.serve(model)
        path = "/" + urllib.parse.parse_qs(address.query, keep_blank_values=True)["url"][0]
        self.assertTrue(path.endswith("a model.pstrip"))
        status, body, _ = self.get(address, urllib.parse.quote(path))
        self.assertEqual((status, body[:4]), (200, GOLDEN.read_bytes()[:4]))

    def test_is_for_this_machine_alone(self):
        address = self.serve(GOLDEN)
        self.assertEqual(self.get(address, "/", Host="evil.example")[0], 403)
        self.assertEqual(self.get(address, "/", Host=f"localhost:{address.port}")[0], 200)
        (self.folder / "share/secret").write_text("secret")
        for path in ("/../secret", "/%2e%2e/secret", "/..%2fsecret", "/files/1/x", "/files/0"):
            self.assertIn(self.get(address, path)[0], (400, 404), path)

    def test_slows_down_as_asked(self):
        address = self.serve(GOLDEN, "--bandwidth", "8kbit")
        path = "/" + urllib.parse.parse_qs(address.query)["url"][0]
        start = time.monotonic()
        self.get(address, path, Range="bytes=0-499")
        self.assertGreater(time.monotonic() - start, 0.4)

    def test_says_what_it_cannot_do(self):
        def run(*arguments):
            done = subprocess.run([self.program, "view", *map(str, arguments)], capture_output=True, text=True, timeout=60)
            return done.returncode, done.stderr
        self.assertEqual(run(self.folder / "none.obj")[0], 2)
        for word in ("2", "fastbit", "1bit"):
            code, message = run(GOLDEN, "--bandwidth", word)
            self.assertEqual(code, 1, word)
            self.assertIn("--bandwidth", message)
        taken = self.serve(GOLDEN)
        self.assertEqual(run(GOLDEN, "--port", taken.port)[0], 2)
        os.remove(self.folder / "share/pstrips/viewer/index.html")
        code, message = run(GOLDEN)
        self.assertEqual(code, 5)
        self.assertIn("web/build", message)


if __name__ == "__main__":
    unittest.main()
