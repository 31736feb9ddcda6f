#include "output/deep_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "base/parallel.h"
#include "image/half.h"
#include "output/exr_attributes.h"
#include "render/mattes.h"

namespace burin {
namespace {

/// In the order of their names, as an EXR has them.
std::vector<ChannelFormat> deep_channels(bool is_float) {
    const PixelType color = is_float ? PixelType::float32 : PixelType::float16;
    return {{"A", color},
            {"B", color},
            {"G", color},
            {"R", color},
            {"Z", PixelType::float32},
            {"lineid", PixelType::uint32},
            {"materialid", PixelType::uint32},
            {"objectid", PixelType::uint32},
            {"qi", PixelType::uint32}};
}

ExrOptions deep_options(const Frame& frame, const OutputOptions& output, const std::vector<NamedIds>& names) {
    std::optional<int> image_counter;
    if (output.frame.is_of_sequence) image_counter = static_cast<int>(std::floor(output.frame.number));
    ExrOptions exr = exr_options_of(frame, image_counter, output.exr.has_camera);
    if (!output.fingerprint.empty()) exr.attributes.push_back({kFingerprintName, output.fingerprint});
    constexpr std::uint8_t kTidy = 3;  // sorted, and nothing overlaps
    exr.attributes.push_back({"deepImageState", ExrBytes{"deepImageState", {kTidy}}});
    exr.attributes.push_back({"idManifest", ExrBytes{"idmanifest", id_manifest(names)}});
    // OpenEXR before 3.2 reads 4 bytes too many behind a manifest: they are the first ones of this name.
    exr.attributes.push_back({"idManifestNote", "MurmurHash3_32 of names"});
    exr.threads = output.threads;
    exr.compression = output.exr.compression;
    return exr;
}

void put_half(float value, std::uint8_t*& to) {
    const std::uint16_t half = half_from_float(value);
    std::memcpy(to, &half, sizeof half);
    to += sizeof half;
}
template <typename Number>
void put_number(Number value, std::uint8_t*& to) {
    std::memcpy(to, &value, sizeof value);
    to += sizeof value;
}

/// The bytes of a row's samples, channel by channel.
std::vector<std::uint8_t> bytes_of(const std::vector<DeepSample>& samples, bool is_float) {
    constexpr std::size_t kColors = 4, kOthers = 5;
    const std::size_t size = kColors * (is_float ? sizeof(float) : sizeof(std::uint16_t)) + kOthers * sizeof(float);
    std::vector<std::uint8_t> bytes(samples.size() * size);
    std::uint8_t* to = bytes.data();
    const auto put_color = [&](float value) { is_float ? put_number(value, to) : put_half(value, to); };
    for (const DeepSample& s : samples) put_color(s.alpha);
    for (int c = 2; c >= 0; --c) {
        for (const DeepSample& s : samples) put_color(s.color[c]);
    }
    for (const DeepSample& s : samples) put_number(s.z, to);
    for (const DeepSample& s : samples) put_number(s.line, to);
    for (const DeepSample& s : samples) put_number(s.material, to);
    for (const DeepSample& s : samples) put_number(s.object, to);
    for (const DeepSample& s : samples) put_number(s.invisibility, to);
    return bytes;
}

}  // namespace

DeepWriter::DeepWriter(const Frame& frame, const Film& film, const OutputOptions& output)
    : mattes_(*film.mattes()),
      crop_(film.crop()),
      sampler_(frame),
      is_float_(frame.scene->deep.is_float),
      exr_(output.path, film.display(), film.crop(), deep_channels(is_float_),
           deep_options(frame, output, sampler_.names())) {}
DeepWriter::~DeepWriter() = default;

void DeepWriter::write(std::size_t band) {
    PixelRect rows = crop_;
    rows.y0 += static_cast<int>(band) * Film::kBandRows;
    rows.y1 = std::min(rows.y0 + Film::kBandRows, crop_.y1);
    const auto width = static_cast<std::size_t>(rows.width()), height = static_cast<std::size_t>(rows.height());
    DeepSampler sampler = sampler_;
    std::vector<DeepRow> packed(height);
    std::vector<std::vector<DeepSample>> samples(height);
    for (DeepRow& row : packed) row.counts.resize(width, 0);
    mattes_.for_deep_pixels(rows, [&](const Mattes::DeepPixel& pixel) {
        const std::span<const DeepSample> own = sampler.samples_of(pixel);
        const auto y = static_cast<std::size_t>(pixel.y - rows.y0), x = static_cast<std::size_t>(pixel.x - rows.x0);
        packed[y].counts[x] = static_cast<std::uint32_t>(own.size());
        samples[y].insert(samples[y].end(), own.begin(), own.end());
    });
    for (std::size_t y = 0; y < height; ++y) packed[y].samples = bytes_of(samples[y], is_float_);
    exr_.write_rows(rows.y0, packed);
}

void DeepWriter::write_all(int threads) {
    const auto bands = static_cast<std::size_t>((crop_.height() + Film::kBandRows - 1) / Film::kBandRows);
    parallel_for(bands, threads, [&](std::size_t band, int) { write(band); });
}

void DeepWriter::finish() { exr_.finish(); }

}  // namespace burin
