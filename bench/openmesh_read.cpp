#include "bench/openmesh_read.h"

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/System/omstream.hh>

namespace burin::bench {

std::size_t openmesh_read(const std::string& path) {
    omerr().disable();  // it prints a line for every complex edge
    omlog().disable();
    OpenMesh::TriMesh_ArrayKernelT<> mesh;
    if (!OpenMesh::IO::read_mesh(mesh, path)) return 0;
    return mesh.n_faces();
}

}  // namespace burin::bench
