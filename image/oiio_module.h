#pragma once

/// The interface of the module burin_oiio.so, in plain C so that it can be found by name.

/// Writes width x height pixels of `channels` (3 or 4) 16-bit values per pixel, sRGB-encoded, alpha
/// not multiplied in, to `path`, whose extension says the format (PNG or TIFF), with `bits` (8 or
/// 16) per value. Returns nullptr, or what went wrong (valid until the next call in this thread).
extern "C" const char* burin_oiio_write(const char* path, int width, int height, int channels,
                                        int bits, const unsigned short* pixels);

/// Reads `path` as 16-bit values, `channels` of them per pixel. Returns nullptr or what went wrong.
/// The caller gives a function that allocates room for the pixels.
extern "C" const char* burin_oiio_read(const char* path, int* width, int* height, int* channels,
                                       unsigned short* (*allocate)(void* context,
                                                                   unsigned long long count),
                                       void* context);
