#pragma once

#include <cstddef>

#include "image/exr_deep.h"
#include "output/deep_samples.h"
#include "output/film_files.h"
#include "render/film.h"
#include "render/frame.h"

namespace burin {

/// DeepWriter writes what a film's mattes know of samples to a deep EXR, band after band. The file appears under its
/// name only when finish() has been called. Everything throws InputError.
class DeepWriter {
  public:
    /// The film has mattes that collect them. `output.path`: of the deep file. Nothing of the scene is read after this.
    DeepWriter(const Frame& frame, const Film& film, const OutputOptions& output);
    ~DeepWriter();

    /// Writes a band of the film, before it is closed. It is called once for each band, in any order, by any threads at
    /// once.
    void write(std::size_t band);
    /// Writes all bands of a film that is drawn.
    void write_all(int threads);
    /// Puts the file under its name, after all bands are written.
    void finish();

  private:
    const Mattes& mattes_;
    PixelRect crop_;
    DeepSampler sampler_;  // copied by each thread
    bool is_float_;
    ExrDeepWriter exr_;
};

}  // namespace burin
