"""Reads the declarations of a C++ header as this project writes them, each with its comment of `///` lines.

It knows clang-format's output and no more: declarations begin on lines of their own and end with `;` or `}`.
"""

import re
from dataclasses import dataclass, field

NAMESPACE = re.compile(r"^namespace [\w:]+ \{\n(.*?)^\}  // namespace", re.DOTALL | re.MULTILINE)
LABEL = re.compile(r"^(public|private|protected):$")
FORWARD = re.compile(r"^(class|struct) \w+;")
MEMBER = re.compile(r"^(?P<type>[\w:<>, ]+?[>\w]) (?P<names>\w[^()]*?);$", re.DOTALL)


@dataclass
class Declaration:
    kind: str  # "class", "struct", "enum", "using", "function", "variable", "text"
    name: str
    code: str  # as it stands in the header, without GELATIN_API
    doc: str  # its comment in one line; empty lines are kept
    members: list = field(default_factory=list)  # of a class or struct: what is public


def _kind_and_name(code):
    for kind, pattern in [
        ("enum", r"enum (?:class |struct )?(\w+)"),
        ("class", r"(?:template <[^>]*>\s*)?class (\w+)"),
        ("struct", r"(?:template <[^>]*>\s*)?struct (\w+)"),
        ("using", r"using (\w+)"),
        ("function", r"[^={]*?(operator\s*\S{1,2}|~?\w+)\("),
        ("variable", r"[^={]*?(\w+)\s*(?:[={;,]|$)"),
    ]:
        found = re.match(pattern, code)
        if found:
            return kind, found[1]
    return "text", ""


def _without_comments(line):
    return re.sub(r"//.*", "", line)


def _ends(code):
    bare = "\n".join(map(_without_comments, code.split("\n"))).rstrip()
    is_whole = all(bare.count(a) == bare.count(b) for a, b in ("()", "{}"))
    return is_whole and bare.endswith((";", "}"))


def _dedent(text):
    return re.sub(r"^    ", "", text, flags=re.MULTILINE)


def _members(kind, code):
    body = code[code.index("{") + 1 : code.rindex("}")]
    return list(read_declarations(_dedent(body), is_public=kind == "struct"))


def read_declarations(text, is_public=True):
    """The public declarations of a namespace's or class's body, in order."""
    doc, lines = [], []
    last = Declaration("text", "", "", "")

    def text_alone():
        if doc:
            yield Declaration("text", "", "", " ".join(doc))
            doc.clear()

    for line in text.split("\n"):
        stripped = line.strip()
        if not lines and (not stripped or stripped.startswith("// ")):
            yield from text_alone()
        elif not lines and LABEL.match(stripped):
            is_public = stripped == "public:"
        elif not lines and stripped.startswith("///<"):  # goes on behind the line above
            last.code += "\n" + line
            last.doc += " " + stripped[4:].strip()
        elif not lines and stripped.startswith("///"):
            doc.append(stripped[3:].strip())
        else:
            lines.append(line)
            code = "\n".join(lines)
            if not _ends(code):
                continue
            trailing = stripped.partition("///<")[2].strip()
            if not FORWARD.match(stripped) and is_public and not stripped.startswith("friend "):
                code = code.replace("GELATIN_API ", "")
                kind, name = _kind_and_name(code)
                members = _members(kind, code) if kind in ("class", "struct") else []
                last = Declaration(kind, name, code, " ".join(doc + [trailing] * bool(trailing)), members)
                yield last
            doc, lines = [], []
    yield from text_alone()


def read_header(text):
    """The declarations of the namespaces in a header."""
    return [d for body in NAMESPACE.findall(text) for d in read_declarations(body)]
