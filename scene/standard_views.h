#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "scene/camera.h"

// Several orthographic views of a scene on one sheet, as workshops draw parts.

namespace burin {

struct PictureSettings;

enum class StandardView : std::uint8_t { front, back, top, bottom, left, right, iso };
constexpr std::string_view kStandardViewNames[] = {"front", "back", "top", "bottom", "left", "right", "iso"};
std::optional<StandardView> standard_view_named(std::string_view name);
/// Whether a view shows three sides at once. Such views have no hidden lines unless they are asked for.
constexpr bool is_pictorial(StandardView view) { return view == StandardView::iso; }

/// Where views stand around that from the front: `first`, each on the side away from where it looks from, as in Europe;
/// `third`, on the side that it looks from, as in America.
enum class ViewProjection : std::uint8_t { first, third };

struct ViewOnSheet {
    StandardView view = StandardView::front;
    Camera camera;
    bool has_hidden_lines = true;  ///< as the look draws them; else none
};

/// Places views in rows and columns within the margins of a picture, aligned and at one scale: the picture's, or the
/// largest at which they fit. The front is what looks along -Z (along +Y where Z is up). Each camera's area is its
/// view's cell, which may reach into the margins. Throws InputError if the scene has no extent, UsageError if views do
/// not fit at the picture's scale. `fitting_scale`: gets the largest one at which they do.
std::vector<ViewOnSheet> views_on_sheet(const std::vector<StandardView>& views, ViewProjection projection,
                                        const PictureSettings& picture, const glm::dvec3& up, const PointSource& points,
                                        double* fitting_scale = nullptr);

}  // namespace burin
