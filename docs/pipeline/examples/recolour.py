"""Gives the lines of one object another colour, in a picture that has layers `lines` and `crypto`.

    recolour.py SHOT.exr OBJECT '#rrggbb' COMP.png MATTE.png

Needs NumPy and OpenImageIO's Python module (Debian: python3-openimageio).
"""
import json
import sys

import numpy as np
import OpenImageIO as oiio

shot, name, colour, comp, matte = sys.argv[1:]
layer = "CryptoLineObject"  # lines, by the object that they belong to

channels, manifest = {}, {}
file = oiio.ImageInput.open(shot)
part = 0
while file.seek_subimage(part, 0):  # one, or with --parts one for each layer
    spec = file.spec()
    for attribute in spec.extra_attribs:
        key = attribute.name.removesuffix("/manifest")
        if key != attribute.name and spec.getattribute(key + "/name") == layer:
            manifest = json.loads(attribute.value)
    pixels = file.read_image(part, 0, 0, spec.nchannels, "float")
    channels.update((channel, pixels[..., i]) for i, channel in enumerate(spec.channelnames))
    part += 1

# A rank has a name's number, as the bits of a float, and its share of the pixel.
number = np.uint32(int(manifest[name], 16)).view(np.float32)
share = np.zeros_like(channels["A"])
for rank in range(3):
    for id_channel, share_channel in (("R", "G"), ("B", "A")):
        ids, shares = (channels[f"{layer}{rank:02}.{c}"] for c in (id_channel, share_channel))
        share += np.where(ids == number, shares, 0)


def to_srgb(x):
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * np.maximum(x, 0.0031308) ** (1 / 2.4) - 0.055)


def to_linear(x):
    return x / 12.92 if x <= 0.04045 else ((x + 0.055) / 1.055) ** 2.4


def write(path, image):
    image = np.ascontiguousarray(np.clip(to_srgb(image), 0, 1), np.float32)
    out = oiio.ImageOutput.create(path)
    out.open(path, oiio.ImageSpec(image.shape[1], image.shape[0], image.shape[2], "uint8"))
    out.write_image(image)
    out.close()


# Colours are linear and premultiplied: the old ink goes as far as the matte says, and the new one comes in its place.
ink = np.maximum(channels["lines.A"], 1e-6)
rgb = [to_linear(int(colour[i : i + 2], 16) / 255) for i in (1, 3, 5)]
picture = np.stack(
    [
        channels[c] + share * (new - channels["lines." + c] / ink) + (1 - channels["A"])  # over white
        for c, new in zip("RGB", rgb)
    ],
    axis=-1,
)
write(comp, picture)
write(matte, share[..., None])
