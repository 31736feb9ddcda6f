#pragma once

/// The interface of the module burin_draco.so, in plain C so that it can be found by name.

extern "C" {

/// An attribute of a compressed mesh, and where its values go.
struct BurinDracoAttribute {
    unsigned id;              ///< its number in the compressed data
    unsigned components;      ///< numbers per point, 3 or 4
    unsigned component_type;  ///< of the numbers, as glTF names it
    void* values;             ///< room for points x components numbers
};

/// Decompresses a mesh of `points` points and `triangles` triangles, into `indices` (three per
/// triangle) and into the attributes. Takes no memory for a mesh that says to be larger. Returns
/// nullptr, or what went wrong.
const char* burin_draco_decode(const void* bytes, unsigned long long size, unsigned long long points,
                               unsigned long long triangles, unsigned* indices, BurinDracoAttribute* attributes,
                               unsigned attribute_count);
}
