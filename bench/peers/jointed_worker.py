"""jointed_worker.py JOB.json: runs one peer on one scene with joints, in a process of its own and in the job's folder.

A peer's module has TITLE, LICENCE, PACKAGES, NOTES, VARIANTS as those of worker.py, and class Peer. Settings have
`steps` a frame, `threads`, and perhaps `runs`, how many are enough, and `frames`, how many by the name of a scene.

    class Peer:
        def __init__(scene, settings, job)   # builds the scene, imports the package
        def step() -> seconds, seconds       # goes on by one frame; wall-clock and processor time of that alone
        def state()                          # places [p, 3] and rotations since the start [p, 3, 3] of the parts, nodes [n, 3]
        def remark() -> text                 # at the end, if there is one: what the engine itself complained about

`frames.txt` has a line for each frame as soon as it is complete: both times, then what is measured.
"""

import importlib
import json
import sys
import time
import traceback
from pathlib import Path

import numpy as np

from jointed_measures import METERS
from jointed_scene import read_scene

FAR_AWAY = 100.0  # [m]


def run(job):
    file = Path(job["scene"])
    scene = read_scene(file, Path(job["mesh"]))
    module = importlib.import_module(f"jointed_{job['peer']}")
    start = time.perf_counter()
    peer = module.Peer(scene, module.VARIANTS[job["variant"]], job)
    Path("loading.txt").write_text(f"{time.perf_counter() - start}\n", encoding="ascii")
    meter = METERS[file.stem](scene)
    with open("frames.txt", "w", encoding="ascii") as frames:
        for frame in range(1, job["frames"] + 1):
            times = peer.step()
            row = []
            if job["measured"]:
                state = peer.state()
                if not all((np.abs(values) < FAR_AWAY).all() for values in state):
                    raise SystemExit(f"explodes at frame {frame}: something is {FAR_AWAY:.0f} m away, or not finite")
                row = [float(value) for value in meter.of_frame(frame * scene.step, *state)]
            frames.write(json.dumps([*times, *row]) + "\n")
            frames.flush()
    if hasattr(peer, "remark"):
        Path("remark.txt").write_text(peer.remark(), encoding="utf-8")


if __name__ == "__main__":
    try:
        run(json.loads(Path(sys.argv[1]).read_text(encoding="utf-8")))
    except Exception as error:
        traceback.print_exc()
        sys.exit(f"{type(error).__name__}: {' '.join(str(error).split())}")  # the last line is the reason
