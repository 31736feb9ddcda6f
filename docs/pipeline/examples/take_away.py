"""Takes an object, with its lines, out of a deep picture, and flattens what is left over white.

    take_away.py DEEP.exr OBJECT OUT.png     OBJECT "": takes away nothing

Needs NumPy and OpenImageIO's Python module (Debian: python3-openimageio).
"""
import sys

import numpy as np
import OpenImageIO as oiio


def number_of(name):
    """MurmurHash3 of 32 bits, seed 0."""
    data, mask, h = name.encode(), 0xFFFFFFFF, 0
    turned = lambda value, bits: (value << bits | value >> 32 - bits) & mask
    for at in range(0, len(data), 4):
        word = data[at:at + 4]
        h ^= turned(int.from_bytes(word, "little") * 0xCC9E2D51 & mask, 15) * 0x1B873593 & mask
        if len(word) == 4:
            h = (turned(h, 13) * 5 + 0xE6546B64) & mask
    h ^= len(data)
    h = (h ^ h >> 16) * 0x85EBCA6B & mask
    h = (h ^ h >> 13) * 0xC2B2AE35 & mask
    return h ^ h >> 16


deep, name, path = sys.argv[1:]
file = oiio.ImageInput.open(deep)
spec = file.spec()
samples = file.read_native_deep_image()
channel = {name: i for i, name in enumerate(spec.channelnames)}
taken = number_of(name) if name else None

picture = np.ones((spec.height * spec.width, 3), np.float32)
for pixel in range(samples.pixels):
    left = 1.0  # what samples in front let through
    seen = np.zeros(3)
    for i in range(samples.samples(pixel)):  # from front to back
        if samples.deep_value_uint(pixel, channel["objectid"], i) == taken:
            continue
        seen += left * np.array([samples.deep_value(pixel, channel[c], i) for c in "RGB"])
        left *= 1 - samples.deep_value(pixel, channel["A"], i)
    picture[pixel] = seen + left

picture = np.clip(picture, 0, 1)
codes = np.where(picture <= 0.0031308, 12.92 * picture, 1.055 * np.maximum(picture, 0.0031308) ** (1 / 2.4) - 0.055)
out = oiio.ImageOutput.create(path)
out.open(path, oiio.ImageSpec(spec.width, spec.height, 3, "uint8"))
out.write_image(codes.reshape(spec.height, spec.width, 3).astype(np.float32))
out.close()
