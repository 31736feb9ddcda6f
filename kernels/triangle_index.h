#pragma once

#include <vector>

#include "kernels/tile_kernels.h"

// Lines are compared with the triangles near them only, which an index of boxes finds.

namespace burin {

/// Finds the triangles that touch boxes on the screen, so that lines are compared with few of them: by the boxes around
/// triangles, cut into steps of a byte.
class TriangleIndex {
  public:
    TriangleIndex() = default;
    TriangleIndex(TriangleIndex&&) = default;  // not copied: boxes are told by where they lie
    TriangleIndex& operator=(TriangleIndex&&) = default;

    /// Indexes the triangles `listed`. What lies beyond `bounds` is taken to be at its rim.
    void make(const TileKernels& kernels, const CrossedTriangle* triangles, const std::uint32_t* listed,
              std::size_t count, const ScreenBox& bounds) {
        kernels_ = &kernels;
        boxes_.x = axis(bounds.x0, bounds.x1);
        boxes_.y = axis(bounds.y0, bounds.y1);
        boxes_.nearness = axis(bounds.low, bounds.high);
        boxes_.count = count;
        const std::size_t size = StepBoxes::rounded_up(count),
                          around_size = StepBoxes::rounded_up(size / StepBoxes::kAtOnce);
        steps_.resize(StepBoxes::kNumbers * (size + around_size));
        for (std::size_t k = 0; k < StepBoxes::kNumbers; ++k) {
            boxes_.steps[k] = steps_.data() + k * (size + around_size);
            boxes_.around[k] = boxes_.steps[k] + size;
        }
        kernels.hide.box_in_steps(triangles, listed, boxes_);
    }
    /// What find() takes.
    StepBox in_steps(const ScreenBox& box) const {
        return {step(boxes_.x, box.x0), step(boxes_.y, box.y0), step(boxes_.x, box.x1), step(boxes_.y, box.y1),
                step(boxes_.nearness, box.low)};
    }
    /// Lists all that touch any of some boxes and reach nearer than its `low`, in their order, and some more that are
    /// off by less than a step, or lie beyond the bounds, or where all are equally near. `numbers`: of the triangles,
    /// as they are to be called; `found` needs room for all. Returns how many.
    std::size_t find(const StepBox* boxes, std::size_t count, const std::uint32_t* numbers,
                     std::uint32_t* found) const {
        return kernels_->hide.list_in_boxes(boxes_, boxes, count, numbers, found);
    }

  private:
    static StepBoxes::Axis axis(float begin, float end) {
        return {begin, end > begin ? static_cast<float>(StepBoxes::kSteps) / (end - begin) : 0};
    }
    /// The step of a value, as the kernel computes it.
    static std::uint8_t step(const StepBoxes::Axis& axis, float v) {
        const float steps = (v - axis.from) * axis.steps_per_unit;
        constexpr float kLast = StepBoxes::kSteps - 1;
        return steps > 0 ? static_cast<std::uint8_t>(steps < kLast ? steps : kLast) : std::uint8_t{0};
    }

    const TileKernels* kernels_ = nullptr;
    StepBoxes boxes_;
    std::vector<std::uint8_t> steps_;
};

}  // namespace burin
