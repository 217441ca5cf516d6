"""The keys of scene files, found in the code that reads them: the calls of TableReader in src/model/scene/, the structs that
they fill, and the checks of validate().

It follows readers from function to function by their names, as a reader of that code does. What it cannot follow is an
error, not a gap.
"""

import re
from dataclasses import dataclass, field

from cpp_headers import MEMBER, read_declarations, read_header

FUNCTION = re.compile(r"^(?:inline )?(?:[\w:<>, ]+?)[ &*](\w+)\(([^;{}]*)\)\s*(?:const )?\{\n(.*?)^\}", re.MULTILINE | re.DOTALL)
METHOD = re.compile(r"^    (?:[\w:<>, ]+?)[ &*](operator\(\)|\w+)\(([^;{}]*)\)\s*const \{\n(.*?)^    \}", re.MULTILINE | re.DOTALL)
LIMIT = re.compile(r'constexpr Limit (k\w+)\{"((?:[^"\\]|\\.)*)"')
CALL = re.compile(
    r"\b(?P<reader>\w+)\.(?P<method>read|read_direction|read_name|read_names|read_two_texts|read_two_points|require|require_one_of|table|tables|find|check)"
    r"\((?P<arguments>(?:[^()]|\((?:[^()]|\([^()]*\))*\))*)\)"
)
NESTED = re.compile(r"(?<![.\w])(?P<function>(?:read|require)_\w+)\((?:std::move\()?\*?(?:std::move\()?\*?(?P<reader>\w+)\b(?!\.)")
OF_CALL = re.compile(r"\b(?P<function>read_\w+)\(\*(?P<reader>\w+)\.table\(\"(?P<key>\w+)\"\)")
ASSIGNED = re.compile(r"(?P<name>\w+)\s*[=:]\s*\*?(?P<reader>\w+)\.tables?\(\"(?P<key>\w+)\"\)")
LOOP = re.compile(r"for \((?:const )?TableReader& (\w+) : (\w+)\)")
SCALAR = re.compile(r"^\s*(double|int|bool|std::string|glm::[di]vec3) (\w+)[;{ ]", re.MULTILINE)
CHOSEN = re.compile(r"^\s*\w+ (\w+) = (\w+::\w+);", re.MULTILINE)
STRINGS = re.compile(r'"((?:[^"\\]|\\.)*)"')
TYPES = {"double": "number", "int": "whole number", "bool": "true or false", "std::string": "text", "std::filesystem::path": "text",
         "glm::dvec2": "two numbers", "glm::dvec3": "[x, y, z]", "glm::ivec3": "three whole numbers"}  # fmt: skip


@dataclass
class Member:
    type: str
    default: str
    doc: str


@dataclass
class Key:
    name: str
    type: str = ""
    default: str = ""
    allowed: str = ""
    doc: str = ""
    choices: list = field(default_factory=list)
    required: bool = False
    alternatives: list = field(default_factory=list)  # of which exactly one must be there
    is_table: bool = False


def read_members(declarations):
    """Members of each struct: {struct: {member: Member}}."""
    structs = {}
    for struct in declarations:
        if struct.kind not in ("struct", "class"):
            continue
        members = structs.setdefault(struct.name, {})
        for d in struct.members:
            code = re.sub(r"\s*//.*", "", d.code).strip()
            found = d.kind == "variable" and MEMBER.match(re.sub(r"\s+", " ", code))
            if not found:
                continue
            for name, brace, equal in re.findall(r"(\w+)(?:(\{[^}]*\})|\s*=\s*([^,;]+))?(?:,\s*|$)", found["names"]):
                default = equal or brace.strip("{}")
                doc = re.sub(r"\s*//[/!]?<?\s?", " ", d.doc).strip()
                members[name] = Member(found["type"].strip(), default, doc)
    return structs


def _split(arguments):
    """Arguments of a call, at the commas outside of brackets."""
    parts, depth, part = [], 0, ""
    for c in arguments:
        depth += (c in "([{") - (c in ")]}")
        if c == "," and depth == 0:
            parts.append(part.strip())
            part = ""
        else:
            part += c
    return [*parts, part.strip()]


def _plain(type_name):
    """The type itself, without const, &, * and the containers around it."""
    name = re.sub(r"\bconst\b|[&*]", "", type_name).strip()
    found = re.fullmatch(r"(?:std::optional|std::vector)<(.*)>", name)
    return _plain(found[1]) if found else name


class Code:
    """The functions, structs and limits that know the keys of scene files."""

    def __init__(self, root):
        folder = root / "src/model/scene"
        texts = [f.read_text(encoding="utf-8") for f in sorted(folder.glob("*.cpp")) + sorted(folder.glob("*.h"))]
        header = (root / "include/gelatin/scene.h").read_text(encoding="utf-8")
        local = [d for text in texts for body in re.findall(r"^struct \w+ \{.*?^\};", text, re.M | re.S) for d in read_declarations(body)]
        self.structs = read_members(local + read_header(header))
        self.limits = {name: allowed.replace('\\"', '"') for text in texts for name, allowed in LIMIT.findall(text)}
        self.functions = {}
        checks = {}
        for text in texts:
            for name, parameters, body in FUNCTION.findall(text):
                self.functions.setdefault(name, []).append((parameters, body))
            for name, parameters, body in FUNCTION.findall(text) + METHOD.findall(text):
                self._note_checks(checks, parameters, body)
        self.allowed = {place: "; ".join(dict.fromkeys(texts)) for place, texts in checks.items()}
        names = (root / "src/model/setting_names.cpp").read_text(encoding="utf-8")
        self.spring_kinds = STRINGS.findall(re.search(r"spring_kind_names\(\)[^{]*\{(.*?)^\}", names, re.S | re.M)[1])

    def _note_checks(self, checks, parameters, body):
        variables = self.variables(parameters, body)
        for call in re.finditer(r"\bchecks_?\.check(_direction|_text)?\(", body):
            arguments = _split(self._rest_of_call(body[call.end() :]))
            owner, member = self.member_of(arguments[1], variables)
            if not owner:
                continue
            limits = re.findall(r"\bk[A-Z]\w+", arguments[2]) if len(arguments) > 2 else []
            texts = [self.limits[limit] for limit in limits]
            if call[1] == "_text":
                texts = ["not empty"]
            if call[1] == "_direction":
                texts = ["not [0, 0, 0]"]
            checks.setdefault((owner, member), []).extend(texts)

    @staticmethod
    def _rest_of_call(text):
        depth = 1
        for i, c in enumerate(text):
            depth += (c == "(") - (c == ")")
            if depth == 0:
                return text[:i]
        raise ValueError(f"a call without an end: {text[:60]}")

    def variables(self, parameters, body):
        """Types of a function's parameters and of the locals that are structs."""
        types = {}
        for parameter in _split(parameters):
            found = re.match(r"(.*?)[ &*](\w+)$", parameter)
            if found:
                types[found[2]] = _plain(found[1])
        for struct, name in re.findall(r"^\s*(?:const )?(\w+)[&*]? (\w+)(?:;|\{|\s=)", body, re.MULTILINE):
            if struct in self.structs:
                types[name] = struct
        for struct, name in re.findall(r"std::vector<(\w+)>& (\w+) =", body):
            types[name] = struct
        for name, struct in re.findall(r"auto\* (\w+) = std::get_if<(\w+)>", body):
            types[name] = struct
        return types

    def member_of(self, expression, variables):
        """(struct, member) that an expression like `object.start.scale` names; (None, None): it is none."""
        made = re.search(r"emplace<(\w+)>\(\)\.(\w+)", expression)
        if made:
            return made[1], made[2]
        expression = re.sub(r"\[\w+\]|^\*|\.emplace\(.*\)|\(\)|\.string|\.filename", "", expression).replace("->", ".")
        first, *path = expression.split(".")
        owner = variables.get(first)
        for member in path[:-1]:
            owner = _plain(self.structs.get(owner, {}).get(member, Member("", "", "")).type)
        if not path or path[-1] not in self.structs.get(owner, {}):
            return None, None
        return owner, path[-1]

    def read(self, function, reader, tables, path):
        """Adds what `function` reads by its parameter `reader` to `tables`: {path: {name: Key}}."""
        for parameters, body in self.functions[function]:
            if "TableReader" in parameters or not parameters.strip() or path == "":
                self._read_body(function, parameters, body, reader, tables, path)

    def _read_body(self, function, parameters, body, reader, tables, path):
        if path == "":
            places = {"reader": ""}
        else:
            own = re.search(r"TableReader>?&? (\w+)", parameters)
            if not own:
                return
            places = {own[1]: path}
        for name, source in LOOP.findall(body):
            if source in places:
                places[name] = places[source]
        for found in ASSIGNED.finditer(body):
            if found["reader"] in places:
                places[found["name"]] = _join(places[found["reader"]], found["key"])
        for call in CALL.finditer(body):
            if call["reader"] in places:
                keys = tables.setdefault(places[call["reader"]], {})
                self._note(keys, call["method"], _split(call["arguments"]), parameters, body[: call.start()])
        for key, allowed in re.findall(r'\w+\.fail\("(\w+)", "must be ([^"]*)"\)', body):
            keys = tables[next(iter(places.values()))]
            keys[key].allowed = keys[key].allowed or allowed
        for found in [*NESTED.finditer(body), *OF_CALL.finditer(body)]:
            if found["reader"] not in places:
                continue
            inner = places[found["reader"]]
            if "key" in found.groupdict():
                inner = _join(inner, found["key"])
            if found["function"] in self.functions and found["function"] != function:
                self.read(found["function"], found["reader"], tables, inner)

    def _note(self, keys, method, arguments, parameters, before):
        """Notes what a call of a reader says of a key. `before` is the function up to there, the last declaration counts."""
        names = STRINGS.findall(arguments[0])
        if method in ("require", "require_one_of"):
            for name in names:
                key = keys.setdefault(name, Key(name))
                key.required |= method == "require"
                if method == "require_one_of":
                    key.alternatives = names
            return
        if not names:
            raise ValueError(f"a key that is no text: {method}({', '.join(arguments)})")
        key = keys.setdefault(names[0], Key(names[0]))
        if method == "check":
            key.allowed = self.limits[arguments[1]]
        elif method == "read_names":
            key.type, key.choices = "list of names", self.spring_kinds
        elif method == "read_two_texts":
            key.type = "two texts"
        elif method == "read_two_points":
            key.type, key.allowed = "[[x, y, z], [x, y, z]]", f"two {STRINGS.findall(arguments[1])[0]}"
        elif method in ("table", "tables"):
            key.is_table, key.type = True, "table" if method == "table" else "list of tables"
        if method == "find" or method not in ("read", "read_direction", "read_name", "read_names", "table", "tables"):
            return
        if len(arguments) < 2:
            return
        variables = self.variables(parameters, before)
        owner, member = self.member_of(arguments[1], variables)
        if not owner:  # by way of a local variable: the struct that is filled has a member of this name
            owner, member = next(((s, names[0]) for s in variables.values() if names[0] in self.structs.get(s, {})), (None, None))
        default = dict(CHOSEN.findall(before)).get(arguments[1], "")
        if owner:
            found = self.structs[owner][member]
            default = found.default
            key.type = key.type or TYPES.get(_plain(found.type), "")
            key.doc = _both(key.doc, found.doc)
            key.allowed = _both(key.allowed, self.allowed.get((owner, member), ""))
        else:
            key.type = key.type or TYPES.get({name: kind for kind, name in SCALAR.findall(before)}.get(arguments[1], ""), "")
        if len(arguments) > 2:
            pairs = re.findall(r'\{\s*"(\w+)",\s*(\w+::\w+)\s*\}', arguments[2])
            key.type, key.choices = "name", [name for name, _ in pairs]
            default = next((f'"{name}"' for name, value in pairs if value == default), "")
        if default not in ("", "{}", "std::nullopt"):
            key.default = _both(key.default, default)


def _both(first, second):
    """What two shapes say of a key that both have."""
    return first if not second or second == first else f"{first} or {second}" if first else second


def _join(path, key):
    return f"{path}.{key}" if path else key


def read_tables(root):
    """All keys that scene files may have: {path of the table: {name: Key}}; "" is the file itself."""
    code, tables = Code(root), {}
    code.read("read_scene", "reader", tables, "")
    return tables


def _default(key):
    if key.required:
        return "required"
    if key.alternatives:
        return "one of these" if len(key.alternatives) > 1 else "required"
    if not key.default:
        return ""
    text = key.default
    if key.type == "[x, y, z]" and re.fullmatch(r"-?[\d.]+", text):
        text = ", ".join([text] * 3)
    if key.type == "three whole numbers":
        text = ", ".join([text] * 3)
    text = re.sub(r"(\d+)\.0\b", r"\1", text)
    return f"`[{text}]`" if "," in text else f"`{text}`"


def _title(path):
    lists = ("material", "object", "collider", "object.part", "object.handle", "object.load", "rigid", "rigid.load", "collision.pair", "attachment")
    return f"[[{path}]]" if path in lists else f"[{path}]"


HEAD = """# All keys of scene files

Made from the code that reads scene files, and from the checks of their values. [Scene files](scene-files.md) explains them. A table in
another one is written as `[object.mesher]` here; in a file `mesher = { ... }` says the same. The last column is the comment of
the field that the key fills, in [include/gelatin/scene.h](api-cpp.md#gelatinsceneh).
"""


def page(root):
    parts = [HEAD]
    for path, keys in read_tables(root).items():
        if not path:
            continue
        parts += [f"## {_title(path)}\n", "| key | value | default | allowed | |", "| --- | --- | --- | --- | --- |"]
        for key in sorted(keys.values(), key=lambda key: not key.required):
            value = " or ".join(f'`"{name}"`' for name in key.choices) or key.type
            if key.is_table:
                value = f"[{key.type}](#{re.sub(r'[^a-z_]', '', _join(path, key.name))})"
            cells = [f"`{key.name}`", value, _default(key), key.allowed, re.sub(r"([<*])", r"\\\1", key.doc)]
            parts.append("| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |")
        parts.append("")
    return "\n".join(parts)
