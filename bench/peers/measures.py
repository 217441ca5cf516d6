"""What is measured of each frame, in double precision and the same for all peers: volumes, momentum, crossings."""

import itertools

import numpy as np

from bodies import volume

PAIRS_AT_ONCE = 2_000_000  # bounds the memory of a search


def faces_of(tets):
    """The boundary of a body, [f, 3]: faces that belong to one tet only."""
    faces = np.concatenate([tets[:, corners] for corners in ([1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1])])
    _, first, count = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
    return faces[first[count == 1]]


def edges_of(faces):
    """[e, 2], each edge once."""
    return np.unique(np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1), axis=0)


def signed_volume(a, b, c, d):
    """Six times that of the tets abcd."""
    return np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a)


def are_crossing(p, q, a, b, c):
    """Whether each segment pq passes through the inside of the triangle abc in the same row."""
    through_plane = signed_volume(a, b, c, p) * signed_volume(a, b, c, q) < 0
    sides = np.stack([signed_volume(p, q, a, b), signed_volume(p, q, b, c), signed_volume(p, q, c, a)])
    return through_plane & ((sides > 0).all(axis=0) | (sides < 0).all(axis=0))


def overlapping_boxes(low, high, other_low, other_high):
    """Yields pairs (index, index of the other) whose boxes overlap, found by sorting along the longest axis."""
    axis = int(np.argmax(np.ptp(other_high, axis=0)))
    order = np.argsort(other_low[:, axis])
    starts = other_low[order, axis]
    longest = (other_high - other_low)[:, axis].max()
    first = np.searchsorted(starts, low[:, axis] - longest, "left")
    counts = np.searchsorted(starts, high[:, axis], "right") - first
    ends = np.cumsum(counts)
    done = 0
    while done < len(low):
        before = ends[done] - counts[done]
        until = max(done + 1, int(np.searchsorted(ends, before + PAIRS_AT_ONCE, "right")))
        part = counts[done:until]
        mine = np.repeat(np.arange(done, until), part)
        within = np.arange(part.sum()) - np.repeat(np.cumsum(part) - part, part)
        other = order[np.repeat(first[done:until], part) + within]
        near = ((low[mine] <= other_high[other]) & (other_low[other] <= high[mine])).all(axis=1)
        yield mine[near], other[near]
        done = until


def count_crossings(points, edges, other_points, other_faces):
    """How many pairs there are of an edge of one body that passes through a face of the other."""
    ends, corners = points[edges], other_points[other_faces]
    low, high = ends.min(axis=1), ends.max(axis=1)
    other_low, other_high = corners.min(axis=1), corners.max(axis=1)
    mine = ((low <= other_high.max(axis=0)) & (high >= other_low.min(axis=0))).all(axis=1)
    theirs = ((other_low <= high.max(axis=0)) & (other_high >= low.min(axis=0))).all(axis=1)
    if not mine.any() or not theirs.any():
        return 0
    ends, corners = ends[mine], corners[theirs]
    count = 0
    for e, f in overlapping_boxes(low[mine], high[mine], other_low[theirs], other_high[theirs]):
        count += int(are_crossing(*ends[e].swapaxes(0, 1), *corners[f].swapaxes(0, 1)).sum())
    return count


class Measure:
    """Measures the frames of one scene."""

    def __init__(self, scene, masses):
        self.scene, self.masses = scene, masses
        self.faces = [faces_of(body.tets) for body in scene.bodies]
        self.edges = [edges_of(faces) for faces in self.faces]
        self.rest_volumes = [volume(scene.points(body), body.tets) for body in scene.bodies]

    def volume_ratios(self, positions):
        return [
            volume(positions[body.nodes], body.tets) / rest
            for body, rest in zip(self.scene.bodies, self.rest_volumes)
        ]

    def crossings(self, positions):
        bodies = range(len(self.scene.bodies))
        points = [positions[body.nodes] for body in self.scene.bodies]
        return sum(
            count_crossings(points[i], self.edges[i], points[j], self.faces[j])
            for i, j in itertools.permutations(bodies, 2)
        )

    def momentum(self, before, positions):
        """By the mean velocities since the frame before [kg m/s]; the same for all, as not all report velocities."""
        return self.masses @ (positions - before) / self.scene.step

    def first_momentum(self):
        return sum(self.masses[body.nodes].sum() * body.velocity for body in self.scene.bodies)


def check():
    """Tests the counter of crossings. @throws AssertionError"""
    tet = np.array([[0, 1, 2, 3]])
    faces = faces_of(tet)
    edges = edges_of(faces)
    assert len(faces) == 4 and len(edges) == 6
    corner = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
    needle = np.array([[0.3, 0.3, 0.1], [0.3, 0.3, -1], [0.35, 0.3, -1], [0.3, 0.35, -1]])
    assert volume(corner, tet) == 1 / 6
    assert count_crossings(needle, edges, corner, faces) == 3  # its three long edges through one face
    assert count_crossings(corner, edges, needle, faces) == 0
    assert count_crossings(needle - [0, 0, 0.2], edges, corner, faces) == 0  # below that face
    assert count_crossings(needle + [2, 0, 0], edges, corner, faces) == 0

    random = np.random.default_rng(7)
    ends, corners = random.random((300, 2, 3)), random.random((200, 3, 3)) ** 2
    # By another formula, over all pairs: the point (s, u, v) in p + s (q - p) = a + u (b - a) + v (c - a).
    p, q = ends[:, None, 0], ends[:, None, 1]
    a, b, c = (corners[None, :, k] for k in range(3))
    pairs = np.broadcast_shapes(p.shape, a.shape)
    matrix = np.stack([np.broadcast_to(column, pairs) for column in (q - p, a - b, a - c)], axis=-1)
    s, u, v = np.moveaxis(np.linalg.solve(matrix, (a - p)[..., None])[..., 0], -1, 0)
    expected = int(((s > 0) & (s < 1) & (u > 0) & (v > 0) & (u + v < 1)).sum())
    points, other = ends.reshape(-1, 3), corners.reshape(-1, 3)
    found = count_crossings(points, np.arange(600).reshape(-1, 2), other, np.arange(600).reshape(-1, 3))
    assert found == expected > 100, (found, expected)
