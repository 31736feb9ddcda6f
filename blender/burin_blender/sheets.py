"""Style sheets that a user chooses, and their parameters: those that come with the program, texts and files."""

import functools
import json
import os
import re
import shutil
import subprocess

import bpy
from bpy.props import EnumProperty, PointerProperty, StringProperty

from . import core, library
from .object_rules import ObjectRules
from .sheet_text import color_list

try:
    import tomllib
except ImportError:  # Python before 3.11: sheets are drawn, but their parameters cannot be shown
    tomllib = None

# Sheets of the program, for when the program itself is not there.
BUILT_IN = ("technical", "blueprint", "comic", "patent", "wireframe", "instructions", "pencil", "architect", "strata")
SECONDS_TO_ANSWER = 10
LENGTH = re.compile(r"\s*([-+0-9.eE]+)\s*(px|mm|pt|%|world)\s*")


class SheetError(core.BurinError):
    """A style sheet cannot be read; the text says which and why."""


class Parameter:
    """A parameter of a sheet: a number, a length in `unit`, or a colour."""

    def __init__(self, name, value, low=None, high=None):
        self.name, self.low, self.high, self.unit = name, low, high, ""
        self.is_color = not isinstance(value, (int, float)) and LENGTH.fullmatch(str(value)) is None
        if self.is_color:
            self.value = linear_color(value)
        elif isinstance(value, str):
            number, self.unit = LENGTH.fullmatch(value).groups()
            self.value = float(number)
        else:
            self.value = float(value)

    def setting(self, value):
        """A value as burin_set() takes it."""
        text = color_list(value) if self.is_color else f"{float(value)!r}{self.unit}"
        return f"style.{self.name}={text}"


def linear_color(value):
    """Three linear numbers, of `#rrggbb` or of a list."""
    if not isinstance(value, str):
        return tuple(float(c) for c in value)
    codes = [int(value[i:i + 2], 16) / 255 for i in (1, 3, 5)]
    return tuple(c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in codes)


def program():
    """The path of the program `burin` that belongs to the library, or None: some things only the program tells."""
    named = [core.preference(), os.environ.get("BURIN", ""), shutil.which("burin") or ""]
    try:
        folder = os.path.dirname(os.path.realpath(library.find_library(core.preference())))
        named += [os.path.join(folder, *up, "burin") for up in ((), ("..", "bin"), ("..", "..", "bin"))]
    except library.LibraryError:
        pass
    for path in named:
        path = os.path.join(path, "burin") if os.path.isdir(path) else path
        if os.path.isfile(path) and ".so" not in os.path.basename(path) and os.access(path, os.X_OK):
            return path
    return None


def answer(*arguments):
    """What the program prints, or None."""
    path = program()
    if path is None:
        return None
    # Blender's own settings for Python are none of the program's business.
    environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    try:
        done = subprocess.run([path, *arguments], capture_output=True, env=environment, stdin=subprocess.DEVNULL,
                              timeout=SECONDS_TO_ANSWER)
    except (OSError, subprocess.TimeoutExpired):
        return None
    return done.stdout.decode(errors="replace") if done.returncode == 0 else None


@functools.lru_cache(maxsize=None)
def known_sheets():
    """(name, summary) of the sheets that can be had by name."""
    text = answer("styles", "--json")
    try:
        return tuple((s["name"], s["summary"]) for s in json.loads(text)["styles"])
    except (KeyError, TypeError, ValueError):
        return tuple((name, "") for name in BUILT_IN)


@functools.lru_cache(maxsize=None)
def text_of_name(name):
    """The text of a sheet that can be had by name; None if the program is not there to tell it."""
    return answer("styles", name)


@functools.lru_cache(maxsize=None)
def sheet_items():
    """For an EnumProperty: Blender wants its texts to live on."""
    return [(name, name.replace("_", " ").title(), summary) for name, summary in known_sheets()]


@functools.lru_cache(maxsize=8)
def text_of_file(path, changed):
    """The text of a file, read again when it has changed."""
    with open(path, encoding="utf-8") as file:
        return file.read()


def sheet_of(settings):
    """The sheet that was chosen, as burin_set_style() takes it. Throws SheetError."""
    if settings.source == "NAME":
        return settings.name_of_sheet
    if settings.source == "TEXT":
        if settings.text is None:
            raise SheetError("no text with a style sheet is chosen (Render properties, Style Sheet)")
        # What has one line counts as a name.
        return settings.text.as_string() + "\n\n"
    if not settings.path:
        raise SheetError("no file with a style sheet is chosen (Render properties, Style Sheet)")
    path = bpy.path.abspath(settings.path)
    try:
        return text_of_file(path, os.stat(path).st_mtime_ns) + "\n\n"
    except (OSError, UnicodeDecodeError) as error:
        raise SheetError(f"style sheet {path}: {error}")


def text_of(settings):
    """The text of the sheet that was chosen; None where it is not known."""
    if settings.source == "NONE":
        return None
    if settings.source == "NAME":
        return text_of_name(settings.name_of_sheet)
    try:
        return sheet_of(settings)
    except SheetError:
        return None


@functools.lru_cache(maxsize=16)
def parameters_of_text(text):
    if tomllib is None or text is None:
        return ()
    try:
        table = tomllib.loads(text).get("parameters", {})
        return tuple(Parameter(name, entry["value"], entry.get("min"), entry.get("max")) if isinstance(entry, dict)
                     else Parameter(name, entry) for name, entry in table.items())
    except (AttributeError, KeyError, TypeError, ValueError):  # the library says what is wrong with it
        return ()


def parameters(settings):
    """The parameters of the sheet that was chosen."""
    return parameters_of_text(text_of(settings))


def fits(parameter, value):
    """Whether a value that was kept is one for this parameter."""
    return (hasattr(value, "__len__") and len(value) == 3) if parameter.is_color else isinstance(value, (int, float))


def read_parameters(settings, keep):
    """Makes a slider for each parameter. `keep`: values that are there already stay."""
    values = settings.values
    known = {parameter.name: parameter for parameter in parameters(settings)}
    for name in list(values.keys()):
        if not keep or name not in known or not fits(known[name], values[name]):
            del values[name]
    for name, parameter in known.items():
        if name not in values:
            values[name] = parameter.value
        hints = values.id_properties_ui(name)
        if parameter.is_color:
            hints.update(subtype="COLOR", min=0.0, max=1.0, default=parameter.value)
            continue
        limits = {limit: float(number) for limit, number in (("min", parameter.low), ("max", parameter.high))
                  if number is not None}
        # Sheets allow far more than one wants to drag through.
        soft = {"soft_max": min(limits.get("max", 1e9), max(4 * abs(parameter.value), 1.0))}
        hints.update(default=parameter.value, description=f"In {parameter.unit}" if parameter.unit else "", **limits,
                     **soft)


def plain(value):
    """A value of a parameter as Python has it."""
    return tuple(value) if hasattr(value, "__len__") else float(value)


def parameter_lines(settings):
    """Settings of those parameters that are not as in the sheet."""
    values = settings.values
    found = []
    for parameter in parameters(settings):
        if parameter.name in values and fits(parameter, values[parameter.name]):
            value = plain(values[parameter.name])
            if value != parameter.value:
                found.append(parameter.setting(value))
    return found


def not_drawn(scene):
    """What of objects and materials a sheet of its own has no say about."""
    notes = []
    if ObjectRules(scene):
        notes.append("beside a style sheet Line Art's usage and crease angles of objects count for nothing")
    if any(slot.material is not None and slot.material.burin.use_line_color
           for thing in scene.objects for slot in thing.material_slots):
        notes.append("beside a style sheet line colours of materials count for nothing")
    return notes


def sheet_changed(settings, context):
    read_parameters(settings, keep=False)


class BurinSheetValues(bpy.types.PropertyGroup):
    """Values of the parameters of the sheet, by their names."""


class BurinSheetSettings(bpy.types.PropertyGroup):
    """Which style sheet draws."""

    source: EnumProperty(
        name="Style Sheet", update=sheet_changed,
        items=(("NONE", "None", "Lines look as the panels say"),
               ("NAME", "Preset", "A sheet that comes with Burin, or one of ~/.config/burin/styles"),
               ("TEXT", "Text", "A text of this file"), ("FILE", "File", "A file")))
    name_of_sheet: EnumProperty(name="Preset", update=sheet_changed, items=lambda self, context: sheet_items())
    text: PointerProperty(name="Text", type=bpy.types.Text, update=sheet_changed)
    path: StringProperty(name="File", subtype="FILE_PATH", update=sheet_changed)
    values: PointerProperty(type=BurinSheetValues)


CLASSES = (BurinSheetValues, BurinSheetSettings)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
    for function in (known_sheets, text_of_name, sheet_items):
        function.cache_clear()
