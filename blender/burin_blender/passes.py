"""The passes of a view layer: which Burin draws, from which of its layers, as arrays for Blender."""

from typing import NamedTuple

import numpy as np


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
    names = {"mist": "Mist", "position": "Position", "vector": "Vector", "uv": "UV", "shadow": "Shadow",
             "ambient_occlusion": "Ambient Occlusion", "emit": "Emission", "environment": "Environment",
             "diffuse_color": "Diffuse Color", "glossy_color": "Glossy Color"}
    for attribute, name in names.items():
        if getattr(view_layer, "use_pass_" + attribute, False):
            notes.add(f"the pass {name} is not drawn")
    return notes


def channels_of(wanted):
    """The library's channels that a pass is made of."""
    if wanted.name == "Depth":
        return ["Z"]
    if wanted.name == "Normal":
        return ["N.X", "N.Y", "N.Z"]
    single = {"IndexOB": "index.object", "IndexMA": "index.material", "ObjectNumber": "id.object",
              "MaterialNumber": "id.material"}.get(wanted.name)
    if single:
        return [single]
    prefix = {"Combined": "", "Lines": "lines.", "LinesHidden": "lines_hidden."}.get(wanted.name, wanted.name + ".")
    return [prefix + letter for letter in "RGBA"]


def type_of(channel):
    """What the library's values of a channel are; `index` is made from ids, by Job.draw()."""
    if channel.startswith("id."):
        return np.dtype(np.uint32)
    is_float = channel == "Z" or channel.startswith(("index.", "Crypto"))
    return np.dtype(np.float32 if is_float else np.float16)


def layers_for(passes, has_holdouts):
    """The library's layers that passes are made of, as its option has them."""
    layers = dict.fromkeys(p.layers for p in passes)
    if has_holdouts:
        layers["CryptoObject"] = None
    return ",".join(layers)
