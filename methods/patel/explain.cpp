#include "methods/patel/explain.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <numeric>

#include "methods/abuffer.h"
#include "methods/patel/patel.h"
#include "methods/patel/patel_tile.h"
#include "methods/surface_bins.h"

namespace burin {
namespace {

[[gnu::format(printf, 1, 2)]] std::string format(const char* pattern, ...) {
    char text[512];
    va_list arguments;
    va_start(arguments, pattern);
    std::vsnprintf(text, sizeof text, pattern, arguments);
    va_end(arguments);
    return text;
}

/// Counted as the file has the polygons: large meshes are put in spatial order.
std::uint32_t triangle_in_input(const Mesh& mesh, std::uint32_t triangle) {
    const std::uint32_t place = mesh.input_place_of(triangle);
    std::uint32_t before = 0;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const std::uint32_t other = mesh.input_place_of(t);
        before += other < place || (other == place && t < triangle) ? 1 : 0;
    }
    return before;
}

/// Pictures of masks side by side, each under its title.
template <typename Mask>
std::string pictures_side_by_side(const std::vector<std::pair<std::string, Mask>>& titled) {
    constexpr std::size_t kSide = static_cast<std::size_t>(mask_side<Mask>);
    std::string text = "   ";
    for (const auto& [title, mask] : titled) {
        text += format(" %-*s", static_cast<int>(std::max(kSide, title.size()) + 2), title.c_str());
    }
    text += '\n';
    for (std::size_t row = 0; row < kSide; ++row) {
        text += "   ";
        for (const auto& [title, mask] : titled) {
            const std::string line = mask_picture(mask).substr(row * (kSide + 1), kSide);
            text += format(" %-*s", static_cast<int>(std::max(kSide, title.size()) + 2), line.c_str());
        }
        text += '\n';
    }
    return text;
}

template <typename Mask>
class Explainer {
  public:
    Explainer(const Frame& frame, const ExtendedGrid& grid, int x, int y)
        : frame_(frame), grid_(grid), x_(x), y_(y), tile_(frame, grid) {}

    std::string explain() {
        const PixelRect pixel{x_, y_, x_ + 1, y_ + 1};
        const int margin_px = grid_.apron / grid_.samples_per_pixel() + 1;
        const SurfaceBins bins(frame_.surfaces, pixel, 1, margin_px, 1);
        tile_.load(pixel, bins.surfaces(0));
        visible_ = &tile_.resolve(x_, y_);
        lines_ = &tile_.find_lines(x_, y_);
        number_fragments();
        return header() + fragment_texts() + pair_texts() + result_text();
    }

  private:
    std::span<const Fragment<Mask>> fragments() const { return tile_.fragments(x_, y_); }

    /// Fragments are called 1, 2, ... from front to back; the background comes last.
    void number_fragments() {
        const auto list = fragments();
        order_.resize(list.size());
        std::iota(order_.begin(), order_.end(), 0u);
        const glm::dvec2 center(x_ + 0.5, y_ + 0.5);
        std::stable_sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
            return tile_.plane_of(list[a]).nearness(center) > tile_.plane_of(list[b]).nearness(center);
        });
        label_.assign(list.size() + 1, "background");
        for (std::size_t i = 0; i < order_.size(); ++i) {
            label_[order_[i]] = "fragment " + std::to_string(i + 1);
        }
    }

    std::string header() const {
        return format("pixel %d,%d of %dx%d: %zu fragment%s, masks %dx%d (own samples %dx%d, apron %d)\n", x_, y_,
                      frame_.width, frame_.height, fragments().size(), fragments().size() == 1 ? "" : "s", grid_.side,
                      grid_.side, grid_.samples_per_pixel(), grid_.samples_per_pixel(), grid_.apron);
    }

    std::string fragment_texts() const {
        std::string text;
        const auto list = fragments();
        const SurfaceSet& surfaces = frame_.surfaces;
        const glm::dvec2 center(x_ + 0.5, y_ + 0.5);
        for (std::size_t i = 0; i < order_.size(); ++i) {
            const Fragment<Mask>& f = list[order_[i]];
            const SurfaceId id = tile_.surface_of(f);
            const DepthPlane& plane = tile_.plane_of(f);
            const double distance = surfaces.projection.distance(plane.nearness(center));
            const double per_nearness = surfaces.projection.orthographic ? -1.0 : -distance * distance;
            const glm::dvec3 normal = surfaces.view_to_world * surfaces.view_normal(id);
            text += format("\nfragment %zu: object %u \"%s\", material %u \"%s\", polygon %u, triangle %u\n", i + 1,
                           surfaces.object_id(id), frame_.scene->objects[id.instance].name.c_str(),
                           surfaces.material_id(id), frame_.material_of(id).name.c_str(), surfaces.polygon_id(id),
                           triangle_in_input(surfaces.mesh_of(id), id.triangle));
            text += format("    distance %.9g at the pixel's centre, %+.4g per pixel right, %+.4g per pixel down\n",
                           distance, plane.per_x * per_nearness, plane.per_y * per_nearness);
            text += format("    normal %.4f %.4f %.4f\n", normal.x, normal.y, normal.z);
            text += pictures_side_by_side<Mask>({{"covers", f.mask}, {"visible", visible_->masks[order_[i]]}});
        }
        return text;
    }

    std::string pair_texts() const {
        std::string text;
        for (const FragmentPair& pair : lines_->pairs) {
            const LineDecision& d = pair.decision;
            const LineClassSet drawn = d.classes & frame_.criteria.classes;
            text += "\n" + label_[pair.first] + " and " + label_[pair.second] + ": " + std::string(describe(d.reason)) +
                    "\n";
            if (!d.classes.empty()) {
                text += "    classes: " + to_string(d.classes) +
                        (drawn.empty() ? ", none of them asked for\n"
                                       : "; drawn as " + std::string(name_of(*drawn.first())) + "\n");
            }
            if (d.gap_px != 0) {
                text += std::isinf(d.gap_px)
                            ? "    nothing behind it\n"
                            : format("    the other surface is %.3g pixel widths farther there\n", d.gap_px);
            }
            text += edge_text(d.edge);
            text += format("    between the samples at %.4f,%.4f and %.4f,%.4f\n", pair.points[0].pixel.x,
                           pair.points[0].pixel.y, pair.points[1].pixel.x, pair.points[1].pixel.y);
        }
        return text;
    }

    std::string edge_text(const SurfaceEdge& edge) const {
        if (edge.half_edge == kNoHalfEdge) return {};
        const Mesh& mesh = frame_.surfaces.mesh_of(edge.surface);
        const auto& t = mesh.triangles[edge.half_edge / 3];
        const glm::dmat4& to_world = frame_.scene->objects[edge.surface.instance].to_world;
        const auto corner = [&](std::uint32_t k) {
            return glm::dvec3(to_world * glm::dvec4(mesh.position(t[k % 3]), 1.0));
        };
        const glm::dvec3 a = corner(edge.half_edge % 3), b = corner(edge.half_edge % 3 + 1);
        return format("    the edge from (%.6g, %.6g, %.6g) to (%.6g, %.6g, %.6g)\n", a.x, a.y, a.z, b.x, b.y, b.z);
    }

    std::string result_text() const {
        std::string text = "\n";
        const PixelResult result = tile_.shade(x_, y_);
        if (!lines_->any) return text + "no line is drawn in this pixel by these samples\n";
        std::vector<std::pair<std::string, Mask>> titled;
        for (std::size_t c = 0; c < kLineClassCount; ++c) {
            if (lines_->masks[c] == Mask{}) continue;
            titled.emplace_back(std::string(kLineClassNames[c]), lines_->masks[c]);
        }
        text += "strokes:\n" + pictures_side_by_side<Mask>(titled);
        return text + format("line coverage of the pixel: %.4f\n", static_cast<double>(result.lines.a));
    }

    const Frame& frame_;
    ExtendedGrid grid_;
    int x_, y_;
    PatelTile<Mask> tile_;
    const VisibleSamples<Mask>* visible_ = nullptr;
    const PixelLines<Mask>* lines_ = nullptr;
    std::vector<std::uint32_t> order_;
    std::vector<std::string> label_;
};

}  // namespace

std::string drawn_by_abuffer(const Frame& given, int x, int y) {
    Frame frame = given;
    frame.crop = {x, y, x + 1, y + 1};
    LayerSet layers{.depth = false, .normal = false, .ids = false};
    layers.coverage = true;
    Film film({0, 0, frame.width, frame.height}, frame.crop, layers, frame.criteria.classes);
    render_abuffer(frame, RunOptions{}, film);
    std::string classes;
    for (std::size_t c = 0; c < kLineClassCount; ++c) {
        const Channel* const channel = film.image().find("coverage." + std::string(kLineClassNames[c]));
        const double coverage = channel == nullptr ? 0 : film.image().value(*channel, 0, 0);
        if (coverage > 0)
            classes += (classes.empty() ? "" : ", ") + std::string(kLineClassNames[c]) + format(" %.4f", coverage);
    }
    return "method abuffer, with lines that these samples miss, covers of the pixel: " +
           (classes.empty() ? "nothing" : classes) + "\n";
}

std::string explain_pixel(const Frame& frame, int x, int y) {
    return with_patel_grid(*frame.scene, [&](auto mask, const ExtendedGrid& grid) {
        return Explainer<decltype(mask)>(frame, grid, x, y).explain();
    });
}

}  // namespace burin
