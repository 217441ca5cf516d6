"""One body of a simulator."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from .simulator import Simulator

Array = npt.NDArray[np.float32]


class Body:
    """One body of a simulator: `simulator["ball"]`.

    Arrays are slices of the simulator's, and follow the same rules. Nodes are in an order of the simulator's own.
    """

    def __init__(self, simulator: Simulator, fields: dict[str, Any]) -> None:
        self._simulator = simulator
        self.name: str = fields["name"]
        #: the body's nodes, among those of the simulator
        self.nodes = slice(*fields["nodes"])
        self._faces = slice(*fields["faces"])
        self._tets = slice(*fields["tets"])
        #: [kg]
        self.mass: float = fields["mass"]
        #: [m^3]
        self.rest_volume: float = fields["rest_volume"]

    def __repr__(self) -> str:
        return f"<gelatin.Body '{self.name}': {len(self)} nodes>"

    def __len__(self) -> int:
        """The number of nodes."""
        return self.nodes.stop - self.nodes.start

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
        """By the body's own nodes, shape (tets, 4)."""
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
    def volume(self) -> float:
        """[m^3]"""
        a, b, c, d = self.positions[self.tets.T].astype(np.float64)
        return float(np.einsum("ij,ij->i", b - a, np.cross(c - a, d - a)).sum() / 6.0)

    @property
    def contact_forces(self) -> Array:
        """The force of contacts on each node, normal and friction [N], shape (nodes, 3); (0, 3) without contact."""
        return self._simulator.contact_forces[self.nodes]

    @property
    def contact_force(self) -> npt.NDArray[np.float64]:
        """Their sum: what other bodies and colliders exert on the body [N], shape (3,)."""
        return self.contact_forces.sum(axis=0, dtype=np.float64)


def _mean(values: Array, masses: Array) -> npt.NDArray[np.float64]:
    weights = masses.astype(np.float64)
    return weights @ values.astype(np.float64) / weights.sum()
