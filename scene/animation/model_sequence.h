#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "mesh/model.h"
#include "mesh/model_source.h"
#include "scene/animation/frame_pattern.h"
#include "scene/animation/scene_animation.h"

namespace burin {

/// What a scene says of a sequence of files.
struct SequenceSettings {
    FramePattern pattern;
    std::string object;          ///< its name, for messages
    double frame_offset = 0;     ///< the number of a frame's file less that of the frame
    bool holds_missing = false;  ///< the last file before one that is missing is shown instead; else it is an error
    MeshOptions options;         ///< how to read them; without a budget
    std::uint64_t budget_bytes = ModelBudget::kDefaultLimit;  ///< for each file
};

/// ModelSequence is a model per frame, each in a file of its own. Between two of them vertices lie between, if both
/// have the same polygons; if not, the earlier one is held. Before the first and behind the last of them, where a
/// shutter may be open, the nearest one is held.
///
/// A scene has the same objects and materials in all its frames: those of the file that it is loaded with. Objects of
/// another file stand for those of the same name, and, where names differ, of the same place in the file; what that
/// file has not is not drawn, and what it has more is left out with a note. The same holds of materials.
class ModelSequence : public ModelMotion {
  public:
    explicit ModelSequence(SequenceSettings settings);

    /// The model that the scene is loaded with, each object with a mesh of its own. To be called once, before at().
    Model load(double frame);

    Pose at(double frame) const override;
    std::vector<std::string> files_at(double frame) const override;
    /// The first frame that has a file. Throws InputError if there is none.
    double first_frame() const;

  private:
    using Source = std::shared_ptr<const ModelSource>;
    struct Shown {
        std::string file, later;  ///< a second one, if it is between two
        double part = 0;
        std::optional<double> missing = std::nullopt;  ///< the number of a file that would be the second one
    };
    Shown files_of(double frame) const;
    std::string file_for(double frame, double number) const;
    bool has_file(double number) const;
    bool is_beyond_all(double number) const;
    std::vector<double> numbers() const;
    Source read(const std::string& path) const;
    Model model_at(double frame, std::vector<std::string>& notes) const;
    std::vector<std::uint32_t> materials_for(const Model& model, const std::string& file,
                                             std::vector<std::string>& notes) const;

    SequenceSettings settings_;
    std::vector<std::string> object_names_, material_names_;  // of the first file
    mutable std::mutex mutex_;  // of what was read last: frames near each other share files
    mutable std::vector<std::pair<std::string, Source>> read_;
};

}  // namespace burin
