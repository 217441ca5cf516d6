#!/usr/bin/env python3
"""The library as others use it: installed and found by find_package, from its page in an empty folder, and as a part of
another project."""

import argparse
import json
import os
import re
import shutil
import struct
import subprocess
import sys
import unittest
import zlib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
OPTIONS = None  # of the command line
# Without OpenGL: no driver, no display.
BLIND = {"__EGL_VENDOR_LIBRARY_FILENAMES": "/dev/null", "LIBGL_DRIVERS_PATH": "/dev/null", "DISPLAY": ""}


def run(*command, folder=None, extra=None):
    done = subprocess.run([str(word) for word in command], cwd=folder, env={**os.environ, **(extra or {})},
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, command))} failed with {done.returncode}:\n{done.stdout}")
    return done.stdout


def empty_folder(name):
    folder = OPTIONS.build / "package" / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    return folder


def configure(source, build, *settings):
    return run(OPTIONS.cmake, "-S", source, "-B", build, "-G", OPTIONS.generator,
               "-D", f"CMAKE_CXX_COMPILER={OPTIONS.compiler}", *settings)


def read_png(file):
    """Rows of (red, green, blue) of an 8-bit RGB picture."""
    data, at, packed = file.read_bytes(), 8, b""
    width, height = struct.unpack(">II", data[16:24])
    while at < len(data):
        (size,), kind = struct.unpack(">I", data[at:at + 4]), data[at + 4:at + 8]
        packed += data[at + 8:at + 8 + size] if kind == b"IDAT" else b""
        at += 12 + size
    raw, before, rows = zlib.decompress(packed), bytearray(3 * width), []
    for y in range(height):
        begin = y * (3 * width + 1)
        kind, row = raw[begin], bytearray(raw[begin + 1:begin + 1 + 3 * width])
        for i in range(3 * width):
            left, up, corner = (row[i - 3], before[i], before[i - 3]) if i >= 3 else (0, before[i], 0)
            guess = left + up - corner
            nearest = min((abs(guess - left), 0, left), (abs(guess - up), 1, up), (abs(guess - corner), 2, corner))[2]
            row[i] = (row[i] + (0, left, up, (left + up) // 2, nearest)[kind]) & 255
        rows.append([tuple(row[i:i + 3]) for i in range(0, 3 * width, 3)])
        before = row
    return rows


def blocks_of(page, language):
    text = (ROOT / page).read_text(encoding="utf-8")
    return re.findall(rf"^```{language}\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)


class Installed(unittest.TestCase):
    """With the library in a folder of its own."""

    @classmethod
    def setUpClass(cls):
        cls.prefix = empty_folder("prefix")
        run(OPTIONS.cmake, "--install", OPTIONS.build, "--prefix", cls.prefix)

    def build(self, source, name):
        folder = empty_folder(name)
        configure(source, folder, "-D", f"CMAKE_PREFIX_PATH={self.prefix}", "-D", "CMAKE_BUILD_TYPE=Release")
        run(OPTIONS.cmake, "--build", folder, "--parallel", "1")
        return folder

    def test_headers_need_nothing_but_glm(self):
        headers = list(self.prefix.glob("include/**/*.h"))
        self.assertGreater(len(headers), 8)
        for header in headers:
            for name in re.findall(r"#include [<\"]([^>\"]+)", header.read_text(encoding="utf-8")):
                self.assertRegex(name, r"^(gelatin/\w+\.h|glm/.*|[a-z_]+)$", header.name)
            self.assertNotRegex(header.read_text(encoding="utf-8"), r"Eigen|toml::|GLuint|GLenum")
            run(OPTIONS.compiler, "-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", "-I", self.prefix / "include",
                "-include", header, "-x", "c++", "/dev/null")

    def test_only_the_public_names_are_exported(self):
        library = next(self.prefix.glob("lib*/**/libgelatin.so"))
        names = run("nm", "--dynamic", "--demangle", "--defined-only", library).splitlines()
        self.assertGreater(len(names), 40)
        for line in names:
            name = line.split(maxsplit=2)[2]
            self.assertRegex(name, r"^((typeinfo|typeinfo name|vtable) for )?gelatin::")
            self.assertNotRegex(name, r"gelatin::(gl|gpu|cpu|render)::")
        self.assertRegex(str(library.resolve()), r"libgelatin\.so\.\d+\.\d+\.\d+$")
        soname = run("readelf", "--dynamic", library)
        self.assertRegex(soname, r"SONAME.*libgelatin\.so\.\d+\.\d+\]")

    def test_other_minor_versions_are_refused(self):
        folder = empty_folder("other_version")
        (folder / "CMakeLists.txt").write_text("cmake_minimum_required(VERSION 3.22)\nproject(other LANGUAGES CXX)\n"
                                               "find_package(gelatin 0.2 REQUIRED)\n", encoding="utf-8")
        with self.assertRaisesRegex(AssertionError, "0.2"):
            configure(folder, folder / "build", "-D", f"CMAKE_PREFIX_PATH={self.prefix}")

    def test_the_headless_example_runs_without_opengl(self):
        folder = self.build(ROOT / "examples/headless", "headless")
        output = run(folder / "headless", extra=BLIND)
        self.assertRegex(output, r"gelatin \d+\.\d+\.\d+ on CPU")
        self.assertRegex(output, r"after 2\.00 s its centre is at \d\.\d\d 0\.\d\d ")
        self.assertRegex(output, r"the floor presses it with [1-9]\d* N")

    def test_the_embedding_example_draws_the_body_with_its_own_shader(self):
        folder = self.build(ROOT / "examples/embed", "embed")
        picture = folder / "picture.png"
        run("xvfb-run", "--auto-servernum", "--server-args=-screen 0 1280x1024x24", folder / "embed", "36", picture)
        rows = read_png(picture)
        orange = [(x, y) for y, row in enumerate(rows) for x, (r, g, b) in enumerate(row) if r > g > b and r > 60]
        self.assertGreater(len(orange), 3000)
        self.assertLess(len(orange), 60000)
        middle = sum(x for x, _ in orange) / len(orange)
        self.assertLess(abs(middle - 320), 60)

    def test_the_page_leads_from_an_empty_folder_to_a_picture(self):
        folder = empty_folder("page")
        (folder / "CMakeLists.txt").write_text(blocks_of("docs/embedding.md", "cmake")[0], encoding="utf-8")
        (folder / "main.cpp").write_text(blocks_of("docs/embedding.md", "cpp")[0], encoding="utf-8")
        configure(folder, folder / "build", "-D", f"CMAKE_PREFIX_PATH={self.prefix}")
        run(OPTIONS.cmake, "--build", folder / "build", "--parallel", "1")
        run(folder / "build/jelly", folder=folder)
        rows = read_png(folder / "jelly.png")
        self.assertGreater(len({pixel for row in rows for pixel in row}), 100)


    def test_snippets_compile(self):
        """Those of the pages that are no programs, each as the body of a function."""
        checked = 0
        for page in sorted(file.relative_to(ROOT) for file in ROOT.glob("docs/*.md")):
            for snippet in blocks_of(page, "cpp"):
                if "int main(" in snippet or snippet.startswith(("template", "--8<--")):
                    continue  # the first have tests of their own, the others are Gelatin's own code
                includes = re.findall(r"^#include .*$", snippet, re.MULTILINE)
                body = re.sub(r"^#include .*$", "", snippet, flags=re.MULTILINE)
                folder = empty_folder("snippet")
                names = [*self.prefix.glob("include/gelatin/*.h")]
                text = "".join(f"#include <gelatin/{header.name}>\n" for header in names) + "\n".join(includes)
                (folder / "snippet.cpp").write_text(f"{text}\nvoid snippet() {{\n{body}\n}}\n", encoding="utf-8")
                with self.subTest(page=str(page)):
                    run(OPTIONS.compiler, "-std=c++20", "-fsyntax-only", "-Wall", "-Wno-unused-variable", "-Werror",
                        "-I", self.prefix / "include", folder / "snippet.cpp")
                    checked += 1
        self.assertGreaterEqual(checked, 2)


class Subproject(unittest.TestCase):
    """Configured inside another project; built with --long alone, as that takes as long as everything."""

    HOST = """cmake_minimum_required(VERSION 3.25)
project(host LANGUAGES CXX)
add_subdirectory("{root}" gelatin EXCLUDE_FROM_ALL)
file(WRITE "${{CMAKE_BINARY_DIR}}/main.cpp" [[{program}]])
add_executable(host "${{CMAKE_BINARY_DIR}}/main.cpp")
target_link_libraries(host PRIVATE gelatin::gelatin)
get_property(targets DIRECTORY "{root}" PROPERTY BUILDSYSTEM_TARGETS)
message(STATUS "targets: ${{targets}}")
get_property(options DIRECTORY PROPERTY COMPILE_OPTIONS)
message(STATUS "leaked: '${{options}}${{CMAKE_CXX_STANDARD}}${{CMAKE_CXX_VISIBILITY_PRESET}}${{CMAKE_BUILD_TYPE}}"
               "${{CMAKE_CXX_COMPILER_LAUNCHER}}${{CMAKE_RUNTIME_OUTPUT_DIRECTORY}}'")
get_property(subfolders DIRECTORY "{root}" PROPERTY SUBDIRECTORIES)
message(STATUS "subfolders: '${{subfolders}}'")
"""
    # That of the page, without its picture: it runs on a machine without OpenGL, too.
    PROGRAM = blocks_of("docs/embedding.md", "cpp")[0].replace("options.need_gl = true;", "")
    PROGRAM = re.sub(r'gelatin::save_picture.*\n\s*std::printf\("jelly.png: ', 'std::printf("', PROGRAM)

    # What only the window, the command line and the tests need.
    MISSING = [word for name in ("glfw3", "CGAL", "CLI11", "GTest", "X11")
               for word in ("-D", f"CMAKE_DISABLE_FIND_PACKAGE_{name}=ON")]

    def configure_host(self, name, *settings):
        folder = empty_folder(name)
        (folder / "CMakeLists.txt").write_text(self.HOST.format(root=ROOT, program=self.PROGRAM), encoding="utf-8")
        output = configure(folder, folder / "build", *self.MISSING, "-D", "CMAKE_EXPORT_COMPILE_COMMANDS=ON", *settings)
        return output, json.loads((folder / "build/compile_commands.json").read_text(encoding="utf-8"))

    def check(self, output, commands):
        targets = re.search(r"targets: (.*)", output)[1].split(";")
        self.assertIn("gelatin_library", targets)
        for target in targets:
            self.assertRegex(target, r"^gelatin_(core|mesh|model|cpu|gl|gpu|sim|render|picture|core_version|library)$")
        self.assertIn("leaked: ''", output)
        self.assertIn("subfolders: ''", output)
        own = [each["command"] for each in commands if f"-I{ROOT}/src" in each["command"]]
        self.assertGreater(len(own), 50)  # a folder's sources are compiled together
        for command in own:
            self.assertNotIn("-Werror", command)
            self.assertNotIn("ccache", command)
            self.assertIn("-O3", command)  # though the host has no build type
            self.assertIn("-fvisibility=hidden", command)
        host = next(each["command"] for each in commands if each["file"].endswith("/main.cpp"))
        self.assertNotIn("-Wold-style-cast", host)
        self.assertNotIn(f"{ROOT}/src", host)
        self.assertIn(f"{ROOT}/include", host)

    def test_brings_the_library_alone(self):
        self.check(*self.configure_host("subproject"))
        self.build_and_run(OPTIONS.build / "package/subproject/build")

    def build_and_run(self, build):
        if OPTIONS.long:
            run(OPTIONS.cmake, "--build", build, "--target", "host")
            self.assertIn("the ball after 0.58 s", run(build / "host", extra=BLIND))

    def test_is_static_where_the_host_wants_that(self):
        self.check(*self.configure_host("static_subproject", "-D", "BUILD_SHARED_LIBS=OFF"))
        build = OPTIONS.build / "package/static_subproject/build"
        self.build_and_run(build)
        files = [file.read_text(encoding="utf-8") for file in build.glob("*.ninja")]
        self.assertTrue(all("libgelatin.so" not in text for text in files))


def main():
    global OPTIONS
    parser = argparse.ArgumentParser()
    for name in ("cmake", "generator", "compiler", "build"):
        parser.add_argument(f"--{name}", required=True)
    parser.add_argument("--long", action="store_true", help="build the subprojects, too")
    OPTIONS, rest = parser.parse_known_args()
    OPTIONS.build = Path(OPTIONS.build).resolve()
    unittest.main(argv=[sys.argv[0], *rest], verbosity=2)


if __name__ == "__main__":
    main()
