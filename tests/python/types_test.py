"""The package's types, those of the compiled module's stub included, agree with each other and with a program that uses them."""

import shutil
import subprocess
import sys
from pathlib import Path

import gelatin

PROGRAM = """
import gelatin

scene = gelatin.load("scenes/bounce.toml", {"simulation.frames": 10})
ball: gelatin.Object = scene.add("ball", gelatin.Sphere(0.5), material=scene.materials[0], position=(0, 1, 0))
sim = gelatin.Simulator(scene, backend="cpu")
speed: float = float(sim["ball"].velocities[:, 1].max())
reveal_type(sim.positions)
sim["ball"].set_velocity((0, 1, 0))
frames = gelatin.AnimationFrames([[(0, 0, 0)]], rate=30)
gelatin.Collider(gelatin.Box(), animation=gelatin.Animation(frames, loop=True))
gelatin.Handle(skeleton=gelatin.Skeleton("arm.glb", radius=0.1))
gelatin.Handle(gelatin.SphereRegion((0, 0, 0), 1), [gelatin.Keyframe()])
sim.set_collider_vertices("wave", sim["ball"].positions)
gelatin.Simulator(scene, backend="cuda")
gelatin.Sphere(radius="large")
sim["ball"].hand
gelatin.Animation(source="curl")
"""


def test_types(tmp_path):
    # A copy without links, which mypy would follow out of the package.
    package = tmp_path / "gelatin"
    package.mkdir()
    for file in Path(gelatin.__file__).parent.iterdir():
        if file.suffix in (".py", ".pyi", ".typed"):
            shutil.copy(file, package / file.name)
    assert (package / "_gelatin.pyi").exists()
    (tmp_path / "program.py").write_text(PROGRAM)
    command = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", tmp_path / "cache", "gelatin", "program.py"]
    result = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    lines = [line for line in result.stdout.splitlines() if ": error:" in line]
    assert [line.split(":")[0] for line in lines] == ["program.py"] * 4, result.stdout + result.stderr
    for line, problem in zip(lines, ('"backend"', '"radius"', '"hand"', '"source"')):
        assert problem in line
    assert "float" in result.stdout and "ndarray" in result.stdout
