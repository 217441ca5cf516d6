"""bench/peers/run.py answers wrong options with one line and the exit code 2, before it installs anything."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = Path(__file__).resolve().parents[2] / "bench" / "peers" / "run.py"


class PeersTest(unittest.TestCase):
    def refused(self, *options, because):
        with tempfile.TemporaryDirectory() as work:
            command = [sys.executable, PROGRAM, "--work", work, "--gelatin", sys.executable, *options]
            done = subprocess.run(command, capture_output=True, text=True, check=False)
            self.assertEqual([], list(Path(work).iterdir()))
        self.assertEqual(2, done.returncode)
        self.assertEqual("", done.stdout)
        self.assertRegex(done.stderr, rf"^run\.py: error: .*{because}.*\n$")

    def test_wrong_options_are_refused(self):
        self.refused("--peers", "newton,newtown", because="'newtown' is none of gelatin, newton")
        self.refused("--scenes", "C", because="'C' is none of A, B")
        self.refused("--frames", "0", because="--frames")
        self.refused("--time-limit", "soon", because="--time-limit")
        self.refused("--gelatin", "/nowhere/gelatin", because="/nowhere/gelatin: there is no such program")
        self.refused("--report", "/nowhere/peers.md", because="/nowhere/peers.md: there is no such folder")
        self.refused("--scenes", "grab", because="grab is only for --joints")
        self.refused("--joints", "--scenes", "A", because="A is not for --joints")
        self.refused("--joints", "--peers", "pybullet", because="pybullet is not for --joints")
        self.refused("--threads", "2", because="--threads")


if __name__ == "__main__":
    unittest.main()
