"""One body of a simulator."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Union

import numpy as np
import numpy.typing as npt

from .arguments import number, numbers, wrong_type
from .errors import InvalidInput
from .hands import Hand
from .progress import counted
from .shapes import BoxRegion, HalfSpaceRegion, Region, SphereRegion

if TYPE_CHECKING:
    from .simulator import Simulator

Array = npt.NDArray[np.float32]
#: The nodes in a region, as the body is now; or their indices in the body; or True for those, shape (nodes,).
Nodes = Union[Region, npt.ArrayLike]


class Body:
    """One body of a simulator: `simulator["ball"]`.

    Arrays are slices of the simulator's, and follow the same rules. Nodes are in an order of the simulator's own.
    """

    def __init__(self, simulator: Simulator, index: int, fields: dict[str, Any]) -> None:
        self._simulator = simulator
        self._index = index
        self.name: str = fields["name"]
        #: the body's nodes, among those of the simulator
        self.nodes = slice(*fields["nodes"])
        self._faces = slice(*fields["faces"])
        self._tets = slice(*fields["tets"])
        #: [m^3]
        self.rest_volume: float = fields["rest_volume"]
        #: whether it has no tets, and moves as a whole
        self.is_rigid: bool = fields["is_rigid"]

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Body) and (other._simulator, other._index) == (self._simulator, self._index)

    def __hash__(self) -> int:
        return hash((id(self._simulator), self._index))

    def __repr__(self) -> str:
        return f"<gelatin.Body '{self.name}': {counted(len(self), 'node')}>"

    @property
    def mass(self) -> float:
        """[kg]"""
        return float(self._simulator._objects[self.name]["mass"])

    def __len__(self) -> int:
        """The number of nodes."""
        return int(self.nodes.stop - self.nodes.start)

    @property
    def positions(self) -> Array:
        """[m], shape (nodes, 3). A view, as Simulator.positions."""
        return self._simulator.positions[self.nodes]

    @property
    def velocities(self) -> Array:
        """[m/s], shape (nodes, 3). A view, as Simulator.velocities."""
        return self._simulator.velocities[self.nodes]

    @property
    def rest_positions(self) -> Array:
        """Where the scene places the nodes at the start [m], shape (nodes, 3)."""
        return self._simulator.rest_positions[self.nodes]

    @property
    def masses(self) -> Array:
        """[kg], shape (nodes,)."""
        return self._simulator.masses[self.nodes]

    @property
    def faces(self) -> npt.NDArray[np.uint32]:
        """The surface's triangles, by the body's own nodes, shape (faces, 3)."""
        return self._simulator.faces[self._faces] - np.uint32(self.nodes.start)

    @property
    def tets(self) -> npt.NDArray[np.uint32]:
        """By the body's own nodes, shape (tets, 4). A rigid body has none."""
        return self._simulator.tets[self._tets] - np.uint32(self.nodes.start)

    @property
    def center(self) -> npt.NDArray[np.float64]:
        """The centre of mass [m], shape (3,)."""
        return _mean(self.positions, self.masses)

    @property
    def velocity(self) -> npt.NDArray[np.float64]:
        """The velocity of the centre of mass [m/s], shape (3,)."""
        return _mean(self.velocities, self.masses)

    @property
    def rotation(self) -> npt.NDArray[np.float64]:
        """The rotation from the start that is nearest to where its nodes are, in the mean of their masses, shape (3, 3).

        It rotates columns: `rest_positions @ rotation.T` has the present orientation.
        """
        return np.array(self._simulator._core.rotation(self._index)).reshape(3, 3)

    @property
    def spin(self) -> npt.NDArray[np.float64]:
        """The angular velocity about the centre of mass, from the angular momentum [degrees/s], shape (3,)."""
        masses = self.masses.astype(np.float64)[:, None]
        arms = self.positions - self.center
        momentum = (masses * np.cross(arms, self.velocities)).sum(axis=0)
        square = (masses * arms).T @ arms
        return np.asarray(np.degrees(np.linalg.solve(np.trace(square) * np.eye(3) - square, momentum)))

    @property
    def volume(self) -> float:
        """What the surface encloses [m^3]."""
        a, b, c = self.positions[self.faces.T] - self.center
        return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6.0)

    @property
    def contact_forces(self) -> Array:
        """The force of contacts on each node, normal and friction [N], shape (nodes, 3); (0, 3) without contact."""
        return self._simulator.contact_forces[self.nodes]

    @property
    def contact_force(self) -> npt.NDArray[np.float64]:
        """Their sum: what other bodies and colliders exert on the body [N], shape (3,)."""
        return np.asarray(self.contact_forces.sum(axis=0, dtype=np.float64))

    # What can be changed between steps. Each call raises InvalidInput for values that are not allowed.

    def nodes_in(self, region: Region) -> npt.NDArray[np.int64]:
        """The nodes that are in a region now, by their indices in the body, ascending. Raises InvalidInput as for a scene's."""
        if not isinstance(region, (BoxRegion, SphereRegion, HalfSpaceRegion)):
            raise wrong_type("region", region, "a BoxRegion, a SphereRegion or a HalfSpaceRegion")
        return np.array(self._simulator._core.nodes_in(self._index, region), np.int64)

    def set_positions(self, positions: npt.ArrayLike) -> None:
        """Puts the nodes somewhere else [m], shape (nodes, 3), with the velocities that they have.

        A rigid body takes the nearest pose, in the mean of its nodes' masses, and keeps its velocity and spin. Held nodes
        stay. With contact, bodies that overlap afterwards are moved apart, as at the start.
        """
        self._simulator._core.set_positions(self._index, self._vectors(positions, "positions"))

    def set_velocity(self, velocity: npt.ArrayLike) -> None:
        """Sets the velocity of all nodes [m/s], shape (3,), or of each, shape (nodes, 3). Held nodes keep theirs.

        A rigid body takes the velocity and spin of the same momentum and angular momentum.
        """
        self._simulator._core.set_velocities(self._index, self._vectors(velocity, "velocity"))

    def set_force(self, force: npt.ArrayLike) -> None:
        """Sets a force on the body [N], shape (3,), distributed by mass, or on each node, shape (nodes, 3).

        It acts until another one is set; 0 ends it. Its work is unknown, so that the energy is not checked meanwhile.
        """
        vector = numbers("force", force, self._shapes())
        if vector.shape == (3,):
            masses = self.masses.astype(np.float64)
            vector = vector * (masses / masses.sum())[:, None]
        self._simulator._core.set_forces(self._index, self._vectors(vector, "force"))
        self._simulator._forced.add(self._index)

    def pin(self, nodes: Nodes) -> None:
        """Holds nodes where they are, until `unpin` or Simulator.reset. It takes as long as making the simulator again."""
        self._simulator._core.pin(self._index, self._indices(nodes).tolist())

    def unpin(self) -> None:
        """Releases all nodes that `pin` holds. It takes as long as `pin`."""
        self._simulator._core.unpin(self._index)

    def hold(self, nodes: Nodes, stiffness: float | None = None, damping_time: float | None = None) -> Hand:
        """Takes hold of nodes, with damped springs to a target that is where they are now.

        stiffness: of all springs together [N/m]; None: the body's weight stretches them by a hundredth of its size.
        damping_time: damping divided by stiffness [s]; None: critical for the body's mass.
        """
        chosen = self._indices(nodes)
        if len(chosen) == 0:
            raise InvalidInput("there is no node to hold")
        if stiffness is None:
            stiffness = 9.81 * self.mass / (0.01 * self.rest_volume ** (1 / 3))
        stiffness = number("stiffness", stiffness, may_be_zero=False)
        if damping_time is None:
            damping_time = 2.0 * float(np.sqrt(self.mass / stiffness))
        return Hand(self._simulator, self.nodes.start + chosen, stiffness, number("damping_time", damping_time))

    def _vectors(self, values: npt.ArrayLike, what: str) -> npt.NDArray[np.float32]:
        vectors = numbers(what, values, self._shapes())
        if vectors.shape not in ((3,), (len(self), 3)):
            raise InvalidInput(f"{what} must have the shape (3,) or ({len(self)}, 3), not {vectors.shape}")
        return np.ascontiguousarray(np.broadcast_to(vectors.astype(np.float32), (len(self), 3)))

    def _shapes(self) -> str:
        return f"numbers of the shape (3,) or ({len(self)}, 3)"

    def _indices(self, nodes: Nodes) -> npt.NDArray[np.int64]:
        if isinstance(nodes, (BoxRegion, SphereRegion, HalfSpaceRegion)):
            return self.nodes_in(nodes)
        try:
            chosen = np.atleast_1d(np.asarray(nodes))
        except ValueError:  # lists of different lengths
            chosen = np.zeros((1, 1))
        if chosen.dtype == bool and chosen.shape == (len(self),):
            return np.flatnonzero(chosen)
        if chosen.size == 0:
            return np.zeros(0, np.int64)
        if chosen.ndim != 1 or chosen.dtype.kind not in "iu" or chosen.min() < 0 or chosen.max() >= len(self):
            raise InvalidInput(f"nodes must be a region, indices below {len(self)}, or a mask of the shape ({len(self)},)")
        return chosen.astype(np.int64)


def _mean(values: Array, masses: Array) -> npt.NDArray[np.float64]:
    weights = masses.astype(np.float64)
    return np.asarray(weights @ values.astype(np.float64) / weights.sum())
