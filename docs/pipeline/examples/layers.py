"""Shows what is in a picture that has layers `lines`, `Z` and `crypto`: a PNG for each.

    layers.py SHOT.exr OBJECT BEAUTY.png LINES.png MATTE.png DEPTH.png

Needs NumPy and OpenImageIO's Python module (Debian: python3-openimageio).
"""
import json
import sys

import numpy as np
import OpenImageIO as oiio

shot, name, beauty, lines, matte, depth = sys.argv[1:]

file = oiio.ImageInput.open(shot)
spec = file.spec()
pixels = file.read_image(0, 0, 0, spec.nchannels, "float")
channels = {channel: pixels[..., i] for i, channel in enumerate(spec.channelnames)}
manifests = [a for a in spec.extra_attribs if a.name.endswith("/manifest")]
names = next(json.loads(a.value) for a in manifests
             if spec.getattribute(a.name.removesuffix("manifest") + "name") == "CryptoObject")


def over_white(layer):
    """Colours are linear and premultiplied."""
    return np.stack([channels[layer + c] + 1 - channels[layer + "A"] for c in "RGB"], axis=-1)


def share_of(name):
    """How much of each pixel the object covers: a rank has a name's number, as the bits of a float, and its share."""
    number = np.uint32(int(names[name], 16)).view(np.float32)
    share = np.zeros_like(channels["A"])
    for rank in range(3):
        for id_channel, share_channel in ("RG", "BA"):
            ids, shares = (channels[f"CryptoObject{rank:02}.{c}"] for c in (id_channel, share_channel))
            share += np.where(ids == number, shares, 0)
    return share


def greys_of_depth():
    """The nearest place is white, the farthest one is dark, the background is black."""
    z, is_there = channels["Z"], np.isfinite(channels["Z"]) & (channels["A"] > 0)
    near, far = z[is_there].min(), z[is_there].max()
    return np.where(is_there, 1 - 0.9 * (z - near) / (far - near), 0) ** 2.2


def write(path, image):
    image = np.clip(image.reshape(spec.height, spec.width, -1), 0, 1)
    codes = np.where(image <= 0.0031308, 12.92 * image, 1.055 * np.maximum(image, 0.0031308) ** (1 / 2.4) - 0.055)
    out = oiio.ImageOutput.create(path)
    out.open(path, oiio.ImageSpec(spec.width, spec.height, image.shape[2], "uint8"))
    out.write_image(np.ascontiguousarray(codes, np.float32))
    out.close()


write(beauty, over_white(""))
write(lines, over_white("lines."))
write(matte, share_of(name))
write(depth, greys_of_depth())
