#include "scene/paper.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "mesh/text_scan.h"
#include "scene/scene.h"

namespace burin {
namespace {

struct NamedSize {
    std::string_view name;
    double width_mm, height_mm;
};
constexpr NamedSize kPapers[] = {{"A5", 148, 210},         {"A4", 210, 297},       {"A3", 297, 420},
                                 {"A2", 420, 594},         {"A1", 594, 841},       {"A0", 841, 1189},
                                 {"letter", 215.9, 279.4}, {"legal", 215.9, 355.6}};
constexpr double kSmallest_mm = 1, kLargest_mm = 5000;

struct NamedUnit {
    std::string_view name;
    double mm;
};
constexpr NamedUnit kPaperUnits[] = {{"mm", 1}, {"cm", 10}, {"m", 1000}, {"in", 25.4}, {"ft", 304.8}};

bool is_same_word(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

std::optional<double> positive_number(std::string_view text) {
    double value = 0;
    const char* const end = text.data() + text.size();
    if (text.empty() || scan_number(text.data(), end, value) != end) return std::nullopt;
    if (!(value > 0 && std::isfinite(value))) return std::nullopt;
    return value;
}

std::string short_text(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

}  // namespace

std::optional<glm::dvec2> paper_named(std::string_view name) {
    constexpr std::string_view kLying = "-landscape", kUnit = "mm";
    const bool lies = name.size() > kLying.size() && is_same_word(name.substr(name.size() - kLying.size()), kLying);
    const std::string_view kind = lies ? name.substr(0, name.size() - kLying.size()) : name;
    for (const NamedSize& paper : kPapers) {
        if (!is_same_word(kind, paper.name)) continue;
        return lies ? glm::dvec2(paper.height_mm, paper.width_mm) : glm::dvec2(paper.width_mm, paper.height_mm);
    }
    if (lies || name.size() < kUnit.size() || name.substr(name.size() - kUnit.size()) != kUnit) return std::nullopt;
    const std::string_view sides = name.substr(0, name.size() - kUnit.size());
    const std::size_t by = sides.find('x');
    if (by == std::string_view::npos) return std::nullopt;
    const auto width = positive_number(sides.substr(0, by)), height = positive_number(sides.substr(by + 1));
    if (!width || !height || std::min(*width, *height) < kSmallest_mm || std::max(*width, *height) > kLargest_mm)
        return std::nullopt;
    return glm::dvec2(*width, *height);
}

std::string names_of_papers() {
    std::string names;
    for (const NamedSize& paper : kPapers) names += std::string(paper.name) + ", ";
    return names + "these with -landscape, or WIDTHxHEIGHTmm, 1 to 5000 mm";
}

std::optional<double> scale_named(std::string_view text) {
    const std::size_t colon = text.find(':');
    const auto above = positive_number(text.substr(0, colon));
    const auto below = colon == std::string_view::npos ? std::optional(1.0) : positive_number(text.substr(colon + 1));
    if (!above || !below) return std::nullopt;
    const double scale = *above / *below;
    return scale >= 1e-12 && scale <= 1e12 ? std::optional(scale) : std::nullopt;
}

std::string text_of_scale(double scale) { return scale < 1 ? "1:" + short_text(1 / scale) : short_text(scale) + ":1"; }

double round_scale_down(double scale) {
    // To three digits of whichever side is not 1.
    const double side = std::max(scale, 1 / scale);
    const double step = std::pow(10.0, std::floor(std::log10(side)) - 2);
    constexpr double kRounding = 1e-9;
    return scale >= 1 ? std::floor(side / step + kRounding) * step : 1 / (std::ceil(side / step - kRounding) * step);
}

std::optional<double> unit_named(std::string_view name) {
    for (const NamedUnit& unit : kPaperUnits) {
        if (unit.name == name) return unit.mm;
    }
    return std::nullopt;
}

void fit_to_paper(PictureSettings& picture) {
    if (!picture.paper.size_mm) return;
    const glm::dvec2 mm = *picture.paper.size_mm;
    const int longer = std::max(picture.width, picture.height);
    const int shorter =
        std::max(1, static_cast<int>(std::lround(longer * std::min(mm.x, mm.y) / std::max(mm.x, mm.y))));
    picture.width = mm.x >= mm.y ? longer : shorter;
    picture.height = mm.x >= mm.y ? shorter : longer;
    picture.dpi = longer * 25.4 / std::max(mm.x, mm.y);
}

glm::dvec2 size_in_mm(const PictureSettings& picture) {
    if (picture.paper.size_mm) return *picture.paper.size_mm;
    return glm::dvec2(picture.width, picture.height) * (25.4 / picture.dpi);
}

glm::dvec2 size_within_margins_mm(const PictureSettings& picture) {
    const glm::dvec2 whole = size_in_mm(picture);
    const auto& [top, right, bottom, left] = picture.paper.margin_mm;
    const glm::dvec2 within = whole - glm::dvec2(left + right, top + bottom);
    if (!(within.x > 0 && within.y > 0)) {
        throw InputError("paper of " + short_text(whole.x) + " x " + short_text(whole.y) +
                         " mm is too small for margins of " + short_text(top) + ", " + short_text(right) + ", " +
                         short_text(bottom) + ", " + short_text(left) +
                         " mm (top, right, bottom, left); make them smaller, or the paper larger");
    }
    return within;
}

ViewArea area_of_mm(const PictureSettings& picture, const glm::dvec2& low_mm, const glm::dvec2& high_mm) {
    // Pixels are whole, paper is not: shares are of the pixels.
    const glm::dvec2 whole = glm::dvec2(picture.width, picture.height) * (25.4 / picture.dpi);
    return {low_mm / whole, high_mm / whole};
}

ViewArea area_within_margins(const PictureSettings& picture) {
    const auto& [top, right, bottom, left] = picture.paper.margin_mm;
    if (!picture.paper.size_mm && top + right + bottom + left == 0) return {};
    const glm::dvec2 low(left, top);
    return area_of_mm(picture, low, low + size_within_margins_mm(picture));
}

}  // namespace burin
