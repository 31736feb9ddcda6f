#include "cli/farm/memory_forecast.h"

#include <algorithm>

namespace burin {
namespace {

// Measured with models of 12 to 900,000 triangles, and pictures of 640x360 to 3840x2160.
constexpr std::uint64_t kProgramBytes = 16'500'000;
constexpr std::uint64_t kBytesPerTriangle = 60;
constexpr std::uint64_t kBytesPerCopiedTriangle = 40;  // of meshes that stand in a scene more than once
constexpr std::uint64_t kBytesPerObject = 4'000;
constexpr std::uint64_t kBytesOfTiffModule = 115'000'000;  // and of the libraries that it brings along
constexpr std::uint64_t kBytesPerThread = 2'500'000;
/// How many lines a picture has is not known before it is drawn. What they take is told from the number of triangles,
/// up to a number of bytes that large scenes seldom passed.
struct Found {
    std::uint64_t per_triangle, most;
    std::uint64_t in(const PictureLoad& load) const { return std::min(per_triangle * load.placed_triangles, most); }
};
constexpr Found kFragments{200, 20'000'000}, kAllLines{200, 20'000'000}, kPathLines{100, 16'000'000};
/// Lines of all classes have all edges that are seen or hidden, with all that sheets may ask for.
constexpr std::uint64_t kBytesPerTriangleOfAll = 3'000;
constexpr std::uint64_t kBytesPerSavedPixel = 24;
/// Regions of surfaces in a vector file are made of samples.
constexpr std::uint64_t kBytesOfRegions = 20'000'000, kBytesPerRegionPixel = 60;
constexpr std::uint64_t kBytesPerDisplayPixel = 6;  // of a picture that is written as PNG or TIFF
constexpr std::uint64_t kBytesPerColor = 8;         // red, green, blue and alpha in half precision

/// Of ranks of Cryptomatte and of the layer `line`, which are made for the rows that are written.
std::uint64_t bytes_per_pixel_made(const LayerSet& layers) {
    constexpr std::uint64_t kBytesPerRank = 8, kBytesOfLine = 22;
    std::uint64_t count = 0;
    for (int layer = 0; layer < kCryptoLayerCount; ++layer)
        count += std::uint64_t{layers.crypto.has(static_cast<CryptoLayer>(layer))};
    return kBytesPerRank * count * static_cast<std::uint64_t>(layers.crypto_ranks) + (layers.line ? kBytesOfLine : 0);
}

/// Of all else.
std::uint64_t bytes_per_pixel(const LayerSet& layers, int classes) {
    const auto number = [](bool is_there, std::uint64_t bytes) { return is_there ? bytes : 0; };
    constexpr std::uint64_t kCoverageBytes = 2;
    return number(layers.beauty, kBytesPerColor) + number(layers.lines, kBytesPerColor) +
           number(layers.surface, kBytesPerColor) + number(layers.lines_hidden, kBytesPerColor) +
           kBytesPerColor * layers.line_sets.size() + number(layers.depth, 4) + number(layers.normal, 12) +
           number(layers.ids, 12) + number(layers.coverage, kCoverageBytes * static_cast<std::uint64_t>(classes)) +
           +number(layers.motion, 8);
}

/// Layers of colours.
std::uint64_t color_layers(const LayerSet& layers) {
    return std::uint64_t{layers.beauty} + std::uint64_t{layers.lines} + std::uint64_t{layers.surface} +
           std::uint64_t{layers.lines_hidden} + layers.line_sets.size();
}

std::uint64_t pixel_count(PixelRect area) {
    return static_cast<std::uint64_t>(area.width()) * static_cast<std::uint64_t>(area.height());
}

/// Part of a number, in tenths.
constexpr std::uint64_t tenths(std::uint64_t count, std::uint64_t of) { return count * of / 10; }

std::uint64_t pixels_of_band(PixelRect area) {
    return std::uint64_t{Film::kBandRows} * static_cast<std::uint64_t>(area.width());
}

/// Of a film that is written while it is drawn, without what is made for rows: each thread has a band in work, and
/// copies those that it writes; others wait.
std::uint64_t bytes_of_bands(const PictureLoad& load) {
    constexpr std::uint64_t kCopies = 17, kWaiting = 14;  // tenths
    const std::uint64_t band = bytes_per_pixel(load.layers, load.classes) * pixels_of_band(load.area);
    return std::min(tenths(kCopies * static_cast<std::uint64_t>(load.threads) + kWaiting, band),
                    2 * uncompressed_bytes(load));
}

/// Of a film that is in memory as a whole, in the same way.
std::uint64_t bytes_of_whole(const PictureLoad& load) {
    const std::uint64_t pixels = pixel_count(load.area);
    std::uint64_t bytes = bytes_per_pixel(load.layers, load.classes) * pixels;
    if (load.format == OutputFormat::png || load.format == OutputFormat::tiff) bytes += kBytesPerDisplayPixel * pixels;
    // Shares of owners stand beside it.
    constexpr std::uint64_t kBytesOfOwners = 10;
    if (load.layers.crypto.has_any() || load.layers.line) bytes += kBytesOfOwners * load.covered.pixels;
    return bytes;
}

/// Of what is made for the rows that each thread writes.
std::uint64_t bytes_made(const PictureLoad& load) {
    const std::uint64_t copies = load.is_in_bands ? 17 : 15;  // tenths
    const std::uint64_t made = bytes_per_pixel_made(load.layers);
    return std::min(tenths(copies * static_cast<std::uint64_t>(load.threads), made * pixels_of_band(load.area)),
                    2 * made * pixel_count(load.area));
}

/// Of the samples of a deep file: those of a whole picture, or of bands that are in work, and rows that wait to be
/// compressed.
std::uint64_t bytes_of_deep(const PictureLoad& load) {
    constexpr std::uint64_t kWhole = 60, kHidden = 50, kOfMean = 75, kWaiting = 75, kPerThread = 145;
    if (!load.layers.deep) return 0;
    if (load.is_in_bands)
        return (kWaiting + kPerThread * static_cast<std::uint64_t>(load.threads)) * load.covered.band_pixels;
    const bool has_hidden = load.layers.deep_hidden && load.keeps_all_lines;
    return ((load.sub_frames > 1 ? kOfMean : kWhole) + (has_hidden ? kHidden : 0)) * load.covered.pixels;
}

/// Sums of the frame that is drawn: a number in single precision for each of half precision, and shares by name.
std::uint64_t bytes_of_sums(const PictureLoad& load) {
    constexpr std::uint64_t kBytesOfShares = 80, kBytesOfSamples = 80;
    if (load.sub_frames <= 1) return 0;
    std::uint64_t bytes = 2 * kBytesPerColor * pixel_count(load.area) * color_layers(load.layers);
    if (load.layers.crypto.has_any()) bytes += kBytesOfShares * load.covered.pixels;
    if (load.layers.deep) bytes += kBytesOfSamples * load.covered.pixels;
    // What is summed is a film as a whole, where it is not drawn in bands.
    if (!load.finishes_in_bands) bytes += kBytesPerColor * pixel_count(load.area) * color_layers(load.layers);
    return bytes;
}

}  // namespace

MemoryForecast forecast_memory(const PictureLoad& load) {
    MemoryForecast forecast;
    forecast.program = kProgramBytes + (load.format == OutputFormat::tiff ? kBytesOfTiffModule : 0);
    forecast.model = kBytesPerTriangle * load.triangles + kBytesPerObject * load.objects;
    // The film of a frame that is written is there until that is done, even if nothing of it is needed any more.
    const auto films = static_cast<std::uint64_t>(load.frames_at_once);
    forecast.film = load.is_in_bands ? films * bytes_of_bands(load) + bytes_of_deep(load)
                                     : films * (bytes_of_whole(load) + bytes_of_deep(load));
    forecast.film += bytes_made(load);
    if (load.saves_surface) forecast.film += kBytesPerSavedPixel * pixel_count(load.area);
    if (load.has_regions) forecast.film += kBytesOfRegions + kBytesPerRegionPixel * pixel_count(load.area);
    forecast.blur = bytes_of_sums(load);
    if (load.cap_bytes > 0) forecast.blur = std::min(forecast.blur, load.cap_bytes / 2);
    std::uint64_t method = kBytesPerThread * static_cast<std::uint64_t>(load.threads) + kFragments.in(load);
    if (load.placed_triangles > load.triangles)
        method += kBytesPerCopiedTriangle * (load.placed_triangles - load.triangles);
    if (load.finds_all)
        method += kBytesPerTriangleOfAll * load.placed_triangles;
    else if (load.keeps_all_lines)
        method += kAllLines.in(load);
    else if (is_vector(load.format))
        method += kPathLines.in(load);
    forecast.method = load.cap_bytes > 0 ? std::min(method, load.cap_bytes) : method;
    forecast.least = load.least_cap_bytes;
    return forecast;
}

std::uint64_t uncompressed_bytes(const PictureLoad& load) {
    if (!load.has_flat || is_vector(load.format)) return 0;
    return (bytes_per_pixel(load.layers, load.classes) + bytes_per_pixel_made(load.layers)) * pixel_count(load.area);
}

std::uint64_t deep_bytes(const PictureLoad& load) {
    constexpr std::uint64_t kPerSample = 28, kPerPixel = 4;
    return load.layers.deep ? kPerPixel * pixel_count(load.area) + kPerSample * load.covered.pixels : 0;
}

}  // namespace burin
