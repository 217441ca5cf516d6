"""What is measured of each frame of a scene with joints, the same for all peers: openings of joints, slips, places."""

import numpy as np

from jointed_scene import WORLD


class Poses:
    """Where points of parts are in a frame."""

    def __init__(self, scene, places, turns):
        self.parts = {part.name: (part.place, place, turn) for part, place, turn in zip(scene.parts, places, turns)}

    def carry(self, name, points):
        """@param points at the start"""
        if name == WORLD:
            return points
        start, place, turn = self.parts[name]
        return (points - start) @ turn.T + place

    def back(self, name, points):
        """@return where these points were in the part at the start"""
        start, place, turn = self.parts[name]
        return (points - place) @ turn + start

    def place(self, name):
        return self.parts[name][1]


def opening(joint, poses):
    """How far the points of a joint are from where they may be [m]."""
    apart = poses.carry(joint.part, joint.ends) - poses.carry(joint.to, joint.ends)
    if joint.is_hinge:
        return np.linalg.norm(apart, axis=1).max()
    axis = poses.carry(joint.to, joint.ends[1]) - poses.carry(joint.to, joint.ends[0])
    axis /= np.linalg.norm(axis)
    return np.linalg.norm(apart[0] - (apart[0] @ axis) * axis)


def softs_of(scene, nodes):
    ends = np.cumsum([len(soft.points) for soft in scene.softs])
    return zip(scene.softs, np.split(nodes, ends[:-1]))


class Grab:
    """The gripper: what becomes of the ball from when the lift begins to when the fingers open."""

    TITLE = "a gripper lifts a soft ball and carries it"
    HEAD = ("joint opens [mm]", "ball rises [m]", "is carried [m]", "slips sideways [mm]", "slips down [mm]", "is dropped")
    LIFT, OPEN = 1.5, 6.0  # [s]: keyframes of scenes/grab.toml

    def __init__(self, scene):
        self.scene = scene

    def of_frame(self, _time, places, turns, nodes):
        """Opening of joints, the ball's centre, and where that was in the palm at the start."""
        poses = Poses(self.scene, places, turns)
        ball = self.scene.softs[0].masses() @ nodes / self.scene.softs[0].mass()
        widest = max(opening(joint, poses) for joint in self.scene.joints)
        return [widest, *ball, *poses.back("palm", ball)]

    def summary(self, times, rows):
        """@return what the report shows, and whether the ball was not dropped"""
        held = (times >= self.LIFT - 1e-9) & (times <= self.OPEN + 1e-9)
        if not held.any() or times[-1] < self.OPEN:
            return [f"{1000 * rows[:, 0].max():.2f}", "", "", "", "", "not finished"], False
        ball, in_palm = rows[held, 1:4], rows[held, 4:7]
        slip = in_palm - in_palm[0]
        down = -slip[:, 1].min()
        dropped = down > 0.1
        cells = [f"{1000 * rows[:, 0].max():.2f}", f"{ball[-1, 1] - ball[0, 1]:.3f}", f"{ball[-1, 0] - ball[0, 0]:.3f}"]
        sideways = np.linalg.norm(slip[:, [0, 2]], axis=1).max()
        return cells + [f"{1000 * sideways:.0f}", f"{1000 * down:.0f}", "yes" if dropped else "no"], not dropped


class Car:
    """The car: how far it gets, and what its tyres do."""

    TITLE = "a car on soft tyres drives over a log and up a kerb"
    HEAD = ("joint opens [mm]", "car gets [m]", "climbs the kerb", "body tilts at most [degrees]", "tyre leaves its rim [mm]")

    def __init__(self, scene):
        self.scene = scene
        kerb = next(collider for collider in scene.colliders if "box" in collider["shape"])
        self.edge = kerb["position"][0] - kerb["shape"]["box"][0] / 2
        self.height = kerb["position"][1] + kerb["shape"]["box"][1] / 2
        self.rims = [part.name for part in scene.parts if part.name.endswith("rim")]

    def of_frame(self, _time, places, turns, nodes):
        """Opening of joints, the body's place and tilt, the rearmost and lowest rim, how far a glued node is off."""
        poses = Poses(self.scene, places, turns)
        off = 0.0
        for soft, points in softs_of(self.scene, nodes):
            wanted = poses.carry(soft.carrier, soft.points[soft.glued])
            off = max(off, np.linalg.norm(points[soft.glued] - wanted, axis=1).max())
        rims = np.array([poses.place(rim) for rim in self.rims])
        tilt = np.degrees(np.arccos(np.clip(turns[0][1, 1], -1, 1)))
        widest = max(opening(joint, poses) for joint in self.scene.joints)
        return [widest, *places[0], tilt, rims[:, 0].min(), rims[:, 1].min(), off]

    def summary(self, _times, rows):
        """@return what the report shows, and whether all wheels were on the kerb"""
        start = self.scene.parts[0].place[0]
        wheel = self.scene.part(self.rims[0]).place[1]
        climbed = bool(((rows[:, 5] > self.edge) & (rows[:, 6] > wheel + self.height / 2)).any())
        cells = [f"{1000 * rows[:, 0].max():.2f}", f"{rows[-1, 1] - start:.2f}", "yes" if climbed else "no"]
        return cells + [f"{rows[:, 4].max():.0f}", f"{1000 * rows[:, 7].max():.2f}"], climbed


METERS = {"grab": Grab, "car": Car}
