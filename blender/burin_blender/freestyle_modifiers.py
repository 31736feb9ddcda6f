"""Modifiers of Freestyle's line styles as expressions of a style sheet.

A modifier takes what the modifiers before it have made of a value, and blends another value into it. Those that a sheet
cannot say exactly are named instead."""

import math

from .sheet_text import color_call, number_text

# How many places of a curve or of a ramp are taken where it is no polyline.
CURVE_STOPS = 64

SCALAR_BLENDS = {
    "MIX": "mix({a}, {b}, {f})",
    "ADD": "{a} + {f} * {b}",
    "SUBTRACT": "{a} - {f} * {b}",
    "MULTIPLY": "{a} * (1 - {f} + {f} * {b})",
    "DIVIDE": "({b} != 0 ? (1 - {f}) * {a} + {f} * {a} / {b} : {a})",
    "DIFFERENCE": "mix({a}, abs({a} - {b}), {f})",
    "MINIMUM": "min({f} * {b}, {a})",
    "MAXIMUM": "max({f} * {b}, {a})",
}
COLOR_BLENDS = {
    "MIX": "mix({a}, {b}, {f})",
    "ADD": "{a} + {f} * {b}",
    "SUBTRACT": "{a} - {f} * {b}",
    "MULTIPLY": "{a} * (1 - {f} + {f} * {b})",
    "SCREEN": "1 - (1 - {f} + {f} * (1 - {b})) * (1 - {a})",
    "DIFFERENCE": "mix({a}, abs({a} - {b}), {f})",
    "DARKEN": "mix({a}, min({a}, {b}), {f})",
    "LIGHTEN": "max({a}, {f} * {b})",
}
MATERIAL_VALUES = {
    "LINE": lambda m: luminance(m.line_color), "LINE_R": lambda m: m.line_color[0],
    "LINE_G": lambda m: m.line_color[1], "LINE_B": lambda m: m.line_color[2], "LINE_A": lambda m: m.line_color[3],
    "DIFF": lambda m: luminance(m.diffuse_color), "DIFF_R": lambda m: m.diffuse_color[0],
    "DIFF_G": lambda m: m.diffuse_color[1], "DIFF_B": lambda m: m.diffuse_color[2],
    "ALPHA": lambda m: m.diffuse_color[3],
}
MATERIAL_COLORS = {"LINE": lambda m: tuple(m.line_color[:3]), "DIFF": lambda m: tuple(m.diffuse_color[:3])}


def luminance(color):
    """Freestyle's: its weights are not those of a display."""
    return 0.35 * color[0] + 0.45 * color[1] + 0.2 * color[2]


class NotCarried(Exception):
    """A sheet cannot say what a modifier does."""


class StyleValues:
    """Colour, alpha and thickness of one line style, as expressions.

    `place`: how far along its stroke a place is, 0 to 1. `materials`: those that are shown."""

    def __init__(self, sheet, line_style, place, materials):
        self.sheet, self.style, self.place, self.materials = sheet, line_style, place, materials
        self.notes = []
        self.color = self.modified("color", color_call(line_style.color), COLOR_BLENDS)
        self.alpha = self.modified("alpha", number_text(line_style.alpha), SCALAR_BLENDS)
        self.thickness = self.modified("thickness", number_text(line_style.thickness), SCALAR_BLENDS)

    def modified(self, kind, value, blends):
        for modifier in getattr(self.style, kind + "_modifiers"):
            if not modifier.use:
                continue
            try:
                value = self.sheet.let(self.blended(kind, modifier, value, blends))
            except NotCarried:
                self.notes.append(f"{kind} modifier {modifier.type.replace('_', ' ').title()} ({modifier.name})")
        return value

    def blended(self, kind, modifier, value, blends):
        if modifier.blend not in blends:
            raise NotCarried
        if modifier.type == "DISTANCE_FROM_OBJECT" and modifier.target is None:
            return value  # Freestyle leaves it out, too
        other = self.sheet.let(self.other_value(kind, modifier))
        result = blends[modifier.blend].format(a=value, b=other, f=number_text(modifier.influence))
        return f"(is_crease ? {result} : {value})" if modifier.type == "CREASE_ANGLE" else result

    def other_value(self, kind, modifier):
        """What is blended in."""
        if modifier.type == "CALLIGRAPHY":
            turn = number_text(math.degrees(modifier.orientation))
            return between(modifier.thickness_min, modifier.thickness_max, f"abs(sind(direction - {turn}))")
        if kind == "color":
            if modifier.type == "MATERIAL" and not modifier.use_ramp and modifier.material_attribute in MATERIAL_COLORS:
                return self.of_materials(MATERIAL_COLORS[modifier.material_attribute], color_call)
            return f"ramp(\"{self.color_ramp(modifier.color_ramp)}\", {self.position(modifier)})"
        position = self.mapped(modifier, self.position(modifier))
        if kind == "alpha":
            return position
        if modifier.type == "CREASE_ANGLE":
            return between(modifier.thickness_min, modifier.thickness_max, position)
        # Freestyle takes the distance of the two values, whichever is larger.
        return between(modifier.value_min, modifier.value_min + abs(modifier.value_max - modifier.value_min), position)

    def position(self, modifier):
        """Where on its ramp or curve a modifier looks, 0 to 1."""
        if modifier.type == "ALONG_STROKE":
            return self.place
        if modifier.type == "DISTANCE_FROM_CAMERA":
            return linstep(modifier.range_min, modifier.range_max, "distance")
        if modifier.type == "DISTANCE_FROM_OBJECT":
            x, y, z = (number_text(c) for c in modifier.target.location)
            distance = f"hypot(hypot(P.x - {x}, P.y - {y}), P.z - {z})"
            return linstep(modifier.range_min, modifier.range_max, distance)
        if modifier.type == "CREASE_ANGLE":
            return linstep(math.degrees(modifier.angle_min), math.degrees(modifier.angle_max), "(180 - dihedral)")
        if modifier.type == "MATERIAL" and modifier.material_attribute in MATERIAL_VALUES:
            return self.of_materials(MATERIAL_VALUES[modifier.material_attribute], number_text)
        raise NotCarried

    def mapped(self, modifier, position):
        if modifier.mapping == "LINEAR":
            return f"(1 - {position})" if modifier.invert else position
        mapping = modifier.curve
        mapping.initialize()
        curve = mapping.curves[0]
        places = [i / (CURVE_STOPS - 1) for i in range(CURVE_STOPS)]
        stops = [(x, limited(mapping.evaluate(curve, x), mapping.clip_min_y, mapping.clip_max_y)) for x in places]
        return f"ramp(\"{self.sheet.ramp(stops, 'linear')}\", {position})"

    def color_ramp(self, ramp):
        elements = [(e.position, tuple(e.color[:3])) for e in ramp.elements]
        is_plain = ramp.color_mode == "RGB" and all(a[0] < b[0] for a, b in zip(elements, elements[1:]))
        if is_plain and ramp.interpolation in {"LINEAR", "CONSTANT"}:
            if ramp.interpolation == "CONSTANT" and elements[0][0] > 0:
                elements.insert(0, (0.0, elements[0][1]))
            return self.sheet.ramp(elements, "linear" if ramp.interpolation == "LINEAR" else "step")
        if ramp.interpolation == "CONSTANT":
            raise NotCarried
        places = [i / (CURVE_STOPS - 1) for i in range(CURVE_STOPS)]
        return self.sheet.ramp([(x, tuple(ramp.evaluate(x)[:3])) for x in places], "linear")

    def of_materials(self, value_of, text_of):
        """A value that depends on the material of the front side; black and 0 where there is none."""
        names = {}
        for material in self.materials:
            names.setdefault(text_of(value_of(material)), []).append(material.name)
        terms = [f"(material in {self.sheet.group('materials', names[text])}) * {text}" for text in sorted(names)]
        if not terms:
            return color_call((0, 0, 0)) if text_of is color_call else "0"
        return f"({' + '.join(terms)})"


def between(low, high, position):
    return f"({number_text(low)} + {number_text(high - low)} * {position})"


def linstep(low, high, value):
    return f"linstep({number_text(low)}, {number_text(high)}, {value})"


def limited(number, low, high):
    return min(max(float(number), low), high)
