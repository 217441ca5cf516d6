"""What Gelatin raises on purpose, with one line of text for the user. Attributes are set where they are known."""

from __future__ import annotations


class Error(Exception):
    """Base of every exception that Gelatin raises on purpose."""


class InvalidInput(Error, ValueError):
    """A scene, a file or a call is wrong."""

    file: str = ""
    #: 0: does not apply
    line: int = 0
    #: dotted key of a scene, argument, or part of a mesh file
    field: str = ""
    #: as it was given
    value: str = ""


class Diverged(Error, ArithmeticError):
    """The simulation produced numbers that are not finite, or energy without a cause."""

    #: the first step with an invalid state, counted from frame 0; 0: unknown
    step: int = 0
    #: the frame that this step belongs to
    frame: int = 0
    #: [s]
    time: float = 0.0
    object: str = ""
    #: index in the object; undefined if the step is unknown
    node: int = 0


class GlError(Error):
    """OpenGL failed; the text has the driver's messages."""


class NoOpenGl(GlError):
    """There is no OpenGL that Gelatin can use."""


class SystemError(Error, OSError):
    """The operating system or a helper program failed: disk full, a program missing."""
