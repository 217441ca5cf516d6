"""scripts/check_text finds each kind of text that does not belong into the project, and nothing else."""

import importlib.machinery
import importlib.util
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "scripts" / "check_text"

# Put together here, so that this file itself passes the check.
UNFINISHED, ISSUE, HOME = "TO" + "DO", "iss" + "ue 12", "/ho" + "me/somebody/mesh.obj"

GLOSSARY = {
    "CONTRIBUTING.md": "| word | meaning | not |\n| --- | --- | --- |\n| blocked | stopped | stuck, `hold(s\\|ing)? up` (but: `hold on`) |\n"
}

# What the glossary of this project finds, and what it must not find.
REFUSED = """
the actors meet|an obstacle|each tick|a BVH of faces|it is mended|capped at 1|the way of a node|ways of bodies|part of its way|along their ways|
bodies share a way|the slow way|a body is told|a line tells|it is not looked at|another look|what the node has of velocity|what of it is inside|
its rooms|what is held up|bodies hold up a press|a divided step|courses of bodies|looking back|clear of itself|a body that meets itself|its liveliness
""".replace("\n", "").split("|")
ALLOWED = """It goes half way, both ways, and on its way in the same way, by way of a table. Give way. Look at it. The camera looks at the ball. The look of a
surface. There is room. Of course. Hold the key. A clear sky. What has moved. Two bodies meet. The attic, the ticket. It held up to 3 J.
"""


def run(name, text, **others):
    with tempfile.TemporaryDirectory() as root:
        for path, content in {name: text, **others}.items():
            file = Path(root) / path
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(content)
        return subprocess.run([sys.executable, PROGRAM, root], capture_output=True, text=True, check=False)


class CheckText(unittest.TestCase):
    def assert_refused(self, name, text, *words, **others):
        result = run(name, text, **others)
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertEqual(result.stdout.count("\n"), 1, result.stdout)
        for word in [name, *words]:
            self.assertIn(word, result.stdout)

    def assert_passes(self, name, text, **others):
        result = run(name, text, **others)
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

    def test_numbered_bindings(self):
        self.assert_refused("shaders/a.comp", "layout(std430, binding = 3) buffer A { uint a[]; };\n", "a.comp:1", "by name")
        self.assert_refused("src/gpu/a.cpp", "texels.bind(4);\n", "by name")
        self.assert_refused("src/render/a.cpp", "glActiveTexture(GL_TEXTURE3);\n", "by name")
        self.assert_passes("src/gl/a.cpp", "glBindBufferBase(target, block.index, id);\n")
        self.assert_passes("src/gpu/a.cpp", 'program.bind("Positions", nodes.positions);\n')

    def test_names_of_files_that_are_not_there(self):
        self.assert_refused("docs/a.md", "See docs/b.md and docs/a.md.\n", "docs/b.md")
        self.assert_refused("shaders/sim/a.comp", "// Parity: tests/gpu/a_test.cpp.\n", "tests/gpu/a_test.cpp")
        self.assert_passes("CHANGELOG.md", "docs/b.md has gone.\n")

    def test_names_of_shaders_that_are_not_there(self):
        there = {"shaders/sim/a.comp": "\n"}
        self.assert_refused("docs/a.md", "`shaders/sim/`: `a`, `b`\n", "'b'", **there)
        self.assert_refused("src/gpu/a.h", "/// shaders/sim/a.comp, b.comp.\n", "'b.comp'", **there)
        self.assert_passes("docs/a.md", "`shaders/sim/`: `a`; shaders/sim/a.comp and a.comp\n", **there)

    def test_twins_that_are_not_there(self):
        there = {
            "src/cpu/a/a.h": "class Walk {\n    void go();\n};\nvoid run_all(int n);\n// class Gone\nint a = call(1);\n",
            "src/gpu/a/b.h": "struct Boxes {\n};\n",
            "shaders/sim/a/a.comp": "\n",
        }

        def refused(comment, *words):
            self.assert_refused("shaders/sim/c.glsl", f"// What it does. {comment}\n", "c.glsl:1", "twin", *words, **there)

        def passes(comment):
            self.assert_passes("shaders/sim/c.glsl", f"// What it does. {comment}\n", **there)

        passes("CPU twin: gelatin::cpu::Walk. More.")
        passes("CPU twin: cpu::Walk::go, run_all.")
        passes("CPU twins, which say why: gelatin::cpu::Walk, src/cpu/a/a.h.")
        passes("GPU twins: gpu::Boxes, shaders/sim/a/a.comp.\n// Parity")
        passes("GLSL twin:\n// sim/a/a.comp.")
        refused("CPU twin: gelatin::cpu::Walks.", "'gelatin::cpu::Walks'", "CPU twin")
        refused("CPU twin: cpu::Walk::stop.", "cpu::Walk::stop")
        refused("CPU twin: cpu::Boxes.", "cpu::Boxes")
        refused("CPU twin: gpu::Boxes.", "gpu::Boxes")
        refused("CPU twin: cpu::Gone.", "cpu::Gone")
        refused("CPU twins: cpu::Walk, and\n// cpu::Stand.", "cpu::Stand")
        refused("CPU twin: shaders/sim/a/a.comp.", "CPU twin")
        refused("GLSL twin: sim/a/walk.", "sim/a/walk")

    def test_words_of_the_glossary(self):
        self.assert_refused("src/a.h", "// It holds\n// up the press.\n", "a.h:1", "'holds up'", "'blocked'", **GLOSSARY)
        self.assert_refused("src/a.cpp", 'log("what is holding "\n    "Up");\n', "a.cpp:1", **GLOSSARY)
        self.assert_refused("docs/a.md", "`a\nb`\n\nIt holds up.\n", "a.md:4", **GLOSSARY)
        self.assert_passes("src/a.h", "// Stuck; hold on; upholds up; hold upon; held_up\n", **GLOSSARY)
        self.assert_passes("docs/a.md", "`holds up`\n```sh\nhold up\n```\n", **GLOSSARY)
        self.assert_passes("src/cpu/contact/a.h", "// holds up\n", **GLOSSARY)
        self.assert_refused("src/gpu/contact/a.h", "// holds up\n", "blocked", **GLOSSARY)

    def test_each_pattern_of_our_glossary_finds_what_it_is_for(self):
        loader = importlib.machinery.SourceFileLoader("check_text", str(PROGRAM))
        program = importlib.util.module_from_spec(importlib.util.spec_from_loader("check_text", loader))
        loader.exec_module(program)
        patterns = [pattern for pattern, _ in program.read_glossary(ROOT)]
        self.assertGreater(len(patterns), 20)
        for pattern in patterns:
            self.assertTrue(any(pattern.search(text) for text in REFUSED), pattern.pattern)
            self.assertIsNone(pattern.search(ALLOWED), pattern.pattern)
        for text in REFUSED:
            self.assertTrue(any(pattern.search(text) for pattern in patterns), text)

    def test_the_status_of_decisions(self):
        there = {"docs/decisions/0002-b.md": "# 2. B\n\nStatus: holds.\n"}
        link = "[0002](0002-b.md)"

        def passes(status):
            self.assert_passes("docs/decisions/0001-a.md", f"# 1. A\n\nStatus: {status}\n\n## Context\n", **there)

        def refused(status, *words):
            self.assert_refused("docs/decisions/0001-a.md", f"# 1. A\n\n{status}\n", *words, **there)

        passes("holds.")
        passes(f"replaced by {link}.")
        passes(f"holds, but for planes (see {link}) and for friction (see {link}, {link}).")
        refused("## Context", "Status")
        refused("Status: holds, but for planes.", "Status")
        refused("Status: replaced.", "Status")
        refused("Status: replaced by [0003](0003-c.md).", "'0003-c.md': there is no such decision")

    def test_long_files_are_only_warned_of(self):
        self.assertIn("500 lines", self.assert_passes("src/a.cpp", "int a;\n" * 500))
        self.assertEqual("", self.assert_passes("src/a.cpp", "int a;\n" * 400))

    def test_what_is_built_is_not_read(self):
        self.assert_passes("build/release/a.cpp", f"// {UNFINISHED}\n")
        self.assert_passes("out/a.md", f"{UNFINISHED}\n")
        self.assert_refused("src/model/assembly/a.cpp", f"// {UNFINISHED}\n", "unfinished work")


if __name__ == "__main__":
    unittest.main()
