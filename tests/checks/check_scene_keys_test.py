"""scripts/check_scene_keys finds each key that the code or the page lacks; what it makes of the code is right."""

import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "scripts/check_scene_keys"
PAGE = "docs/scene-files.md"
CODE = "src/model/scene"
READ = [PAGE, CODE, "include/gelatin/scene.h", "src/model/setting_names.cpp"]

sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "docs/site"))
from scene_keys import page, read_tables  # noqa: E402


def run(changes):
    """The check on a copy of what it reads: {file: (old, new)} is changed there."""
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        for name in READ:
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            copy = shutil.copytree if (ROOT / name).is_dir() else shutil.copy
            copy(ROOT / name, root / name)
        for name, (old, new) in changes.items():
            text = (root / name).read_text(encoding="utf-8")
            assert old in text, old
            (root / name).write_text(text.replace(old, new), encoding="utf-8")
        return subprocess.run([sys.executable, PROGRAM, root], capture_output=True, text=True, check=False)


class CheckSceneKeys(unittest.TestCase):
    def assert_refused(self, name, old, new, *words):
        result = run({name: (old, new)})
        self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
        for word in words:
            self.assertIn(word, result.stdout)

    def assert_missing_if_renamed(self, name, key, *tables):
        """A key of another name in the code is missing on the page, and the page's own is no key any more."""
        words = [f"[{table}]: '{word}" for table in tables for word in ("renamed' is missing", f"{key}' is no key")]
        self.assert_refused(f"{CODE}/{name}", f'"{key}"', '"renamed"', *words)

    def test_the_page_has_the_keys_of_the_code(self):
        result = run({})
        self.assertEqual((result.returncode, result.stdout), (0, ""), result.stderr)

    def test_a_new_key_of_the_code_is_missed_on_the_page(self):
        for function, table in [
            ("sleep", "simulation"), ("frames", "simulation"), ("self_collision", "collision"), ("eye", "camera"), ("damping", "material"),
        ]:  # fmt: skip
            self.assert_refused(
                f"{CODE}/scene_file.cpp", f'reader.read("{function}"', f'reader.read("novel", x); reader.read("{function}"',
                f"[{table}]: 'novel' is missing",
            )  # fmt: skip

    def test_keys_of_every_kind_of_table_are_followed(self):
        self.assert_missing_if_renamed("scene_file_drives.cpp", "interpolation", "object.handle", "collider")
        self.assert_missing_if_renamed("scene_file_drives.cpp", "release", "object.handle")
        self.assert_missing_if_renamed("scene_file_drives.cpp", "until", "object.load", "rigid.load")
        self.assert_missing_if_renamed("scene_file_drives.cpp", "break_force", "attachment")
        self.assert_missing_if_renamed("scene_file_drives.cpp", "line", "attachment")
        self.assert_missing_if_renamed("scene_file_drives.cpp", "limits", "attachment")
        self.assert_missing_if_renamed("scene_file_drives.cpp", "of_other", "attachment.universal")
        self.assert_missing_if_renamed("scene_file_drives.cpp", "rest", "attachment.spring")
        self.assert_missing_if_renamed("scene_file_drives.cpp", "position", "attachment.motor", "attachment.motor.keyframes")
        self.assert_missing_if_renamed("scene_file_copies.cpp", "jitter", "object.copies", "rigid.copies")
        self.assert_missing_if_renamed("scene_file_bodies.cpp", "scatter", "object.start")
        self.assert_missing_if_renamed("scene_file_bodies.cpp", "cell_size", "object.mesher")
        self.assert_missing_if_renamed("scene_file_bodies.cpp", "segments", "object.shape", "collider.shape")
        self.assert_missing_if_renamed("scene_file_bodies.cpp", "surface_velocity", "collider")
        self.assert_missing_if_renamed("scene_file_bodies.cpp", "spin", "object", "rigid")
        self.assert_missing_if_renamed("scene_file_bodies.cpp", "inertia", "rigid")
        for table in ("object.pins", "object.part.region", "object.handle.region", "object.load.region", "attachment.region"):
            self.assert_refused(f"{CODE}/scene_file_region.cpp", 'read("offset"', 'read("novel"', f"[{table}]: 'novel'")

    def test_a_new_table_of_the_code_is_missed_on_the_page(self):
        self.assert_refused(
            f"{CODE}/scene_file_bodies.cpp", 'reader.table("copies")', 'reader.table("novel")', "[object.novel]", "no such table",
        )  # fmt: skip

    def test_a_key_that_only_the_page_has_is_found(self):
        self.assert_refused(PAGE, "| `sleep` |", "| `slept` |", "[simulation]: 'slept' is no key", "'sleep' is missing")
        self.assert_refused(PAGE, "| `counts` | required |", "| `counts` | required | |\n| `novel` | 1 |", "[object.copies]: 'novel'")
        self.assert_refused(PAGE, "`{ scatter = 0.1 }`", "`{ strew = 0.1 }`", "[object.start]: 'strew'", "'scatter' is missing")

    def test_a_deleted_row_is_missed(self):
        self.assert_refused(PAGE, "| `from`, `until` |", "| `from` |", "[object.load]: 'until' is missing")


class SceneKeys(unittest.TestCase):
    def test_defaults_limits_and_choices_are_those_of_the_code(self):
        tables = read_tables(ROOT)
        material = tables["material"]
        self.assertEqual((material["density"].default, material["density"].allowed), ("1000.0", "greater than 0"))
        self.assertTrue(material["name"].required)
        self.assertEqual(material["springs"].choices, ["structural", "shear", "flex"])
        self.assertEqual(tables["simulation"]["solver"].default, '"implicit"')
        self.assertEqual(tables["object.copies"]["turn"].allowed, "from 0 to 180")
        self.assertEqual(tables["object.shape"]["segments"].allowed, "from 1 to 1000")
        self.assertEqual(tables["object.part"]["region"].alternatives, ["region", "attribute"])
        self.assertEqual(tables["object.load"]["until"].type, "number")
        self.assertEqual((tables["rigid"]["mass"].type, tables["rigid"]["mass"].allowed), ("number", "greater than 0"))
        self.assertEqual(tables["rigid"]["inertia"].type, "[x, y, z]")
        self.assertNotIn("mesher", tables["rigid"])
        attachment = tables["attachment"]
        self.assertEqual((attachment["compliance"].default, attachment["compliance"].allowed), ("0.0", "0 or more"))
        self.assertEqual((attachment["point"].type, attachment["line"].type), ("[x, y, z]", "[[x, y, z], [x, y, z]]"))
        self.assertTrue(attachment["object"].required)
        self.assertEqual(attachment["limits"].type, "two numbers")
        self.assertEqual(tables["attachment.spring"]["stiffness"].allowed, "0 or more")
        self.assertTrue(tables["attachment.motor.keyframes"]["time"].required)

    def test_every_key_has_a_row(self):
        text = page(ROOT)
        for table, keys in read_tables(ROOT).items():
            for name in keys if table else []:
                self.assertIn(f"\n| `{name}` |", text)


if __name__ == "__main__":
    unittest.main()
