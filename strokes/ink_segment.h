#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "kernels/tile_kernels.h"
#include "shading/ink/inked_lines.h"

namespace burin {

/// The way of a stroke from one of its points to the next: the cones that draw it, and the ink along it.
class InkSegment {
  public:
    /// Strokes narrower than the masks can show are drawn wider and as much lighter.
    struct Part {
        PenCone cone;
        bool is_thin = false;  ///< drawn wider than it is
        /// Of its first and last end: how much longer its body is drawn to meet that of the next part of the stroke.
        /// Nothing where only a disc fills what is between them.
        std::array<std::optional<float>, 2> longer_px;
        /// Its body, made longer.
        PenCone body() const;
    };
    /// Where a stroke goes on from one part to another one: lets their bodies meet, if the stroke turns so little there
    /// and its width changes so evenly that no disc is needed.
    static void join(Part& before, Part& after);

    InkSegment(const InkPoint& from, const InkPoint& to, StrokeSide side);

    /// Whether masks show a width only as a wider stroke of lighter ink.
    static bool is_thin(float width_px, StrokeSide side) { return width_px < finest_px(side); }

    /// One cone, or two where the stroke becomes thin on the way. None where there is no ink.
    std::span<const Part> parts() const { return {parts_.data(), part_count_}; }
    std::span<Part> parts() { return {parts_.data(), part_count_}; }
    /// Cuts off what lies beyond the end of the stroke at `place`, along its direction there.
    void cut(glm::dvec2 place, glm::dvec2 outward);
    double radius_px() const { return radius_px_; }
    /// Whether the ink changes along a part, and not its width alone.
    bool changes_ink(const Part& part) const;

    /// The share of the way at which it is nearest to a place.
    float share_nearest(glm::dvec2 place) const;
    float nearness_at(float share) const { return glm::mix(from_->nearness, to_->nearness, share); }
    glm::vec3 color_at(float share) const { return glm::mix(from_->color, to_->color, share); }
    /// The opacity of the ink with which the cones are drawn.
    float alpha_at(float share) const;

    const InkPoint& from() const { return *from_; }
    const InkPoint& to() const { return *to_; }

  private:
    static float finest_px(StrokeSide side);

    const InkPoint *from_, *to_;
    glm::dvec2 along_;
    double per_square_;   // 1 / length squared, 0 for a dot
    float finest_px_;     // full widths from here on are drawn as they are
    float strength_ = 1;  // where the width does not change
    double radius_px_ = 0;
    std::array<Part, 2> parts_;
    std::size_t part_count_ = 0;
};

}  // namespace burin
