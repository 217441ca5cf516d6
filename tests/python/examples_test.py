"""The examples, which end in checks of their own, and the snippets of docs/python.md."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

ARGUMENTS = {"drop_my_mesh": ["{folder}"], "random_squeezes": ["128"], "many_worlds": ["16"]}
EXAMPLES = sorted(Path("examples/python").glob("*.py"))


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda example: example.stem)
def test_example(example, tmp_path):
    arguments = [text.format(folder=tmp_path) for text in ARGUMENTS.get(example.stem, [])]
    result = subprocess.run([sys.executable, example, *arguments], capture_output=True, text=True)
    assert result.returncode == 0, result.stderr
    assert result.stdout
    if example.stem == "drop_my_mesh":
        assert (tmp_path / "ring.obj").read_text().count("\nf ") > 1000


def test_snippets_of_the_page(tmp_path, monkeypatch, needs_gl):
    """They make one program, from the first to the last."""
    page = Path("docs/python.md").read_text(encoding="utf-8")
    snippets = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
    assert len(snippets) >= 8
    (tmp_path / "scenes").symlink_to(Path("scenes").resolve())
    monkeypatch.chdir(tmp_path)
    names = {}
    for snippet in snippets:
        line = page[: page.index(snippet)].count("\n")
        exec(compile("\n" * line + snippet, "docs/python.md", "exec"), names)
    assert (tmp_path / "ball.png").stat().st_size > 1000
