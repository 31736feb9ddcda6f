"""A drawn job as the result of Blender's render."""

import bpy
import numpy as np

from . import cryptomatte
from .passes import channels_of
from .pixels import interleave, large_buffer, limit_depth

# From 4.1 on foreach_set() of a pass takes a flat array, before rows of pixels; other ways take 20 times as long.
TAKES_FLAT = bpy.app.version >= (4, 1, 0)


def not_held_out(job, channels):
    """The part of each pixel's ink and surfaces that is left beside objects that cut a hole; None: all."""
    if not job.gathered.holdouts:
        return None
    alpha = channels["A"].astype(np.float32)
    held = cryptomatte.share_of(job.gathered.holdouts, job.crypto_ranks, channels.get)
    return np.clip(1 - np.divide(held, alpha, out=np.zeros_like(held), where=alpha > 0), 0, 1)


def fill_pass(job, wanted, channels, left, out):
    """Makes the pixels (height, width, channels) of a pass."""
    is_ink = wanted.name in {"Combined", "Lines", "LinesHidden"}
    interleave([channels[name] for name in channels_of(wanted)], out,
               paper=job.paper if wanted.name == "Combined" else None, left=left if is_ink else None)
    if wanted.name == "Depth":
        limit_depth(out)


def give_to_blender(engine, job, memory, layer):
    """Makes what a child has drawn the render's result."""
    channels = job.arrays(memory)
    left = not_held_out(job, channels)
    cryptomatte.rename(channels, "CryptoObject", job.gathered.shown.object_names.own)
    cryptomatte.rename(channels, "CryptoMaterial", job.gathered.shown.material_names.own)
    passes = {wanted.name: wanted for wanted in job.passes}
    buffer = large_buffer(4 * job.width * job.height)
    result = engine.begin_result(0, 0, job.width, job.height, layer=layer)
    for render_pass in result.layers[0].passes:
        wanted = passes.get(render_pass.name)
        if wanted is None:
            continue
        count = len(wanted.channels)
        out = buffer[:count * job.width * job.height].reshape(job.height, job.width, count)
        fill_pass(job, wanted, channels, left, out)
        render_pass.rect.foreach_set(out.reshape(-1) if TAKES_FLAT else out.reshape(-1, count))
    engine.end_result(result)
