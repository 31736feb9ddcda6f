"""How lines look by the panels alone: plain settings, or, where materials and objects have a say, a style sheet."""

import math

from .core import BurinError
from .object_rules import ObjectRules
from .sheet_text import SheetText, color_call, color_list, key, list_text, number_text, quoted

LINE_CLASSES = ("mark", "border", "silhouette", "intersection", "object", "material", "crease", "polygon")

MOST_COLORS = 100  # an expression of a sheet has room for so many, and more


def line_classes(settings):
    """The line classes of the panel, as the library names them."""
    return [name for name in LINE_CLASSES if name.upper() in settings.line_types]


def crease_degrees(settings):
    """Where creases begin, and where they are full."""
    begin = min(math.degrees(settings.crease_angle), 180)
    return round(begin, 4), round(min(begin + math.degrees(settings.crease_fade), 180), 4)


def crease_angle_text(begin, full):
    return repr(begin) if full <= begin else f"[{begin!r}, {full!r}]"


def hidden_width(settings):
    return settings.hidden_width if settings.use_hidden_width else settings.width


def dash_text(settings):
    return f"[{round(settings.dash, 6)!r}, {round(settings.gap, 6)!r}]"


def look_lines(settings):
    """Settings that say how lines look without a style sheet."""
    return [
        f"lines.draw={','.join(line_classes(settings)) or 'none'}",
        f"lines.width={round(settings.width, 6)!r}",
        f"lines.color={color_list(settings.color)}",
        f"lines.side={settings.side.lower()}",
        f"lines.hidden.style={settings.hidden.lower()}",
        f"lines.hidden.width={round(hidden_width(settings), 6)!r}",
        f"lines.hidden.color={color_list(settings.hidden_color)}",
        f"lines.hidden.dash={dash_text(settings)}",
    ]


def colored_materials(shown):
    """Names of materials whose lines have a colour of their own, by that colour."""
    found = {}
    for material in shown.materials.values():
        if material.own_color is not None:
            found.setdefault(material.own_color, []).append(material.name)
    return found


def sheet_text(scene, shown):
    """A sheet with the look of the panels, or None if plain settings can say it."""
    settings = scene.burin
    classes = line_classes(settings)
    rules, colors = ObjectRules(shown), colored_materials(shown)
    if not classes or not (rules or colors):
        return None
    if len(colors) > MOST_COLORS:
        raise BurinError(f"materials have {len(colors)} line colours; {MOST_COLORS} are possible")
    begin, full = crease_degrees(settings)
    found = rules.crease_angle(begin)
    sheet = SheetText([f"crease_angle = {crease_angle_text(found, full if found == begin else found)}"])
    conditions = rules.conditions(sheet, begin)
    select = [f"select = {quoted(' and '.join(conditions))}"] if conditions else []
    common = [f"classes = {list_text(classes)}", *select]
    sheet.table("[[set]]", ['name = "visible"', 'style = "visible"', *common])
    sheet.table("[style.visible]", [key("width", number_text(settings.width)),
                                    key("color", line_color(sheet, settings.color, colors)),
                                    f"side = {quoted(settings.side.lower())}"])
    if settings.hidden != "NONE":
        sheet.table("[[set]]", ['name = "hidden"', 'style = "hidden"', "qi = [1, 255]", *common])
        dash = [f"dash = {dash_text(settings)}"] if settings.hidden == "DASHED" else []
        sheet.table("[style.hidden]", [key("width", number_text(hidden_width(settings))),
                                       key("color", color_call(settings.hidden_color)), *dash])
    return sheet.text()


def line_color(sheet, color, colors):
    """The colour of visible lines: that of the front side's material where it has one."""
    if not colors:
        return color_call(color)
    groups = {own: sheet.group("materials", names) for own, names in colors.items()}
    terms = [f"(material in {group}) * {color_call(own)}" for own, group in groups.items()]
    others = " or ".join(f"material in {group}" for group in groups.values())
    return " + ".join([*terms, f"(not ({others})) * {color_call(color)}"])
