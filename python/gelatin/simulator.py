"""A scene that runs."""

from __future__ import annotations

import dataclasses
import os
from collections.abc import Callable, Iterator, Sequence
from typing import Any, Literal, TypeVar, Union, cast

import numpy as np
import numpy.typing as npt

from . import _gelatin
from .arguments import check_function, path, text, texts, vectors, whole_number
from .bodies import Body
from .errors import InvalidInput
from .hands import Hand
from .objects import Attached, Attachment, Camera, Collider, JointMotor, Object
from .pictures import Picture
from .progress import counted, frames_with_bar
from .recording import Recorder
from .scene import Scene, attachment_of, load

Array = npt.NDArray[np.float32]
Callback = TypeVar("Callback", bound=Callable[["Simulator"], object])


class Simulator:
    """A scene that runs.

    scene: a Scene, or the path of a scene file.
    backend: "auto" takes OpenGL on a GPU, but the CPU where bodies can meet others by contact, or where there is no GPU.
    gl_device: index of an EGL device; None: the best.

    Raises InvalidInput for a scene that cannot be built, and NoOpenGl if "gl" is asked for and there is none.

    Arrays. With the CPU backend `positions` and `velocities` are views of the simulator's own memory, without a copy, and
    read-only. A view keeps the simulator alive. It shows the state at which it was taken until the next call that steps,
    resets or loads; after that its contents are those of some other step. So take a property again after each step, and
    `.copy()` what you want to keep. With OpenGL they are copies.

    Threads. Other threads of Python run while it steps. They must not use the same simulator meanwhile: RuntimeError. With
    OpenGL a simulator belongs to the thread that made it.
    """

    def __init__(
        self,
        scene: Union[Scene, str, os.PathLike[str]],
        backend: Literal["auto", "gl", "cpu"] = "auto",
        *,
        gl_device: int | None = None,
    ) -> None:
        if isinstance(scene, (str, os.PathLike)):
            scene = load(scene)
        device = None if gl_device is None else whole_number("gl_device", gl_device)
        self._begin(_gelatin.Simulator(scene, text("backend", backend), device), scene)

    @classmethod
    def _of(cls, core: _gelatin.Simulator, scene: Scene) -> Simulator:
        """One that exists already, in a batch."""
        simulator = cls.__new__(cls)
        simulator._begin(core, scene)
        return simulator

    def _begin(self, core: _gelatin.Simulator, scene: Scene) -> None:
        self.scene = scene
        self._core = core
        self._objects = self._read_objects()
        self._hands: list[Hand] = []
        self._forced: set[int] = set()  # indices of objects
        self._attached = 0  # attachments of programs
        self._step_callbacks: list[Callable[[Simulator], object]] = []
        self._frame_callbacks: list[Callable[[Simulator], object]] = []

    def _read_objects(self) -> dict[str, dict[str, Any]]:
        return {fields["name"]: fields for fields in self._core.objects()}

    def __repr__(self) -> str:
        bodies, nodes = counted(len(self._objects), "body", "bodies"), counted(len(self.masses), "node")
        return f"<gelatin.Simulator: {bodies}, {nodes}, frame {self.frame}, {self.device}>"

    # Bodies

    def __getitem__(self, name: str) -> Body:
        """The body of the object with this name. Raises KeyError."""
        if name not in self._objects:
            raise KeyError(f"there is no object '{name}'; there are {', '.join(map(repr, self._objects))}")
        return Body(self, list(self._objects).index(name), self._objects[name])

    def __iter__(self) -> Iterator[Body]:
        return (self[name] for name in self._objects)

    def __len__(self) -> int:
        return len(self._objects)

    def __contains__(self, body: object) -> bool:
        """Whether it has an object of this name, or this body."""
        return body in self._objects if isinstance(body, str) else isinstance(body, Body) and body._simulator is self

    # Time

    def step(self, count: int = 1) -> None:
        """Makes `count` steps; `substeps` of them are a frame. Ctrl-C ends it after a whole step.

        Raises Diverged after a step with nodes that are not finite, or faster than the scene's energy allows.
        The state is then invalid until `reset` or `load_checkpoint`.
        """
        count = whole_number("count", count)
        if not self._step_callbacks and not self._frame_callbacks:
            self._core.step(count)
            return
        for _ in range(count):
            frame = self.frame
            self._core.step(1)
            self._call(self._step_callbacks)
            if self.frame != frame:
                self._call(self._frame_callbacks)

    def advance(self, frames: int = 1) -> None:
        """Makes `frames` frames. Raises as `step`."""
        frames = whole_number("frames", frames)
        if self._step_callbacks:
            for _ in range(frames):
                self.step(self.substeps)
        elif not self._frame_callbacks:
            self._core.advance(frames)
        else:
            for _ in range(frames):
                self._core.advance(1)
                self._call(self._frame_callbacks)

    def run(self, frames: int | None = None, progress: bool = False) -> None:
        """Makes `frames` frames; None: to the end of the scene's.

        progress: shows a bar, if the package tqdm is installed.
        """
        if frames is None:
            frames = max(0, self.scene.simulation.frames - self.frame)
        if not progress:
            self.advance(frames)
            return
        for _ in frames_with_bar(whole_number("frames", frames)):
            self.advance(1)

    def on_step(self, callback: Callback) -> Callback:
        """Has `callback(simulator)` called after every step. Works as a decorator."""
        check_function("callback", callback)
        self._step_callbacks.append(callback)
        return callback

    def on_frame(self, callback: Callback) -> Callback:
        """Has `callback(simulator)` called after every frame. Works as a decorator."""
        check_function("callback", callback)
        self._frame_callbacks.append(callback)
        return callback

    def remove_callback(self, callback: Callable[[Simulator], object]) -> None:
        """No longer calls it. Raises ValueError if it is none of the callbacks."""
        for callbacks in (self._step_callbacks, self._frame_callbacks):
            if callback in callbacks:
                callbacks.remove(callback)
                return
        raise ValueError("this is no callback of the simulator")

    def reset(self) -> None:
        """Returns to the start: hands, forces, pins, attachments and vertices of programs are gone. Allowed after Diverged."""
        self._core.reset()
        self._forget_changes()

    @property
    def frame(self) -> int:
        """Completed frames; 0 is the start."""
        return self._core.frame

    @property
    def time(self) -> float:
        """[s]"""
        return self._core.time

    @property
    def substeps(self) -> int:
        """Steps per frame."""
        return self._core.substeps

    @property
    def step_size(self) -> float:
        """[s]"""
        return self._core.step_size

    @property
    def backend(self) -> str:
        """"gl" or "cpu"."""
        return self._core.backend

    @property
    def device(self) -> str:
        """Name of the GPU, or of the CPU's instruction set."""
        return self._core.device

    # State: nodes of all bodies, one body after the other, in the order of the scene

    @property
    def positions(self) -> Array:
        """[m], shape (nodes, 3), float32. A view; see the class."""
        return self._core.positions()

    @property
    def velocities(self) -> Array:
        """[m/s], shape (nodes, 3), float32. A view; see the class."""
        return self._core.velocities()

    @property
    def rest_positions(self) -> Array:
        """Where the scene places the nodes at the start [m], shape (nodes, 3), float32. Never changes."""
        return self._core.rest_positions()

    @property
    def masses(self) -> Array:
        """[kg], shape (nodes,), float32. `set_material` alone changes them."""
        return self._core.masses()

    @property
    def faces(self) -> npt.NDArray[np.uint32]:
        """Nodes of the surfaces' triangles, counter-clockwise from outside, shape (faces, 3). Never changes."""
        return self._core.faces()

    @property
    def tets(self) -> npt.NDArray[np.uint32]:
        """Nodes of the tets, shape (tets, 4). Never changes."""
        return self._core.tets()

    # Forces

    @property
    def contact_forces(self) -> Array:
        """The force of contacts on each node, normal and friction [N], shape (nodes, 3); (0, 3) without contact."""
        return self._core.contact_forces()

    @property
    def contact_friction(self) -> Array:
        """The part of `contact_forces` that is friction [N], the same shape."""
        return self._core.contact_friction()

    @property
    def holding_forces(self) -> Array:
        """What pins and handles exert on each node [N], shape (nodes, 3); (0, 3) if there are none."""
        return self._core.holding_forces()

    def statistics(self) -> dict[str, Any]:
        """Measures the present state: energies, momentum, contacts, with the keys of `gelatin run --stats`.

        Raises Diverged if the bodies have more energy than the start, gravity and loads explain.
        """
        return self._core.statistics()

    def set_material(self, name: str, **fields: Any) -> None:
        """Changes fields of a material, which are those of `gelatin.Material`. It takes as long as making the simulator.

        Raises InvalidInput for a material that there is not, or values that are not allowed.
        """
        found = [material for material in self.scene.materials if material.name == name]
        if not found:
            raise InvalidInput(f"there is no material '{name}'")
        changed = dataclasses.replace(found[0], **fields)
        self._core.set_material(changed)
        materials = [changed if material is found[0] else material for material in self.scene.materials]
        self.scene = dataclasses.replace(self.scene, materials=materials)
        self._objects = self._read_objects()

    def set_collider_vertices(self, collider: str, vertices: npt.ArrayLike) -> None:
        """Where the vertices of a collider with `AnimationByProgram` are to be when a frame's time from now has passed.

        They go there at even speed, and stay there until another call: call it before each `advance(1)`. `reset` puts them back
        to where the shape has them. Checkpoints have them.

        collider: its name.
        vertices: those of its shape, in its order, before scale, rotation, position and keyframes place it [m], shape
            (vertices, 3). For a mesh in memory they are as many as its `vertices`, for a file as many as in the file.

        Raises InvalidInput for a collider that there is not or that no program moves, for another number of vertices, and for
        numbers that are not finite; TypeError for what is no array of numbers.
        """
        self._core.set_collider_vertices(text("collider", collider), vectors("vertices", vertices, "vertices"))

    # Attachments

    def attach(
        self,
        object: Union[str, Object, Attachment],
        to: Union[str, Object, Collider] = "",
        where: Attached | None = None,
        **fields: Any,
    ) -> int:
        """Attaches an object from now on, as `Scene.add_attachment` does at the start. `reset` removes it. Checkpoints have it.

        It may have the name of a broken one that `attach` has made: that one is then called by its place.

        object: its name, or itself; or a whole `gelatin.Attachment`.
        to, where: regions, points and lines are in the world at present.

        Returns its place in `attachments`. Raises InvalidInput for an object that there is not, or if no node is there.
        """
        if not isinstance(object, Attachment):
            attachment = attachment_of(object, to, where, **fields)
        elif to == "" and where is None and not fields:
            attachment = object
        else:
            raise InvalidInput("object: a gelatin.Attachment says all of it: no other argument is allowed")
        place = self._core.attach(attachment)
        self._attached += 1
        self._read_attachments()
        return place

    def detach(self, attachment: Union[int, str]) -> None:
        """Breaks an attachment, given by its place in `attachments` or by its name, until `reset`. Raises InvalidInput if there is none."""
        self._core.detach(self._place_of(attachment))

    def set_motor(
        self,
        attachment: Union[int, str],
        motor: JointMotor | None = None,
        *,
        speed: float | None = None,
        position: float | None = None,
        force: float | None = None,
    ) -> None:
        """What the motor of a joint does from now on, until `reset`. Checkpoints have it. It replaces the motor as a whole.

        attachment: its place in `attachments`, or its name.
        motor: all of it; or else
        speed, position, force: as of `gelatin.JointMotor`, [degrees/s], [degrees] and [N m] of a line, [m/s], [m] and [N] of a
            rail and a distance. Without a force: whatever it takes. With a force of 0 it does nothing.

        Raises InvalidInput for an attachment that there is not or that has no coordinate, and for values that are not allowed.
        """
        if motor is None:
            motor = JointMotor(speed, position, force)
        elif not (speed is None and position is None and force is None):
            raise InvalidInput("motor: a gelatin.JointMotor says all of it: no other argument is allowed")
        self._core.set_motor(self._place_of(attachment), motor)

    def attachments(self) -> list[dict[str, Any]]:
        """For each attachment, in the order of the scene's: `name`, `force` on its object [N] and `is_broken`.

        The force is that at the end of the last step; of a broken one, what broke it. A joint that has a coordinate has `joint`,
        too: `position` [rad] of a line, else [m], `speed` [rad/s] or [m/s], and `effort` of limits, spring and motor, or of what
        keeps a distance [N m] or [N]. A recording has no attachments.
        """
        return self._core.attachments()

    def set_cavity(
        self,
        cavity: Union[int, str],
        *,
        object: str | None = None,
        pressure: float | None = None,
        amount: float | None = None,
    ) -> None:
        """What a cavity has from now on, in place of its keyframes, until `reset`. Checkpoints have it.

        cavity: its place in `cavities`, or its name.
        object: the name of the object that it is in; needed where cavities of several have this name.
        pressure: of the law "constant", above the ambient one [Pa].
        amount: of the law "sealed", as of `gelatin.Cavity`, > 0.

        Raises InvalidInput for a cavity that there is not, and for values that are not allowed.
        """
        self._core.set_cavity(self._cavity_of(cavity, object), pressure, amount)

    def cavities(self) -> list[dict[str, Any]]:
        """For each cavity, object by object: `name`, `object`, `volume` [m^3] and `pressure` above the ambient one [Pa].

        Volumes are those of the end of the last step, and pressures with what `set_cavity` has set since.
        """
        return self._core.cavities()

    def _cavity_of(self, cavity: Union[int, str], object: str | None) -> int:
        """Its place in `cavities`. Raises InvalidInput if there is none of this name, or several."""
        place = None if isinstance(cavity, str) else whole_number("cavity", cavity)
        if place is not None and object is None:
            return place
        all_of_them = [(status["object"], status["name"]) for status in self.cavities()]
        if place is not None:
            if place < len(all_of_them) and all_of_them[place][0] != object:
                raise InvalidInput(f"cavity = {place}: is in '{all_of_them[place][0]}', not in '{object}'")
            return place
        found = [k for k, (owner, name) in enumerate(all_of_them) if name == cavity and object in (None, owner)]
        if len(found) != 1:
            known = ", ".join(f"'{name}' of '{owner}'" for owner, name in all_of_them) or "none"
            what = "is the name of no cavity" if not found else f"is the name of {len(found)} cavities: an object has to be given"
            raise InvalidInput(f"cavity = {cavity!r}: {what}; there is {known}")
        return found[0]

    def _place_of(self, attachment: Union[int, str]) -> int:
        """Of an attachment in `attachments`, by its name. Raises InvalidInput if there is none."""
        if isinstance(attachment, str):
            names = [status["name"] for status in self.attachments()]
            if attachment not in names:
                known = f"there is {', '.join(names)}" if names else "there is none"
                raise InvalidInput(f"attachment = {attachment!r}: is not the name of an attachment; {known}")
            attachment = names.index(attachment)
        return whole_number("attachment", attachment)

    # Pictures

    def render(
        self,
        width: int = 1280,
        height: int = 720,
        *,
        quality: Literal["auto", "high", "fast"] = "auto",
        camera: Camera | None = None,
        overlays: Union[str, Sequence[str]] = (),
    ) -> Picture:
        """Draws the present state, as `gelatin run` does: shape (height, width, 3), uint8. Notebooks show it.

        width, height: [pixels]
        quality: "fast" is light at each vertex, about a tenth of the time on software drivers.
        camera: None: the scene's, or one that shows all of it.
        overlays: as of `gelatin run --overlay`: ["stress", "cut:x"], or one of them.

        OpenGL is needed for this alone. The first picture takes longer: it compiles shaders. Pictures of a simulator belong
        to one thread.

        Raises NoOpenGl if there is none; InvalidInput for a size, a camera or an overlay that is not allowed.
        """
        size = whole_number("width", width), whole_number("height", height)
        return self._core.render(*size, text("quality", quality), camera, texts("overlays", overlays)).view(Picture)

    # Files

    def save_checkpoint(self, file: str | os.PathLike[str]) -> None:
        """Saves the exact state, to continue with the same numbers, but for pins of `Body.pin`, which it does not have.

        The file is written completely or not at all. Raises SystemError.
        """
        self._core.save_checkpoint(path("file", file))

    def load_checkpoint(self, file: str | os.PathLike[str], frame: int | None = None) -> None:
        """Continues from a saved state, bit for bit, or from a frame of a recording.

        frame: its number in the recording; None: the last one.

        Raises InvalidInput for a file of another scene, or a damaged one, and for a frame that is not recorded.
        """
        self._core.load_checkpoint(path("file", file), None if frame is None else whole_number("frame", frame))
        self._attached += len(self.attachments()) - len(self.scene.attachments)
        self._read_attachments()

    def record(self, file: str | os.PathLike[str], every: int = 1) -> Recorder:
        """Records the present frame, and in a `with` block every frame, or every so many, and the last one.

        >>> with sim.record("run.gel"):
        ...     sim.advance(100)

        `gelatin.play`, and `gelatin render`, `export` and `view` take the file. Frames are kept to the last bit; what is
        written before a crash can be read. Frames ascend: after `reset`, or an earlier checkpoint, another recording begins.

        Raises SystemError if it cannot be written; in the block, InvalidInput for a frame that is not after those recorded.
        """
        return Recorder(self, file, every)

    def _read_attachments(self) -> None:
        """Those of programs, by the names that they have now."""
        present = cast("list[Attachment]", self._core.scene_attachments())
        own = len(present) - self._attached
        self.scene = dataclasses.replace(self.scene, attachments=[*self.scene.attachments[:own], *present[own:]])

    def _forget_changes(self) -> None:
        if self._hands:
            self._hands.clear()
            self._core.set_pulls([])
        for body in self._forced:
            self._core.set_forces(body, np.zeros((0, 3), np.float32))
        self._forced.clear()
        if self._attached:
            self.scene = dataclasses.replace(self.scene, attachments=self.scene.attachments[: -self._attached])
            self._attached = 0

    def _call(self, callbacks: list[Callable[[Simulator], object]]) -> None:
        for callback in list(callbacks):
            callback(self)


class Player(Simulator):
    """A recording. `advance` and `step` go to the next recorded frame, if there is one; what changes it raises InvalidInput.

    All that can be read, measured and drawn of a simulator is as it was in the run.
    """

    def __init__(self, file: str | os.PathLike[str]) -> None:
        core = _gelatin.play(path("file", file))
        self._begin(core, cast(Scene, core.scene()))
        #: the numbers of the recorded frames
        self.frames: list[int] = core.recorded_frames()

    def show(self, frame: int) -> None:
        """Goes to a recorded frame, by its number. Raises InvalidInput if it is not recorded."""
        self._core.show_recorded(whole_number("frame", frame))

    def advance(self, frames: int = 1) -> None:
        """Goes on by recorded frames, to the last one at most, and calls back after each."""
        for _ in range(whole_number("frames", frames)):
            before = self.frame, self.time
            self._core.step(1)
            if (self.frame, self.time) == before:
                break
            self._call(self._step_callbacks)
            self._call(self._frame_callbacks)

    def step(self, count: int = 1) -> None:
        """The same: a step is a recorded frame."""
        self.advance(whole_number("count", count))

    def reset(self) -> None:
        """Returns to the first frame."""
        self._core.reset()


def play(file: str | os.PathLike[str]) -> Player:
    """Opens a recording. Raises InvalidInput if it is none, or is damaged."""
    return Player(file)
