"""Channels of a picture as pixels of a pass: single precision, interleaved, rows from the bottom."""

import mmap

import numpy as np

BLOCK_PIXELS = 1 << 14  # what is worked on at once lies in the cache
BACKGROUND_DEPTH = 1e10  # as Blender's own engines have it
# A half's bits, shifted to where a float has them, make a float that is too small by this.
HALF_SCALE = np.float32(2.0 ** 112)


def large_buffer(count):
    """An array of floats in large pages: with small ones, first use of the memory takes longer than the work."""
    memory = mmap.mmap(-1, max(4 * count, 1), flags=mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS)
    if hasattr(mmap, "MADV_HUGEPAGE"):
        try:
            memory.madvise(mmap.MADV_HUGEPAGE)
        except OSError:  # a kernel without them
            pass
    return np.frombuffer(memory, np.float32, count)


def to_float(values, out):
    """Numbers of any type of the library's as floats. Of halves, which are finite here, in a third of the time of
    NumPy's conversion."""
    if values.dtype == np.float16:
        bits = out.view(np.int32)
        bits[...] = values.view(np.int16)
        np.left_shift(bits, 13, out=bits)
        np.bitwise_and(bits, np.int32(-0x70000001), out=bits)  # copies of the sign
        np.multiply(out, HALF_SCALE, out=out)
    else:
        out[...] = values


def put_on_paper(block, paper, left):
    """Puts paper behind premultiplied pixels, but not into holes: `left` is the part of a pixel beside them."""
    red, green, blue, alpha = block
    free = 1 - alpha
    if left is not None:
        free *= left
    for channel, light in zip((red, green, blue), paper):
        channel += free if light == 1 else free * np.float32(light)
    alpha += free


def interleave(channels, out, paper=None, left=None):
    """Fills out[y, x, i], rows from the bottom, with channels[i], rows from the top. `left`: by what all are
    multiplied, rows from the top, or None; `paper`: three numbers, what is behind red green blue alpha, or None."""
    height, width, count = out.shape
    rows = max(1, BLOCK_PIXELS // width)
    buffers = np.empty((count, rows, width), np.float32)
    for y in range(0, height, rows):
        size = min(rows, height - y)
        source = slice(height - y - size, height - y)
        block = buffers[:, :size]
        factor = None if left is None else left[source][::-1]
        for values, one in zip(channels, block):
            to_float(values[source][::-1], one)
            if factor is not None:
                one *= factor
        if paper is not None:
            put_on_paper(block, paper, factor)
        for i in range(count):
            out[y:y + size, :, i] = block[i]


def limit_depth(pixels):
    np.minimum(pixels, np.float32(BACKGROUND_DEPTH), out=pixels)
