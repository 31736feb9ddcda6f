#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shading/ink/found_lines.h"
#include "shading/ink/line_random.h"
#include "shading/sheet/variables.h"

// What is known of lines becomes columns of numbers, which expressions read.

namespace burin {

/// A place on a line: a stroke sample.
struct LineSample {
    std::uint32_t run = 0, piece = 0;  ///< in LineRuns; the piece among all
    double share = 0;                  ///< of the way along the piece
};

/// What the same lines are drawn with more than once for.
struct SampleVariant {
    std::uint32_t seed = 0;
    std::uint32_t copy = 0;
    std::string_view set;
};

/// The columns of some samples. Buffers are used again.
class SampleColumns {
  public:
    const VariableColumns& columns() const { return columns_; }
    const float* of(Variable v, std::size_t component = 0) const { return columns_.of(v, component); }
    /// Of the attributes that fill() was called with.
    const float* of_attribute(std::size_t number) const { return attributes_[number]; }

  private:
    friend class LineColumns;
    VariableColumns columns_;
    std::vector<const float*> attributes_;
    std::vector<float> numbers_;
};

/// LineColumns computes variables for places on lines. It may be used by several threads.
class LineColumns {
  public:
    /// `asked`: the classes that any line set asks for. `lines` must outlive it, and have what `variables` need.
    LineColumns(const FoundLines& lines, LineClassSet asked, const VariableSet& variables);

    const LineRuns& runs() const { return runs_; }
    const FoundLines& lines() const { return lines_; }
    /// Fills columns of the variables, for each sample a number, and of the attributes with these names.
    void fill(std::span<const LineSample> samples, const VariableSet& variables, const SampleVariant& variant,
              SampleColumns& out, std::span<const std::string> attributes = {}) const;

    std::uint32_t object_of(std::size_t piece) const { return lines_.sides[piece].front_object; }
    std::uint32_t material_of(std::size_t piece) const { return lines_.sides[piece].front_material; }
    /// The object on which noise stands. Where two objects meet, which one is in front may change from one picture to
    /// the next, and noise must not jump then: it is one of the two, by a hash of their names.
    std::uint32_t anchor_of(std::size_t piece) const;
    /// Hashes what an object, a chain is; the same in all frames.
    LineHash object_hash(std::size_t piece, const SampleVariant& variant) const;
    LineHash chain_hash(const LineRun& run, const SampleVariant& variant) const;
    /// The position of a sample in its object, and the size of a pixel there in the object's units.
    struct InObject {
        glm::dvec3 position{0.0};
        double px_size = 1;
    };
    InObject in_object(const LineSample& sample) const;
    double depth_at(const LineSample& sample) const;
    glm::dvec2 place_of(const LineSample& sample) const {
        const LinePiece& p = runs_.pieces[sample.piece].piece;
        return sample.share < 0.5 ? p.from + (p.to - p.from) * sample.share
                                  : p.to - (p.to - p.from) * (1 - sample.share);
    }
    double at_of(const LineSample& sample) const {
        const RunPiece& p = runs_.pieces[sample.piece];
        return glm::mix(p.at_from_px, p.at_to_px, sample.share);
    }

  private:
    struct Columns;  // that fill() writes

    const LineSides& sides_of(std::size_t piece) const { return lines_.sides[piece]; }
    void fill_sides(std::span<const LineSample> samples, Columns& out) const;
    void fill_chains(std::span<const LineSample> samples, const VariableSet& variables, Columns& out) const;
    void fill_surface(std::span<const LineSample> samples, Columns& out) const;
    /// A value of the front surface, which changes linearly in space.
    float surface_value(const LineSample& sample, std::size_t column) const;
    float gap_at(const LineSample& sample) const;
    /// In view space.
    glm::dvec3 position_of(const LineSample& sample) const;

    const FoundLines& lines_;
    const LineRuns& runs_;
    LineClassSet asked_;
    std::vector<double> world_length_;  // of each piece: from the beginning of its run to that of the piece
};

}  // namespace burin
