"""Other programs read what Gelatin exports, with the numbers of the simulation: USD's library, trimesh, meshio and VTK.
Gelatin reads what meshio writes of cells that are no tets.
Gelatin reads the surfaces that trimesh and meshio write, and they those that it writes.
Needs PyPI, so it is one of the long tests. Assimp reads glTF in tests/sim/animation_file_test.cpp.

The numbers are those of a checkpoint, for nodes, and of a point cache, for what is drawn; tests of C++ compare both with
the simulation. Files of floats must have the same, bit for bit, and so must text, which has enough digits.
"""

import json
import math
import os
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
VENV = ROOT / "build/readers-venv"
REQUIREMENTS = Path(__file__).with_name("readers_requirements.txt")
PROGRAM = os.environ.get("GELATIN_PROGRAM", str(ROOT / "build/release/bin/gelatin"))
LAST = 12  # frame

SCENE = f"""
[simulation]
frames = {LAST}
[[material]]
name = "jelly"
youngs_modulus = 2e4
[[object]]
name = "1st bar"  # no name for USD
shape = {{ file = "bar.obj" }}
mesher = {{ nodes = 200 }}
material = "jelly"
position = [0, 1, 0]
[[object]]
name = "box"
shape = {{ box = [0.5, 0.5, 0.5], segments = [3, 3, 3] }}
material = "jelly"
position = [0, 2, 0]
[[collider]]
shape = {{ box = [4, 0.5, 4] }}
position = [0, -0.25, 0]
"""


JOINTS = """
[simulation]
frames = 1
[[material]]
name = "jelly"
[[object]]
name = "box"
shape = { box = [0.5, 0.5, 0.5] }
position = [0, 2, 0]
[[rigid]]
name = "arm"
shape = { box = [0.6, 0.1, 0.1] }
material = "jelly"
position = [3, 1, 0]
[[rigid]]
name = "hand"
shape = { box = [0.2, 0.1, 0.1] }
material = "jelly"
position = [3.5, 1, 0]
[[attachment]]
object = "arm"
line = [[2.7, 1, 0], [2.7, 1, 1]]
limits = [-30, 45]
spring = { stiffness = 5, damping = 0.1, rest = 10 }
[[attachment]]
object = "hand"
to = "arm"
rail = [[3.5, 1, 0], [4.5, 1, 0]]
motor = { speed = 0.5, force = 20 }
break_force = 500
[[attachment]]
object = "hand"
to = "arm"
universal = { point = [3.4, 1, 0], own = [0, 1, 0], of_other = [0, 0, 1] }
[[attachment]]
object = "hand"
distance = [[3.5, 1, 0], [3.5, 2, 0]]
limits = [0, 1.5]
[[attachment]]
object = "box"
to = "arm"
distance = [[0, 2, 0], [3, 1, 0]]
"""


def install():
    """A virtual environment with all readers, unless there is one already."""
    done = VENV / "requirements.txt"
    if done.exists() and done.read_bytes() == REQUIREMENTS.read_bytes():
        return
    subprocess.run([sys.executable, "-m", "venv", "--clear", VENV], check=True)
    subprocess.run(
        [VENV / "bin/pip", "install", "--quiet", "--disable-pip-version-check", "--requirement", REQUIREMENTS], check=True
    )
    done.write_bytes(REQUIREMENTS.read_bytes())


def png(size):
    """A checkerboard."""

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(b"\0" + bytes(255 * ((x // 8 + y // 8) % 2) for x in range(size) for _ in "rgb") for y in range(size))
    head = struct.pack(">IIBBBBB", size, size, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


def textured_bar():
    """OBJ text: a closed box of 2 x 2 x 6 quads, each side with the whole image."""
    size = (0.4, 0.4, 1.2)
    cells = (2, 2, 6)
    lines, numbers = ["mtllib bar.mtl", "usemtl paint"], {}

    def corner(at, uv):
        if at not in numbers:
            numbers[at] = len(numbers) + 1
            lines.append("v " + " ".join(str(s * (k / n - 0.5)) for s, k, n in zip(size, at, cells)))
        lines.append(f"vt {uv[0]} {uv[1]}")
        return numbers[at]

    faces, count = [], 0
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for side in (0, 1):
            for i in range(cells[u]):
                for j in range(cells[v]):
                    quad = []
                    for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
                        at = [0, 0, 0]
                        at[axis], at[u], at[v] = side * cells[axis], i + a, j + b
                        count += 1
                        quad.append((corner(tuple(at), (at[u] / cells[u], at[v] / cells[v])), count))
                    faces.append(quad if side else quad[::-1])
    lines += ["f " + " ".join(f"{p}/{t}" for p, t in quad) for quad in faces]
    return "\n".join(lines) + "\n"


def mixed_cells(size):
    """A box of cells in columns of hexahedra, of pairs of wedges, and of six pyramids about a node, with random nodes inside."""
    import meshio

    random = np.random.default_rng(1)
    points = np.array(list(np.ndindex(size + 1, size + 1, size + 1)), float)
    inside = np.all((points > 0) & (points < size), axis=1)
    points[inside] += random.uniform(-0.15, 0.15, (inside.sum(), 3))
    number = np.arange(len(points)).reshape(size + 1, size + 1, size + 1)
    cells, centres = {"hexahedron": [], "wedge": [], "pyramid": []}, []
    for x, y, z in np.ndindex(size, size, size):
        corners = [number[x + a, y + b, z + c] for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
        if (kind := (x + 2 * y) % 3) == 0:
            cells["hexahedron"].append(corners)
        elif kind == 1:
            cells["wedge"] += [[corners[k] for k in half] for half in ((0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7))]
        else:
            tip = len(points) + len(centres)
            centres.append(points[corners].mean(axis=0))
            for side in ((0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)):
                cells["pyramid"].append([corners[k] for k in side] + [tip])
    order = random.permutation(len(points) + len(centres))  # of the nodes in the file
    points = np.vstack([points, centres])[np.argsort(order)]
    return meshio.Mesh(points, [(kind, order[np.array(of_kind)]) for kind, of_kind in cells.items()])


class Readers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.kept = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.kept.cleanup)
        cls.folder = Path(cls.kept.name)
        (cls.folder / "bar.obj").write_text(textured_bar())
        (cls.folder / "bar.mtl").write_text("newmtl paint\nKd 1 1 1\nmap_Kd bar.png\n")
        (cls.folder / "bar.png").write_bytes(png(64))
        (cls.folder / "scene.toml").write_text(SCENE)
        cls.gelatin("run", "scene.toml", "--backend", "cpu", "--record", "run.gel", "--checkpoint", "end")
        for file in ("bar.obj", "bar.mtl", "bar.png"):
            (cls.folder / file).unlink()  # the recording has them
        for out in ("run.usda", "run.glb", "run.pc2"):
            cls.gelatin("export", "run.gel", out)
        cls.gelatin("export", "run.gel", "frames", "--format", "vtu")

        cache = (cls.folder / "run.pc2").read_bytes()
        points, samples = struct.unpack_from("<i", cache, 16)[0], struct.unpack_from("<i", cache, 28)[0]
        assert samples == LAST + 1
        cls.points = np.frombuffer(cache, "<f4", offset=32).reshape(samples, points, 3)
        end = (cls.folder / "end").read_bytes()
        cls.nodes = np.frombuffer(end, "<f4", 4 * struct.unpack_from("<Q", end, 24)[0], 80).reshape(-1, 4)[:, :3]

    @classmethod
    def gelatin(cls, *arguments):
        result = subprocess.run(
            [PROGRAM, *arguments, "--quiet"], cwd=cls.folder, capture_output=True, text=True, check=False
        )
        assert result.returncode == 0, result.stderr

    def points_of(self, vertices):
        """Which points of the first frame these are, exactly."""
        numbers = {point.tobytes(): k for k, point in enumerate(self.points[0])}
        return [numbers[vertex.tobytes()] for vertex in np.asarray(vertices, np.float32)]

    def assert_same(self, actual, expected):
        np.testing.assert_array_equal(np.asarray(actual), expected)

    def test_usd_has_points_and_nodes_of_all_frames_and_is_valid(self):
        from pxr import Usd, UsdGeom, UsdShade, UsdValidation

        stage = Usd.Stage.Open(str(self.folder / "run.usda"))
        validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
        self.assertGreater(len(validators), 10)
        problems = UsdValidation.ValidationContext(validators).Validate(stage)
        self.assertEqual([problem.GetMessage() for problem in problems], [])

        meshes = [prim for prim in stage.Traverse() if prim.IsA(UsdGeom.Mesh)]
        self.assertEqual([mesh.GetDisplayName() for mesh in meshes], ["1st bar", "box", "collider 1"])
        for mesh in meshes:
            points = UsdGeom.Mesh(mesh).GetPointsAttr()
            self.assertEqual(points.GetTimeSamples(), list(range(LAST + 1)))
            numbers = self.points_of(points.Get(0))
            for frame in range(LAST + 1):
                self.assert_same(points.Get(frame), self.points[frame][numbers])
        tets = [prim for prim in stage.Traverse() if prim.IsA(UsdGeom.TetMesh)]
        nodes = np.concatenate([UsdGeom.TetMesh(prim).GetPointsAttr().Get(LAST) for prim in tets])
        self.assert_same(nodes, self.nodes[: len(nodes)])
        for mesh in meshes:
            self.assertTrue(UsdShade.MaterialBindingAPI(mesh).ComputeBoundMaterial()[0])
        box = UsdShade.MaterialBindingAPI(meshes[1]).ComputeBoundMaterial()[0].ComputeSurfaceSource()[0]
        self.assertEqual([box.GetInput("diffuseColor").Get()], list(UsdGeom.Mesh(meshes[1]).GetDisplayColorAttr().Get()))
        material = UsdShade.MaterialBindingAPI(meshes[0]).ComputeBoundMaterial()[0]
        image = UsdShade.Shader(material.GetPrim().GetChild("image")).GetInput("file").Get()
        self.assertEqual(Path(image.resolvedPath).read_bytes(), png(64))

    # The line that docs/command-line.md gives.
    def test_usd_is_converted_to_its_binary_form(self):
        from pxr import Sdf, Usd

        text, binary = self.folder / "run.usda", self.folder / "run.usdc"
        Sdf.Layer.FindOrOpen(str(text)).Export(str(binary))
        self.assertTrue(binary.read_bytes().startswith(b"PXR-USDC"))
        of_text, of_binary = Usd.Stage.Open(str(text)), Usd.Stage.Open(str(binary))
        for prim in of_text.Traverse():
            for attribute in prim.GetAttributes():
                other = of_binary.GetAttributeAtPath(attribute.GetPath())
                self.assertEqual(attribute.GetTimeSamples(), other.GetTimeSamples())
                for time in attribute.GetTimeSamples() or [0]:
                    self.assertEqual(attribute.Get(time), other.Get(time))

    def test_gltf_has_points_of_any_frame_and_the_texture(self):
        import trimesh

        numbers = {}
        for frame in (0, 5, LAST):
            self.gelatin("export", "run.gel", "one.glb", "--from", str(frame), "--to", str(frame))
            meshes = trimesh.load(self.folder / "one.glb", process=False).geometry
            self.assertEqual(sorted(meshes), ["1st bar", "box", "collider 1"])
            for name, mesh in meshes.items():
                if frame == 0:
                    numbers[name] = self.points_of(mesh.vertices)
                self.assert_same(mesh.vertices.astype(np.float32), self.points[frame][numbers[name]])
            texture = meshes["1st bar"].visual.material.baseColorTexture
            self.assertEqual(texture.size, (64, 64))
            self.assertEqual([texture.getpixel((x, 0)) for x in (0, 8)], [(0, 0, 0), (255, 255, 255)])
        whole = trimesh.load(self.folder / "run.glb", process=False).geometry
        for name, mesh in whole.items():
            self.assert_same(mesh.vertices.astype(np.float32), self.points[0][numbers[name]])

    def test_meshio_reads_nodes_and_values(self):
        import meshio

        mesh = meshio.read(self.folder / "frames" / f"frame_{LAST:06}.vtu")
        self.assert_same(mesh.points, self.nodes)
        first = meshio.read(self.folder / "frames/frame_000000.vtu")
        np.testing.assert_allclose(mesh.point_data["displacement"], mesh.points - first.points, atol=1e-6)
        self.assertEqual([block.type for block in mesh.cells], ["tetra", "triangle"])
        self.assertEqual(sorted(mesh.cell_data), ["object", "strain", "stress"])

    def test_cells_of_meshio_become_tets(self):
        import meshio

        size = 5
        mesh = mixed_cells(size)
        counts = {block.type: len(block.data) for block in mesh.cells}
        regions = [np.full(len(block.data), k + 1) for k, block in enumerate(mesh.cells)]
        for kind, binary, name in [
            *((kind, binary, "material") for kind in ("vtu", "vtk42", "vtk51") for binary in (True, False)),
            *(("gmsh22", binary, "gmsh:physical") for binary in (True, False)),
            ("medit", None, "medit:ref"),
        ]:
            with self.subTest(kind=kind, binary=binary):
                ending = {"vtk42": "vtk", "vtk51": "vtk", "gmsh22": "msh", "medit": "mesh"}.get(kind, kind)
                file = self.folder / f"mixed.{ending}"
                data = {name: regions} | ({"gmsh:geometrical": regions} if kind == "gmsh22" else {})
                options = {} if binary is None else {"binary": binary}
                meshio.write(file, meshio.Mesh(mesh.points, mesh.cells, cell_data=data), file_format=kind, **options)
                subprocess.run([PROGRAM, "mesh", file, "-o", "tets.vtu"], cwd=self.folder, capture_output=True, check=True)
                tets = meshio.read(self.folder / "tets.vtu")
                corners = tets.points[tets.cells[0].data]
                volumes = np.linalg.det(corners[:, 1:] - corners[:, :1]) / 6
                self.assertAlmostEqual(volumes.sum(), size**3, places=9)
                self.assertGreater(volumes.min(), 0)
                of_region = np.bincount(tets.cell_data["attribute"][0])[1:]
                self.assertEqual(list(of_region), [6 * counts["hexahedron"], 3 * counts["wedge"], 2 * counts["pyramid"]])
                sides = np.sort(tets.cells[0].data[:, [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]]], axis=-1)
                _, uses = np.unique(sides.reshape(-1, 3), axis=0, return_counts=True)
                self.assertEqual(np.sum(uses == 1), 12 * size**2)  # two on each square of the box
                self.assertEqual(uses.max(), 2)

    def test_vtk_reads_the_series(self):
        from vtk import vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader
        from vtk.util.numpy_support import vtk_to_numpy

        def read(reader, name):
            reader.SetFileName(str(self.folder / "frames" / name))
            reader.Update()
            self.assertEqual(reader.GetErrorCode(), 0)
            return reader.GetOutput()

        for frame in range(LAST + 1):
            surface = read(vtkXMLPolyDataReader(), f"frame_{frame:06}.vtp")
            self.assert_same(vtk_to_numpy(surface.GetPoints().GetData()), self.points[frame])
        tets = read(vtkXMLUnstructuredGridReader(), f"frame_{LAST:06}.vtu")
        nodes = vtk_to_numpy(tets.GetPoints().GetData())
        self.assert_same(nodes, self.nodes)
        values = tets.GetPointData()
        names = [values.GetArrayName(k) for k in range(values.GetNumberOfArrays())]
        self.assertEqual(names, ["velocity", "displacement", "contact_force", "contact_friction"])


class Joints(unittest.TestCase):
    def test_usd_has_joints_of_rigid_bodies(self):
        from pxr import Gf, Usd, UsdPhysics, UsdValidation

        with tempfile.TemporaryDirectory() as folder:
            scene, film = Path(folder) / "joints.toml", Path(folder) / "joints.usda"
            scene.write_text(JOINTS)
            subprocess.run([PROGRAM, "run", scene, "--quiet", "--animation", film], check=True)
            stage = Usd.Stage.Open(str(film))
        validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
        problems = UsdValidation.ValidationContext(validators).Validate(stage)
        self.assertEqual([problem.GetMessage() for problem in problems], [])
        arm, hand = stage.GetPrimAtPath("/simulation/arm"), stage.GetPrimAtPath("/simulation/hand")
        self.assertTrue(UsdPhysics.RigidBodyAPI(arm).GetKinematicEnabledAttr().Get())
        self.assertAlmostEqual(UsdPhysics.MassAPI(arm).GetMassAttr().Get(), 0.006 * 1000, 4)
        joints = [UsdPhysics.Joint(prim) for prim in stage.GetPrimAtPath("/simulation/joints").GetChildren()]
        self.assertEqual(len(joints), 4)  # none of what is deformable
        hinge, slider, universal, rope = joints
        self.assertEqual(hinge.GetBody0Rel().GetTargets(), [])
        self.assertEqual(hinge.GetBody1Rel().GetTargets(), [arm.GetPath()])
        revolute = UsdPhysics.RevoluteJoint(hinge.GetPrim())
        self.assertEqual((revolute.GetLowerLimitAttr().Get(), revolute.GetUpperLimitAttr().Get()), (-30, 45))
        spring = UsdPhysics.DriveAPI(hinge.GetPrim(), "angular")
        self.assertAlmostEqual(spring.GetStiffnessAttr().Get(), 5 * math.pi / 180, 6)  # by degree
        self.assertEqual(spring.GetTargetPositionAttr().Get(), 10)
        self.assertEqual(slider.GetBody0Rel().GetTargets(), [arm.GetPath()])
        self.assertEqual(slider.GetBreakForceAttr().Get(), 500)
        axis = Gf.Rotation(slider.GetLocalRot1Attr().Get()).TransformDir(Gf.Vec3d(0, 0, 1))
        self.assertTrue(Gf.IsClose(axis, Gf.Vec3d(1, 0, 0), 1e-6))
        motor = UsdPhysics.DriveAPI(slider.GetPrim(), "linear")
        self.assertEqual((motor.GetTargetVelocityAttr().Get(), motor.GetMaxForceAttr().Get()), (0.5, 20))
        self.assertGreater(UsdPhysics.LimitAPI(universal.GetPrim(), "rotY").GetLowAttr().Get(), 0)
        self.assertEqual(UsdPhysics.DistanceJoint(rope.GetPrim()).GetMaxDistanceAttr().Get(), 1.5)


class Surfaces(unittest.TestCase):
    """Round trips of a body with a hole, of triangles. Its numbers have few digits, so that all formats keep them."""

    def setUp(self):
        kept = tempfile.TemporaryDirectory()
        self.addCleanup(kept.cleanup)
        self.folder = Path(kept.name)
        n, m = 24, 12
        u, v = np.meshgrid(np.arange(n), np.arange(m), indexing="ij")
        a, b = 2 * np.pi * u / n, 2 * np.pi * v / m
        ring = 2 + 0.75 * np.cos(b)
        points = np.stack([ring * np.cos(a), ring * np.sin(a), 0.75 * np.sin(b) + 3], axis=-1).reshape(-1, 3)
        self.points = np.round(256 * points) / 256 + 0.0  # -0 is 0

        def number(i, j):
            return (i % n) * m + j % m

        corners = number(u, v), number(u + 1, v), number(u + 1, v + 1), number(u, v + 1)
        self.faces = np.concatenate([np.stack([corners[k] for k in t], axis=-1).reshape(-1, 3) for t in ((0, 1, 2), (0, 2, 3))])
        p, q, r = (self.points[self.faces[:, k]] for k in range(3))
        self.volume = np.einsum("ij,ij->", p, np.cross(q, r)) / 6

    def gelatin(self, *arguments):
        result = subprocess.run([PROGRAM, *arguments], cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    def assert_read(self, name):
        surface = json.loads(self.gelatin("info", name, "--json"))
        self.assertEqual(surface["notes"], [], name)
        self.assertEqual((surface["vertices"], surface["faces"]), (len(self.points), len(self.faces)), name)
        self.assertTrue(surface["closed"], name)
        self.assertAlmostEqual(surface["volume"], self.volume, delta=1e-6 * self.volume, msg=name)
        self.gelatin("mesh", name, "-o", "back.ply")
        back = trimesh.load(self.folder / "back.ply", process=False)
        self.assert_same_triangles(back.vertices, back.faces)

    def assert_same_triangles(self, vertices, faces):
        """In any order, but from the same corner and of the same orientation."""

        def rows(triangles):
            flat = triangles.reshape(-1, 9)
            return flat[np.lexsort(flat.T)]

        np.testing.assert_array_equal(rows(np.asarray(vertices)[faces]), rows(self.points[self.faces]))

    def test_what_trimesh_writes_is_read(self):
        mesh = trimesh.Trimesh(self.points, self.faces, process=False)
        for name, options in (
            ("a.obj", {"digits": 12}),
            ("a.stl", {}),
            ("b.stl", {"file_type": "stl_ascii"}),
            ("a.ply", {}),
            ("b.ply", {"encoding": "ascii"}),
            ("a.off", {"digits": 12}),
            ("a.glb", {}),
        ):
            mesh.export(self.folder / name, **options)
            self.assert_read(name)
        for name, content in trimesh.exchange.gltf.export_gltf(trimesh.Scene(mesh)).items():
            (self.folder / name).write_bytes(content)
        self.assert_read("model.gltf")

    def test_what_meshio_writes_is_read(self):
        mesh = meshio.Mesh(self.points, [("triangle", self.faces)])
        for name, options in (
            ("a.obj", {}),
            ("a.stl", {"binary": True}),
            ("b.stl", {"binary": False}),
            ("a.ply", {"binary": True}),
            ("b.ply", {"binary": False}),
            ("a.off", {}),
        ):
            meshio.write(self.folder / name, mesh, **options)
            self.assert_read(name)

    def test_trimesh_and_meshio_read_what_is_written(self):
        trimesh.Trimesh(self.points, self.faces, process=False).export(self.folder / "from.ply")
        for name in ("a.obj", "a.stl", "a.ply", "a.off"):
            self.gelatin("mesh", "from.ply", "-o", name)
            by_trimesh = trimesh.load(self.folder / name, process=False)
            by_meshio = meshio.read(self.folder / name)
            self.assert_same_triangles(by_trimesh.vertices, by_trimesh.faces)
            self.assert_same_triangles(by_meshio.points, by_meshio.cells_dict["triangle"])


if __name__ == "__main__":
    install()
    python = VENV / "bin/python"
    if Path(sys.prefix).resolve() != VENV.resolve():
        sys.exit(subprocess.run([python, *sys.argv], check=False).returncode)
    import meshio
    import numpy as np
    import trimesh

    unittest.main()
