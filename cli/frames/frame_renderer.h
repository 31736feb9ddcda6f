#pragma once

#include <algorithm>
#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/arguments.h"
#include "cli/blur.h"
#include "cli/farm/covered_blocks.h"
#include "cli/frames/fingerprint.h"
#include "cli/frames/frame_plan.h"
#include "cli/frames/posed_scene.h"
#include "cli/render_stats.h"
#include "output/deep_file.h"
#include "output/film_files.h"
#include "output/paths/vector_drawing.h"

namespace burin {

/// A picture that is drawn and not yet written. Writing it reads nothing of the scene that changes with the next frame.
struct DrawnFrame {
    double number = 0;
    std::vector<OutputOptions> outputs;
    Frame frame;
    std::unique_ptr<Film> film;
    std::unique_ptr<FilmChannels> channels;  ///< of the film, if it is written when it is drawn
    /// Of each EXR, if they are written while it is drawn, but for their names.
    std::vector<std::unique_ptr<BandWriter>> bands;
    std::unique_ptr<DeepWriter> deep;  ///< of a deep file
    bool is_deep_written = false;      ///< that was written while it was drawn, but for its name
    VectorDrawing drawing;             ///< of vector files
    StageTimes times;
    int sub_frames = 1;                  ///< whose mean it is
    std::vector<double> skipped_behind;  ///< frames that come next and are there already

    /// Writes the files, which appear under their names when they are complete. Throws InputError.
    void write(const Arguments& arguments);
};

/// Draws the frames of a job, one after the other.
class FrameRenderer {
  public:
    /// `outputs`: of the first frame. Throws InputError and UsageError.
    FrameRenderer(const Arguments& arguments, const Method& method, LoadedInput input, const FramePlan& plan,
                  const std::vector<OutputOptions>& outputs);

    /// The fingerprint of a frame. Throws InputError and UsageError.
    FrameFingerprint fingerprint_of(double frame) const;
    /// Whether all files of a frame are there, whole, and of this fingerprint. `note`: gets what a user should know of
    /// those that are not.
    bool is_there(double frame, const FrameFingerprint& fingerprint, std::string& note) const;

    /// What a frame changes. Any thread may call it while another frame is drawn. Throws InputError.
    SceneChange change_at(double frame) const;
    /// Puts the scene into a frame, and makes the camera ready. Throws InputError and UsageError.
    void pose(SceneChange&& change);
    /// How long the frame in work has been posed: draw() adds it to what the frame took to load.
    double pose_s() const { return pose_s_; }
    /// The files of a frame.
    std::vector<OutputOptions> outputs_of(double frame, const FrameFingerprint& fingerprint) const;
    /// Draws what it was put into, for these files. Throws InputError, UsageError and Interrupted.
    DrawnFrame draw(const std::vector<OutputOptions>& outputs, Progress* progress);

    /// What drawing the first frame will take, which is posed for that; with --keep-going, the first that can be read.
    struct Outlook {
        LayerSet layers;
        bool is_in_bands = false;           ///< an EXR is written while it is drawn
        bool finishes_in_bands = false;     ///< so does the method, whatever is written
        int sub_frames = 1;                 ///< whose mean it is
        std::size_t pieces = 1;             ///< in which it is drawn one after the other, under a cap for memory
        std::uint64_t least_cap_bytes = 0;  ///< that it can be drawn under; 0: there is no cap for it
        CoveredBlocks covered;
    };
    /// Draws nothing. Throws InputError and UsageError.
    Outlook outlook();

    /// Whether frames change more than their number.
    bool moves() const { return animation_.moves(); }
    const Scene& scene() const { return posed_.scene(); }
    const Camera& camera() const { return camera_; }

  private:
    bool has_paths() const {
        return std::any_of(outputs_.begin(), outputs_.end(), [](const auto& o) { return is_vector(o.format); });
    }
    bool has_pixels() const {
        return std::any_of(outputs_.begin(), outputs_.end(), [](const auto& o) { return !is_vector(o.format); });
    }
    void count_pieces(const Frame& frame, Outlook& outlook) const;
    LayerSet layers_of_picture(const Frame& frame, bool& in_bands) const;
    void begin_files(RunOptions& run, bool in_bands, DrawnFrame& drawn, std::atomic<bool>& has_write_failed);
    RenderStats draw_picture(const Frame& frame, const RunOptions& run, Film& film, DrawnFrame& drawn);
    RenderStats draw_pixels(const Frame& frame, const RunOptions& run, Film& film, DrawnFrame& drawn);
    RenderStats draw_as_paths(const Frame& frame, const RunOptions& run, Film& film, DrawnFrame& drawn);
    RenderStats draw_as_paths_too(const RunOptions& run, DrawnFrame& drawn);
    void make_ready(Frame& frame, const LayerSet& layers, double time);
    void find_next(Frame& frame, double number);
    std::vector<double> next_frames_of(double frame) const;
    /// The scene at a time within the frame in work.
    Moment moment_at(double number, double time, MomentUse use);
    void note(const std::string& text);

    const Arguments& arguments_;
    const Method& method_;
    const FramePlan& plan_;
    std::vector<OutputOptions> outputs_;  // of the first frame
    SceneAnimation animation_;
    std::optional<Fingerprints> fingerprints_;
    bool has_hidden_lines_ = false;
    bool moves_;       // objects, meshes or cameras, those of a turntable, too
    bool is_blurred_;  // by what moves, if anything does
    std::optional<JobCamera> job_camera_;
    PosedScene posed_;
    std::vector<ViewOnSheet> views_;
    Blur blur_;
    std::vector<CameraSettings> first_cameras_;  // at rest
    Camera camera_;
    SceneChange next_change_;  // one frame later, for the layer `motion`
    SurfaceSet next_surfaces_;
    double pose_s_ = 0;               // of the frame in work
    bool is_first_ = true;            // no frame was drawn
    std::vector<std::string> noted_;  // without their numbers: each is said once
};

}  // namespace burin
