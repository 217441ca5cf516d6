"""Scenes with joints as all peers get them: what the scene file says, and the tets that Gelatin exports."""

import tomllib
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

import measures
from bodies import lumped_masses_of, read_array, volume

WORLD = ""  # the name of what a joint without `to` joins to


@dataclass
class Part:
    """A rigid body."""

    name: str
    place: np.ndarray  # of the shape's origin at the start, in which its centre of mass is [m]
    turn: np.ndarray  # rotation matrix at the start
    mass: float
    nodes: slice  # of its surface, in the file that Gelatin exports
    box: np.ndarray | None = None  # its size [m]
    vertices: np.ndarray | None = None  # of the shape, where it is no box
    triangles: np.ndarray | None = None


@dataclass
class Soft:
    """A deformable body."""

    name: str
    nodes: slice
    points: np.ndarray  # at the start, at rest [n, 3]
    tets: np.ndarray  # of its own nodes
    material: dict
    carrier: str = WORLD  # the part to which it is glued
    glued: np.ndarray = field(default_factory=lambda: np.empty(0, int))

    def mass(self):
        return self.material["density"] * volume(self.points, self.tets)

    def masses(self):
        return lumped_masses_of(self.points, self.tets, self.material["density"])


@dataclass
class Joint:
    name: str
    part: str
    to: str
    is_hinge: bool  # else a slider
    ends: np.ndarray  # of its line [2, 3] [m]
    limits: tuple | None  # [rad, m]
    spring: dict | None
    motor: dict | None  # of a hinge in rad/s

    def axis(self):
        return (self.ends[1] - self.ends[0]) / np.linalg.norm(self.ends[1] - self.ends[0])

    def command(self, time):
        """Speed, position and greatest force of the motor, as the keyframes have changed them; None: not given."""
        now = {key: self.motor.get(key) for key in ("speed", "position", "force")}
        for change in self.motor.get("keyframes", []):
            if change["time"] <= time + 1e-9:
                now |= {key: value for key, value in change.items() if key != "time"}
        return now["speed"], now["position"], now["force"]


@dataclass
class JointedScene:
    file: Path
    frames: int
    parts: list[Part]
    softs: list[Soft]
    joints: list[Joint]
    colliders: list[dict]
    step: float = 1 / 60  # between two frames [s]
    gravity: tuple = (0, -9.81, 0)

    def part(self, name):
        return next(part for part in self.parts if part.name == name)

    def friction(self, collider):
        """As Gelatin's: a collider's own, otherwise that of the soft body."""
        return collider.get("friction", self.softs[0].material["friction"])


def rotation(degrees):
    """About x, then y, then z."""
    matrix = np.eye(3)
    for axis, angle in enumerate(np.radians(degrees)):
        i, j = (axis + 1) % 3, (axis + 2) % 3
        turn = np.eye(3)
        turn[[i, j], [i, j]], turn[i, j], turn[j, i] = np.cos(angle), -np.sin(angle), np.sin(angle)
        matrix = turn @ matrix
    return matrix


def read_obj(file):
    rows = [line.split() for line in file.read_text(encoding="utf-8").splitlines()]
    vertices = np.array([row[1:4] for row in rows if row and row[0] == "v"], float)
    faces = [[int(corner.split("/")[0]) - 1 for corner in row[1:]] for row in rows if row and row[0] == "f"]
    return vertices, np.array([[face[0], face[k], face[k + 1]] for face in faces for k in range(1, len(face) - 1)])


def distances(points, a, b, c):
    """Of each point from the nearest of the triangles abc."""
    best = np.full(len(points), np.inf)
    for p, q, r in zip(a, b, c):
        normal = np.cross(q - p, r - p)
        normal /= np.linalg.norm(normal)
        inside = np.ones(len(points), bool)
        for start, end in ((p, q), (q, r), (r, p)):
            inside &= (points - start) @ np.cross(normal, end - start) >= 0
            along = np.clip((points - start) @ (end - start) / ((end - start) @ (end - start)), 0, 1)
            best = np.minimum(best, np.linalg.norm(points - start - along[:, None] * (end - start), axis=1))
        best = np.where(inside, np.minimum(best, np.abs((points - p) @ normal)), best)
    return best


def glued_nodes(soft, part):
    """As Gelatin's: nodes of the surface within half of its median edge from the part."""
    faces = measures.faces_of(soft.tets)
    edges = measures.edges_of(faces)
    reach = np.median(np.linalg.norm(soft.points[edges[:, 0]] - soft.points[edges[:, 1]], axis=1)) / 2
    nodes = np.unique(faces)
    corners = (part.vertices @ part.turn.T + part.place)[part.triangles]
    return nodes[distances(soft.points[nodes], *corners.swapaxes(0, 1)) <= reach]


def read_joint(description):
    is_hinge = "line" in description
    unit = np.pi / 180 if is_hinge else 1
    limits = description.get("limits")
    motor = description.get("motor")
    if motor and is_hinge:
        scale = lambda row: row | {key: row[key] * unit for key in ("speed", "position") if key in row}  # noqa: E731
        motor = scale(motor) | {"keyframes": [scale(change) for change in motor.get("keyframes", [])]}
    return Joint(
        name=description["name"],
        part=description["object"],
        to=description.get("to", WORLD),
        is_hinge=is_hinge,
        ends=np.array(description["line" if is_hinge else "rail"], float),
        limits=limits and tuple(unit * value for value in limits),
        spring=description.get("spring"),
        motor=motor,
    )


def read_part(description, nodes, density, folder):
    part = Part(
        name=description["name"],
        place=np.array(description["position"], float),
        turn=rotation(description.get("rotation", [0, 0, 0])),
        mass=0,
        nodes=nodes,
    )
    if "box" in description["shape"]:
        part.box = np.array(description["shape"]["box"], float)
        part.mass = density * part.box.prod()
        return part
    part.vertices, part.triangles = read_obj(folder / description["shape"]["file"])
    a, b, c = (part.vertices[part.triangles[:, k]] for k in range(3))
    part.mass = density * np.einsum("ij,ij->", a, np.cross(b, c)) / 6
    return part


def read_bodies(text):
    """@return for each body in the file of a frame: the slice of its nodes, and its tets, none of a rigid body"""
    kinds, owners = read_array(text, "types", "u1"), read_array(text, "object", "<i4")
    ends = read_array(text, "offsets", "<i8")
    starts = np.concatenate([[0], ends[:-1]])
    corners = read_array(text, "connectivity", "<i8")
    for k in np.unique(owners):
        cells = np.array([corners[starts[cell] : ends[cell]] for cell in np.flatnonzero(owners == k)])
        is_soft = kinds[owners == k][0] == 10
        yield slice(int(cells.min()), int(cells.max()) + 1), cells - cells.min() if is_soft else None


def read_scene(file, frame):
    """@param frame the VTU file of frame 0 of this scene file"""
    description = tomllib.loads(file.read_text(encoding="utf-8"))
    text = frame.read_text(encoding="ascii")
    points = read_array(text, "Points", "<f4").reshape(-1, 3).astype(float)
    bodies = list(read_bodies(text))
    materials = {material["name"]: material for material in description["material"]}
    rigid = [nodes for nodes, tets in bodies if tets is None]
    deformable = [(nodes, tets) for nodes, tets in bodies if tets is not None]
    scene = JointedScene(
        file=file,
        frames=description["simulation"]["frames"],
        parts=[
            read_part(body, nodes, materials[body["material"]]["density"], file.parent)
            for body, nodes in zip(description["rigid"], rigid)
        ],
        softs=[
            Soft(body["name"], nodes, points[nodes], tets, materials[body["material"]])
            for body, (nodes, tets) in zip(description["object"], deformable)
        ],
        joints=[],
        colliders=description["collider"],
    )
    for attachment in description["attachment"]:
        if "rail" in attachment or "line" in attachment:
            scene.joints.append(read_joint(attachment))
            continue
        soft = next(soft for soft in scene.softs if soft.name == attachment["object"])
        soft.carrier = attachment["to"]
        soft.glued = glued_nodes(soft, scene.part(soft.carrier))
    return scene
