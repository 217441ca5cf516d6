"""The pages of the programming interfaces: C++ from the comments of include/gelatin/, Python from docstrings."""

import ast
import re

from cpp_headers import read_header

CPP_HEAD = """# C++ API

Made from the headers in `include/gelatin/`, which an installed Gelatin has. [Embedding](embedding.md) is the guide to it. SI units, +y is up.
Everything is in the namespace `gelatin`. What is wrong throws [`InvalidInput`](#invalidinput).
"""
PYTHON_HEAD = """# Python API

Made from the docstrings of `python/gelatin/`. [Python](python.md) is the guide to it. SI units, +y is up.
"""
GROUPS = {  # of the Python page: names of gelatin.__all__, the rest comes last
    "Scenes": "Scene load SimulationSettings CollisionSettings Material MaterialPair SpringKinds Camera",
    "Objects and colliders": "Object Rigid Mesher Part TetAttribute Start Handle Skeleton Keyframe Drag Load Force Traction Pressure Cavity CavityKeyframe Collider Animation AnimationClip AnimationFiles AnimationFrames AnimationByProgram Attachment Attached AttachedPoint AttachedLine AttachedRail AttachedUniversal AttachedDistance JointSpring JointMotor MotorKeyframe",
    "Shapes and regions": "Shape Sphere Box Capsule Text File Mesh Plane Region BoxRegion SphereRegion HalfSpaceRegion",
    "Running": "Simulator Body Hand Batch Recorder",
    "Many runs": "sweep Between Run",
    "Pictures and films": "Picture Film film",
    "Errors": "Error InvalidInput Diverged NoOpenGl GlError SystemError",
}

TAGS = re.compile(r"\s*@(param|throws|pre|post|return)\s+")
TITLES = {"throws": "Throws", "pre": "Requires", "post": "Ensures", "return": "Returns"}
WORD = re.compile(r"`[^`]*`|\bdocs/([\w-]+)\.md\b|~?\b[A-Za-z_]\w*(?:::\w+)*(?:\(\))?")


def _anchors(declarations):
    return {d.name: d.name.lower() for d in declarations if d.kind in ("class", "struct", "enum", "using")}


def _prose(text, anchors):
    """Plain text as Markdown: names of types are links, other names of code are in its type face."""

    def mark(match):
        word = match[0]
        if word.startswith("`"):
            return word
        if match[1]:
            return f"[{match[1].replace('-', ' ')}]({match[1]}.md)"
        owner = word.partition("::")[0]
        if owner in anchors and (owner != word or word != "Mesh"):
            return f"[`{word}`](#{anchors[owner]})"
        return f"`{word}`" if "::" in word or "_" in word or word.endswith("()") else word

    return WORD.sub(mark, re.sub(r"([*<])", r"\\\1", text))


def _doc(text, anchors):
    """A comment as Markdown, with its @tags as a list."""
    first, *rest = TAGS.split(text)
    paragraphs = first.strip().replace("  ", "\n\n")  # an empty line of the comment
    lines = [_prose(paragraphs, anchors), ""]
    for tag, words in zip(rest[::2], rest[1::2]):
        if tag == "param":
            name, _, words = words.partition(" ")
            lines.append(f"- `{name}`: {_prose(words.strip(), anchors)}")
        else:
            lines.append(f"- {TITLES[tag]}: {_prose(words.strip(), anchors)}")
    return "\n".join(lines).strip() + "\n"


def _code(code):
    code = re.sub(r"///<?", "//", code)
    return f"```cpp\n{code.strip()}\n```\n"


def _head_of_class(code):
    return code.partition("{")[0].strip() + ";"


def _parts(declaration, anchors):
    """A declaration at the top of a header; classes member by member, structs as they stand."""
    if declaration.kind == "text":
        yield _doc(declaration.doc, anchors)
        return
    yield f"### {declaration.name}\n"
    yield _doc(declaration.doc, anchors)
    if declaration.kind != "class":
        yield _code(declaration.code)
        return
    yield _code(_head_of_class(declaration.code))
    titled = None
    for member in declaration.members:
        if member.kind == "text":
            continue
        if member.doc and member.name != titled:  # once for all overloads
            titled = member.name
            anchor = f"{declaration.name}-{re.sub(r'[^A-Za-z_]', '', titled)}".lower()
            yield f"#### {titled} {{ #{anchor} }}\n"
        yield _code(member.code)
        if member.doc:
            yield _doc(member.doc, anchors)


def cpp_page(root):
    headers = {f.name: read_header(f.read_text(encoding="utf-8")) for f in sorted((root / "include/gelatin").glob("*.h"))}
    anchors = _anchors([d for declarations in headers.values() for d in declarations])
    parts = [CPP_HEAD]
    order = sorted(headers, key=lambda name: (name not in ("scene.h", "simulator.h"), name))
    for name in order:
        if not headers[name]:
            continue
        parts.append(f"## gelatin/{name}\n")
        for declaration in headers[name]:
            parts += _parts(declaration, anchors)
    return "\n".join(parts)


def _python_names(root):
    for node in ast.parse((root / "python/gelatin/__init__.py").read_text(encoding="utf-8")).body:
        if isinstance(node, ast.Assign) and node.targets[0].id == "__all__":
            return ast.literal_eval(node.value)
    raise ValueError("python/gelatin/__init__.py has no __all__")


def python_page(root):
    names = _python_names(root)
    groups = {title: group.split() for title, group in GROUPS.items()}
    grouped = {name for group in groups.values() for name in group}
    compiled = {"version", "commit"}  # functions of the module in C++, which have no source in Python
    groups["Others"] = [name for name in names if name not in grouped | compiled]
    parts = [PYTHON_HEAD]
    for title, group in groups.items():
        missing = [name for name in group if name not in names]
        if missing:
            raise ValueError(f"docs/site/api_pages.py: gelatin has no {', '.join(missing)}")
        if group:
            parts.append(f"## {title}\n")
            parts += [f"::: gelatin.{name}\n" for name in group]
    parts.append("## Version\n\n`gelatin.version()` is the version, `gelatin.commit()` the commit from which it was built.\n")
    return "\n".join(parts)
