#!/usr/bin/env python3
"""Runs the same two scenes on Gelatin and on its peers, and compares time, volume, momentum and crossings.

Scene A: three soft balls of 100 kg fall on a floor and on each other. Scene B: a ball of 100 kg and one of 12.5 kg meet
head on, without gravity. All get the same tets, which Gelatin makes and exports. Each peer runs in a process of its own,
on one thread, and its settings are at the top of its file in bench/peers/.

The peers come from PyPI, into a virtual environment in the work folder; bench/peers/requirements.txt has their versions.
With --joints: scenes/grab.toml, a gripper that carries a soft ball, and scenes/car.toml, a car on soft tyres (jointed.py).
A peer that cannot be installed, fails or does not end in time is listed with the reason, and the others still run.
"""

import argparse
import os
import shutil
import subprocess
import sys
import venv
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
PEERS = ["gelatin", "newton", "mujoco", "pybullet"]
SCENES = ["A", "B"]
JOINTED = ["grab", "car"]
REQUIREMENTS = HERE / "requirements.txt"


class Parser(argparse.ArgumentParser):
    def error(self, message):
        self.exit(2, f"run.py: error: {message}\n")


def positive(text):
    value = int(text)
    if value < 1:
        raise ValueError
    return value


def names(allowed):
    def parse(text):
        found = text.split(",")
        unknown = [name for name in found if name not in allowed]
        if unknown:
            raise argparse.ArgumentTypeError(f"'{unknown[0]}' is none of {', '.join(allowed)}")
        return found

    return parse


def parse_arguments():
    parser = Parser(prog="run.py", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--work", type=Path, default=ROOT / "build/peers", metavar="FOLDER",
                        help="for the environment and the runs; build/peers")
    parser.add_argument("--gelatin", type=Path, default=ROOT / "build/release/bin/gelatin", metavar="PATH",
                        help="the program; build/release/bin/gelatin")
    parser.add_argument("--peers", type=names(PEERS), metavar="P,...", help=", ".join(PEERS))
    parser.add_argument("--joints", action="store_true", help="the scenes grab and car, which have joints, in place of A and B")
    parser.add_argument("--scenes", type=names(SCENES + JOINTED), metavar="S,...", help="A, B; with --joints grab, car")
    parser.add_argument("--runs", type=positive, default=3, metavar="N", help="with --joints: of each engine, by turns; 3")
    parser.add_argument("--frames", type=positive, metavar="N", help="at most N frames instead of 150 (A) and 120 (B)")
    parser.add_argument("--time-limit", type=positive, default=600, metavar="S",
                        help="for each peer and scene, loading included [s]; 600. What was done until then counts")
    parser.add_argument("--report", type=Path, metavar="FILE.md", help="also write the tables to this file")
    parser.add_argument("--note", default="", help="a sentence for the report, such as what else the machine did")
    parser.add_argument("--reuse", action="store_true", help="do not repeat runs that the work folder has")
    parser.add_argument("--check", action="store_true", help="only test the counter of crossings")
    options = parser.parse_args()
    options.peers = options.peers or [peer for peer in PEERS if peer != "pybullet" or not options.joints]
    options.scenes = options.scenes or (JOINTED if options.joints else SCENES)
    wrong = [name for name in options.scenes if (name in JOINTED) != options.joints]
    wrong += ["pybullet"] if options.joints and "pybullet" in options.peers else []
    if wrong:
        parser.error(f"{wrong[0]} is {'not for' if options.joints else 'only for'} --joints")
    options.work, options.gelatin = options.work.resolve(), options.gelatin.resolve()
    if not options.check and not os.access(options.gelatin, os.X_OK):
        parser.error(f"--gelatin {options.gelatin}: there is no such program; build it with scripts/build")
    if options.report and not options.report.resolve().parent.is_dir():
        parser.error(f"--report {options.report}: there is no such folder")
    return options


def install(python, package):
    """@return why it cannot be installed, or nothing"""
    command = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--only-binary", ":all:"]
    done = subprocess.run([*command, "--constraint", REQUIREMENTS, package], capture_output=True, text=True, check=False)
    return done.stderr.strip().splitlines()[-1] if done.returncode else ""


def make_environment(folder):
    try:
        venv.create(folder, with_pip=True)
    except (OSError, subprocess.CalledProcessError) as error:
        shutil.rmtree(folder, ignore_errors=True)
        sys.exit(f"run.py: error: no virtual environment can be made (Debian: python3-venv): {error}")


def main():
    options = parse_arguments()
    environment = options.work / "environment"
    python = environment / "bin/python"
    if Path(sys.prefix) != environment:
        if not python.exists():
            make_environment(environment)
        problem = install(python, "numpy")
        if problem:
            sys.exit(f"run.py: error: numpy: {problem}")
        os.execv(python, [str(python), str(Path(__file__).resolve()), *sys.argv[1:]])

    # They need numpy, which only the environment has.
    import comparison
    import jointed

    (jointed if options.joints else comparison).compare(options, lambda package: install(python, package))


if __name__ == "__main__":
    main()
