"""What docs/site makes of the repository's files, before MkDocs sees it: links, lists, the gallery, the pages of C++."""

import re
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "docs/site"))
import api_pages  # noqa: E402
import gallery  # noqa: E402
import links  # noqa: E402
from cpp_headers import read_header  # noqa: E402

HEADER = """
namespace gelatin {

class Forward;

/// What a thing is. See Scale.
///
/// Second paragraph.
struct Thing {
    int count = 1;     ///< of them, > 0
                       ///< and even
    /// Above it.
    double size{2.0};  ///< [m]
};

enum class Scale { small, large };

class GELATIN_API Machine {
public:
    /// Does it.
    /// @param count of things, > 0 @throws InvalidInput if there is none
    /// @return how long it took [s]
    double run(int count,
               double speed = 1.0);
    /// The same for all.
    double run();

private:
    /// Hidden.
    int hidden();
};

/// Loads one.
GELATIN_API Thing load_thing(const char* file);

}  // namespace gelatin
"""


class Links(unittest.TestCase):
    def rewrite(self, text, origin, page):
        return links.link_within_site(text, origin, page)

    def test_files_are_found_from_where_they_are_linked(self):
        self.assertEqual(self.rewrite("[a](docs/contact.md#law)", "README.md", "index.md"), "[a](contact.md#law)")
        self.assertEqual(self.rewrite("[a](../README.md)", "docs/contact.md", "contact.md"), "[a](index.md)")
        self.assertEqual(self.rewrite("[a](../contact.md)", "docs/decisions/0001-dependencies.md", "decisions/0001-dependencies.md"), "[a](../contact.md)")
        self.assertEqual(self.rewrite("[a](docs/decisions)", "README.md", "index.md"), "[a](decisions/index.md)")

    def test_sources_have_pages(self):
        changed = self.rewrite("[a](../examples/quick_start.cpp)", "docs/tutorial.md", "tutorial.md")
        self.assertEqual(changed, "[a](sources/examples/quick_start.cpp.md)")
        self.assertIn("{ .cpp }", links.source_page("examples/quick_start.cpp"))

    def test_other_links_and_code_stay(self):
        for text in ["[a](https://toml.io)", "[a](#here)", "[a](nowhere.md)", "```\n[a](docs/contact.md)\n```"]:
            self.assertEqual(self.rewrite(text, "README.md", "index.md"), text)

    def test_lists_begin_with_an_empty_line_outside_of_code(self):
        self.assertEqual(links.separate_lists("so:\n- a\n  more\n- b\n1. c"), "so:\n\n- a\n  more\n- b\n1. c")
        self.assertEqual(links.separate_lists("1. a\n\n   more\n2. b"), "1. a\n\n   more\n\n2. b")
        self.assertEqual(links.separate_lists("```\nso:\n- a\n```"), "```\nso:\n- a\n```")


class Gallery(unittest.TestCase):
    def test_the_first_comment_is_the_line(self):
        self.assertEqual(gallery.first_comment("# A ball\n# falls.\n\n[simulation]\n# not this\n"), "A ball falls.")
        self.assertEqual(gallery.first_comment("[simulation]\n# not this\n"), "")

    def test_every_scene_is_there(self):
        text = gallery.page()
        for scene in gallery.scenes():
            self.assertIn(f"gelatin run scenes/{scene.name}", text)


class CppPage(unittest.TestCase):
    def test_declarations_have_their_comments(self):
        thing, scale, machine, load = read_header(HEADER)
        self.assertEqual([d.kind for d in (thing, scale, machine, load)], ["struct", "enum", "class", "function"])
        self.assertEqual(thing.doc, "What a thing is. See Scale.  Second paragraph.")
        self.assertEqual([(m.name, m.doc) for m in thing.members], [("count", "of them, > 0 and even"), ("size", "Above it. [m]")])
        self.assertEqual([m.name for m in machine.members], ["run", "run"])
        self.assertEqual(load.code, "Thing load_thing(const char* file);")

    def test_tags_become_a_list_and_types_links(self):
        text = "".join(api_pages._parts(read_header(HEADER)[2], {"InvalidInput": "invalidinput"}))
        self.assertIn("- `count`: of things, > 0\n- Throws: [`InvalidInput`](#invalidinput) if there is none\n- Returns: how long", text)
        self.assertEqual(text.count("#### run"), 1)
        self.assertNotIn("hidden", text)

    def test_every_public_type_is_there(self):
        text = api_pages.cpp_page(ROOT)
        for header in (ROOT / "include/gelatin").glob("*.h"):
            for name in re.findall(r"^(?:enum class|struct|class) (?:GELATIN_API )?(\w+)[^;]*?\{", header.read_text(), re.M):
                self.assertIn(f"### {name}\n", text)


class Commands(unittest.TestCase):
    def test_commands_have_options_and_scenes_that_exist(self):
        """Of the pages, in blocks and in lines."""
        options = set(re.findall(r"--[a-z][\w-]*", (ROOT / "docs/command-line.md").read_text(encoding="utf-8")))
        texts = {file.name: file.read_text(encoding="utf-8") for file in [*(ROOT / "docs").glob("*.md"), ROOT / "README.md"]}
        texts["gallery"] = gallery.page()
        for name, text in texts.items():
            for command in re.findall(r"(?:^|`)(?:build/release/bin/)?gelatin (?:run|view|info|mesh|render|export) [^`\n]*", text, re.M):
                words = command.partition(" #")[0]
                self.assertEqual(set(re.findall(r"(?<!\S)--[a-z][\w-]*", words)) - options, set(), f"{name}: {command}")
                for scene in re.findall(r"scenes/\w+\.toml", words):
                    self.assertTrue((ROOT / scene).is_file(), f"{name}: {command}")


if __name__ == "__main__":
    unittest.main()
