#!/usr/bin/env python3
"""Runs the commands of the pages, in the order in which a reader comes to them, in an empty folder.

Each line of a block of shell commands is run as it is printed, or is in OTHERS, with what runs it instead. Blocks that
a page asks its reader to save are saved. Without --long, runs end after a few frames.
"""

import argparse
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
OPTIONS = None  # of the command line
SHORT_RUN = "--frames 6"
WINDOW_TIME = 20  # [s] that a window is watched for

# Commands that are not run here, and what runs them, or why nothing does.
OTHERS = {
    r"scripts/(demo|build|setup)\b.*": "every build of the project begins with these scripts",
    r"scripts/test\b.*": "runs this test",
    r"bench/peers/run\.py .*": "downloads other simulators; tests/checks/peers_test.py runs what needs none",
    r"python examples/.*": "tests/python/examples_test.py",
    r"python -c 'from pxr .*": "tests/checks/readers_test.py, which has USD's library",
    r"pip install '\.\[sweep\]'": "scripts/setup_python installs the same",
    r"cmake .*|build/jelly|build/embed/embed": "tests/package/package_test.py",
    r"python3 -m venv my_environment|my_environment/bin/.*": "compiles everything once more: scripts/build_wheel",
    r"build/release/bin/scene_in_code": "a test of its own, examples.scene_in_code",
}

CLUSTERS = ("cluster-slurm.md", "cluster-ssh.md")  # nobody has one here

# What a short look leaves out: it takes long, or needs a long recording.
LONG = r"gelatin (view|sweep)\b|--resume| --from "

# A closed surface, for the meshes that pages take for granted: a box of 0.2 m.
BOX = "".join(f"v {x} {y} {z}\n" for x in (0, 0.2) for y in (0, 0.2) for z in (0, 0.2)) + """
f 1 2 4 3
f 5 7 8 6
f 1 5 6 2
f 3 4 8 7
f 1 3 7 5
f 2 6 8 4
"""


def pages():
    return [ROOT / "README.md", *(page for page in sorted((ROOT / "docs").glob("*.md")) if page.name not in CLUSTERS)]


def commands_of(block):
    for line in block.splitlines():
        command = re.sub(r"(^|\s)#.*", "", line).strip()
        if command:
            yield command


def runs_elsewhere(command):
    return any(re.fullmatch(pattern, command) for pattern in OTHERS)


class Reader:
    """Somebody who does what a page says, in a folder that has the repository's files."""

    def __init__(self, folder):
        self.folder = folder
        for name in ("scenes", "docs", "examples"):
            (folder / name).symlink_to(ROOT / name)
        (folder / "build").mkdir()
        (folder / "build/release").symlink_to(OPTIONS.build)
        for name in ("bunny.obj", "cow.obj", "model.obj"):
            (folder / name).write_text(BOX, encoding="utf-8")
        self.environment = {**os.environ, "PATH": f"{OPTIONS.build}/bin:{os.environ['PATH']}", "GELATIN_PYTHON": sys.executable,
                            "PYTHONPATH": str(OPTIONS.build / "python")}

    def read(self, page):
        """Of each block of code: its language and its text. What is to be saved is, when the reader comes to it."""
        text = page.read_text(encoding="utf-8")
        for found in re.finditer(r"^```(\w*)[^\n]*\n(.*?)^```$", text, re.MULTILINE | re.DOTALL):
            before = text[:found.start()].rstrip().rpartition("\n\n")[2]
            name = re.search(r"\b[Ss]ave .*? as `([\w.]+)`", before)
            if name:
                (self.folder / name[1]).write_text(found[2], encoding="utf-8")
            yield found[1], found[2]

    def run(self, command):
        """Returns the exit code and what was printed. A window must stay open until it is killed, which counts as 0."""
        shows_window = re.match(r"\S*gelatin view\b", command)
        if shows_window:
            command = f"xvfb-run --auto-servernum --server-args='-screen 0 1280x1024x24' {command}"
        elif re.match(r"\S*gelatin run\b", command) and not OPTIONS.long and "--frames" not in command:
            command += f" {SHORT_RUN}"
        with subprocess.Popen(["bash", "-c", command], cwd=self.folder, env=self.environment, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True) as process:
            try:
                output = process.communicate(timeout=WINDOW_TIME if shows_window else None)[0]
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                return 0, process.communicate()[0]
        if shows_window:
            return 1, f"the window has closed by itself:\n{output}"
        return process.returncode, output


class Pages(unittest.TestCase):
    def test_every_command_is_run(self):
        """By this test, or by what OTHERS names."""
        ran, others = 0, set()
        for page in pages():
            with tempfile.TemporaryDirectory() as folder:
                reader = Reader(Path(folder))
                for language, text in reader.read(page):
                    if language != "sh":
                        continue
                    for command in commands_of(text):
                        if runs_elsewhere(command):
                            others.add(command)
                            continue
                        if not OPTIONS.long and re.search(LONG, command):
                            continue
                        with self.subTest(page=page.name, command=command):
                            code, output = reader.run(command)
                            self.assertEqual(code, 0, output)
                            self.check_files(reader.folder, command)
                        ran += 1
        self.assertGreater(ran, 15)
        for pattern in OTHERS:
            self.assertTrue(any(re.fullmatch(pattern, command) for command in others), f"{pattern}: no page has it")

    def check_files(self, folder, command):
        """Files that a command is asked to write are there."""
        words = shlex.split(command)
        for option, file in zip(words, words[1:]):
            if option in ("--video", "--image", "--record", "--stats", "-o", "--export"):
                self.assertTrue((folder / file).exists(), f"{file} is missing")

    def test_shown_output_is_what_is_printed(self):
        """Of blocks with commands behind '$ '."""
        shown = 0
        for page in pages():
            with tempfile.TemporaryDirectory() as folder:
                reader = Reader(Path(folder))
                for _, text in reader.read(page):
                    if not text.startswith("$ "):
                        continue
                    command, _, expected = text[2:].partition("\n")
                    with self.subTest(page=page.name, command=command):
                        self.assertEqual(reader.run(command)[1].strip(), expected.strip())
                    shown += 1
        self.assertGreater(shown, 0)


class CommandsOf(unittest.TestCase):
    def test_leaves_out_comments(self):
        self.assertEqual(list(commands_of("# so\ngelatin info a.toml  # counts\n\nls --color='#1'\n")),
                         ["gelatin info a.toml", "ls --color='#1'"])


def main():
    global OPTIONS
    parser = argparse.ArgumentParser()
    parser.add_argument("--build", required=True, type=lambda text: Path(text).resolve())
    parser.add_argument("--long", action="store_true")
    OPTIONS, rest = parser.parse_known_args()
    if shutil.which("xvfb-run") is None:
        sys.exit("xvfb-run is missing")
    unittest.main(argv=[sys.argv[0], *rest], verbosity=2)


if __name__ == "__main__":
    main()
