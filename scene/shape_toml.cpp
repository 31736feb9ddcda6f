#include "scene/shape_toml.h"

#include <cstdint>

namespace burin {
namespace {

class ShapeReader {
  public:
    explicit ShapeReader(TomlReader& t) : t_(t) {}

    Shape read() {
        static const std::vector<std::string_view> kShapes = {"box",  "plane", "sphere", "cylinder",
                                                              "cone", "torus", "teapot"};
        const std::size_t kind = *t_.choice("shape", kShapes);
        shape_.name = kShapes[kind];
        switch (kind) {
            case 0:
                read_box();
                break;
            case 1:
                read_plane();
                break;
            case 2:
                read_sphere();
                break;
            case 3:
            case 4:
                read_cylinder(kind == 4);
                break;
            case 5:
                read_torus();
                break;
            default:
                read_teapot();
        }
        return std::move(shape_);
    }

  private:
    double positive(std::string_view key, double fallback) { return t_.number(key, kPositive).value_or(fallback); }
    int count(std::string_view key, int low, int high, int fallback) {
        const int n = t_.integer(key, low, high).value_or(fallback);
        shape_.settings += (shape_.settings.empty() ? "" : ", ") + std::string(key) + " " + std::to_string(n);
        return n;
    }
    int count(std::string_view key, int low, int fallback) { return count(key, low, 4096, fallback); }
    void set_size(std::uint64_t polygons, std::uint64_t corners) {
        shape_.polygons = polygons;
        shape_.corners = corners;
    }
    static std::uint64_t product(int a, int b) { return static_cast<std::uint64_t>(a) * static_cast<std::uint64_t>(b); }

    void read_box() {
        const glm::dvec3 size = t_.vector("size").value_or(glm::dvec3(1.0));
        if (!(size.x > 0 && size.y > 0 && size.z > 0)) t_.fail("size", "must be positive");
        set_size(6, 24);
        shape_.make = [=] { return make_box(size); };
    }
    void read_plane() {
        const auto size = t_.numbers("size", 2).value_or(std::vector<double>{1, 1});
        if (!(size[0] > 0 && size[1] > 0)) t_.fail("size", "must be positive");
        const int columns = count("columns", 1, 1), rows = count("rows", 1, 1);
        set_size(product(columns, rows), 4 * product(columns, rows));
        shape_.make = [=] { return make_plane(size[0], size[1], columns, rows); };
    }
    void read_sphere() {
        const double radius = positive("radius", 0.5);
        const int segments = count("segments", 3, 64), rings = count("rings", 2, 32);
        set_size(product(segments, rings),
                 4 * product(segments, rings) - 2 * product(segments, 1));  // triangles at the poles
        shape_.make = [=] { return make_sphere(radius, segments, rings); };
    }
    void read_cylinder(bool is_cone) {
        const double radius = positive("radius", 0.5), top_radius = is_cone ? 0 : positive("top_radius", radius);
        const double height = positive("height", 1);
        const int segments = count("segments", 3, 64);
        const int ends = is_cone ? 1 : 2;  // each a polygon
        set_size(product(segments, 1) + product(ends, 1), product(segments, is_cone ? 3 : 4) + product(segments, ends));
        shape_.make = [=] { return make_cylinder(radius, top_radius, height, segments); };
    }
    void read_torus() {
        const double radius = positive("radius", 0.5), tube_radius = positive("tube_radius", 0.2);
        const int segments = count("segments", 3, 64), tube_segments = count("tube_segments", 3, 32);
        set_size(product(segments, tube_segments), 4 * product(segments, tube_segments));
        shape_.make = [=] { return make_torus(radius, tube_radius, segments, tube_segments); };
    }
    void read_teapot() {
        const int tessellation = count("tessellation", 1, 256, 10);
        set_size(32 * product(tessellation, tessellation), 128 * product(tessellation, tessellation));
        shape_.make = [=] { return make_teapot(tessellation); };
    }

    TomlReader& t_;
    Shape shape_;
};

}  // namespace

Shape read_shape(TomlReader& t) { return ShapeReader(t).read(); }

}  // namespace burin
