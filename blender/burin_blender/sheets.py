"""Style sheets that a user chooses, presets, texts and files, and their parameters."""

import functools
import os
import re

import bpy
from bpy.props import EnumProperty, PointerProperty, StringProperty

from . import core
from .object_rules import ObjectRules
from .presets import answers, own_files, sheet_items, text_of_file, text_of_name
from .sheet_text import color_list

try:
    import tomllib
except ImportError:  # Python before 3.11: sheets are drawn, but their parameters cannot be shown
    tomllib = None

UNIT = re.compile(r"In (px|mm|pt|%|world)")  # what a slider says
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


def sheet_of(settings):
    """The sheet that was chosen, as burin_set_style() takes it. Throws SheetError."""
    if settings.source == "NAME":
        name = settings.name_of_sheet
        if not name:  # what Blender says of a number that no item has
            raise SheetError("the preset that was chosen is not there (Render properties, Style Sheet)")
        path = own_files().get(name)
        return name if path is None else text_of_path(path)
    if settings.source == "TEXT":
        if settings.text is None:
            raise SheetError("no text with a style sheet is chosen (Render properties, Style Sheet)")
        # Of a text Blender makes no new copy when it is edited. What has one line counts as a name.
        return settings.text.original.as_string() + "\n\n"
    if not settings.path:
        raise SheetError("no file with a style sheet is chosen (Render properties, Style Sheet)")
    return text_of_path(bpy.path.abspath(settings.path))


def text_of_path(path):
    """The text of a file as burin_set_style() takes it. Throws SheetError."""
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


def kept_parameters(values):
    """The parameters that sliders were made for, as the sliders say. They serve where the sheet's text is not known."""
    found = []
    for name in values.keys():
        hints = values.id_properties_ui(name).as_dict()
        # A script's value has no slider: a colour is one without it, but of a number nobody knows the unit.
        if hasattr(values[name], "__len__") or "description" in hints:
            default, unit = hints["default"], UNIT.fullmatch(hints.get("description", ""))
            found.append(Parameter(name, f"{default!r}{unit[1]}" if unit else default, hints["min"], hints["max"]))
    return tuple(found)


def parameters(settings):
    """The parameters of the sheet that was chosen."""
    text = text_of(settings)
    if settings.source != "NONE" and (text is None or tomllib is None):
        return kept_parameters(settings.values)
    return parameters_of_text(text)


def fits(parameter, value):
    """Whether a value that was kept is one for this parameter."""
    return (hasattr(value, "__len__") and len(value) == 3) if parameter.is_color else isinstance(value, (int, float))


def read_parameters(settings, keep):
    """Makes a slider for each parameter. `keep`: values that are there already stay."""
    values = settings.values
    known = {parameter.name: parameter for parameter in parameters(settings) if parameter.value != ()}
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


def not_drawn(settings, shown):
    """What of objects and materials a sheet of its own has no say about, and values that cannot be given to it."""
    notes = []
    if text_of(settings) is None:
        known = {parameter.name for parameter in parameters(settings)}
        notes += [f"the value of the style sheet's parameter {name} counts for nothing: the program burin, which tells "
                  "what it means, is not found" for name in settings.values.keys() if name not in known]
    if ObjectRules(shown):
        notes.append("beside a style sheet Line Art's usage and crease angles of objects count for nothing")
    if any(material.own_color is not None for material in shown.materials.values()):
        notes.append("beside a style sheet line colours of materials count for nothing")
    return notes


def sheet_changed(settings, context):
    for name in list(settings.values.keys()):
        del settings.values[name]
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
    answers.__init__()
