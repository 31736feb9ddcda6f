"""What a view layer shows, as style sheets ask for it: its objects and materials by names that a sheet can tell apart,
and what they say about lines. Nothing here refers to Blender's memory."""

from typing import NamedTuple


def address(thing):
    """Where Blender has a thing itself, whichever of its evaluated copies is asked."""
    return thing.original.as_pointer()


class Names:
    """A sheet knows a thing by its name alone. So each thing has one of its own, which means nothing in patterns; it is
    nearly always Blender's."""

    def __init__(self):
        self.of_things = {}  # key of a thing: name
        self.own = {}  # name: Blender's, where that is another one
        self.last_numbers = {}  # name: the number of the last thing that would have had it, too

    def name(self, key, own):
        """The name of a thing that Blender calls `own`."""
        if key not in self.of_things:
            plain = own.replace("*", "_").replace("?", "_")
            if plain.startswith("!"):
                plain = "_" + plain[1:]
            name, number = plain, self.last_numbers.get(plain, 0)
            while name in self.last_numbers:
                number += 1
                name = f"{plain}~{number}"
            self.last_numbers[plain] = number
            self.last_numbers.setdefault(name, 0)
            self.of_things[key] = name
            if name != own:
                self.own[name] = own
        return self.of_things[key]


class ShownMaterial(NamedTuple):
    """What a material says about lines."""
    name: str
    own_color: tuple  # of lines on it; None: they have the colour of others
    line_color: tuple  # Freestyle's, with alpha
    diffuse_color: tuple  # of the viewport display, with alpha


class Shown:
    """The objects and materials of a view layer."""

    def __init__(self):
        self.object_names, self.material_names = Names(), Names()
        self.usages = {}  # Line Art's usage, but for INCLUDE: names of objects
        self.crease_angles = {}  # degrees between normals: names of objects
        self.of_objects = {}  # address of an object: its names; several where instances are used otherwise
        self.materials = {}  # name: ShownMaterial

    def add_object(self, thing, usage, is_holdout, crease_angle):
        """Gives the object's name. What is used otherwise has another one. `crease_angle`: in degrees, or None."""
        key = (address(thing), usage, is_holdout)
        is_new = key not in self.object_names.of_things
        name = self.object_names.name(key, thing.name)
        if is_new:
            self.of_objects.setdefault(key[0], []).append(name)
            if usage != "INCLUDE":
                self.usages.setdefault(usage, []).append(name)
            if crease_angle is not None:
                self.crease_angles.setdefault(crease_angle, []).append(name)
        return name

    def keep(self, names):
        """Forgets the other objects."""
        for found in (self.usages, self.crease_angles, self.of_objects):
            for what in list(found):
                left = [name for name in found.pop(what) if name in names]
                if left:
                    found[what] = left

    def own_name(self, name):
        """What Blender calls an object."""
        return self.object_names.own.get(name, name)

    def add_material(self, material):
        """Gives the material's name."""
        name = self.material_names.name(address(material), material.name)
        settings = material.burin
        own_color = tuple(settings.line_color) if settings.use_line_color else None
        self.materials[name] = ShownMaterial(name, own_color, tuple(material.line_color), tuple(material.diffuse_color))
        return name

    def names_in(self, things):
        """The names of those of some objects that are shown."""
        return list(dict.fromkeys(name for thing in things for name in self.of_objects.get(address(thing), ())))


NOTHING_SHOWN = Shown()  # for what does not depend on it
