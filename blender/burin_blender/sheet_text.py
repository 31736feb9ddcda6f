"""Pieces of style sheets as text: TOML, and expressions of the sheet's language."""

import json


def quoted(text):
    """A TOML string; control characters are escaped."""
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def list_text(texts):
    return "[" + ", ".join(quoted(text) for text in texts) + "]"


def number_text(number):
    """A number as expressions take it: decimal, a negative one in brackets."""
    text = repr(round(float(number), 6))
    return f"({text})" if text.startswith("-") else text


def color_list(color):
    """A colour as a setting or a key takes it: linear."""
    return "[" + ", ".join(repr(round(float(c), 6)) for c in color[:3]) + "]"


def color_call(color):
    """A colour as an expression."""
    return "rgb(" + ", ".join(number_text(c) for c in color[:3]) + ")"


def key(name, value):
    """`name = value`, where the value is an expression: a text, or a number if it is one."""
    try:
        return f"{name} = {float(value)!r}"
    except ValueError:
        return f"{name} = {quoted('=' + value)}"


class SheetText:
    """A style sheet that is written bit by bit: groups, ramps and lets in any order, then sets and styles."""

    def __init__(self, top):
        self.top = ["style_version = 1", *top]
        self.groups, self.lets, self.ramps, self.blocks = [], [], [], []

    def group(self, kind, names):
        """A group of `objects` or `materials`, whose names mean nothing in patterns; gives its name."""
        name = f"group_{len(self.groups)}"
        self.groups.append(f"{name} = {{ {kind} = {list_text(names)} }}")
        return name

    def let(self, expression):
        """A value that has a name; gives the name."""
        name = f"let_{len(self.lets)}"
        self.lets.append(key(name, expression))
        return name

    def ramp(self, stops, between):
        """A curve through (place, value), where values are numbers or colours; gives its name."""
        name = f"ramp_{len(self.ramps)}"
        texts = (f"[{place!r}, {color_list(value) if isinstance(value, tuple) else repr(value)}]"
                 for place, value in stops)
        self.ramps.append(f"[ramp.{name}]\nstops = [{', '.join(texts)}]\nbetween = {quoted(between)}\n")
        return name

    def table(self, head, entries):
        self.blocks.append("\n".join([head, *entries, ""]))

    def text(self):
        parts = ["\n".join(self.top) + "\n"]
        if self.groups:
            parts.append("\n".join(["[groups]", *self.groups, ""]))
        if self.lets:
            parts.append("\n".join(["[let]", *self.lets, ""]))
        return "\n".join(parts + self.ramps + self.blocks)
