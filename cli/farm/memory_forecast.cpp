#include "cli/farm/memory_forecast.h"

#include <algorithm>

namespace burin {
namespace {

// Measured with models of 12 to 900,000 triangles, and pictures of 640x360 to 3840x2160.
constexpr std::uint64_t kProgramBytes = 16'000'000;
constexpr std::uint64_t kBytesPerTriangle = 60;
constexpr std::uint64_t kBytesPerObject = 4'000;
constexpr std::uint64_t kBytesOfTiffModule = 110'000'000;  // and of the libraries that it brings along
constexpr std::uint64_t kBytesPerThread = 4'000'000;
// Of bands that wait to be compressed. Fewer of them wait where there is only one thread.
constexpr std::uint64_t kBytesPerColumn = 5'000, kBytesPerColumnOfOneThread = 3'800;
constexpr std::uint64_t kDeepBytesPerColumn = 14'000, kDeepBytesPerColumnOfOneThread = 7'000;
/// How many lines a picture has is not known before it is drawn. What they take is told from the numbers of triangles
/// and objects, up to a number of bytes that large scenes seldom passed.
struct Found {
    std::uint64_t per_triangle, per_object, most;
    std::uint64_t in(const PictureLoad& load) const {
        return std::min(per_triangle * load.triangles + per_object * load.objects, most);
    }
};
constexpr Found kFragments{400, 60'000, 13'000'000};
constexpr Found kAllLines{400, 60'000, 17'000'000}, kPathLines{100, 60'000, 16'000'000};
/// Regions of surfaces in a vector file are made of samples.
constexpr std::uint64_t kBytesOfRegions = 20'000'000, kBytesPerRegionPixel = 60;
constexpr std::uint64_t kBytesPerDisplayPixel = 6;  // of a picture that is written as PNG or TIFF
constexpr std::uint64_t kBytesPerColor = 8;         // red, green, blue and alpha in half precision

/// Of the ranks of Cryptomatte, which are made for the rows that are written.
std::uint64_t bytes_per_pixel_of_ranks(const LayerSet& layers) {
    constexpr std::uint64_t kBytesPerRank = 8;
    std::uint64_t count = 0;
    for (int layer = 0; layer < kCryptoLayerCount; ++layer)
        count += std::uint64_t{layers.crypto.has(static_cast<CryptoLayer>(layer))};
    return kBytesPerRank * count * static_cast<std::uint64_t>(layers.crypto_ranks);
}

/// Of all else.
std::uint64_t bytes_per_pixel(const LayerSet& layers, int classes) {
    const auto number = [](bool is_there, std::uint64_t bytes) { return is_there ? bytes : 0; };
    constexpr std::uint64_t kCoverageBytes = 2;
    return number(layers.beauty, kBytesPerColor) + number(layers.lines, kBytesPerColor) +
           number(layers.surface, kBytesPerColor) + number(layers.lines_hidden, kBytesPerColor) +
           kBytesPerColor * layers.line_sets.size() + number(layers.depth, 4) + number(layers.normal, 12) +
           number(layers.ids, 12) + number(layers.coverage, kCoverageBytes * static_cast<std::uint64_t>(classes)) +
           number(layers.line, 22) + number(layers.motion, 8);
}

/// Layers of colours.
std::uint64_t color_layers(const LayerSet& layers) {
    return std::uint64_t{layers.beauty} + std::uint64_t{layers.lines} + std::uint64_t{layers.surface} +
           std::uint64_t{layers.lines_hidden} + layers.line_sets.size();
}

std::uint64_t pixel_count(PixelRect area) {
    return static_cast<std::uint64_t>(area.width()) * static_cast<std::uint64_t>(area.height());
}

}  // namespace

MemoryForecast forecast_memory(const PictureLoad& load) {
    MemoryForecast forecast;
    forecast.program = kProgramBytes + (load.format == OutputFormat::tiff ? kBytesOfTiffModule : 0);
    forecast.model = kBytesPerTriangle * load.triangles + kBytesPerObject * load.objects;
    const std::uint64_t pixels = pixel_count(load.area);
    const auto columns = static_cast<std::uint64_t>(load.area.width());
    if (load.is_in_bands) {
        const std::uint64_t waiting = load.threads > 1 ? kBytesPerColumn : kBytesPerColumnOfOneThread;
        forecast.film = std::min(waiting * columns, uncompressed_bytes(load));
    } else {
        constexpr std::uint64_t kRowsOfRanks = 32;
        forecast.film = bytes_per_pixel(load.layers, load.classes) * pixels +
                        bytes_per_pixel_of_ranks(load.layers) * std::min(kRowsOfRanks * columns, pixels);
        if (load.format == OutputFormat::png || load.format == OutputFormat::tiff)
            forecast.film += kBytesPerDisplayPixel * pixels;
    }
    // Samples of deep files, and of rows that wait to be compressed.
    constexpr std::uint64_t kBytesPerSample = 48;
    if (load.layers.deep) {
        const std::uint64_t whole = kBytesPerSample * pixels,
                            deep_columns = load.threads > 1 ? kDeepBytesPerColumn : kDeepBytesPerColumnOfOneThread;
        forecast.film += load.is_in_bands ? std::min(deep_columns * columns, 2 * whole) : whole;
    }
    // Shares of owners are kept beside the film.
    constexpr std::uint64_t kBytesOfOwners = 16;
    if (load.layers.crypto.has_any() || load.layers.line) forecast.film += kBytesOfOwners * pixels;
    forecast.film *= static_cast<std::uint64_t>(load.frames_at_once);
    // Sums of the frame that is drawn: a number in single precision for each of half precision, and shares by name.
    constexpr std::uint64_t kBytesOfSharesInSums = 40;
    if (load.is_blurred) {
        forecast.film += 2 * kBytesPerColor * pixels * color_layers(load.layers);
        if (load.layers.crypto.has_any()) forecast.film += kBytesOfSharesInSums * pixels;
    }
    if (load.has_regions) forecast.film += kBytesOfRegions + kBytesPerRegionPixel * pixels;
    std::uint64_t method = kBytesPerThread * static_cast<std::uint64_t>(load.threads) + kFragments.in(load);
    if (load.keeps_all_lines)
        method += kAllLines.in(load);
    else if (is_vector(load.format))
        method += kPathLines.in(load);
    forecast.method = load.cap_bytes > 0 ? std::min(method, load.cap_bytes) : method;
    return forecast;
}

std::uint64_t uncompressed_bytes(const PictureLoad& load) {
    return (bytes_per_pixel(load.layers, load.classes) + bytes_per_pixel_of_ranks(load.layers)) *
           pixel_count(load.area);
}

}  // namespace burin
