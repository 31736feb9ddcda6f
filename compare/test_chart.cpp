#include "compare/test_chart.h"

#include <cmath>

#include "mesh/build_meshes.h"

namespace burin {
namespace {

constexpr int kColumns = 16;
constexpr int kStarLines = 180;
constexpr int kSlopeLines = 36;
constexpr double kGaps_px[] = {.001, .003, .01, .03, .1, .3, 1, 3};
constexpr double kHiddenSlopes_deg[] = {45, 75};
/// Covers as steep as a round object is near its limb.
constexpr double kCoverSlopes_deg[] = {60, 75};
constexpr double kFarSlope_deg = 20;
constexpr int kPyramids = 8;
constexpr double kEyeZ = 1000;

/// The radical inverse of i: fractions that are spread evenly over [0, 1).
double spread_fraction(unsigned i, unsigned base) {
    double result = 0, digit = 1.0 / base;
    for (; i > 0; i /= base, digit /= base) result += digit * (i % base);
    return result;
}

void add_object(Scene& scene, PolygonSoup soup, const char* name) {
    soup.object_names = {name};
    soup.materials = {Material{}};
    scene.materials.push_back(soup.materials[0]);
    for (Mesh& mesh : build_meshes(soup, {})) {
        SceneObject object;
        object.name = name;
        object.mesh = static_cast<std::uint32_t>(scene.meshes.size());
        object.materials = {static_cast<std::uint32_t>(scene.materials.size() - 1)};
        scene.meshes.push_back(std::move(mesh));
        scene.objects.push_back(std::move(object));
    }
}

class ChartBuilder {
  public:
    explicit ChartBuilder(double width_px) : half_length_(16 + 0.5 * width_px), half_width_(9 + 0.5 * width_px) {
        cell_ = std::ceil(2 * std::hypot(half_length_, half_width_)) + 4;
        const int cells =
            kStarLines + kSlopeLines +
            static_cast<int>(std::size(kGaps_px) * (std::size(kHiddenSlopes_deg) + std::size(kCoverSlopes_deg))) +
            kPyramids;
        const int rows = (cells + kColumns - 1) / kColumns;
        chart_.width = kColumns * static_cast<int>(cell_);
        chart_.height = rows * static_cast<int>(cell_);
        chart_.reach_px = 3 + 0.5 * width_px;
    }

    TestChart build() {
        for (int i = 0; i < kStarLines; ++i) chart_.star.push_back(add_tent(glm::radians(double(i)), 45, 45));
        for (int i = 0; i < kSlopeLines; ++i) {
            chart_.slopes.push_back(add_tent(glm::radians(i * 180.0 / kSlopeLines + 1.7), 65, -20));
        }
        int turn = 0;
        for (const double gap : kGaps_px) {
            for (const double slope : kHiddenSlopes_deg) {
                const Segment segment = add_tent(glm::radians(turn++ * 23.0 + 5), slope, slope);
                add_cover(gap);
                chart_.hidden.push_back({segment, gap});
            }
            for (const double slope : kCoverSlopes_deg) {
                const double angle_rad = glm::radians(turn++ * 23.0 + 5);
                const Segment segment = add_tent(angle_rad, slope, kFarSlope_deg);
                add_slanted_cover(angle_rad, slope, gap);
                chart_.hidden.push_back({segment, gap});
            }
        }
        for (int i = 0; i < kPyramids; ++i) add_pyramid(glm::radians(i * 90.0 / kPyramids + 3.3));

        Scene& scene = chart_.scene;
        scene.cameras.emplace_back();
        add_object(scene, std::move(tents_), "ridges");
        add_object(scene, std::move(covers_), "covers");
        add_object(scene, std::move(pyramids_), "pyramids");
        scene.picture.width = chart_.width;
        scene.picture.height = chart_.height;
        scene.lines.classes = LineClassSet();
        chart_.camera.orthographic = true;
        chart_.camera.height = chart_.height;
        chart_.camera.to_world[3] = glm::dvec4(0.5 * chart_.width, 0.5 * chart_.height, kEyeZ, 1);
        return std::move(chart_);
    }

  private:
    static std::uint32_t add_vertex(PolygonSoup& soup, glm::dvec2 p, double z) {
        soup.positions.emplace_back(p, z);
        return static_cast<std::uint32_t>(soup.positions.size() - 1);
    }
    /// World to picture: y points down there.
    glm::dvec2 on_picture(glm::dvec2 p) const { return {p.x, chart_.height - p.y}; }

    /// The middle of the next cell, at an offset of a fraction of a pixel.
    glm::dvec2 next_cell() {
        const int i = cells_used_++;
        const auto k = static_cast<unsigned>(i + 1);
        center_ = glm::dvec2((i % kColumns + 0.5) * cell_, (i / kColumns + 0.5) * cell_) +
                  glm::dvec2(spread_fraction(k, 2), spread_fraction(k, 3)) - 0.5;
        return center_;
    }

    /// Two faces that fall by the given angles to the left and to the right of a ridge at z = 0.
    Segment add_tent(double angle_rad, double left_deg, double right_deg) {
        const glm::dvec2 c = next_cell(), d(std::cos(angle_rad), std::sin(angle_rad)), n(-d.y, d.x);
        const glm::dvec2 a = c - d * half_length_, b = c + d * half_length_;
        const double left_z = -half_width_ * std::tan(glm::radians(left_deg));
        const double right_z = -half_width_ * std::tan(glm::radians(right_deg));
        const std::uint32_t va = add_vertex(tents_, a, 0), vb = add_vertex(tents_, b, 0);
        const glm::dvec2 out = n * half_width_;
        const std::uint32_t left[] = {va, vb, add_vertex(tents_, b + out, left_z), add_vertex(tents_, a + out, left_z)};
        const std::uint32_t right[] = {vb, va, add_vertex(tents_, a - out, right_z),
                                       add_vertex(tents_, b - out, right_z)};
        tents_.add_polygon(left);
        tents_.add_polygon(right);
        return {on_picture(a), on_picture(b)};
    }

    /// A square over the whole of the last cell.
    void add_cover(double z) {
        const double h = 0.5 * cell_ - 1;
        const std::uint32_t corners[] = {
            add_vertex(covers_, center_ + glm::dvec2(-h, -h), z), add_vertex(covers_, center_ + glm::dvec2(h, -h), z),
            add_vertex(covers_, center_ + glm::dvec2(h, h), z), add_vertex(covers_, center_ + glm::dvec2(-h, h), z)};
        covers_.add_polygon(corners);
    }

    /// A rectangle over the last cell's tent, parallel to its left face.
    void add_slanted_cover(double angle_rad, double slope_deg, double z) {
        const glm::dvec2 d(std::cos(angle_rad), std::sin(angle_rad)), n(-d.y, d.x);
        const glm::dvec2 along = d * (half_length_ + 1), out = n * (half_width_ + 1);
        const double fall = (half_width_ + 1) * std::tan(glm::radians(slope_deg));
        const std::uint32_t corners[] = {
            add_vertex(covers_, center_ - along - out, z + fall), add_vertex(covers_, center_ + along - out, z + fall),
            add_vertex(covers_, center_ + along + out, z - fall), add_vertex(covers_, center_ - along + out, z - fall)};
        covers_.add_polygon(corners);
    }

    void add_pyramid(double angle_rad) {
        const glm::dvec2 c = next_cell(), d(std::cos(angle_rad), std::sin(angle_rad)), n(-d.y, d.x);
        const double h = half_length_ - 4;
        // From the corners run creases to the apex, and must not get into the silhouettes'
        // profiles.
        const double inset = chart_.reach_px + 1.5 - kEndMargin_px;
        const glm::dvec2 corners[] = {c - d * h - n * h, c + d * h - n * h, c + d * h + n * h, c - d * h + n * h};
        std::uint32_t base[4];
        for (std::size_t i = 0; i < 4; ++i) {
            base[i] = add_vertex(pyramids_, corners[i], -h);
            const glm::dvec2 next = corners[(i + 1) % 4], along = glm::normalize(next - corners[i]);
            chart_.silhouettes.push_back({on_picture(corners[i] + along * inset), on_picture(next - along * inset)});
        }
        const std::uint32_t apex = add_vertex(pyramids_, c, 0);
        for (std::size_t i = 0; i < 4; ++i) {
            const std::uint32_t side[] = {base[i], base[(i + 1) % 4], apex};
            pyramids_.add_polygon(side);
        }
        const std::uint32_t bottom[] = {base[3], base[2], base[1], base[0]};
        pyramids_.add_polygon(bottom);
    }

    double half_length_, half_width_, cell_;
    int cells_used_ = 0;
    glm::dvec2 center_{0.0};
    PolygonSoup tents_, covers_, pyramids_;
    TestChart chart_;
};

}  // namespace

TestChart make_test_chart(double width_px) { return ChartBuilder(width_px).build(); }

}  // namespace burin
