#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/arguments.h"
#include "cli/output_files.h"
#include "output/film_files.h"
#include "scene/animation/frame_pattern.h"
#include "scene/scene_description.h"

namespace burin {

/// A file that is written per frame, or once if there is one frame only.
struct FrameFile {
    std::string option;  ///< that asks for it
    std::string path;    ///< as it was given
    std::optional<FramePattern> pattern;

    std::string path_of(double frame) const { return pattern ? pattern->path_of(frame) : path; }
};

/// Which frames a command renders, and what it calls their files.
struct FramePlan {
    std::vector<double> frames;      ///< in order, at least one
    bool is_sequence = false;        ///< frames were asked for; else it is a still
    bool is_at_rest = false;         ///< a still of a scene that does not say which frames it has
    std::vector<FrameFile> outputs;  ///< pictures, then a deep file; at least one
    std::optional<FrameFile> lines;  ///< --save-lines
};

/// Refuses names that do not fit the frames that the command line asks for, before the scene is read. Throws
/// UsageError.
void check_names_of_frames(const Arguments& arguments, const std::vector<OutputOptions>& outputs);

/// The frames that the command line asks for, or else the scene. Throws UsageError.
FramePlan plan_frames(const Arguments& arguments, const SceneDescription& scene,
                      const std::vector<OutputOptions>& outputs);

/// The files of a plan's frames that are there already, or the one of a single frame. Folders are read once, whatever
/// the number of frames.
std::vector<OutputFile> existing_outputs(const FramePlan& plan);

/// Throws InputError if a frame's files cannot be written.
void check_files_of(const FramePlan& plan, double frame);

/// The files of all frames, and `others`.
std::vector<OutputFile> all_outputs(const FramePlan& plan, std::vector<OutputFile> others);

/// Removes temporary files of the frames' files that dead processes left behind.
void sweep_outputs(const FramePlan& plan);

}  // namespace burin
