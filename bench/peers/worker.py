"""worker.py JOB.json: runs one peer on one scene, in a process of its own and in the job's folder.

A peer's module has TITLE, LICENCE, PACKAGES (of PyPI, whose versions are reported), NOTES (its settings in words),
VARIANTS (settings by name) and

    class Peer:
        masses                               # of the nodes [kg], [n]
        def __init__(scene, settings, job)   # builds the scene, imports the package
        def step() -> seconds                # goes on by one frame; wall-clock time of that alone
        def positions()                      # of all nodes [m], [n, 3], float64

What has been simulated is on disk after every frame, so that nothing is lost when the process is stopped:
`states.bin` (positions, the start first), `times.txt` (seconds, a line for each frame), `masses.npy`, `loading.txt`.
"""

import importlib
import json
import sys
import time
import traceback
from pathlib import Path

import numpy as np

from bodies import read_scene

FAR_AWAY = 100.0  # [m]: nothing gets there in these scenes unless the simulation explodes


def run(job):
    scene = read_scene(Path(job["scene"]), Path(job["mesh"]))
    module = importlib.import_module(f"{job['peer']}_peer")
    start = time.perf_counter()
    peer = module.Peer(scene, module.VARIANTS[job["variant"]], job)
    Path("loading.txt").write_text(f"{time.perf_counter() - start}\n", encoding="ascii")
    np.save("masses.npy", peer.masses)
    with open("states.bin", "wb") as states, open("times.txt", "w", encoding="ascii") as times:
        positions = peer.positions()
        if np.abs(positions - scene.positions).max() > 1e-5:
            raise SystemExit("the nodes do not start where they should")
        states.write(positions.tobytes())
        for frame in range(1, job["frames"] + 1):
            seconds = peer.step()
            positions = peer.positions()
            if not (np.abs(positions) < FAR_AWAY).all():
                raise SystemExit(f"explodes at frame {frame}: nodes are {FAR_AWAY:.0f} m away, or not finite")
            states.write(positions.tobytes())
            states.flush()
            times.write(f"{seconds}\n")
            times.flush()


if __name__ == "__main__":
    try:
        run(json.loads(Path(sys.argv[1]).read_text(encoding="utf-8")))
    except Exception as error:
        traceback.print_exc()
        sys.exit(f"{type(error).__name__}: {' '.join(str(error).split())}")  # the last line is the reason
