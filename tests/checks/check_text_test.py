"""scripts/check_text finds each kind of text that does not belong into the project, and nothing else."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = Path(__file__).resolve().parents[2] / "scripts" / "check_text"

# Put together here, so that this file itself passes the check.
UNFINISHED, ISSUE, HOME = "TO" + "DO", "iss" + "ue 12", "/ho" + "me/somebody/mesh.obj"


def run(name, text):
    with tempfile.TemporaryDirectory() as root:
        file = Path(root) / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
        return subprocess.run([sys.executable, PROGRAM, root], capture_output=True, text=True, check=False)


class CheckText(unittest.TestCase):
    def assert_refused(self, name, text, *words):
        result = run(name, text)
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertEqual(result.stdout.count("\n"), 1, result.stdout)
        for word in [name, *words]:
            self.assertIn(word, result.stdout)

    def assert_passes(self, name, text):
        result = run(name, text)
        self.assertEqual((result.returncode, result.stdout), (0, ""), result.stderr)
        return result.stderr

    def test_plain_text_passes(self):
        self.assert_passes("src/a.h", '#pragma once\n// SI units; see "src/a.h".\n#include "b.h"\n')

    def test_marks_of_unfinished_work(self):
        self.assert_refused("src/a.cpp", f"int a;\n// {UNFINISHED}: later\n", "a.cpp:2", "unfinished work")
        self.assert_refused("docs/a.md", "<" * 7 + " ours\n", "merge")

    def test_paths_of_one_machine(self):
        self.assert_refused("scripts/run", f"cat {HOME}\n", "one machine")
        self.assert_passes("scripts/run", "cat /usr/share/fonts /tmp/a ${HOME}/work/b\n")

    def test_issue_numbers(self):
        self.assert_refused("docs/a.md", f"As in {ISSUE}.\n", "say the reason")
        self.assert_passes("shaders/a.glsl", "#version 430 core\n")

    def test_white_space(self):
        self.assert_refused("CMakeLists.txt", "project(a) \n", "CMakeLists.txt:1", "white space")
        self.assert_refused("scenes/a.toml", "a = 1", "newline")

    def test_names_of_files_that_are_not_there(self):
        self.assert_refused("docs/a.md", "See docs/b.md and docs/a.md.\n", "docs/b.md")
        self.assert_refused("shaders/sim/a.comp", "// Parity: tests/gpu/a_test.cpp.\n", "tests/gpu/a_test.cpp")
        self.assert_passes("CHANGELOG.md", "docs/b.md has gone.\n")

    def test_long_files_are_only_warned_of(self):
        self.assertIn("500 lines", self.assert_passes("src/a.cpp", "int a;\n" * 500))
        self.assertEqual("", self.assert_passes("src/a.cpp", "int a;\n" * 400))

    def test_what_is_built_is_not_looked_at(self):
        self.assert_passes("build/release/a.cpp", f"// {UNFINISHED}\n")


if __name__ == "__main__":
    unittest.main()
