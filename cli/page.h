#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

// What --page stands for: paper, margins, the look, and how files are written.

namespace burin {

enum class PagePreset : std::uint8_t { none, iso128, patent, plotter, laser };

/// As --set has it.
struct PageSetting {
    std::string_view key, value;
};

/// ISO 128 of the sheet `technical`: visible lines have one width and hidden ones half of it, with dashes of 12 widths
/// and gaps of 3; none is pale, short ones neither, and they are drawn at any depth.
constexpr PageSetting kIso128Settings[] = {
    {"style.hidden", "1"},
    {"style.thin.width", "=width"},
    {"style.dashed.width", "=0.5 * width"},
    {"style.dashed.dash", R"(["=6 * width", "=1.5 * width"])"},
    {"style.dashed.min_length", R"(["=2 * width", "=2 * width"])"},
    {"style.set.hidden.qi", "[1, 255]"},
};

/// One value of --page. Other options replace what it says.
struct Page {
    PagePreset preset = PagePreset::none;
    std::string_view name;
    std::string_view paper = {};                 ///< as --paper has it
    std::array<double, 4> margin_mm = {};        ///< top, right, bottom, left
    std::string_view style = {};                 ///< style sheet; empty: the scene's look
    bool cuts_dashes = false;                    ///< machines ignore patterns
    std::span<const PageSetting> settings = {};  ///< of that style sheet
};

/// Margins of `patent` are those of the European and the United States' patent offices, of `iso128` those of ISO 5457.
constexpr Page kPages[] = {
    {PagePreset::none, ""},
    {PagePreset::iso128, "iso128", "A4", {10, 10, 10, 20}, "technical", false, kIso128Settings},
    {PagePreset::patent, "patent", "A4", {25, 15, 10, 25}, "patent", false},
    {PagePreset::plotter, "plotter", "A4-landscape", {10, 10, 10, 10}, "technical", true},
    {PagePreset::laser, "laser", "A4-landscape", {5, 5, 5, 5}, "", true},
};

constexpr const Page& page_of(PagePreset preset) { return kPages[static_cast<std::size_t>(preset)]; }

/// The widest line of laser cutters' files.
constexpr double kHairlineMm = 0.01;

}  // namespace burin
