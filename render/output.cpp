#include "render/output.h"

#include "image/exr_io.h"
#include "image/image_io.h"

namespace burin {

void write_output(const Frame& frame, const Film& film, const OutputOptions& options) {
    if (options.format == OutputFormat::exr) {
        ExrOptions exr;
        exr.threads = options.threads;
        exr.texts = {{"software", "burin 0.1.0"}};
        write_exr(options.path, film.image(), exr);
        return;
    }
    const PictureSettings& picture = frame.scene->picture;
    std::optional<glm::vec3> background = picture.background;
    if (!background && !picture.transparent) background = glm::vec3(1.0f);  // white paper
    write_display_image(options.path, to_display(film.image(), background), options.bits);
}

}  // namespace burin
