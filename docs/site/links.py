"""Where the files of the repository are in the site, and Markdown as the site's renderer wants it.

The pages link one another and source files by relative paths, as a reader of the repository needs it. In the site a source
file that is linked gets a page that shows it.
"""

import posixpath
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

# Files and folders that have pages of other names or places than in docs/.
PAGES = {
    "README.md": "index.md",
    "CONTRIBUTING.md": "contributing.md",
    "CHANGELOG.md": "changelog.md",
    "docs/decisions": "decisions/index.md",
    "scenes": "gallery.md",
    "include/gelatin": "api-cpp.md",
}
LANGUAGES = {".h": "cpp", ".inl": "cpp", ".cpp": "cpp", ".py": "python", ".toml": "toml", ".glsl": "glsl", ".comp": "glsl"}
IMAGES = {".png", ".gif", ".svg", ".jpg"}

TARGET = re.compile(r"(?<=\]\()([^)\s]+)(?=\))")
FENCE = re.compile(r"^\s*(```|~~~)")
LIST_ITEM = re.compile(r"^\s*([-*]|\d+\.) ")


def outside_fences(text, change):
    """`text` with `change` applied to each line that is not in a block of code."""
    lines, fenced = [], False
    for line in text.split("\n"):
        if FENCE.match(line):
            fenced = not fenced
        elif not fenced:
            line = change(line)
        lines.append(line)
    return "\n".join(lines)


def place_in_site(path):
    """Where a file of the repository, by its path there, is in the site; None: it is no file, or not shown."""
    if path in PAGES:
        return PAGES[path]
    if path.startswith("docs/") and (ROOT / path).is_file():
        return path.removeprefix("docs/")
    if not (ROOT / path).is_file():
        return None
    keeps_name = Path(path).suffix in IMAGES or path.endswith(".md")
    return f"sources/{path}" if keeps_name else f"sources/{path}.md"


def targets(text, origin):
    """The files of the repository that `text` links, which stands in the file `origin` there."""
    found = []

    def note(line):
        found.extend(path for path, _ in map(lambda t: resolve(t, origin), TARGET.findall(line)) if path)
        return line

    outside_fences(text, note)
    return found


def resolve(target, origin):
    """(path in the repository or None for what is none, anchor with its #)"""
    path, hash_sign, anchor = target.partition("#")
    if not path or re.match(r"[a-z]+:", path):
        return None, hash_sign + anchor
    return posixpath.normpath(posixpath.join(posixpath.dirname(origin), path)), hash_sign + anchor


def link_within_site(text, origin, page):
    """`text` of `origin` with its links rewritten for `page`, its place in the site."""

    def rewrite(match):
        path, anchor = resolve(match[1], origin)
        place = place_in_site(path) if path else None
        return posixpath.relpath(place, posixpath.dirname(page)) + anchor if place else match[0]

    return outside_fences(text, lambda line: TARGET.sub(rewrite, line))


def separate_lists(text):
    """With an empty line before each list that follows a paragraph, which Python-Markdown wants."""
    lines, fenced, first = [], False, ""  # the first line since the last empty one
    for line in text.split("\n"):
        fenced ^= bool(FENCE.match(line))
        if not fenced and LIST_ITEM.match(line) and first and not LIST_ITEM.match(first):
            lines.append("")
            first = ""
        first = (first or line) if line.strip() else ""
        lines.append(line)
    return "\n".join(lines)


def source_page(path):
    """A page that shows a source file."""
    text = (ROOT / path).read_text(encoding="utf-8")
    if path.endswith(".md"):
        return text
    language = LANGUAGES.get(Path(path).suffix, "text")
    return f"# {path}\n\n````` {{ .{language} }}\n{text.rstrip()}\n`````\n"
