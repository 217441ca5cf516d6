"""What MkDocs calls while it builds the site (mkdocs.yml): adds the pages that are made from other files of the
repository, and turns its Markdown, as GitHub and editors read it, into that of the site's renderer."""

import html
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import mermaidx
from latex2mathml.converter import convert as to_mathml
from mkdocs.structure.files import File

import api_pages
import gallery
import links
import scene_keys
from links import ROOT

FORMULA = re.compile(r'<(span|div) class="arithmatex">\\[(\[](.*?)\\[)\]]</\1>', re.DOTALL)
DIAGRAM = re.compile(r"^```mermaid\n(.*?)^```$", re.DOTALL | re.MULTILINE)
PLACE_OF_DIAGRAM = re.compile(r'<div class="diagram" id="(\d+)"></div>')

origins = {}  # pages that are files elsewhere in the repository: their paths there
diagrams = []


def decisions_page():
    """All decisions, by number, with what no longer holds of them."""
    lines = ["# Decisions", "", "Choices that had serious alternatives, with what was measured.", ""]
    for file in sorted((ROOT / "docs/decisions").glob("*.md")):
        title, status = re.match(r"# (?:\d+[:.]?\s*)?(.*)\s+Status: (.*)", file.read_text(encoding="utf-8")).groups()
        lines.append(f"- [{file.name[:4]}]({file.name}): {title}" + ("" if status == "holds." else f" ({status[:-1]})"))
    return "\n".join(lines) + "\n"


def made_pages():
    return {
        "gallery.md": gallery.page(),
        "scene-keys.md": scene_keys.page(ROOT),
        "api-cpp.md": api_pages.cpp_page(ROOT),
        "api-python.md": api_pages.python_page(ROOT),
        "decisions/index.md": decisions_page(),
    }


def on_files(files, config):
    origins.clear()
    diagrams.clear()
    for uri, text in made_pages().items():
        files.append(File.generated(config, uri, content=text))
    for scene in gallery.scenes():
        files.append(
            File.generated(config, f"images/scenes/{scene.stem}.png", abs_src_path=str(gallery.picture(scene)))
        )
    files.append(File.generated(config, "site.css", abs_src_path=str(ROOT / "docs/site/site.css")))
    origins.update({place: path for path, place in links.PAGES.items() if path.endswith(".md")})
    for file in files.documentation_pages():
        if not file.generated_by:
            origins[file.src_uri] = f"docs/{file.src_uri}"

    wanted = [scene.relative_to(ROOT).as_posix() for scene in gallery.scenes()]
    for path in origins.values():
        wanted += links.targets((ROOT / path).read_text(encoding="utf-8"), path)
    while wanted:
        path = wanted.pop()
        place = links.place_in_site(path)
        if not place or place in origins or files.get_file_from_path(place):
            continue
        if Path(path).suffix in links.IMAGES:
            files.append(File.generated(config, place, abs_src_path=str(ROOT / path)))
            continue
        origins[place] = path
        if path.endswith(".md"):
            wanted += links.targets(links.source_page(path), path)
    for place, path in origins.items():
        if not files.get_file_from_path(place):
            files.append(File.generated(config, place, content=links.source_page(path)))
    return files


def on_page_markdown(markdown, page, config, files):
    uri = page.file.src_uri
    origin = origins.get(uri)
    if uri.startswith("sources/"):
        page.meta["search"] = {"exclude": True}
        page.meta["hide"] = ["navigation"]
        if not origin.endswith(".md"):
            return markdown
    if origin:
        markdown = links.link_within_site(markdown, origin, uri)

    def place(match):
        diagrams.append(match[1])
        return f'<div class="diagram" id="{len(diagrams) - 1}"></div>'

    return links.separate_lists(DIAGRAM.sub(place, markdown))


def mathml(match):
    return to_mathml(html.unescape(match[2]).strip(), display="block" if match[1] == "div" else "inline")


def svg(match):
    drawn = mermaidx.render(diagrams[int(match[1])]).svg
    drawn = drawn if isinstance(drawn, str) else drawn()
    return f'<div class="diagram">{drawn.replace("my-svg", "diagram-" + match[1])}</div>'


def on_page_content(content, page, config, files):
    return PLACE_OF_DIAGRAM.sub(svg, FORMULA.sub(mathml, content))
