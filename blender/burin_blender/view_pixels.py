"""The pixels of a picture as a viewport shows them, and their texture."""

import gpu
import numpy as np
from gpu_extras.presets import draw_texture_2d

# A half that is not negative becomes a float by a shift of its bits and this factor, much faster than by numpy's cast.
HALF_TO_FLOAT_SHIFT = 13
HALF_TO_FLOAT_FACTOR = np.float32(2.0 ** 112)


def floats_of(channel):
    """A channel of halves, none of them negative, as float32."""
    bits = channel.view(np.uint16).astype(np.uint32)
    bits <<= HALF_TO_FLOAT_SHIFT
    values = bits.view(np.float32)
    values *= HALF_TO_FLOAT_FACTOR
    return values


def pixels_of(picture, paper):
    """(height, width, 4) float32, linear, rows from the top. `paper`: a colour that lies below, or None: alpha stays,
    and colours are multiplied by it."""
    alpha = floats_of(picture.channel("A"))
    out = np.empty((*alpha.shape, 4), np.float32)
    below = None if paper is None else np.subtract(1, alpha)
    for i, letter in enumerate("RGB"):
        color = floats_of(picture.channel(letter))
        if paper is not None:
            color += below * np.float32(paper[i])
        out[..., i] = color
    out[..., 3] = alpha if paper is None else 1
    return out


class ShownPicture:
    """A picture on the graphics card."""

    def __init__(self, pixels, left, bottom, is_opaque):
        height, width, channels = pixels.shape
        self.left, self.bottom, self.width, self.height = left, bottom, width, height
        self.is_opaque = is_opaque
        buffer = gpu.types.Buffer("FLOAT", width * height * channels, pixels.reshape(-1))
        self.texture = gpu.types.GPUTexture((width, height), format="RGBA16F", data=buffer)

    def draw(self, engine, scene):
        """Draws it in the colours of the display. Its first row is the topmost one."""
        gpu.state.blend_set("NONE" if self.is_opaque else "ALPHA_PREMULT")
        engine.bind_display_space_shader(scene)
        draw_texture_2d(self.texture, (self.left, self.bottom + self.height), self.width, -self.height)
        engine.unbind_display_space_shader()
        gpu.state.blend_set("NONE")
