#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/arguments.h"
#include "cli/blur.h"
#include "cli/frames/fingerprint.h"
#include "cli/frames/frame_plan.h"
#include "cli/frames/posed_scene.h"
#include "cli/render_stats.h"
#include "output/film_files.h"
#include "output/paths/vector_drawing.h"

namespace burin {

/// A picture that is drawn and not yet written. Writing it reads nothing of the scene that changes with the next frame.
struct DrawnFrame {
    double number = 0;
    OutputOptions output;
    Frame frame;
    std::unique_ptr<Film> film;
    std::unique_ptr<FilmChannels> channels;  ///< of the film, if it is written when it is drawn
    std::unique_ptr<BandWriter> bands;       ///< set if an EXR was written while it was drawn, but for its name
    VectorDrawing drawing;                   ///< of vector files
    StageTimes times;
    int sub_frames = 1;                  ///< whose mean it is
    std::vector<double> skipped_behind;  ///< frames that come next and are there already

    /// Writes the file, which appears under its name when it is complete. Throws InputError.
    void write(const Arguments& arguments);
};

/// Draws the frames of a job, one after the other.
class FrameRenderer {
  public:
    /// `output`: of the first frame. Throws InputError and UsageError.
    FrameRenderer(const Arguments& arguments, const Method& method, LoadedInput input, const FramePlan& plan,
                  const OutputOptions& output);

    /// The fingerprint of a frame; empty if files are to have none. Throws InputError and UsageError.
    std::string fingerprint_of(double frame) const;
    /// Whether all files of a frame are there, whole, and of this fingerprint. `note`: gets what a user should know of
    /// those that are not.
    bool is_there(double frame, const std::string& fingerprint, std::string& note) const;

    /// What a frame changes. Any thread may call it while another frame is drawn. Throws InputError.
    SceneChange change_at(double frame) const;
    /// Puts the scene into a frame, and makes the camera ready. Throws InputError and UsageError.
    void pose(SceneChange&& change);
    /// Draws what it was put into. `output` has the name of its file. Throws InputError, UsageError and Interrupted.
    DrawnFrame draw(const OutputOptions& output, Progress* progress);

    /// The layers of the first frame, which is posed for that. `in_bands`: gets whether an EXR of it is written while
    /// it is drawn. Throws InputError and UsageError.
    LayerSet layers_of_first_frame(const OutputOptions& output, bool& in_bands);

    /// Whether frames may be means of several sub-frames.
    bool is_blurred() const { return blur_.is_asked_for() && blur_.samples != 1; }
    /// Whether frames change more than their number.
    bool moves() const { return animation_.moves(); }
    const Scene& scene() const { return posed_.scene(); }
    const Camera& camera() const { return camera_; }

  private:
    LayerSet layers_of_picture(const Frame& frame, const OutputOptions& output, bool& in_bands) const;
    RenderStats draw_picture(const Frame& frame, const RunOptions& run, Film& film, DrawnFrame& drawn);
    void find_next(Frame& frame);
    /// The scene at a time within the frame in work.
    Moment moment_at(double number, double time, MomentUse use);
    void note(const std::string& text);

    const Arguments& arguments_;
    const Method& method_;
    const FramePlan& plan_;
    OutputFormat format_;
    SceneAnimation animation_;
    std::optional<Fingerprints> fingerprints_;
    bool has_hidden_lines_ = false;
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
