"""scripts/docs builds the site without a warning, and what it built is whole: links lead somewhere, formulas and diagrams
are drawn, and no page asks another server for anything. Needs PyPI, so it is one of the long tests."""

import html
import re
import subprocess
import unittest
from pathlib import Path
from urllib.parse import unquote

ROOT = Path(__file__).resolve().parents[2]
SITE = ROOT / "build/site"
LINK = re.compile(r'<(?:a|img|link|script)\b[^>]*?\b(?:href|src)="?([^"\s>]+)')
ANCHOR = re.compile(r'\b(?:id|name)="?([^"\s>]+)')


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        result = subprocess.run([ROOT / "scripts/docs"], capture_output=True, text=True, check=False)
        assert result.returncode == 0, result.stdout + result.stderr
        cls.pages = {file: file.read_text(encoding="utf-8") for file in SITE.rglob("*.html")}

    def test_there_are_pages_of_all_that_the_site_is_made_of(self):
        names = {file.relative_to(SITE).as_posix() for file in self.pages}
        texts = [file.relative_to(ROOT / "docs").with_suffix(".html").as_posix() for file in (ROOT / "docs").rglob("*.md")]
        made = ["index.html", "gallery.html", "scene-keys.html", "api-cpp.html", "api-python.html", "contributing.html"]
        self.assertEqual([name for name in texts + made if name not in names], [])

    def test_links_and_anchors_lead_somewhere(self):
        anchors = {file: {unquote(a) for a in ANCHOR.findall(text)} for file, text in self.pages.items()}
        lost = []
        for file, text in self.pages.items():
            if file.name == "404.html":
                continue  # its links are absolute
            for link in map(html.unescape, LINK.findall(text)):
                path, _, anchor = link.partition("#")
                if re.match(r"[a-z]+:", link):
                    continue
                target = (file.parent / unquote(path)).resolve() if path else file
                if target.is_dir():
                    target = target / "index.html"
                there = target.is_file() and (not anchor or target not in anchors or unquote(anchor) in anchors[target])
                if not there and not anchor.startswith("__"):
                    lost.append(f"{file.relative_to(SITE)}: {link}")
        self.assertEqual(lost, [])

    def test_nothing_is_loaded_from_other_servers(self):
        for file, text in self.pages.items():
            loaded = re.findall(r'<(?:script|img|link)\b[^>]*?(?:src|href)="?(https?:[^"\s>]+)', text)
            self.assertEqual(loaded, [], file)

    def test_formulas_and_diagrams_are_drawn(self):
        for name, formulas, diagrams in [("contact", 40, 0), ("physics", 10, 0), ("architecture", 0, 2), ("viewer", 0, 1)]:
            text = self.pages[SITE / f"{name}.html"]
            self.assertGreaterEqual(text.count("<math"), formulas, name)
            self.assertEqual(len(re.findall(r'<div class="diagram"><svg', text)), diagrams, name)
        for file, text in self.pages.items():
            self.assertNotRegex(text, r"arithmatex|<merror", file)

    def test_each_scene_is_in_the_gallery(self):
        gallery = self.pages[SITE / "gallery.html"]
        for scene in (ROOT / "scenes").glob("*.toml"):
            self.assertIn(f"scenes/{scene.name}", gallery)
            self.assertTrue((SITE / f"images/scenes/{scene.stem}.png").is_file(), scene)

    def test_recipes_are_the_files_that_the_tests_run(self):
        cookbook = re.sub(r"<[^>]*>", "", self.pages[SITE / "cookbook.html"])
        for name in ["python/drop_my_mesh.py", "python/pull_a_body.py", "python/random_squeezes.py", "embed/embed.cpp"]:
            self.assertIn((ROOT / "examples" / name).read_text(encoding="utf-8").strip(), html.unescape(cookbook))

    def test_interfaces_are_whole(self):
        """Each type of the headers and each name of the package has its place, each method of Simulator a heading."""
        cpp, python = self.pages[SITE / "api-cpp.html"], self.pages[SITE / "api-python.html"]
        for header in (ROOT / "include/gelatin").glob("*.h"):
            for name in re.findall(r"^(?:enum class|struct|class) (?:GELATIN_API )?(\w+)[^;]*\{", header.read_text(), re.M):
                self.assertIn(f'id="{name.lower()}"', cpp)
        for method in ["advance_frame", "set_positions", "move_pull", "before_step", "load_checkpoint"]:
            self.assertRegex(cpp, rf"\b{method}\b")
        names = re.findall(r'^    "(\w+)",$', (ROOT / "python/gelatin/__init__.py").read_text(), re.M)
        for name in set(names) - {"version", "commit"}:
            self.assertIn(f'id="gelatin.{name}"', python)


if __name__ == "__main__":
    unittest.main()
