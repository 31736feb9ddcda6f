#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "mesh/polygon_soup.h"

namespace burin {

/// Readers of the single-mesh formats. Each takes the path of a file and returns its polygons.
///
/// All of them read bounded amounts of mapped memory: a count in the file is believed only as far
/// as the file has room for it. They throw InputError ("file:line: what; what to do") for text that
/// does not parse, vertex numbers out of range, and coordinates that are not finite or beyond 1e30.
/// Polygons with fewer than three corners are passed on, to be counted and dropped by build_meshes.

/// Wavefront OBJ. `o` names start objects (`g` names, in a file without any `o`), `usemtl` sets the
/// material, `l` marks edges, or draws lines of the current object. Texture coordinates, normals, free-form surfaces, points are skipped.
/// Colours and opacities come from the `mtllib` files that lie in the model's folder or below.
/// Read on `threads` threads (0 = all cores), which changes nothing else.
PolygonSoup read_obj(const std::string& path, int threads = 1);
/// The same for the text of the file, in pieces of at least `piece_size` bytes, which changes nothing either.
PolygonSoup read_obj_text(const std::string& path, std::string_view text, int threads,
                          std::size_t piece_size);

/// PLY: ASCII and both binary byte orders, polygons and triangle strips, all number types.
/// `element edge` marks edges, or draws lines; other elements and properties are skipped. Plain ASCII is read on `threads`
/// threads (0 = all cores), which changes nothing else.
PolygonSoup read_ply(const std::string& path, int threads = 1);

/// STL, ASCII and binary. Each `solid` of an ASCII file is an object.
PolygonSoup read_stl(const std::string& path);

/// OFF as text, with or without the prefixes for colours, normals and texture coordinates.
PolygonSoup read_off(const std::string& path);

}  // namespace burin
