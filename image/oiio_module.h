#pragma once

/// The interface of the module burin_oiio.so, in plain C so that it can be found by name.

extern "C" {

/// Where the bytes of an image file go. The module opens no file for writing itself, so that a full
/// disk cannot hide in a library's buffers.
struct BurinOiioSink {
    void* context;
    /// Takes the whole file. False if that failed.
    bool (*write)(void* context, const void* bytes, unsigned long long size);
    /// Asked every few rows. False stops the writing.
    bool (*go_on)(void* context);
};

/// Writes width x height pixels of `channels` (3 or 4) 16-bit values per pixel, sRGB-encoded, alpha
/// not multiplied in, to `sink`, with `bits` (8 or 16) per value. The extension of `name` says the
/// format (PNG or TIFF). Returns nullptr, or what went wrong (valid until the next call in this
/// thread). `description`: a text for the file; empty: none.
const char* burin_oiio_write(const char* name, int width, int height, int channels, int bits,
                             const unsigned short* pixels, const char* description, const BurinOiioSink* sink);

/// Reads `path` as 16-bit values, `channels` of them per pixel. Returns nullptr or what went wrong.
/// The caller gives a function that allocates room for the pixels.
const char* burin_oiio_read(const char* path, int* width, int* height, int* channels,
                            unsigned short* (*allocate)(void* context, unsigned long long count), void* context);
}
