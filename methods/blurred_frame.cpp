#include "methods/blurred_frame.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/limit_error.h"
#include "render/blur_extent.h"
#include "render/blur_sums.h"
#include "render/matte_sums.h"
#include "render/mattes.h"

namespace burin {
namespace {

/// Straight parts that the way of a place is measured by.
constexpr int kPartsOfWay = 4;

const ShutterSettings* shutter_of(const Blur& blur) { return blur.shutter ? &*blur.shutter : nullptr; }

bool all_have_mean(const std::vector<ChannelFormat>& channels) {
    return std::all_of(channels.begin(), channels.end(), has_mean);
}
bool any_has_mean(const std::vector<ChannelFormat>& channels) {
    return std::any_of(channels.begin(), channels.end(), has_mean);
}

bool sums_mattes(const Film& film) {
    return film.mattes() != nullptr && (film.mattes()->wants_shares() || film.mattes()->wants_deep());
}
bool needs_middle(const Film& film) { return !all_have_mean(film.channels()) || film.layers().line; }

/// Of sums, and of a picture that is summed.
std::size_t bytes_per_row(const Film& film) {
    constexpr std::size_t kBytesOfMattes = 64;
    std::size_t bytes = sums_mattes(film) ? kBytesOfMattes : 0;
    for (const ChannelFormat& channel : film.channels())
        bytes += has_mean(channel) ? sizeof(float) + size_of(channel.type) : 0;
    return bytes * static_cast<std::size_t>(film.crop().width());
}

/// The rows that are summed at once: under a cap for memory, so many that this takes no more than half of it.
std::vector<PixelRect> bands_of(const Film& film, const RunOptions& options) {
    const PixelRect all = film.crop();
    if (!any_has_mean(film.channels()) && !sums_mattes(film)) return {};
    int height = all.height();
    if (options.memory_bytes > 0) {
        const auto rows = options.memory_bytes / 2 / bytes_per_row(film) / Film::kBandRows * Film::kBandRows;
        height = static_cast<int>(std::clamp<std::uint64_t>(rows, Film::kBandRows, static_cast<std::uint64_t>(height)));
    }
    std::vector<PixelRect> bands;
    for (int y = all.y0; y < all.y1; y += height) bands.push_back({all.x0, y, all.x1, std::min(all.y1, y + height)});
    return bands;
}

/// What is left of a cap for memory by the sums of some rows.
std::uint64_t cap_beside_sums(const Film& film, PixelRect rows, const RunOptions& options) {
    const std::uint64_t taken = bytes_per_row(film) * static_cast<std::uint64_t>(rows.height());
    return options.memory_bytes - std::min(options.memory_bytes / 2, taken);
}

/// Draws sub-frames of one picture.
class BlurredFrame {
  public:
    BlurredFrame(const Method& method, const Blur& blur, const MomentAt& moment_at, int width, int height,
                 const RunOptions& options, Film& film, const ReadyFrame& make_ready)
        : method_(method),
          blur_(blur),
          moment_at_(moment_at),
          width_(width),
          height_(height),
          options_(options),
          film_(film),
          make_ready_(make_ready),
          layers_(layers_with_mean(film.layers())) {
        progress_ = std::exchange(options_.progress, nullptr);
        options_.finished_band = nullptr;
        options_.found_lines = nullptr;
    }

    RenderStats draw(int count) {
        if (progress_ != nullptr) progress_->begin("rendering", sub_frames_drawn(count, options_, film_));
        if (needs_middle(film_))
            draw_frame(frame_of(middle_sub_frame(shutter_of(blur_)), film_.crop(), true), film_, options_);
        if (sums_mattes(film_)) film_.mattes()->begin_mean();
        const std::vector<SubFrame> subs = sub_frames(shutter_of(blur_), blur_.has_lens, count);
        for (const PixelRect& rows : bands_of(film_, options_)) draw_mean(subs, rows);
        return std::move(stats_);
    }

  private:
    Frame frame_of(const SubFrame& sub, PixelRect rows, bool is_middle = false) {
        const Moment moment = moment_at_(sub.time, MomentUse::drawing);
        const bool is_moved = sub.lens != glm::dvec2(0.0);
        const Camera camera = is_moved ? from_lens_point(moment.camera, sub.lens) : moment.camera;
        if (is_moved) check_lens(moment.camera, camera);
        Frame frame = make_frame(*moment.scene, camera, width_, height_, rows, moment.prepared);
        if (make_ready_) make_ready_(frame, is_middle);
        return frame;
    }

    /// Refuses a lens that is too large for the distance in focus. `moved`: the camera as a point of it sees.
    void check_lens(const Camera& camera, const Camera& moved) const {
        const auto is_in_reach = [&](const Camera& c) {
            const glm::dvec2 center = c.projection(width_, height_, 0).center_px;
            const glm::dvec2 farthest = glm::max(glm::abs(center), glm::abs(glm::dvec2(width_, height_) - center));
            return std::max(farthest.x, farthest.y) <= kGuardBandPx;
        };
        if (is_in_reach(moved) || !is_in_reach(camera)) return;
        throw InputError("the lens moves the picture beyond " + std::to_string(static_cast<int>(kGuardBandPx)) +
                         " pixels from its axis; make its radius smaller, or the distance in focus larger");
    }

    void draw_frame(const Frame& frame, Film& film, const RunOptions& options) {
        try {
            add(method_.render(frame, options, film), stats_);
        } catch (const LimitError& error) {
            throw error.times(2);  // sums take up to a half
        }
        if (progress_ != nullptr) progress_->advance();
    }

    void draw_mean(const std::vector<SubFrame>& subs, PixelRect rows) {
        std::optional<Frame> frame = frame_of(subs.front(), rows);
        const LineClassSet classes = frame->criteria.classes;
        const bool in_bands = method_.finishes_in_bands != nullptr && method_.finishes_in_bands(*frame);
        Film film = in_bands ? Film::in_bands(film_.display(), rows, layers_, classes)
                             : Film(film_.display(), rows, layers_, classes);
        BlurSums sums(rows, film.channels());
        std::optional<MatteSums> matte_sums;
        if (sums_mattes(film)) matte_sums.emplace(rows, *film.mattes());
        RunOptions options = options_;
        options.memory_bytes = cap_beside_sums(film_, rows, options);
        if (in_bands) {
            options.finished_band = [&](std::size_t band) {
                sums.add(film.band(band));
                if (matte_sums) matte_sums->add(*film.mattes(), band);
                film.close(band);
            };
        }
        for (std::size_t i = 0; i < subs.size(); ++i) {
            if (i > 0) {
                frame.reset();  // it borrows the moment before
                frame = frame_of(subs[i], rows);
            }
            draw_frame(*frame, film, options);
            if (in_bands) continue;
            sums.add(film.image(), options.threads);
            if (matte_sums) matte_sums->add_all(*film.mattes(), options.threads);
        }
        const int count = static_cast<int>(subs.size());
        sums.put_mean(count, film_.image(), options.threads);
        if (matte_sums) matte_sums->put_mean(count, *film_.mattes(), options.threads);
    }

    const Method& method_;
    const Blur& blur_;
    const MomentAt& moment_at_;
    int width_, height_;
    RunOptions options_;
    Film& film_;
    const ReadyFrame& make_ready_;
    Progress* progress_;
    LayerSet layers_;
    RenderStats stats_;
};

}  // namespace

int sub_frame_count(const Blur& blur, const MomentAt& moment_at, int width, int height) {
    if (!blur.is_asked_for()) return 1;
    if (blur.samples) return *blur.samples;
    double way_px = 0, circle_px = 0;
    BlurExtent extent(width, height);
    const auto look_at = [&](double time) {
        const Moment moment = moment_at(time, MomentUse::extent);
        extent.add(*moment.scene, moment.camera);
        circle_px = std::max(circle_px, extent.circle_px());
    };
    if (blur.shutter) {
        for (int i = 0; i <= kPartsOfWay; ++i)
            look_at(blur.shutter->open + (blur.shutter->close - blur.shutter->open) * i / kPartsOfWay);
        way_px = extent.way_px();
    } else {
        look_at(0);
    }
    return automatic_sub_frames(way_px, blur.has_lens ? circle_px : 0);
}

RenderStats render_blurred(const Method& method, const Blur& blur, int count, const MomentAt& moment_at, int width,
                           int height, const RunOptions& options, Film& film, const ReadyFrame& make_ready) {
    return BlurredFrame(method, blur, moment_at, width, height, options, film, make_ready).draw(count);
}

std::size_t sub_frames_drawn(int count, const RunOptions& options, const Film& film) {
    return bands_of(film, options).size() * static_cast<std::size_t>(count) + (needs_middle(film) ? 1 : 0);
}

BlurParts blur_parts(const RunOptions& options, const Film& film) {
    std::vector<PixelRect> rows = bands_of(film, options);
    const std::uint64_t cap_bytes = rows.empty() ? options.memory_bytes : cap_beside_sums(film, rows.front(), options);
    return {std::move(rows), cap_bytes};
}

}  // namespace burin
