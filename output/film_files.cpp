#include "output/film_files.h"

namespace burin {
namespace {

ExrOptions exr_options(const OutputOptions& options) {
    ExrOptions exr;
    exr.threads = options.threads;
    exr.texts = {{"software", "burin 0.1.0"}};
    if (!options.fingerprint.empty()) exr.texts.emplace_back(kFingerprintName, options.fingerprint);
    return exr;
}

}  // namespace

DisplayImage displayed(const PictureSettings& picture, const Image& image) {
    std::optional<glm::vec3> background = picture.background;
    if (!background && !picture.transparent) background = glm::vec3(1.0f);  // white paper
    return to_display(image, background);
}

void write_output(const Frame& frame, const Film& film, const OutputOptions& options) {
    if (options.format == OutputFormat::exr) return write_exr(options.path, film.image(), exr_options(options));
    DisplayImage image = displayed(frame.scene->picture, film.image());
    image.fingerprint = options.fingerprint;
    write_display_image(options.path, image, options.bits);
}

void write_output(ByteSink& file, const PictureSettings& picture, const Image& image, const OutputOptions& options) {
    if (options.format == OutputFormat::exr) return write_exr(file, options.path, image, exr_options(options));
    const std::string suffix(suffix_of(options.format));
    write_display_image(file, options.path, suffix, displayed(picture, image), options.bits);
}

BandWriter::BandWriter(Film& film, const OutputOptions& options)
    : film_(film),
      exr_(std::make_unique<ExrWriter>(options.path, film.display(), film.crop(), film.channels(),
                                       exr_options(options))) {}

void BandWriter::write(std::size_t band) {
    try {
        const ImageStrip rows = film_.band(band);
        for (int y = rows.data.y0; y < rows.data.y1; y += ExrWriter::kChunkRows) exr_->write_chunk(rows, y);
    } catch (...) {
        has_failed_ = true;
        throw;
    }
    film_.close(band);
}

BandWriter::~BandWriter() = default;

void BandWriter::finish() { exr_->finish(); }

}  // namespace burin
