"""The passes of a view layer: which Burin draws, from which of its layers, as arrays for Blender."""

from typing import NamedTuple

import numpy as np

BACKGROUND_DEPTH = 1e10  # as Blender's own engines have it
CRYPTO_RANKS = 6  # names that the library keeps for a pixel


class Pass(NamedTuple):
    """A pass as Blender registers it, and the library's layers that it is made of."""
    name: str
    channels: str
    kind: str
    layers: str


# Switches of the view layer's own panel, and what they are where there is no such panel.
OWN_PASSES = (
    ("use_pass_lines", True, Pass("Lines", "RGBA", "COLOR", "lines")),
    ("use_pass_hidden", False, Pass("LinesHidden", "RGBA", "COLOR", "lines_hidden")),
    ("use_pass_object_id", False, Pass("ObjectNumber", "X", "VALUE", "ids")),
    ("use_pass_material_id", False, Pass("MaterialNumber", "X", "VALUE", "ids")),
)


def crypto_passes(view_layer, name):
    """As many passes as the view layer's levels ask for, each with two names."""
    count = (view_layer.pass_cryptomatte_depth + 1) // 2
    return [Pass(f"{name}{i:02}", "RGBA", "COLOR", name) for i in range(count)]


def passes_of(view_layer):
    """The passes that a view layer has, in the order in which they are registered."""
    passes = [Pass("Combined", "RGBA", "COLOR", "beauty")]
    if view_layer.use_pass_z:
        passes.append(Pass("Depth", "Z", "VALUE", "Z"))
    if view_layer.use_pass_normal:
        passes.append(Pass("Normal", "XYZ", "VECTOR", "N"))
    if view_layer.use_pass_object_index:
        passes.append(Pass("IndexOB", "X", "VALUE", "ids"))
    if view_layer.use_pass_material_index:
        passes.append(Pass("IndexMA", "X", "VALUE", "ids"))
    for switch, default, own in OWN_PASSES:
        if getattr(getattr(view_layer, "burin", None), switch, default):
            passes.append(own)
    if view_layer.use_pass_cryptomatte_object:
        passes += crypto_passes(view_layer, "CryptoObject")
    if view_layer.use_pass_cryptomatte_material:
        passes += crypto_passes(view_layer, "CryptoMaterial")
    return passes


def missing_passes(view_layer):
    """Switches of Blender's panel that are on, and what they mean here."""
    notes = set()
    if view_layer.use_pass_cryptomatte_asset:
        notes.add("the pass CryptoAsset is not drawn")
    has_crypto = view_layer.use_pass_cryptomatte_object or view_layer.use_pass_cryptomatte_material
    if has_crypto and view_layer.pass_cryptomatte_depth > CRYPTO_RANKS:
        notes.add(f"passes of Cryptomatte have {CRYPTO_RANKS} levels at most")
    names = {"mist": "Mist", "position": "Position", "vector": "Vector", "uv": "UV", "shadow": "Shadow",
             "ambient_occlusion": "Ambient Occlusion", "emit": "Emission", "environment": "Environment",
             "diffuse_color": "Diffuse Color", "glossy_color": "Glossy Color"}
    for attribute, name in names.items():
        if getattr(view_layer, "use_pass_" + attribute, False):
            notes.add(f"the pass {name} is not drawn")
    return notes


def layers_for(passes, has_holdouts):
    """The library's layers that passes are made of, as its option has them."""
    layers = dict.fromkeys(p.layers for p in passes)
    if has_holdouts:
        layers["CryptoObject"] = None
    return ",".join(layers)


def half_as_float():
    """All 65536 halfs as floats: a table is 4 times as fast as NumPy's conversion."""
    return np.arange(65536, dtype=np.uint16).view(np.float16).astype(np.float32)


class PassFiller:
    """Fills arrays (height, width, channels), rows from the bottom, with the passes of one picture."""

    def __init__(self, picture, gathered, session):
        self.picture = picture
        self.gathered = gathered
        self.session = session
        self.names = set(picture.channel_names())
        self.floats = half_as_float()

    def fill(self, wanted_pass, out):
        """What the picture does not have stays as it is, 0."""
        name = wanted_pass.name
        if name == "Depth":
            np.minimum(self.channel("Z"), BACKGROUND_DEPTH, out=out[..., 0])
        elif name == "Normal":
            self.fill_channels(["N.X", "N.Y", "N.Z"], out)
        elif name == "IndexOB":
            self.fill_indices("id.object", self.object_index, out)
        elif name == "IndexMA":
            self.fill_indices("id.material", self.material_index, out)
        elif name in {"ObjectNumber", "MaterialNumber"}:
            out[..., 0] = self.channel("id." + name.removesuffix("Number").lower())
        else:
            prefix = {"Combined": "", "Lines": "lines.", "LinesHidden": "lines_hidden."}.get(name, name + ".")
            self.fill_channels([prefix + letter for letter in "RGBA"], out)

    def channel(self, name):
        """The values of a channel, rows from the bottom."""
        values = self.picture.channel(name)[::-1]
        return self.floats[values.view(np.uint16)] if values.dtype == np.float16 else values

    def fill_channels(self, names, out):
        if names[0] in self.names:
            for i, name in enumerate(names):
                out[..., i] = self.channel(name)

    def fill_indices(self, name, index_of, out):
        ids = self.channel(name)
        indices = np.zeros(int(ids.max(initial=0)) + 1, np.float32)
        for number in np.unique(ids[ids > 0]):
            indices[number] = index_of(int(number))
        out[..., 0] = indices[ids]

    def object_index(self, number):
        first = self.session.numbers[0]
        return self.gathered.objects[self.session.scene.object_of_id(number) - first].pass_index

    def material_index(self, number):
        return next((look.pass_index for look, known in self.session.materials.items() if known == number), 0)

    def share_of(self, names):
        """How much of each pixel objects of some names cover, and all do: their surfaces and lines."""
        share = np.zeros(self.channel("A").shape, np.float32)
        hashes = np.array([crypto_hash(name) for name in names], np.uint32)
        for rank in range(CRYPTO_RANKS // 2):
            for name, part in (("R", "G"), ("B", "A")):
                known = np.isin(self.channel(f"CryptoObject{rank:02}.{name}").view(np.uint32), hashes)
                share += np.where(known, self.channel(f"CryptoObject{rank:02}.{part}"), 0)
        return share


def crypto_hash(name):
    """MurmurHash3 (x86, 32 bits, seed 0) of a name, changed in one bit where it would be no ordinary float."""
    data = name.encode("utf-8", "replace")
    mask = 0xFFFFFFFF

    def scrambled(k):
        k = k * 0xCC9E2D51 & mask
        return (k << 15 | k >> 17) * 0x1B873593 & mask

    value = 0
    whole = len(data) // 4 * 4
    for i in range(0, whole, 4):
        value ^= scrambled(int.from_bytes(data[i:i + 4], "little"))
        value = ((value << 13 | value >> 19) * 5 + 0xE6546B64) & mask
    if whole < len(data):
        value ^= scrambled(int.from_bytes(data[whole:], "little"))
    value ^= len(data)
    value = (value ^ value >> 16) * 0x85EBCA6B & mask
    value = (value ^ value >> 13) * 0xC2B2AE35 & mask
    value ^= value >> 16
    exponent = value >> 23 & 255
    return value ^ 1 << 23 if exponent in (0, 255) else value
