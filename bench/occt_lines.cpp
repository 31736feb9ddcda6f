// Parts as OpenCASCADE's exact hidden-line removal draws them, and as meshes for Burin: occt_lines FOLDER
//
// Makes parts with holes and fillets, writes each as FOLDER/NAME.obj, and prints a line for each: its name, the visible
// sharp edges and outlines that HLRBRep_Algo makes, which are the paths of a drawing, the visible smooth edges, which
// are none, and the seconds that it took.

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRep_Tool.hxx>
#include <GeomAbs_CurveType.hxx>
#include <HLRAlgo_Projector.hxx>
#include <HLRBRep_Algo.hxx>
#include <HLRBRep_HLRToShape.hxx>
#include <Poly_Triangulation.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <gp_Ax2.hxx>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace {

/// Where the eye is.
constexpr double kToEye[3] = {1, 0.8, 1.2};
/// How far meshes are from surfaces, in mm: about a tenth of a pixel.
constexpr double kDeflection = 0.01;

TopoDS_Shape cylinder(double x, double y, double z, double radius, double height) {
    return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(x, y, z), gp_Dir(0, 0, 1)), radius, height).Shape();
}

TopoDS_Shape cut(const TopoDS_Shape& from, const TopoDS_Shape& tool) { return BRepAlgoAPI_Cut(from, tool).Shape(); }

/// Rounds the upright edges of a shape.
TopoDS_Shape with_round_corners(const TopoDS_Shape& shape, double radius) {
    BRepFilletAPI_MakeFillet fillet(shape);
    for (TopExp_Explorer e(shape, TopAbs_EDGE); e.More(); e.Next()) {
        const TopoDS_Edge& edge = TopoDS::Edge(e.Current());
        double first = 0, last = 0;
        const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
        if (curve.IsNull()) continue;
        const gp_Pnt a = curve->Value(first), b = curve->Value(last);
        const bool is_upright = std::hypot(a.X() - b.X(), a.Y() - b.Y()) < 1e-9 && std::abs(a.Z() - b.Z()) > 1e-9;
        if (is_upright) fillet.Add(radius, edge);
    }
    return fillet.Shape();
}

TopoDS_Shape plate() {
    TopoDS_Shape shape = with_round_corners(BRepPrimAPI_MakeBox(gp_Pnt(-50, -30, 0), 100, 60, 10).Shape(), 8);
    for (const double x : {-40.0, 40.0}) {
        for (const double y : {-20.0, 20.0}) shape = cut(shape, cylinder(x, y, -1, 4, 12));
    }
    return cut(shape, cylinder(0, 0, -1, 15, 12));
}

TopoDS_Shape flange() {
    TopoDS_Shape shape = BRepAlgoAPI_Fuse(cylinder(0, 0, 0, 60, 12), cylinder(0, 0, 12, 30, 35)).Shape();
    shape = cut(shape, cylinder(0, 0, -1, 18, 60));
    for (int i = 0; i < 6; ++i) {
        const double angle = i * 1.0471975511965976;
        shape = cut(shape, cylinder(45 * std::cos(angle), 45 * std::sin(angle), -1, 6, 20));
    }
    return shape;
}

TopoDS_Shape bracket() {
    TopoDS_Shape shape = BRepAlgoAPI_Fuse(BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), 80, 50, 10).Shape(),
                                          BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 10), 10, 50, 60).Shape())
                             .Shape();
    for (const double y : {12.0, 38.0}) shape = cut(shape, cylinder(60, y, -1, 5, 12));
    const TopoDS_Shape across = BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(-1, 25, 45), gp_Dir(1, 0, 0)), 14, 12).Shape();
    return with_round_corners(cut(shape, across), 3);
}

/// Writes the mesh of a shape, whose vertices at one place are one.
void write_obj(const TopoDS_Shape& shape, const std::string& path) {
    BRepMesh_IncrementalMesh mesh(shape, kDeflection, false, 0.1);
    std::ofstream out(path);
    out.precision(9);
    std::map<std::array<long long, 3>, int> numbers;
    for (TopExp_Explorer e(shape, TopAbs_FACE); e.More(); e.Next()) {
        const TopoDS_Face& face = TopoDS::Face(e.Current());
        TopLoc_Location location;
        const Handle(Poly_Triangulation) triangles = BRep_Tool::Triangulation(face, location);
        if (triangles.IsNull()) continue;
        std::vector<int> own = {0};
        for (int i = 1; i <= triangles->NbNodes(); ++i) {
            const gp_Pnt p = triangles->Node(i).Transformed(location.Transformation());
            const auto whole = [](double v) { return std::llround(v * 1e6); };
            const auto [found, is_new] =
                numbers.try_emplace({whole(p.X()), whole(p.Y()), whole(p.Z())}, static_cast<int>(numbers.size()) + 1);
            if (is_new) out << "v " << p.X() << ' ' << p.Y() << ' ' << p.Z() << '\n';
            own.push_back(found->second);
        }
        for (int i = 1; i <= triangles->NbTriangles(); ++i) {
            int a = 0, b = 0, c = 0;
            triangles->Triangle(i).Get(a, b, c);
            if (face.Orientation() == TopAbs_REVERSED) std::swap(b, c);
            const auto corner = [&](int node) { return own[static_cast<std::size_t>(node)]; };
            out << "f " << corner(a) << ' ' << corner(b) << ' ' << corner(c) << '\n';
        }
    }
}

int edges_of(const TopoDS_Shape& shape) {
    int count = 0;
    if (shape.IsNull()) return 0;
    for (TopExp_Explorer e(shape, TopAbs_EDGE); e.More(); e.Next()) ++count;
    return count;
}

void measure(const char* name, const TopoDS_Shape& shape, const std::string& folder) {
    write_obj(shape, folder + "/" + name + ".obj");
    const auto start = std::chrono::steady_clock::now();
    const Handle(HLRBRep_Algo) algo = new HLRBRep_Algo();
    algo->Add(shape);
    algo->Projector(HLRAlgo_Projector(gp_Ax2(gp_Pnt(0, 0, 0), gp_Dir(kToEye[0], kToEye[1], kToEye[2]))));
    algo->Update();
    algo->Hide();
    HLRBRep_HLRToShape lines(algo);
    const int drawn = edges_of(lines.VCompound()) + edges_of(lines.OutLineVCompound());
    const int smooth = edges_of(lines.Rg1LineVCompound()) + edges_of(lines.RgNLineVCompound());
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::printf("%s %d %d %.6f\n", name, drawn, smooth, seconds);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: occt_lines FOLDER\n", stderr);
        return 2;
    }
    try {
        measure("plate", plate(), argv[1]);
        measure("flange", flange(), argv[1]);
        measure("bracket", bracket(), argv[1]);
    } catch (const Standard_Failure& failure) {
        std::fprintf(stderr, "occt_lines: %s\n", failure.GetMessageString());
        return 1;
    }
    return 0;
}
