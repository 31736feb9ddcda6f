#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>

// The formats of pictures and drawings, from which follow names, suffixes and the lists of them in messages.

namespace burin {

enum class OutputFormat : std::uint8_t { exr, png, tiff, svg, pdf, dxf };

/// Whether files of a format have paths instead of pixels.
constexpr bool is_vector(OutputFormat format) {
    switch (format) {
        case OutputFormat::exr:
        case OutputFormat::png:
        case OutputFormat::tiff:
            return false;
        case OutputFormat::svg:
        case OutputFormat::pdf:
        case OutputFormat::dxf:
            return true;
    }
    return false;
}

/// A format with its number of bits per value, as the library names it.
struct NamedFormat {
    std::string_view name;
    OutputFormat format;
    int bits;  ///< of PNG and TIFF; an EXR has a type per layer
    std::string_view suffix;
};
/// A suffix alone stands for the first row that has it.
constexpr NamedFormat kNamedFormats[] = {
    {"exr", OutputFormat::exr, 8, ".exr"},     {"png", OutputFormat::png, 8, ".png"},
    {"png16", OutputFormat::png, 16, ".png"},  {"tif", OutputFormat::tiff, 8, ".tif"},
    {"tif16", OutputFormat::tiff, 16, ".tif"}, {"svg", OutputFormat::svg, 8, ".svg"},
    {"pdf", OutputFormat::pdf, 8, ".pdf"},     {"dxf", OutputFormat::dxf, 8, ".dxf"}};

/// The suffix that files of a format have.
constexpr std::string_view suffix_of(OutputFormat format) {
    for (const NamedFormat& f : kNamedFormats) {
        if (f.format == format) return f.suffix;
    }
    return {};
}

/// nullptr: there is none.
inline const NamedFormat* find_format(std::string_view name) {
    const auto* const found = std::find_if(std::begin(kNamedFormats), std::end(kNamedFormats),
                                           [&](const NamedFormat& f) { return f.name == name; });
    return found == std::end(kNamedFormats) ? nullptr : found;
}

/// `suffix`: in small letters; ".tiff" is ".tif". nullptr: no format has it.
inline const NamedFormat* find_format_of_suffix(std::string_view suffix) {
    if (suffix == ".tiff") suffix = ".tif";
    const auto* const found = std::find_if(std::begin(kNamedFormats), std::end(kNamedFormats),
                                           [&](const NamedFormat& f) { return f.suffix == suffix; });
    return found == std::end(kNamedFormats) ? nullptr : found;
}

/// "exr png png16 ...", for messages.
inline std::string names_of_formats() {
    std::string names;
    for (const NamedFormat& f : kNamedFormats) names += (names.empty() ? "" : " ") + std::string(f.name);
    return names;
}

/// ".exr .png .tif", for messages.
inline std::string suffixes_of_formats() {
    std::string suffixes;
    for (const NamedFormat& f : kNamedFormats) {
        if (find_format_of_suffix(f.suffix) == &f) suffixes += (suffixes.empty() ? "" : " ") + std::string(f.suffix);
    }
    return suffixes;
}

}  // namespace burin
