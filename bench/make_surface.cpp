// make_surface FILE.ply: a closed surface of as many triangles as the Stanford dragon, in the same
// kind of file, for measuring where the dragon cannot be fetched.
#include <cmath>
#include <cstdio>
#include <numbers>

namespace {

constexpr int kAround = 933,
              kAlong = 467;  // 2 * 933 * 467 = 871,422 triangles; the dragon has 871,414

/// A torus with bumps, of the dragon's size.
void write_vertex(std::FILE* file, int i, int j) {
    const double u = 2 * std::numbers::pi * i / kAround, v = 2 * std::numbers::pi * j / kAlong;
    const double tube = 0.03 + 0.004 * std::sin(17 * u) * std::sin(9 * v);
    const double reach = 0.07 + tube * std::cos(v);
    std::fprintf(file, "%.6f %.6f %.6f \n", reach * std::cos(u), 0.1 + tube * std::sin(v), reach * std::sin(u));
}

}  // namespace

int main(int argc, char** argv) {
    std::FILE* const file = argc == 2 ? std::fopen(argv[1], "w") : nullptr;
    if (file == nullptr) {
        std::fputs("usage: make_surface FILE.ply\n", stderr);
        return 2;
    }
    std::fprintf(file,
                 "ply\nformat ascii 1.0\nelement vertex %d\nproperty float x\nproperty float y\n"
                 "property float z\nelement face %d\nproperty list uchar int vertex_indices\nend_header\n",
                 kAround * kAlong, 2 * kAround * kAlong);
    for (int i = 0; i < kAround; ++i) {
        for (int j = 0; j < kAlong; ++j) write_vertex(file, i, j);
    }
    for (int i = 0; i < kAround; ++i) {
        for (int j = 0; j < kAlong; ++j) {
            const int next = (i + 1) % kAround * kAlong, above = (j + 1) % kAlong;
            const int a = i * kAlong + j, b = next + j, c = next + above, d = i * kAlong + above;
            std::fprintf(file, "3 %d %d %d \n3 %d %d %d \n", a, b, c, a, c, d);
        }
    }
    return std::fclose(file) == 0 ? 0 : 1;
}
