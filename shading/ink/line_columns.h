#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lines/line_runs.h"
#include "mesh/polygon_soup.h"
#include "shading/ink/line_random.h"
#include "shading/ink/line_sides.h"
#include "shading/sheet/variables.h"

// What is known of lines becomes columns of numbers, which expressions read.

namespace burin {

/// What line shading knows of the picture beside its lines.
struct LineSurroundings {
    const SurfaceSet* surfaces = nullptr;
    glm::dmat4 camera_to_world{1.0};
    std::span<const Material> materials;  ///< by number, from 0
    std::vector<std::string> objects;     ///< names by number, from 0
    std::optional<glm::dvec3> light;      ///< direction to the key light in view space; none: it is at the eye
    double cos_crease_angle = 0.7660444431;
    int width_px = 0, height_px = 0;  ///< of the whole picture
    int frame = 0;
    double time_s = 0;
    LineClassSet classes;  ///< that any line set asks for
};

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

  private:
    friend class LineColumns;
    VariableColumns columns_;
    std::vector<float> numbers_;
};

/// LineColumns computes variables for places on lines. It may be used by several threads.
class LineColumns {
  public:
    /// `variables`: all that will be asked for. What is given must outlive it.
    LineColumns(const LineSurroundings& around, const LineRuns& runs, const VariableSet& variables, int threads);

    const LineRuns& runs() const { return runs_; }
    const LineSurroundings& around() const { return around_; }
    /// Fills columns of the variables, for each sample a number.
    void fill(std::span<const LineSample> samples, const VariableSet& variables, const SampleVariant& variant,
              SampleColumns& out) const;

    std::uint32_t object_of(std::size_t piece) const { return sides_of(piece).front_object; }
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
        return sample.share < 0.5 ? p.from + (p.to - p.from) * sample.share : p.to - (p.to - p.from) * (1 - sample.share);
    }
    double at_of(const LineSample& sample) const {
        const RunPiece& p = runs_.pieces[sample.piece];
        return glm::mix(p.at_from_px, p.at_to_px, sample.share);
    }

  private:
    struct Columns;  // that fill() writes

    const LineSides& sides_of(std::size_t piece) const { return sides_[piece]; }
    void fill_sides(std::span<const LineSample> samples, Columns& out) const;
    void fill_chains(std::span<const LineSample> samples, const VariableSet& variables, Columns& out) const;
    float gap_at(const LineSample& sample) const;

    const LineSurroundings& around_;
    const LineRuns& runs_;
    std::vector<LineSides> sides_;               // of each piece
    std::vector<std::uint32_t> same_name_;       // of each object: how many before it have its name
    std::vector<double> world_length_;           // of each piece: from the beginning of its run to that of the piece
};

}  // namespace burin
