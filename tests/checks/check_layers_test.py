"""scripts/check_layers finds each kind of forbidden include, and nothing in a tree that keeps the rules."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = Path(__file__).resolve().parents[2] / "scripts" / "check_layers"

ARROWS = """
gelatin_layer(core LIBRARIES fmt::fmt)
gelatin_layer(mesh DEPENDS core LIBRARIES assimp::assimp)
gelatin_layer(model DEPENDS mesh)
gelatin_layer(cpu DEPENDS model LIBRARIES TBB::tbb)
gelatin_layer(gl DEPENDS core)
gelatin_layer(gpu DEPENDS model gl)
gelatin_layer(sim DEPENDS cpu gpu)
"""

GOOD_TREE = {
    "CMakeLists.txt": ARROWS,
    "include/gelatin/error.h": "#include <string>\n",
    "include/gelatin/scene.h": '#include "gelatin/error.h"\n',
    "include/gelatin/simulator.h": '#include "gelatin/scene.h"\n',
    "src/core/file.h": '#include "gelatin/error.h"\n',
    "src/mesh/mesh.h": '#include "core/file.h"\n#include "gelatin/scene.h"\n',
    "src/model/layouts.h": '#include "layouts/spring.glsl"\n',
    "src/cpu/solver.h": '#include "core/file.h"\n#include "mesh/mesh.h"\n',
    "src/gl/buffer.h": '#include "core/file.h"\n',
    "src/gpu/solver.h": '#include "gl/buffer.h"\n#include "model/layouts.h"\n',
    "src/sim/simulator.cpp": '#include "gelatin/simulator.h"\n#include "cpu/solver.h"\n',
    "src/cpu/collision/boxes.h": '#include "cpu/solver.h"\n',
    "src/cpu/implicit/sweep.cpp": '#include "cpu/collision/boxes.h"\n',
    "src/gpu/collision/boxes.h": "",
    "shaders/sim/collision/boxes.glsl": "",
    "shaders/sim/implicit/sweep.comp": '#include "sim/collision/boxes.glsl"\n',
    "shaders/layouts/spring.glsl": "",
    "shaders/sim/step.comp": '#include "layouts/spring.glsl"\n',
    "shaders/render/light.glsl": "",
    "apps/viewer/main.cpp": "#include <GLFW/glfw3.h>\n",
}


def run(files):
    with tempfile.TemporaryDirectory() as root:
        for name, text in files.items():
            file = Path(root) / name
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text)
        return subprocess.run([sys.executable, PROGRAM, root], capture_output=True, text=True, check=False)


class CheckLayers(unittest.TestCase):
    def assert_refused(self, name, text, *words):
        result = run({**GOOD_TREE, name: text})
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertEqual(result.stdout.count("\n"), 1, result.stdout)
        for word in [name, *words]:
            self.assertIn(word, result.stdout)

    def test_a_tree_that_keeps_the_rules_passes(self):
        result = run(GOOD_TREE)
        self.assertEqual((result.returncode, result.stdout), (0, ""), result.stderr)

    def test_a_lower_layer_may_not_include_a_higher_one(self):
        self.assert_refused("src/mesh/bad.cpp", '\n  #  include "cpu/solver.h"\n', "bad.cpp:2", "cpu/")

    def test_angle_brackets_hide_nothing(self):
        self.assert_refused("src/gl/bad.cpp", "#include <model/layouts.h>\n", "model/layouts.h")

    def test_the_backends_do_not_know_one_another(self):
        self.assert_refused("src/cpu/bad.cpp", '#include "gpu/solver.h"\n', "gpu/solver.h")
        self.assert_refused("src/gpu/bad.cpp", '#include "cpu/solver.h"\n', "cpu/solver.h")
        self.assert_refused("CMakeLists.txt", ARROWS + "gelatin_layer(cpu DEPENDS model gpu)", "cpu and gpu")

    def test_layers_do_not_go_round_in_a_circle(self):
        self.assert_refused("CMakeLists.txt", ARROWS + "gelatin_layer(core DEPENDS sim)", "circle")

    def test_public_headers_have_their_users(self):
        self.assert_refused("src/gl/bad.cpp", '#include "gelatin/scene.h"\n', "mesh")
        self.assert_refused("src/cpu/bad.cpp", '#include "gelatin/simulator.h"\n', "sim")
        self.assert_refused("include/gelatin/bad.h", '#include "mesh/mesh.h"\n', "mesh/mesh.h")

    def test_includes_name_files_that_are_there_from_the_top(self):
        self.assert_refused("src/mesh/bad.cpp", '#include "mesh/nowhere.h"\n', "nowhere.h")
        self.assert_refused("src/mesh/bad.cpp", '#include "mesh.h"\n', "layer/file.h")
        self.assert_refused("src/mesh/bad.cpp", '#include "../cpu/solver.h"\n', "layer/file.h")

    def test_a_folder_that_is_no_layer_is_named(self):
        self.assert_refused("src/stray/a.cpp", "", "src/stray")

    def test_shaders_include_files_that_are_there_and_their_own(self):
        self.assert_refused("shaders/sim/bad.comp", '#include "include/nowhere.glsl"\n', "nowhere.glsl")
        self.assert_refused("shaders/sim/bad.comp", '#include "render/light.glsl"\n', "drawing")

    def test_capabilities_include_those_that_they_may(self):
        self.assert_refused("src/cpu/drive/bad.h", '#include "cpu/collision/boxes.h"\n', "drive", "collision")
        self.assert_refused("src/cpu/elasticity/bad.h", '#include "cpu/collision/boxes.h"\n', "none only")
        self.assert_refused("shaders/sim/drive/bad.comp", '#include "sim/collision/boxes.glsl"\n', "drive")

    def test_a_folder_that_is_no_capability_is_named(self):
        self.assert_refused("src/gpu/stray/a.cpp", "", "stray is no capability")
        self.assert_refused("shaders/sim/stray/a.comp", "", "stray is no capability")

    def test_only_the_viewer_includes_the_windows_libraries(self):
        self.assert_refused("src/sim/bad.cpp", "#include <GLFW/glfw3.h>\n", "viewer")


if __name__ == "__main__":
    unittest.main()
