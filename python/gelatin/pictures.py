"""Pictures and films, which notebooks show inline."""

from __future__ import annotations

import base64
import os
import struct
import subprocess
import tempfile
import zlib
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _gelatin
from .arguments import path_ending, whole_number
from .errors import InvalidInput, SystemError
from .progress import frames_with_bar

if TYPE_CHECKING:
    from .simulator import Simulator


class Picture(np.ndarray[Any, np.dtype[np.uint8]]):
    """8-bit sRGB, rows from the top: an array of shape (height, width, 3), uint8. Notebooks show it."""

    def save(self, file: str | os.PathLike[str]) -> None:
        """Writes a PNG file, completely or not at all.

        Raises InvalidInput for a name that does not end in .png; SystemError if it cannot be written.
        """
        target = path_ending(file, ".png")
        if not self._is_whole():
            raise InvalidInput(f"a picture must have the shape (height, width, 3), not {self.shape}")
        _gelatin.write_file(target, png_bytes(self))

    def _repr_png_(self) -> bytes | None:
        return png_bytes(self) if self._is_whole() else None

    def _is_whole(self) -> bool:
        return self.ndim == 3 and self.shape[2] == 3 and self.dtype == np.uint8


def png_bytes(pixels: npt.NDArray[np.uint8]) -> bytes:
    """A PNG file. pixels: shape (height, width, 3), uint8."""
    height, width, _ = pixels.shape

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = np.zeros((height, 1 + 3 * width), np.uint8)  # each begins with its filter: none
    rows[:, 1:] = np.asarray(pixels).reshape(height, 3 * width)
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return (
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", header)
        + chunk(b"IDAT", zlib.compress(rows.tobytes(), 6))
        + chunk(b"IEND", b"")
    )


class Film:
    """A film in H.264, as a file. Notebooks show it inline."""

    def __init__(self, file: Path, width: int, height: int, temporary: tempfile.TemporaryDirectory[str] | None) -> None:
        #: the .mp4 file; a temporary one goes with this object
        self.file = file
        #: [pixels]
        self.width = width
        #: [pixels]
        self.height = height
        self._temporary = temporary

    def __repr__(self) -> str:
        return f"<gelatin.Film: {self.file}>"

    def save(self, file: str | os.PathLike[str]) -> None:
        """Copies it, completely or not at all.

        Raises InvalidInput for a name that does not end in .mp4; SystemError if it cannot be written.
        """
        _gelatin.write_file(path_ending(file, ".mp4"), self.file.read_bytes())

    def _repr_html_(self) -> str:
        data = base64.b64encode(self.file.read_bytes()).decode()
        return f'<video controls autoplay loop muted width="{self.width}" src="data:video/mp4;base64,{data}"></video>'


def film(
    sim: Simulator,
    frames: int,
    file: str | os.PathLike[str] | None = None,
    *,
    width: int = 640,
    height: int = 360,
    progress: bool = False,
    **options: Any,
) -> Film:
    """Advances a simulator by `frames` frames and films them in real time, with the program ffmpeg.

    file: the .mp4 file; None: a temporary one.
    width, height: [pixels], even.
    progress: shows a bar, if the package tqdm is installed.
    options: those of Simulator.render.

    Raises InvalidInput for a file of another name; SystemError if there is no ffmpeg or it fails; NoOpenGl, which pictures need; as Simulator.advance.
    """
    frames, width, height = whole_number("frames", frames), whole_number("width", width), whole_number("height", height)
    if file is not None:
        file = path_ending(file, ".mp4")
    if width % 2 or height % 2 or width < 2 or height < 2:
        raise InvalidInput(f"a film's width and height must be even and greater than 0, not {width} and {height}")
    temporary = tempfile.TemporaryDirectory(prefix="gelatin_") if file is None else None
    target = Path(temporary.name) / "film.mp4" if temporary else Path(file or "")
    rate = sim.scene.simulation.frame_rate
    interval = max(1, round(rate / 60))  # of frames of a film, at 60 a second at most
    with _Encoder(target, width, height, rate / interval) as encoder:
        for frame in frames_with_bar(frames) if progress else range(frames):
            if frame % interval == 0:
                encoder.write(sim.render(width, height, **options))
            sim.advance(1)
    return Film(target, width, height, temporary)


class _Encoder:
    """ffmpeg, which reads pictures from a pipe."""

    def __init__(self, file: Path, width: int, height: int, rate: float) -> None:
        pictures = ["-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}", "-r", str(rate), "-i", "-"]
        codec = ["-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "20", "-movflags", "+faststart", "-f", "mp4"]
        command = ["ffmpeg", "-loglevel", "error", "-y", *pictures, *codec, str(file)]
        try:
            self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stderr=subprocess.PIPE)
        except FileNotFoundError:
            raise SystemError("a film needs the program ffmpeg, which is not installed") from None

    def __enter__(self) -> _Encoder:
        return self

    def __exit__(self, kind: Any, error: Any, trace: Any) -> None:
        _, messages = self._process.communicate()
        if self._process.returncode != 0 and (kind is None or kind is BrokenPipeError):
            text = messages.decode(errors="replace").strip()
            raise SystemError(f"ffmpeg failed: {text.splitlines()[-1] if text else 'it gives no reason'}") from None

    def write(self, picture: npt.NDArray[np.uint8]) -> None:
        assert self._process.stdin is not None
        self._process.stdin.write(np.ascontiguousarray(picture).tobytes())
