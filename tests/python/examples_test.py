"""The examples, which end in checks of their own, and the snippets of docs/python.md."""

import functools
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import gelatin

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


def test_squeezes_and_their_loader(tmp_path, monkeypatch):
    """In this process, which is quicker for so few than starting workers."""
    monkeypatch.syspath_prepend("examples/squeezes")
    import make_squeezes
    from squeezes import Squeezes

    monkeypatch.setattr(gelatin, "sweep", functools.partial(gelatin.sweep, workers=0, progress=False))
    make_squeezes.main(6, tmp_path, "scenes/meshes/ring.obj")
    squeezes = Squeezes(tmp_path)
    assert len(squeezes) == 6
    assert (len(Squeezes(tmp_path, train=True)), len(Squeezes(tmp_path, train=False))) == (4, 2)  # seeds 0 and 5
    for squeeze in squeezes:
        frames, nodes, _ = squeeze["positions"].shape
        assert squeeze["contact_forces"].shape == (frames, nodes, 3) and frames == 6
        assert squeeze["picture"].shape == (3, 128, 128) and 0 <= squeeze["picture"].min() <= squeeze["picture"].max() <= 1
    assert max(squeeze["force"] for squeeze in squeezes) > 1
    assert not np.array_equal(squeezes[0]["positions"], squeezes[1]["positions"])


def test_snippets_of_sweeps(tmp_path, monkeypatch):
    """Shorter, and in this process."""
    sweep = gelatin.sweep

    def short(subject, *arguments, **options):
        limits = {"seeds": min(2, options["seeds"])} if "seeds" in options else {}
        return sweep(subject, *arguments, **{**options, **limits}, workers=0, progress=False, frames=2)

    monkeypatch.setattr(gelatin, "sweep", short)
    (tmp_path / "scenes").symlink_to(Path("scenes").resolve())
    snippets = re.findall(r"```python\n(.*?)```", Path("docs/sweeps.md").read_text(encoding="utf-8"), re.DOTALL)
    snippets = [snippet for snippet in snippets if "--8<--" not in snippet]
    assert len(snippets) == 3
    monkeypatch.chdir(tmp_path)
    names = {}
    for snippet in snippets:
        exec(compile(snippet, "docs/sweeps.md", "exec"), names)
    assert len(names["rows"]) == 6 and {row["error"] for row in names["rows"]} == {None}
    import pyarrow.parquet

    heights = pyarrow.parquet.read_table("heights/table.parquet")
    assert heights["height"].null_count == 0
    drops = pyarrow.parquet.read_table("drops/table.parquet").to_pylist()
    assert all((tmp_path / "drops" / row["positions"]).exists() for row in drops)


def test_snippets_of_the_page(tmp_path, monkeypatch, needs_gl):
    """They make one program, from the first to the last."""
    page = Path("docs/python.md").read_text(encoding="utf-8")
    snippets = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
    assert len(snippets) >= 8
    (tmp_path / "scenes").symlink_to(Path("scenes").resolve())
    subprocess.run([sys.executable, "scripts/make_animated_meshes", tmp_path], check=True)
    monkeypatch.chdir(tmp_path)
    names = {}
    for snippet in snippets:
        line = page[: page.index(snippet)].count("\n")
        exec(compile("\n" * line + snippet, "docs/python.md", "exec"), names)
    assert (tmp_path / "ball.png").stat().st_size > 1000


COOKBOOK = Path("docs/cookbook.md").read_text(encoding="utf-8")
RECIPES = [code for code in re.findall(r"```python\n(.*?)```", COOKBOOK, re.DOTALL) if "--8<--" not in code]


@pytest.mark.parametrize("recipe", range(len(RECIPES)))
def test_recipes_of_the_cookbook(recipe, tmp_path, monkeypatch, needs_gl):
    """Each is a program of its own."""
    line = COOKBOOK[: COOKBOOK.index(RECIPES[recipe])].count("\n")
    (tmp_path / "scenes").symlink_to(Path("scenes").resolve())
    subprocess.run([sys.executable, "scripts/make_animated_meshes", tmp_path], check=True)
    monkeypatch.chdir(tmp_path)
    names = {}
    exec(compile("\n" * line + RECIPES[recipe], "docs/cookbook.md", "exec"), names)
    if "ball" in names and "lift" in names:
        assert names["ball"].name == "ball" and names["simulator"]["ball"].center[1] > 0.5  # it is held
