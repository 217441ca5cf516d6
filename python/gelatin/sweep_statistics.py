"""The columns that a sweep measures by itself."""

from __future__ import annotations

import statistics
import time
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any, Union

import numpy as np

from .arguments import texts
from .errors import InvalidInput

if TYPE_CHECKING:
    from .simulator import Simulator

#: Each with its unit; docs/sweeps.md says what they are.
STATISTICS = {
    "nodes": "",
    "frames": "",
    "time": "s",
    "kinetic_energy": "J",
    "elastic_energy": "J",
    "potential_energy": "J",
    "peak_kinetic_energy": "J",
    "peak_elastic_energy": "J",
    "peak_speed": "m/s",
    "contact_force": "N",
    "peak_contact_force": "N",
    "contacts": "",
    "deepest_penetration": "m",
    "volume_ratio": "",
    "least_volume_ratio": "",
    "frame_ms": "ms",
}
UNMEASURED = {"nodes", "frames", "time", "frame_ms"}  # what is known without measuring


def chosen_statistics(what: Union[Sequence[str], None]) -> list[str]:
    """The names of `what`, or all. Raises InvalidInput for one that there is not."""
    names = list(STATISTICS) if what is None else texts("what", what)
    for name in names:
        if name not in STATISTICS:
            raise InvalidInput(f"what: {name!r}: there is no such statistic; there are {', '.join(STATISTICS)}")
    return names


class Statistics:
    """Measures a run."""

    def __init__(self, names: Iterable[str]) -> None:
        self._names = list(names)
        self._measures = not UNMEASURED.issuperset(self._names)
        self._peaks: dict[str, float] = {}
        self._frame_times: list[float] = []
        self._now: dict[str, Any] = {}

    def columns(self) -> dict[str, Any]:
        """What is known so far."""
        if self._frame_times:
            self._now["frame_ms"] = statistics.median(self._frame_times)
        return {name: self._now.get(name) for name in self._names}

    def follow(self, sim: Simulator, frames: int) -> None:
        """Runs to a frame, and measures each one. Raises Diverged."""
        self._take(sim)
        while sim.frame < frames:
            began = time.perf_counter()
            sim.advance(1)
            self._frame_times.append(1e3 * (time.perf_counter() - began))
            self._take(sim)

    def _take(self, sim: Simulator) -> None:
        self._now.update(nodes=len(sim.masses), frames=sim.frame, time=sim.time)
        if self._measures:
            self._now.update(self._measure(sim))

    def _measure(self, sim: Simulator) -> dict[str, Any]:
        measured = sim.statistics()
        now = {name: measured[name] for name in ("kinetic_energy", "elastic_energy", "potential_energy", "contacts")}
        ratios = measured["volume_ratio"].values()
        now["volume_ratio"] = min(ratios)
        self._raise_peak("peak_kinetic_energy", measured["kinetic_energy"])
        self._raise_peak("peak_elastic_energy", measured["elastic_energy"])
        self._raise_peak("deepest_penetration", measured["deepest_penetration"])
        self._raise_peak("least_volume_ratio", -min(ratios))
        if "peak_speed" in self._names:
            self._raise_peak("peak_speed", float(np.sqrt(np.square(sim.velocities).sum(axis=1).max())))
        if len(sim.contact_forces):
            forces = [np.add(force["normal"], force["friction"]) for force in measured["contact_forces"]]
            now["contact_force"] = max((float(np.linalg.norm(force)) for force in forces), default=0.0)
            self._raise_peak("peak_contact_force", now["contact_force"])
        now.update(self._peaks)
        now["least_volume_ratio"] = -self._peaks["least_volume_ratio"]
        return now

    def _raise_peak(self, name: str, value: float) -> None:
        self._peaks[name] = max(value, self._peaks.get(name, value))
