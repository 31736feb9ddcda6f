#include "methods/seen_surfaces.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "methods/abuffer.h"
#include "render/frame.h"

namespace burin {
namespace {

/// Places of a grid; more are no finer than lines hide.
constexpr double kMostPlaces = 24e6;
constexpr int kMostPlacesPerPx = 3;
/// Rows of the finer picture that are in memory at once.
constexpr int kBandRows = 512;
constexpr int kSamplesPerPixel = 2;

/// Has a scene drawn as surfaces alone, `times` as large, while it lives.
class AsSurfaces {
  public:
    AsSurfaces(Scene& scene, int times)
        : scene_(scene),
          lines_(scene.lines),
          sheet_(scene.sheet),
          abuffer_(scene.abuffer),
          dpi_(scene.picture.dpi),
          finds_all_(scene.finds_all),
          names_lines_(scene.names_lines) {
        scene.lines.classes = {};
        scene.lines.style.hidden.style = HiddenStyle::none;
        scene.sheet = nullptr;
        scene.abuffer.samples = kSamplesPerPixel;
        scene.picture.dpi *= times;
        scene.finds_all = scene.names_lines = false;
    }
    ~AsSurfaces() {
        scene_.lines = std::move(lines_);
        scene_.sheet = std::move(sheet_);
        scene_.abuffer = abuffer_;
        scene_.picture.dpi = dpi_;
        scene_.finds_all = finds_all_;
        scene_.names_lines = names_lines_;
    }
    AsSurfaces(const AsSurfaces&) = delete;
    AsSurfaces& operator=(const AsSurfaces&) = delete;

  private:
    Scene& scene_;
    LineSettings lines_;
    std::shared_ptr<const StyleSheet> sheet_;
    AbufferSettings abuffer_;
    double dpi_;
    bool finds_all_, names_lines_;
};

void add_rows(const Image& image, SurfaceGridMaker& maker) {
    const auto objects = image.find("id.object")->as<std::uint32_t>();
    const auto row = [&](const char* channel, std::size_t first) {
        return &image.find(channel)->as<std::uint16_t>()[first];
    };
    for (int y = 0; y < image.height(); ++y) {
        const std::size_t first = static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width());
        maker.add_row(&objects[first], {row("surface.R", first), row("surface.G", first), row("surface.B", first),
                                        row("surface.A", first)});
    }
}

}  // namespace

bool surfaces_have_look(const Scene& scene) {
    return scene.surfaces.shading != SurfaceShading::paper && scene.surfaces.shading != SurfaceShading::none;
}

SurfaceGrid seen_surfaces(Scene& scene, const Camera& camera, PixelRect area, const RunOptions& run) {
    const double pixels = static_cast<double>(area.width()) * area.height();
    const int times = std::clamp(static_cast<int>(std::sqrt(kMostPlaces / std::max(pixels, 1.0))), 1, kMostPlacesPerPx);
    const AsSurfaces only(scene, times);
    // The object is that at the sample after the middle.
    constexpr double kPlace = (kSamplesPerPixel / 2 + 0.5) / kSamplesPerPixel;
    SurfaceGridMaker maker(area, times, glm::dvec2(kPlace));
    const LayerSet layers{.beauty = false,
                          .lines = false,
                          .depth = false,
                          .normal = false,
                          .ids = true,
                          .coverage = false,
                          .surface = true};
    const int width = scene.picture.width * times, height = scene.picture.height * times;
    RunOptions quiet = run;
    quiet.progress = nullptr;
    quiet.found_lines = nullptr;
    quiet.finished_band = nullptr;
    for (int y = area.y0 * times; y < area.y1 * times; y += kBandRows) {
        const PixelRect band{area.x0 * times, y, area.x1 * times, std::min(y + kBandRows, area.y1 * times)};
        const Frame frame = make_frame(scene, camera, width, height, band);
        Film film({0, 0, width, height}, band, layers, {});
        render_abuffer(frame, quiet, film);
        add_rows(film.image(), maker);
    }
    return maker.grid();
}

}  // namespace burin
