"""What of each pixel belongs to objects of some names, by the library's channels of Cryptomatte."""

import numpy as np

FEWEST_RANKS = 6


def ranks_of(view_layer):
    """How many names the library keeps for a pixel: the view layer's levels, but so many that little is left out."""
    return max(FEWEST_RANKS, (view_layer.pass_cryptomatte_depth + 1) // 2 * 2)


def channels_of(ranks):
    """The channels that say which objects cover a pixel: names, then shares, in turn."""
    return [f"CryptoObject{i:02}.{letter}" for i in range(ranks // 2) for letter in "RGBA"]


def share_of(names, ranks, channel):
    """How much of each pixel objects of some names cover, with their surfaces and lines. `channel(name)`: its array."""
    channels = channels_of(ranks)
    hashes = np.array([crypto_hash(name) for name in names], np.uint32)
    share = np.float32(0)
    for hash_channel, part_channel in zip(channels[::2], channels[1::2]):
        is_named = np.isin(channel(hash_channel).view(np.uint32), hashes)
        share = share + np.where(is_named, channel(part_channel), np.float32(0))
    return share


def rename(channels, kind, names):
    """Gives objects or materials in the channels of the passes `kind` other names: {name: the other one}."""
    if not names:
        return
    hashes = {crypto_hash(name): crypto_hash(other) for name, other in names.items()}
    old = np.array(sorted(hashes), np.uint32)
    new = np.array([hashes[number] for number in sorted(hashes)], np.uint32)
    for channel, values in channels.items():
        if channel.startswith(kind) and channel[-1] in "RB":  # names, beside which shares are
            bits = values.view(np.uint32)
            places = np.minimum(np.searchsorted(old, bits), len(old) - 1)
            np.copyto(bits, new[places], where=old[places] == bits)


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
