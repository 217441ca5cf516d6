"""Hands, which pull at bodies."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from .arguments import number, vector

if TYPE_CHECKING:
    from .simulator import Simulator


class Hand:
    """Damped springs by which a program pulls at nodes: `body.hold(nodes)`.

    Each spring joins a node to a fixed offset from `target`. Set `target` to pull. Its work is unknown, so that the energy
    is not checked while it holds.
    """

    def __init__(
        self, simulator: Simulator, nodes: npt.NDArray[np.int64], stiffness: float, damping_time: float
    ) -> None:
        self._simulator = simulator
        #: among those of the simulator, shape (nodes,)
        self.nodes = nodes
        self._stiffness = stiffness
        self._damping_time = damping_time
        places = simulator.positions[nodes].astype(np.float64)
        self._target = places.mean(axis=0)
        self._arms = places - self._target
        simulator._hands.append(self)
        try:
            self._set_all()
        except Exception:
            simulator._hands.remove(self)
            raise

    @property
    def target(self) -> npt.NDArray[np.float64]:
        """Where it pulls the middle of its nodes to [m], shape (3,). Set it at any time."""
        return np.array(self._target)

    @target.setter
    def target(self, target: npt.ArrayLike) -> None:
        self._target = vector("target", target)
        if self in self._simulator._hands:
            self._simulator._core.move_pull(self._simulator._hands.index(self), self._target.tolist())

    @property
    def stiffness(self) -> float:
        """Of all springs together [N/m]. Set it at any time."""
        return self._stiffness

    @stiffness.setter
    def stiffness(self, stiffness: float) -> None:
        self._stiffness = number("stiffness", stiffness, may_be_zero=False)
        self._set_all()

    @property
    def damping_time(self) -> float:
        """Damping divided by stiffness [s]. Set it at any time."""
        return self._damping_time

    @damping_time.setter
    def damping_time(self, damping_time: float) -> None:
        self._damping_time = number("damping_time", damping_time)
        self._set_all()

    @property
    def force(self) -> npt.NDArray[np.float64]:
        """What it exerts on the body at present [N], shape (3,); 0 after `release`."""
        if self not in self._simulator._hands:
            return np.zeros(3)
        positions = self._simulator.positions[self.nodes].astype(np.float64)
        velocities = self._simulator.velocities[self.nodes].astype(np.float64)
        stretch = self._target + self._arms - positions - self.damping_time * velocities
        return np.asarray(stretch.sum(axis=0) * self.stiffness / len(self.nodes))

    def release(self) -> None:
        """Ends the pull. The body keeps its momentum."""
        if self in self._simulator._hands:
            self._simulator._hands.remove(self)
            self._set_all()

    def _set_all(self) -> None:
        self._simulator._core.set_pulls([hand._pull() for hand in self._simulator._hands])

    def _pull(self) -> tuple[list[int], list[list[float]], float, list[float], float]:
        stiffness = self.stiffness / len(self.nodes)
        return self.nodes.tolist(), self._arms.tolist(), stiffness, self._target.tolist(), self.damping_time
