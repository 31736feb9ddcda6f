#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>

// Pictures on paper: sizes in mm, margins and scales.

namespace burin {

/// What is said about the sheet of paper that a picture is drawn on.
struct PaperSettings {
    std::optional<glm::dvec2> size_mm;  ///< width and height; none: the picture has the size that its dpi says
    std::array<double, 4> margin_mm{};  ///< top, right, bottom, left: the view fills what is within
    std::optional<double> scale;        ///< mm on paper per mm of the world; none: the view is fitted
    std::optional<double> unit_mm;      ///< of a unit of the world; none: 1, and 1000 if all models are glTF
};

struct PictureSettings;

/// "A4", "A3-landscape", "letter", "legal", "200x100mm". Nothing for other words.
std::optional<glm::dvec2> paper_named(std::string_view name);
/// The names of sizes, for messages.
std::string names_of_papers();
/// "1:2", "5:1", "0.5", greater than 0.
std::optional<double> scale_named(std::string_view text);
/// A scale as it is said: "1:2", "2.5:1".
std::string text_of_scale(double scale);
/// The largest scale of three digits that is not larger, for messages.
double round_scale_down(double scale);
/// "mm", "cm", "m", "in", "ft": its length in mm.
std::optional<double> unit_named(std::string_view name);

/// Gives a picture the proportions of its paper: the longer side keeps its pixels, and dpi follows from it.
void fit_to_paper(PictureSettings& picture);

/// The whole picture in mm.
glm::dvec2 size_in_mm(const PictureSettings& picture);
/// What its margins leave of it. Throws InputError if that is nothing.
glm::dvec2 size_within_margins_mm(const PictureSettings& picture);

/// The part of a picture that the view fills, as shares of its width and height from the upper left corner.
struct ViewArea {
    glm::dvec2 low{0.0}, high{1.0};
};
/// Of places in mm from the upper left corner.
ViewArea area_of_mm(const PictureSettings& picture, const glm::dvec2& low_mm, const glm::dvec2& high_mm);
/// What is within the margins. Throws InputError if that is nothing.
ViewArea area_within_margins(const PictureSettings& picture);

}  // namespace burin
