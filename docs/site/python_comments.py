"""An extension of griffe, which reads Python for the site: comments `#:` above a field are its documentation, and a line
`name: text` of a docstring describes a parameter, and `>>>` begins an example."""

import re

from griffe import Docstring, Extension

EXAMPLE = re.compile(r"(?:^>>> .*\n?)+", re.MULTILINE)
PARAMETER = re.compile(r"^(\w+(?:, \w+)*): ", re.MULTILINE)


class Comments(Extension):
    def on_attribute(self, *, attr, **kwargs):
        if attr.docstring or not attr.lineno:
            return
        lines = attr.lines_collection[attr.filepath]
        above = attr.lineno - 2
        comment = []
        while above >= 0 and lines[above].strip().startswith("#:"):
            comment.insert(0, lines[above].strip()[2:].strip())
            above -= 1
        if comment:
            attr.docstring = Docstring(" ".join(comment), parent=attr)

    def on_object(self, *, obj, **kwargs):
        if obj.docstring:
            text = PARAMETER.sub(r"- `\1`: ", obj.docstring.value)
            obj.docstring.value = EXAMPLE.sub(lambda m: f"```python\n{m[0].replace('>>> ', '').rstrip()}\n```\n", text)
