#include "output/film_files.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/parallel.h"
#include "output/exr_attributes.h"

namespace burin {
namespace {

std::vector<ChannelFormat> named(std::vector<ChannelFormat> channels, ChannelNames names) {
    for (ChannelFormat& channel : channels) channel.name = channel_name(channel.name, names);
    return channels;
}

void write_rows(ExrWriter& exr, const ImageStrip& strip) {
    for (int y = strip.data.y0; y < strip.data.y1; y += ExrWriter::kChunkRows) exr.write_chunk(strip, y);
}

}  // namespace

FilmChannels::FilmChannels(const Frame& frame, const Film& film) : film_(film) {
    if (film.layers().crypto.has_any() || film.layers().line) mattes_.emplace(frame, film);
}

std::vector<ChannelFormat> FilmChannels::formats(const OutputOptions& options) const {
    std::vector<ChannelFormat> formats = film_.channels();
    constexpr std::size_t kBeautyChannels = 4;
    for (std::size_t i = 0; i < kBeautyChannels && film_.layers().beauty && !options.has_beauty; ++i)
        formats[i].name.clear();
    if (!mattes_) return formats;
    for (ChannelFormat& format : mattes_->formats()) formats.push_back(std::move(format));
    return formats;
}

ExrOptions FilmChannels::exr_options(const Frame& frame, const OutputOptions& options) const {
    std::optional<int> image_counter;
    if (options.frame.is_of_sequence) image_counter = static_cast<int>(std::floor(options.frame.number));
    const ExrChoice& choice = options.exr;
    ExrOptions exr = exr_options_of(frame, image_counter, choice.has_camera);
    if (!options.fingerprint.empty()) exr.attributes.push_back({kFingerprintName, options.fingerprint});
    exr.threads = options.threads;
    exr.compression = choice.compression;
    const std::vector<CryptoAttributes> crypto = mattes_ ? mattes_->attributes() : std::vector<CryptoAttributes>{};
    if (choice.has_parts) {
        exr.parts = parts_of(formats(options), crypto);
        return exr;
    }
    for (const CryptoAttributes& layer : crypto)
        exr.attributes.insert(exr.attributes.end(), layer.attributes.begin(), layer.attributes.end());
    return exr;
}

Image FilmChannels::rows(const ImageStrip& strip, int y0, int y1) const {
    Image image(film_.display(), {strip.data.x0, y0, strip.data.x1, y1});
    const std::vector<ChannelFormat> channels = film_.channels();
    const auto width = static_cast<std::size_t>(image.width());
    for (std::size_t c = 0; c < channels.size(); ++c) {
        const std::size_t size = size_of(channels[c].type);
        std::byte* to = image.add_unfilled(channels[c].name, channels[c].type).bytes.data();
        for (int y = y0; y < y1; ++y) {
            std::size_t x = 0;
            for (const Image* const block : strip.blocks) {
                const std::size_t count = std::min(width - x, static_cast<std::size_t>(strip.block_width));
                if (block == nullptr) {
                    for (std::size_t i = 0; i < count; ++i, to += size)
                        std::memcpy(to, strip.background[c].data(), size);
                } else {
                    const auto row = static_cast<std::size_t>(y - block->data().y0);
                    const std::byte* const from =
                        block->channels()[c].bytes.data() + row * static_cast<std::size_t>(block->width()) * size;
                    std::memcpy(to, from, count * size);
                    to += count * size;
                }
                x += count;
            }
        }
    }
    if (mattes_) mattes_->add_to(image);
    return image;
}

DisplayImage displayed(const PictureSettings& picture, const Image& image) {
    std::optional<glm::vec3> background = picture.background;
    if (!background && !picture.transparent) background = glm::vec3(1.0f);  // white paper
    return to_display(image, background);
}

WrittenFilm write_output(const Frame& frame, const Film& film, const OutputOptions& options) {
    return write_output(frame, film, FilmChannels(frame, film), options);
}

WrittenFilm write_output(const Frame& frame, const Film& film, const FilmChannels& channels,
                         const OutputOptions& options) {
    if (options.format != OutputFormat::exr) {
        DisplayImage image = displayed(frame.scene->picture, film.image());
        image.fingerprint = options.fingerprint;
        write_display_image(options.path, image, options.bits);
        return {};
    }
    ExrWriter exr(options.path, film.display(), film.crop(), named(channels.formats(options), options.exr.names),
                  channels.exr_options(frame, options));
    const ImageStrip strip = strip_of(film.image());
    const int step = channels.adds_any() ? Film::kBandRows : ExrWriter::kChunkRows;
    const auto count = static_cast<std::size_t>((strip.data.height() + step - 1) / step);
    parallel_for(count, options.threads, [&](std::size_t i, int) {
        const int y0 = strip.data.y0 + static_cast<int>(i) * step;
        if (!channels.adds_any()) return exr.write_chunk(strip, y0);
        const Image rows = channels.rows(strip, y0, std::min(y0 + step, strip.data.y1));
        write_rows(exr, strip_of(rows));
    });
    exr.finish();
    return {channels.dropped()};
}

void write_output(ByteSink& file, const PictureSettings& picture, const Image& image, const ExrOptions& exr,
                  const OutputOptions& options) {
    if (options.format == OutputFormat::exr) {
        ExrOptions own = exr;
        own.threads = options.threads;
        return write_exr(file, options.path, image, own);
    }
    const std::string suffix(suffix_of(options.format));
    write_display_image(file, options.path, suffix, displayed(picture, image), options.bits);
}

BandWriter::BandWriter(const Frame& frame, const Film& film, const OutputOptions& options)
    : film_(film),
      channels_(frame, film),
      exr_(std::make_unique<ExrWriter>(options.path, film.display(), film.crop(),
                                       named(channels_.formats(options), options.exr.names),
                                       channels_.exr_options(frame, options))) {}

void BandWriter::write(std::size_t band) {
    const ImageStrip strip = film_.band(band);
    if (!channels_.adds_any()) return write_rows(*exr_, strip);
    const Image rows = channels_.rows(strip, strip.data.y0, strip.data.y1);
    write_rows(*exr_, strip_of(rows));
}

BandWriter::~BandWriter() = default;

WrittenFilm BandWriter::finish() {
    exr_->finish();
    return {channels_.dropped()};
}

}  // namespace burin
