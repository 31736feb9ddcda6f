#pragma once

#include <cstddef>
#include <string>

namespace burin::bench {

/// Reads a file into an OpenMesh::TriMesh with default traits; returns its number of faces,
/// 0 if the file cannot be read.
std::size_t openmesh_read(const std::string& path);

}  // namespace burin::bench
