"""The program `gelatin`, which comes with the package."""

from __future__ import annotations

import os
import sys
from pathlib import Path


def main() -> None:
    """Becomes the program, with the same arguments; but `gelatin sweep` is Python's own."""
    if sys.argv[1:2] == ["sweep"]:
        from .sweep_command import main as sweep

        sys.exit(sweep(sys.argv[2:]))
    program = Path(__file__).parent / "bin" / "gelatin"
    if not program.exists():
        sys.exit(f"gelatin: error: {program} is missing: this package was built without the program")
    os.execv(program, [str(program), *sys.argv[1:]])
