#include "compare/rasterize_svg.h"

#include <stdlib.h>  // mkdtemp

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "base/atomic_file.h"
#include "base/error.h"
#include "compare/run_program.h"
#include "image/image_io.h"
#include "output/svg.h"

namespace burin {
namespace {

/// Fine pixels along the side of a pixel.
constexpr int kFine = 4;

/// The largest part that is drawn at once: what bounds memory, and stays below the largest image of librsvg.
constexpr int kPartSide_px = 1024;

constexpr double kTimeLimit_s = 300;  ///< for a part

/// A folder that exists as long as this object.
class ScratchFolder {
  public:
    ScratchFolder() {
        const char* const parent = std::getenv("TMPDIR");
        path_ =
            (std::filesystem::path(parent != nullptr && *parent != '\0' ? parent : "/tmp") / "burin-XXXXXX").string();
        if (::mkdtemp(path_.data()) == nullptr) {
            throw InputError(path_ + ": cannot make this temporary folder: " + std::strerror(errno) +
                             "; set TMPDIR to a folder that can be written to");
        }
    }
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    std::string file(const char* name) const { return path_ + "/" + name; }

  private:
    std::string path_;
};

/// The part `drawing.crop` of a drawing, with `kFine` times as many pixels along each side.
DisplayImage draw_fine(const VectorDrawing& drawing, const std::string& rasterizer, const ScratchFolder& folder) {
    const std::string svg = folder.file("drawing.svg"), png = folder.file("drawing.png");
    const std::string text = svg_of(drawing);
    AtomicFile file(svg);
    file.write(text.data(), text.size());
    file.commit();
    const int width = kFine * drawing.crop.width(), height = kFine * drawing.crop.height();
    // Without --unlimited, drawings of many paths are refused.
    run_program(rasterizer,
                {"--unlimited", "--width", std::to_string(width), "--height", std::to_string(height), "--format", "png",
                 "--output", png, svg},
                folder.file("log.txt"), kTimeLimit_s);
    DisplayImage image = read_display_image(png);
    // A picture that is opaque everywhere has no alpha channel.
    if (image.width != width || image.height != height || (image.channels != 4 && image.channels != 3)) {
        throw InputError(rasterizer + ": made a picture of " + std::to_string(image.width) + "x" +
                         std::to_string(image.height) + " pixels with " + std::to_string(image.channels) +
                         " channels, not " + std::to_string(width) + "x" + std::to_string(height) + " with 3 or 4");
    }
    return image;
}

/// The mean of a pixel's fine pixels; x and y count from the corner of the fine picture.
glm::vec4 mean_color(const DisplayImage& fine, int x, int y) {
    constexpr float kWhole = 65535;
    const auto channels = static_cast<std::size_t>(fine.channels);
    glm::vec4 sum(0.0f);
    for (int j = 0; j < kFine; ++j) {
        const std::size_t row = static_cast<std::size_t>(kFine * y + j) * static_cast<std::size_t>(fine.width);
        const std::uint16_t* p = fine.pixels.data() + channels * (row + static_cast<std::size_t>(kFine * x));
        for (int i = 0; i < kFine; ++i, p += channels) {
            const float alpha = channels == 4 ? static_cast<float>(p[3]) / kWhole : 1;
            if (alpha == 0) continue;
            for (int c = 0; c < 3; ++c) {
                if (p[c] > 0) sum[c] += alpha * linear_from_srgb(static_cast<float>(p[c]) / kWhole);
            }
            sum.a += alpha;
        }
    }
    return sum / static_cast<float>(kFine * kFine);
}

}  // namespace

std::string find_svg_rasterizer() { return find_program("rsvg-convert"); }

std::vector<glm::vec4> rasterize_svg(VectorDrawing drawing, const std::string& rasterizer) {
    const ScratchFolder folder;
    drawing.paper.reset();
    drawing.paper_mm = {0, 0};  // the size follows from the pixels
    const PixelRect whole = drawing.crop;
    std::vector<glm::vec4> colors(static_cast<std::size_t>(whole.width()) * static_cast<std::size_t>(whole.height()));
    for (int y0 = whole.y0; y0 < whole.y1; y0 += kPartSide_px) {
        for (int x0 = whole.x0; x0 < whole.x1; x0 += kPartSide_px) {
            const PixelRect part{x0, y0, std::min(x0 + kPartSide_px, whole.x1), std::min(y0 + kPartSide_px, whole.y1)};
            drawing.crop = part;
            const DisplayImage fine = draw_fine(drawing, rasterizer, folder);
            for (int y = part.y0; y < part.y1; ++y) {
                for (int x = part.x0; x < part.x1; ++x) {
                    const auto at = static_cast<std::size_t>(y - whole.y0) * static_cast<std::size_t>(whole.width()) +
                                    static_cast<std::size_t>(x - whole.x0);
                    colors[at] = mean_color(fine, x - part.x0, y - part.y0);
                }
            }
        }
    }
    return colors;
}

}  // namespace burin
