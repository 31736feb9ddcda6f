#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/other_files.h"
#include "mesh/polygon_soup.h"

// Each format has a reader, which takes the path of a file and returns its polygons as they stand there.

namespace burin {

/// Readers of the single-mesh formats. Each takes the path of a file and returns its polygons.
///
/// All of them read bounded amounts of mapped memory: a count in the file is believed only as far
/// as the file has room for it. They throw InputError ("file:line: what; what to do") for text that
/// does not parse, vertex numbers out of range, and coordinates that are not finite or beyond 1e30.
/// Polygons with fewer than three corners are passed on, to be counted and dropped by build_meshes.
/// What a reader leaves out, or does not take as it stands, is in the soup's notes; `strict` ones throw instead. That
/// includes what stands behind the last element that the file counts, but for blanks and comments.
///
/// Lines of text end in LF, CRLF or CR alone. Keywords may be in capitals.

/// Wavefront OBJ. `o` names start objects (`g` names, in a file without any `o`), `usemtl` sets the
/// material, `l` marks edges, or draws lines of the current object. Normals, free-form surfaces and points are
/// skipped; lines that
/// begin with a word that OBJ does not have are noted. Colours and opacities come from the `mtllib` files that lie in
/// the model's folder or below. Read on `threads` threads (0 = all cores), which changes nothing else.
/// `other_files`: gets the paths of those, and of textures that they name.
/// `attributes`: what to keep of texture coordinates and of colours behind the coordinates of vertices.
PolygonSoup read_obj(const std::string& path, int threads = 1, OtherFiles* other_files = nullptr,
                     const AttributeWish& attributes = {});
/// Reads the text of an OBJ file, in pieces of at least `piece_size` bytes, which changes nothing either.
PolygonSoup read_obj_text(const std::string& path, std::string_view text, int threads, std::size_t piece_size,
                          OtherFiles* other_files = nullptr, const AttributeWish& attributes = {});

/// PLY: ASCII and both binary byte orders, polygons and triangle strips, all number types.
/// `element edge` marks edges, or draws lines; other elements and properties are skipped. Plain ASCII is read on
/// `threads` threads (0 = all cores), which changes nothing else. Values of an ASCII file may stand on any lines; where
/// that fails each item begins a line, and what follows its last value there is left out.
/// `attributes`: what to keep of further properties of vertices, s and t or u and v, red, green and blue, and others.
PolygonSoup read_ply(const std::string& path, int threads = 1, bool strict = false,
                     const AttributeWish& attributes = {});

/// STL, ASCII and binary. Each `solid` of an ASCII file is an object. Triangles whose coordinates are not finite or
/// beyond 1e30 are left out. A binary file of whole triangles is read to its end, whatever its count says. A text may
/// begin with a facet, without `solid`.
PolygonSoup read_stl(const std::string& path, bool strict = false);

/// OFF as text, with or without the prefixes for colours, normals and texture coordinates. The counts may follow the
/// word OFF without a blank, or stand on several lines, and that of the edges may be missing. Several vertices or
/// polygons may stand on a line, and one on several, where the file makes sense so and not line by line.
PolygonSoup read_off(const std::string& path, bool strict = false);

}  // namespace burin
