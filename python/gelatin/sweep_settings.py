"""Which runs a sweep has, and a scene with the settings of one of them."""

from __future__ import annotations

import copy
import dataclasses
import hashlib
import itertools
import json
import os
import re
import zlib
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, Union

import numpy as np

from .animations import AnimationFiles, AnimationFrames, Skeleton
from .errors import InvalidInput
from .objects import Collider, Object
from .scene import Scene, load
from .shapes import File, Mesh

#: Keys of scene files whose fields have other names in Python.
FIELDS = {
    "Scene": {"material": "materials", "object": "objects", "rigid": "objects", "collider": "colliders", "attachment": "attachments"},
    "CollisionSettings": {"pair": "pairs"},
    "Animation": {"clip": "source.name", "files": "source.pattern", "rate": "source.rate"},
    "Object": {"handle": "handles", "load": "loads", "part": "parts", "cavity": "cavities", "mass": "rigid.mass", "inertia": "rigid.inertia"},
    "Load": {"from": "start", "force": "kind.sum", "traction": "kind.stress", "pressure": "kind.pressure"},
    "Attachment": {
        "region": "where",
        "point": "where.at",
        "line": "where",
        "rail": "where",
        "universal": "where",
        "distance": "where",
    },
    "AttachedUniversal": {"point": "at"},
    "Sphere": {"sphere": "radius"},
    "Box": {"box": "size"},
    "Capsule": {"capsule": "radius"},
    "Plane": {"plane": "normal"},
    "SphereRegion": {"sphere": "center"},
    "HalfSpaceRegion": {"plane": "normal"},
}
PART_OF_KEY = re.compile(r'"([^"]*)"|([^."]+)')
#: Columns of the table that no setting and no statistic may be called.
RESERVED = ("run", "seed", "recording", "error", "warnings", "seconds", "worker")


@dataclasses.dataclass(frozen=True)
class Between:
    """A setting that each seed draws: a number between two, or each number of a vector.

    >>> gelatin.sweep("scene.toml", {"material.jelly.youngs_modulus": gelatin.Between(1e4, 1e6, log=True)}, seeds=100, out="runs")
    """

    #: a number or a list of them; of two integers, integers are drawn, both ends included
    low: Any
    high: Any
    #: whether the logarithms are evenly distributed; both ends > 0
    log: bool = False

    def __post_init__(self) -> None:
        low, high = np.asarray(self.low), np.asarray(self.high)
        if low.dtype.kind not in "iuf" or high.dtype.kind not in "iuf" or low.shape != high.shape or low.ndim > 1:
            raise InvalidInput(f"Between: {self.low!r}, {self.high!r}: must be two numbers, or two lists of as many")
        if not (np.isfinite(low).all() and np.isfinite(high).all() and (low <= high).all()):
            raise InvalidInput(f"Between: {self.low!r}, {self.high!r}: must be finite, the lower one first")
        if self.log and not (low > 0).all():
            raise InvalidInput(f"Between: {self.low!r}: must be greater than 0 with log")

    def draw(self, seed: int, key: str) -> Any:
        """The value of this seed. Another key has an independent one."""
        random = np.random.default_rng([seed, zlib.crc32(key.encode())])
        low, high = np.asarray(self.low), np.asarray(self.high)
        if self.log:
            drawn: Any = np.exp(random.uniform(np.log(low), np.log(high))).clip(low, high)
        elif low.dtype.kind in "iu" and high.dtype.kind in "iu":
            drawn = random.integers(low, high, endpoint=True)
        else:
            drawn = random.uniform(low, high)
        return np.asarray(drawn).tolist()


@dataclasses.dataclass(frozen=True)
class Plan:
    """A run before it is made."""

    settings: dict[str, Any]
    seed: int | None

    @property
    def name(self) -> str:
        """Twelve hexadecimal digits: the same for the same settings and seed, in whichever call."""
        text = json.dumps([_with_floats(self.settings), self.seed], sort_keys=True)
        return hashlib.sha256(text.encode()).hexdigest()[:12]


def _with_floats(value: Any) -> Any:
    """100000 is the same value as 1e5."""
    if isinstance(value, dict):
        return {key: _with_floats(part) for key, part in value.items()}
    if isinstance(value, list):
        return [_with_floats(part) for part in value]
    return float(value) if isinstance(value, int) and not isinstance(value, bool) else value


def plan_runs(
    vary: Mapping[str, Any], samples: Iterable[Mapping[str, Any]] | None, seeds: Union[int, Iterable[int], None]
) -> list[Plan]:
    """All combinations: each sample with each combination of the values in `vary`, with each seed."""
    choices = {key: _values(key, values) for key, values in vary.items()}
    rows = [{}] if samples is None else [dict(sample) for sample in samples]
    if not rows:
        raise InvalidInput("samples: is empty")
    chosen_seeds = _seeds(seeds)
    plans: dict[str, Plan] = {}
    for row in rows:
        for values in itertools.product(*choices.values()):
            for seed in chosen_seeds:
                drawn = {key: _drawn(key, value, seed) for key, value in {**row, **dict(zip(choices, values))}.items()}
                plan = Plan(drawn, seed)
                plans.setdefault(plan.name, plan)
    return list(plans.values())


def is_drawn(vary: Mapping[str, Any], samples: Iterable[Mapping[str, Any]] | None) -> bool:
    """Whether a seed draws any setting."""
    values = [*vary.values(), *(value for sample in samples or () for value in sample.values())]
    return any(isinstance(value, Between) for value in values)


def _values(key: str, values: Any) -> list[Any]:
    _check_key(key)
    if isinstance(values, Between):
        return [values]
    if isinstance(values, (str, bytes, Mapping)) or not isinstance(values, Iterable):
        raise InvalidInput(f"vary: {key}: must be a list of values, or a gelatin.Between, not {values!r}")
    listed = list(values)
    if not listed:
        raise InvalidInput(f"vary: {key}: has no values")
    return listed


def _check_key(key: Any) -> None:
    if not isinstance(key, str) or not key:
        raise InvalidInput(f"vary: {key!r}: must be the name of a setting")
    if key in RESERVED:
        raise InvalidInput(f"vary: {key}: is a column of every table; a setting needs another name")


def _drawn(key: str, value: Any, seed: int | None) -> Any:
    if isinstance(value, Between):
        if seed is None:
            raise InvalidInput(f"vary: {key}: is drawn by seeds, and there are none: seeds=10, or --seeds 10")
        return value.draw(seed, key)
    return plain(value, key)


def _seeds(seeds: Union[int, Iterable[int], None]) -> list[int | None]:
    if seeds is None:
        return [None]
    if isinstance(seeds, (int, np.integer)) and not isinstance(seeds, bool):
        listed: list[Any] = list(range(int(seeds)))
    elif isinstance(seeds, Iterable) and not isinstance(seeds, str):
        listed = list(seeds)
    else:
        listed = []
    if not listed or not all(isinstance(seed, (int, np.integer)) and seed >= 0 for seed in listed):
        raise InvalidInput(f"seeds: {seeds!r}: must be how many, 1 or more, or a list of integers from 0")
    return [int(seed) for seed in listed]


def plain(value: Any, name: str) -> Any:
    """A value of a table as numbers, texts and lists of these. Raises InvalidInput for anything else."""
    if isinstance(value, (np.ndarray, np.generic)):
        value = value.tolist()
    if isinstance(value, Path):
        return str(value)
    if isinstance(value, (list, tuple)):
        return [plain(part, name) for part in value]
    if value is None or isinstance(value, (bool, int, float, str)):
        return value
    raise InvalidInput(f"{name}: must be a number, a text or a list of these, not {type(value).__name__}")


# Settings of scenes


def scene_with(source: Union[Scene, str], settings: Mapping[str, Any]) -> Scene:
    """The scene of a file, read as `gelatin run --set` does, or a copy of a scene, with some settings changed.

    Raises InvalidInput for a key that there is not, and for a value that is not allowed.
    """
    if isinstance(source, str):
        try:
            return load(source, settings)
        except InvalidInput as problem:
            scene = load(source)
            for key in settings:
                find(scene, key)  # a line with the names that there are, if that was it
            raise InvalidInput(str(problem).replace("--set ", "vary: ", 1)) from None
    scene = copy.deepcopy(source)
    for key, value in settings.items():
        owner, field = find(scene, key)
        setattr(owner, field, value)
    try:
        scene.validate()
    except TypeError as problem:
        raise InvalidInput(f"vary: {problem}") from None
    return scene


def find(scene: Scene, key: str) -> tuple[Any, str]:
    """What a key names, as `material.jelly.density` or `object.0.position`: the object and its field.

    Raises InvalidInput, listing the names that there are.
    """
    parts = [quoted or bare for quoted, bare in PART_OF_KEY.findall(key)]
    owner: Any = None
    value: Any = scene
    field, place = "", ""
    for part in parts:
        if dataclasses.is_dataclass(value):
            names = _names(value)
            if part not in names:
                what = place or "a scene"
                raise InvalidInput(f'vary: {key}: {what} has no "{part}"; it has {", ".join(names)}')
            for field in names[part].split("."):
                owner = value if value is not None else owner
                value = getattr(owner, field, None)
            if not place and part in ("object", "rigid"):  # both are in Scene.objects
                value = [o for o in scene.objects if (o.rigid is not None) == (part == "rigid")]
                if not value:
                    raise InvalidInput(f"vary: {key}: the scene has no [[{part}]]")
        elif _is_list_of_tables(value):
            owner, field, value = None, "", _element(value, part, key, place)
        else:
            raise InvalidInput(f"vary: {key}: {place} is a value, it has no keys")
        place = f"{place}.{part}" if place else part
    if owner is None or dataclasses.is_dataclass(value) or _is_list_of_tables(value):
        below = [str(getattr(e, "name", i)) for i, e in enumerate(value)] if isinstance(value, list) else list(_names(value))
        raise InvalidInput(f"vary: {key}: must name a value, as {place}.{below[0]} does; below it are {', '.join(below)}")
    if field not in {f.name for f in dataclasses.fields(owner)}:
        kind, missing = parts[-3], parts[-1]
        other = f"is a {type(owner).__name__.lower()}" if kind == "load" else f"has no {missing}"
        raise InvalidInput(f"vary: {key}: this {kind} {other}")
    return owner, field


def _names(value: Any) -> dict[str, str]:
    """The keys of scene files for a dataclass, and its fields that they name."""
    renamed = FIELDS.get(type(value).__name__, {})
    hidden = {field.partition(".")[0] for field in renamed.values()} | {"line", "pins_line", "name"}
    own = [field.name for field in dataclasses.fields(value) if field.name not in hidden]
    if isinstance(value, Scene):
        own.remove("file")
    return {**{name: name for name in own}, **renamed}


def _is_list_of_tables(value: Any) -> bool:
    return isinstance(value, list) and any(dataclasses.is_dataclass(element) for element in value)


def _element(elements: list[Any], part: str, key: str, place: str) -> Any:
    names = [getattr(element, "name", "") for element in elements]
    if part in names:
        return elements[names.index(part)]
    if part.isdecimal() and int(part) < len(elements):
        return elements[int(part)]
    named = ", ".join(name for name in names if name) or f"{len(elements)}, numbered from 0"
    raise InvalidInput(f'vary: {key}: there is no {place} "{part}"; there are {named}')


# What distinguishes two sweeps


def with_absolute_paths(scene: Scene) -> Scene:
    """A copy whose files are found from any working folder."""
    scene = copy.deepcopy(scene)
    folder = Path(scene.file).parent if scene.file else Path()

    def absolute(file: str | os.PathLike[str]) -> str:
        return str((folder / file).absolute())

    owners: list[Union[Object, Collider]] = [*scene.objects, *scene.colliders]
    for owner in owners:
        if isinstance(owner.shape, File):
            owner.shape.file = absolute(owner.shape.file)
    for collider in scene.colliders:
        if collider.animation and isinstance(collider.animation.source, AnimationFiles):
            collider.animation.source.pattern = absolute(collider.animation.source.pattern)
    for handle in (handle for each in scene.objects for handle in each.handles):
        if handle.skeleton:
            handle.skeleton.file = absolute(handle.skeleton.file)
    return scene


def digest(scene: Scene) -> str:
    """Of all that a scene says, and of its mesh files: equal for equal scenes, wherever they came from."""
    found = hashlib.sha256()
    _add_to_digest(found, with_absolute_paths(scene))
    return found.hexdigest()[:16]


def _add_to_digest(found: Any, value: Any) -> None:
    if isinstance(value, Mesh):
        for part in value.__slots__:
            found.update(np.ascontiguousarray(getattr(value, part), np.float64).tobytes())
    elif isinstance(value, AnimationFrames):
        frames = np.ascontiguousarray(value.frames, np.float64)
        found.update(repr((frames.shape, float(value.rate))).encode() + frames.tobytes())
    elif dataclasses.is_dataclass(value):
        for path in _files_of(value):
            found.update(path.read_bytes() if path.is_file() else str(path).encode())
        found.update(type(value).__name__.encode())
        for field in dataclasses.fields(value):
            if field.name not in ("line", "pins_line", "file", "pattern"):
                _add_to_digest(found, getattr(value, field.name))
    elif isinstance(value, (list, tuple, np.ndarray)):
        found.update(b"[")
        for part in value:
            _add_to_digest(found, part)
        found.update(b"]")
    else:
        is_number = isinstance(value, (int, float, np.number))
        found.update(repr(float(value) if is_number else value).encode() + b",")


def _files_of(value: Any) -> list[Path]:
    """What a scene reads besides its own file."""
    if isinstance(value, (File, Skeleton)):
        return [Path(value.file)]
    if isinstance(value, AnimationFiles):
        pattern = Path(value.pattern)
        return sorted(pattern.parent.glob(pattern.name)) or [pattern]
    return []
