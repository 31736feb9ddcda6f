#pragma once

#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "abuffer/masks/halo_shape.h"
#include "abuffer/masks/mask_stroke.h"
#include "abuffer/masks/visibility.h"
#include "lines/line_decision.h"

// Fragments of a pixel become lines: pairs that touch are decided, surfaces grouped, and strokes made from masks.

namespace burin {

/// Two fragments of a pixel whose visible samples are neighbours, and whether that is a line.
struct FragmentPair {
    std::uint32_t first = 0;  ///< numbers in the pixel's list; the list's length is the background
    std::uint32_t second = 0;
    VisiblePoint points[2];  ///< two neighbouring samples, the ones closest to the pixel's centre
    LineDecision decision;
};

/// The lines of one pixel.
template <typename Mask>
struct PixelLines {
    std::vector<FragmentPair> pairs;
    std::vector<std::uint32_t> group;  ///< per fragment and background: its surface's first member
    /// Samples drawn, per class; each sample is in the mask of one class at most. Only the pixel's
    /// own samples mean anything.
    std::array<Mask, kLineClassCount> masks{};
    bool any = false;
};

/// Finds the lines of a pixel from the masks of its visible fragments: steps 2 and 3 of Patel's
/// method (2000).
///
/// Fragments that continue each other are grouped to surfaces; where two surfaces meet and their boundary deserves a
/// line, edge_between() of their masks is the stroke.
template <typename Mask>
class PixelLineFinder {
  public:
    PixelLineFinder(const SurfaceSet& surfaces, const LineCriteria& criteria, const ExtendedGrid& grid,
                    const MaskStroke& stroke)
        : surfaces_(surfaces), criteria_(criteria), grid_(grid), stroke_(stroke) {}

    /// `surface_of(fragment)` gives a fragment's SurfaceId.
    template <typename SurfaceOf>
    void find(std::span<const Fragment<Mask>> fragments, const VisibleSamples<Mask>& visible, int x, int y,
              const SurfaceOf& surface_of, PixelLines<Mask>& lines) {
        find_pairs(visible, x, y, lines);
        const auto background = static_cast<std::uint32_t>(fragments.size());
        const auto surface = [&](std::uint32_t i) { return i == background ? kBackground : surface_of(fragments[i]); };
        for (FragmentPair& pair : lines.pairs) {
            pair.points[0].surface = surface(pair.first);
            pair.points[1].surface = surface(pair.second);
            pair.decision = decide_line(surfaces_, pair.points[0], pair.points[1], criteria_);
        }
        group_surfaces(visible.masks.size(), lines);
        draw(visible, lines);
    }

  private:
    static constexpr int kSide = mask_side<Mask>;

    bool is_drawn(const FragmentPair& pair) const { return !(pair.decision.classes & criteria_.classes).empty(); }

    /// All pairs of fragments with neighbouring samples, each with its most central contact.
    void find_pairs(const VisibleSamples<Mask>& visible, int x, int y, PixelLines<Mask>& lines) {
        lines.pairs.clear();
        distances_.clear();
        for (int row = 0; row < kSide; ++row) {
            for (int column = 0; column < kSide; ++column) {
                if (column + 1 < kSide) visit(visible, x, y, row, column, 0, 1, lines);
                if (row + 1 < kSide) visit(visible, x, y, row, column, 1, 0, lines);
            }
        }
    }

    void visit(const VisibleSamples<Mask>& visible, int x, int y, int row, int column, int down, int right,
               PixelLines<Mask>& lines) {
        std::uint32_t a = visible.owner[static_cast<std::size_t>(kSide * row + column)];
        std::uint32_t b = visible.owner[static_cast<std::size_t>(kSide * (row + down) + column + right)];
        if (a == b) return;
        glm::dvec2 place_a = grid_.position(x, y, row, column);
        glm::dvec2 place_b = grid_.position(x, y, row + down, column + right);
        if (b < a) {
            std::swap(a, b);
            std::swap(place_a, place_b);
        }
        const int dy = 2 * row + down - (kSide - 1);
        const int dx = 2 * column + right - (kSide - 1);
        const int distance = dx * dx + dy * dy;
        std::size_t i = 0;
        while (i < lines.pairs.size() && (lines.pairs[i].first != a || lines.pairs[i].second != b)) ++i;
        if (i == lines.pairs.size()) {
            lines.pairs.emplace_back();
            distances_.push_back(distance);
        } else if (distance >= distances_[i]) {
            return;
        }
        distances_[i] = distance;
        FragmentPair& pair = lines.pairs[i];
        pair.first = a;
        pair.second = b;
        pair.points[0].pixel = place_a;
        pair.points[1].pixel = place_b;
    }

    /// Fragments without a line between them are one surface.
    void group_surfaces(std::size_t count, PixelLines<Mask>& lines) {
        lines.group.resize(count);
        std::iota(lines.group.begin(), lines.group.end(), 0u);
        const auto root = [&](std::uint32_t i) {
            while (lines.group[i] != i) i = lines.group[i];
            return i;
        };
        for (const FragmentPair& pair : lines.pairs) {
            if (is_drawn(pair)) continue;
            const std::uint32_t a = root(pair.first), b = root(pair.second);
            lines.group[std::max(a, b)] = std::min(a, b);
        }
        for (std::uint32_t i = 0; i < count; ++i) lines.group[i] = root(i);
    }

    void draw(const VisibleSamples<Mask>& visible, PixelLines<Mask>& lines) {
        lines.masks.fill(Mask{});
        lines.any = false;
        group_masks_.assign(visible.masks.size(), Mask{});
        for (std::size_t i = 0; i < visible.masks.size(); ++i) {
            group_masks_[lines.group[i]] |= visible.masks[i];
        }
        for (const FragmentPair& pair : lines.pairs) {
            if (!is_drawn(pair)) continue;
            // Within one surface (a crease that fades out) only the two fragments are concerned.
            const bool two_surfaces = lines.group[pair.first] != lines.group[pair.second];
            const auto mask_of = [&](std::uint32_t i) {
                return two_surfaces ? group_masks_[lines.group[i]] : visible.masks[i];
            };
            const Mask a = mask_of(pair.first), b = mask_of(pair.second);
            Mask stroke = shaped_edge_between(a, b, grid_.apron, stroke_.shape);
            if (stroke_.side != StrokeSide::both) {
                const bool on_first = (pair.decision.front == 0) == (stroke_.side == StrokeSide::inside);
                stroke &= on_first ? a : b;
            }
            const LineClass drawn_as = *(pair.decision.classes & criteria_.classes).first();
            lines.masks[static_cast<std::size_t>(drawn_as)] |= stroke;
            lines.any = true;
        }
        Mask taken{};
        for (Mask& mask : lines.masks) {  // in order of priority
            mask = static_cast<Mask>(mask & ~taken);
            taken |= mask;
        }
    }

    const SurfaceSet& surfaces_;
    const LineCriteria& criteria_;
    ExtendedGrid grid_;
    MaskStroke stroke_;
    std::vector<int> distances_;
    std::vector<Mask> group_masks_;
};

}  // namespace burin
