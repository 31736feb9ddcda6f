"""A picture on the graphics card, as a viewport shows it."""

import gpu
import numpy as np
from gpu_extras.presets import draw_texture_2d
from mathutils import Matrix

from .pixels import interleave, large_buffer

LETTERS = "RGBA"


def used_part(alpha):
    """The box of all pixels that are not empty: x0 y0 x1 y1, or None. What is around it need not be touched."""
    bits = alpha.view(np.uint16)
    rows = np.flatnonzero(bits.any(axis=1))
    if not len(rows):
        return None
    columns = np.flatnonzero(bits[rows[0]:rows[-1] + 1].any(axis=0))
    return columns[0], rows[0], columns[-1] + 1, rows[-1] + 1


def texture_of(pixels):
    """A texture of linear pixels (height, width, 4), float32."""
    height, width, channels = pixels.shape
    buffer = gpu.types.Buffer("FLOAT", width * height * channels, pixels.reshape(-1))
    return gpu.types.GPUTexture((width, height), format="RGBA16F", data=buffer)


class PixelMemory:
    """Memory for pixels, kept from one picture to the next."""

    def __init__(self):
        self.floats = np.empty(0, np.float32)

    def taken(self, width, height):
        count = 4 * width * height
        if self.floats.size < count:
            self.floats = large_buffer(count)
        return self.floats[:count].reshape(height, width, 4)


class ShownPicture:
    """Textures, and where they lie in the region: paper, if there is any, and before it what is drawn."""

    def __init__(self, picture, left, bottom, paper, memory):
        """`left`, `bottom`: of the picture in the region. `paper`: a colour that lies below, or None."""
        self.parts = []  # (texture, left, bottom, width, height)
        self.is_opaque = paper is not None
        channels = [picture.channel(letter) for letter in LETTERS]
        height, width = channels[0].shape
        if paper is not None:
            pixel = np.array([[[*paper, 1]]], np.float32)
            self.parts.append((texture_of(pixel), left, bottom, width, height))
        part = used_part(channels[3])
        if part is not None:
            x0, y0, x1, y1 = (int(place) for place in part)
            pixels = memory.taken(x1 - x0, y1 - y0)
            interleave([channel[y0:y1, x0:x1] for channel in channels], pixels, paper)
            self.parts.append((texture_of(pixels), left + x0, bottom + height - y1, x1 - x0, y1 - y0))

    def draw(self, engine, scene, region):
        """Draws it in the colours of the display."""
        gpu.state.blend_set("NONE" if self.is_opaque else "ALPHA_PREMULT")
        engine.bind_display_space_shader(scene)
        with gpu.matrix.push_pop(), gpu.matrix.push_pop_projection():
            # Blender's own matrices are 1/100 pixel off, which would mix neighbours.
            gpu.matrix.load_matrix(Matrix.Identity(4))
            gpu.matrix.load_projection_matrix(pixels_to_region(region.width, region.height))
            for texture, left, bottom, width, height in self.parts:
                draw_texture_2d(texture, (left, bottom), width, height)
        engine.unbind_display_space_shader()
        gpu.state.blend_set("NONE")


def pixels_to_region(width, height):
    return Matrix(((2 / width, 0, 0, -1), (0, 2 / height, 0, -1), (0, 0, -1, 0), (0, 0, 0, 1)))
