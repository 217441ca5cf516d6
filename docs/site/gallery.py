"""The gallery: each scene of scenes/ with its picture, its own first comment and the commands that show it."""

from links import ROOT

HEAD = """# Gallery

The scenes that come with Gelatin. `gelatin view` shows them in a window, where bodies can be pulled; `gelatin run` films them.
The picture of each is one frame of it, made by `scripts/make_gallery`.
"""


def scenes():
    return sorted((ROOT / "scenes").glob("*.toml"))


def picture(scene):
    return scene.parent / "pictures" / f"{scene.stem}.png"


def first_comment(text):
    """The lines of comment at the begin of a scene file, as one."""
    lines = []
    for line in text.split("\n"):
        if not line.startswith("#"):
            break
        lines.append(line.lstrip("# "))
    return " ".join(lines)


def page():
    parts = [HEAD]
    for scene in scenes():
        path = scene.relative_to(ROOT).as_posix()
        comment = first_comment(scene.read_text(encoding="utf-8"))
        if not comment:
            raise ValueError(f"{path} must begin with a comment that says what it shows")
        if not picture(scene).is_file():
            raise ValueError(f"{path} has no picture: scripts/make_gallery {scene.stem}")
        parts.append(
            f"## {scene.stem.replace('_', ' ').capitalize()}\n\n"
            f"![{scene.stem}](images/scenes/{scene.stem}.png)\n\n{comment}\n\n"
            f"```sh\ngelatin view {path}\ngelatin run {path} --video {scene.stem}.mp4\n```\n\n"
            f"[{path}](sources/{path}.md)\n"
        )
    return "\n".join(parts)
