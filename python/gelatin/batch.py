"""Many worlds of one scene."""

from __future__ import annotations

import os
from collections.abc import Iterator
from typing import Callable, Union

import numpy as np
import numpy.typing as npt

from . import _gelatin
from .arguments import whole_number
from .progress import counted, frames_with_bar
from .scene import Scene, load
from .simulator import Array, Simulator


class Batch:
    """Copies of a scene, called worlds, that cannot see each other. Each has the same bits as a Simulator of the scene.

    scene: a Scene, or the path of a scene file.
    worlds: their number, >= 1.

    Meshes, springs and tets are made once, for all worlds. Worlds are advanced beside each other on all threads, with the
    CPU backend. `batch[3]` is one of them, a Simulator to read and to set; it keeps the batch alive.
    """

    def __init__(self, scene: Union[Scene, str, os.PathLike[str]], worlds: int) -> None:
        if isinstance(scene, (str, os.PathLike)):
            scene = load(scene)
        self.scene = scene
        worlds = whole_number("worlds", worlds, least=1)
        self._core = _gelatin.Batch(scene, worlds)
        self._worlds = [self._core.world(w) for w in range(worlds)]
        self._simulators = [Simulator._of(world, scene) for world in self._worlds]
        self._first = self._simulators[0]

    def __repr__(self) -> str:
        return f"<gelatin.Batch: {counted(len(self), 'world')} of {counted(len(self.masses), 'node')}>"

    def __len__(self) -> int:
        """The number of worlds."""
        return len(self._core)

    def __getitem__(self, world: int) -> Simulator:
        """One world. Raises IndexError."""
        return self._simulators[world]

    def __iter__(self) -> Iterator[Simulator]:
        return iter(self._simulators)

    def step(self, count: int = 1) -> None:
        """Advances every world by `count` steps. Ctrl-C ends it after a whole step of all worlds.

        Worlds that have diverged stand still until they are reset.

        Callbacks of worlds are called, world by world, after each step of all.

        Raises Diverged, naming a world that diverged in these steps, after all others have made theirs. `diverged` has all.
        """
        count = whole_number("count", count)
        listening = [world for world in self._simulators if world._step_callbacks or world._frame_callbacks]
        if not listening:
            self._core.step(count)
            return
        for _ in range(count):
            before = [(world.frame, world.time) for world in listening]
            try:
                self._core.step(1)
            finally:
                for world, (frame, time) in zip(listening, before):
                    if world.time != time:
                        world._call(world._step_callbacks)
                    if world.frame != frame:
                        world._call(world._frame_callbacks)

    def advance(self, frames: int = 1) -> None:
        """Advances every world by `frames` frames. Raises as `step`."""
        self.step(whole_number("frames", frames) * self._first.substeps)

    def run(self, frames: int, progress: bool = False) -> None:
        """As `advance`. progress: shows a bar, if the package tqdm is installed."""
        if not progress:
            self.advance(frames)
            return
        for _ in frames_with_bar(whole_number("frames", frames)):
            self.advance(1)

    def reset(self, mask: npt.ArrayLike | None = None) -> None:
        """Returns worlds to their start, as Simulator.reset. mask: True for those, shape (worlds,); None: all."""
        chosen = np.ones(len(self), bool) if mask is None else np.asarray(mask)
        if chosen.shape != (len(self),) or chosen.dtype != bool:
            raise ValueError(f"mask must be of bool and of shape ({len(self)},), not {chosen.dtype} and {chosen.shape}")
        self._core.reset(chosen.astype(np.uint8).tolist())
        for world in np.flatnonzero(chosen):
            self._simulators[world]._forget_changes()

    def nodes(self, name: str) -> slice:
        """The nodes of an object: batch.positions[:, batch.nodes("ball")]. Raises KeyError."""
        return self._first[name].nodes

    @property
    def substeps(self) -> int:
        """Steps per frame."""
        return self._first.substeps

    @property
    def step_size(self) -> float:
        """[s]"""
        return self._first.step_size

    @property
    def diverged(self) -> npt.NDArray[np.bool_]:
        """The worlds that have diverged since they were reset, shape (worlds,)."""
        return np.array(self._core.diverged())

    @property
    def frames(self) -> npt.NDArray[np.int64]:
        """Completed frames of each world since its start, shape (worlds,)."""
        return np.array([core.frame for core in self._worlds])

    @property
    def times(self) -> npt.NDArray[np.float64]:
        """[s], shape (worlds,)."""
        return np.array([core.time for core in self._worlds])

    @property
    def positions(self) -> Array:
        """[m], shape (worlds, nodes, 3), float32. A copy."""
        return self._stack(lambda core: core.positions())

    @property
    def velocities(self) -> Array:
        """[m/s], shape (worlds, nodes, 3), float32. A copy."""
        return self._stack(lambda core: core.velocities())

    @property
    def contact_forces(self) -> Array:
        """The force of contacts on each node [N], shape (worlds, nodes, 3); (worlds, 0, 3) without contact. A copy."""
        return self._stack(lambda core: core.contact_forces())

    @property
    def rest_positions(self) -> Array:
        """Where the scene places the nodes at the start [m], the same in all worlds: shape (nodes, 3)."""
        return self._first.rest_positions

    @property
    def masses(self) -> Array:
        """[kg], shape (nodes,): those of the first world, and of all but for `set_material`."""
        return self._first.masses

    @property
    def faces(self) -> npt.NDArray[np.uint32]:
        """Nodes of the surfaces' triangles, the same in all worlds: shape (faces, 3)."""
        return self._first.faces

    @property
    def tets(self) -> npt.NDArray[np.uint32]:
        """Nodes of the tets, the same in all worlds: shape (tets, 4)."""
        return self._first.tets

    def _stack(self, array_of: Callable[[_gelatin.Simulator], Array]) -> Array:
        return np.stack([array_of(core) for core in self._worlds])
