#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <utility>

#include "base/lower_extension.h"
#include "base/parallel.h"
#include "burin/drawing.h"
#include "burin/drawn_style.h"
#include "burin/failure.h"
#include "burin/picture.h"
#include "mesh/text_scan.h"
#include "output/film_files.h"
#include "output/paths/make_paths.h"
#include "output/vector_files.h"

namespace burin {
namespace {

const NamedFormat& format_named(std::string_view name) {
    if (const NamedFormat* const found = find_format(name)) return *found;
    throw UsageError("unknown format '" + printable(name) + "'; known are " + names_of_formats());
}

const NamedFormat& format_of_path(const std::string& path) {
    const std::string suffix = lower_extension(path);
    if (const NamedFormat* const found = find_format_of_suffix(suffix)) return *found;
    throw UsageError(path + ": unknown kind of image '" + suffix + "'; burin writes " + suffixes_of_formats());
}

/// A picture, or that of a drawing.
class GivenPicture {
  public:
    GivenPicture(const void* given, const char* style) {
        if (given == nullptr) throw UsageError("picture_or_drawing is NULL");
        const auto kind = *static_cast<const OutputKind*>(given);
        if (kind == OutputKind::picture) {
            if (style != nullptr) {
                throw UsageError("style: must be NULL for a picture, which has its lines drawn already");
            }
            picture_ = static_cast<const burin_picture*>(given);
        } else if (kind == OutputKind::drawing) {
            const auto& drawing = *static_cast<const burin_drawing*>(given);
            drawn_.reset(picture_of(drawing, style, drawing.threads));
            picture_ = drawn_.get();
        } else {
            throw UsageError("this is no picture of burin_render() and no drawing of burin_find_lines()");
        }
    }
    const burin_picture& operator*() const { return *picture_; }
    /// On the picture, if it was drawn for this.
    std::vector<std::string> notes() const { return drawn_ ? drawn_->notes : std::vector<std::string>{}; }

  private:
    const burin_picture* picture_ = nullptr;
    std::unique_ptr<burin_picture> drawn_;
};

/// What users should know of the file that this thread made last.
thread_local std::vector<std::string> t_notes;

/// A drawing as the text of a vector file. `notes`: gets what users should know.
std::string vector_text(const void* given, OutputFormat format, const char* style, std::vector<std::string>& notes) {
    if (given == nullptr) throw UsageError("picture_or_drawing is NULL");
    if (*static_cast<const OutputKind*>(given) != OutputKind::drawing)
        throw UsageError("format: a vector file is made of a drawing of burin_find_lines(), not of a picture");
    const auto& drawing = *static_cast<const burin_drawing*>(given);
    if (style == nullptr) notes = drawing.notes;
    InkedLines inked = inked_lines_of(drawing, style, drawing.threads, notes, {true, false});
    VectorOptions options;
    options.crop = drawing.frame.crop;
    VectorStats stats;
    VectorDrawing paths = vector_drawing_of(std::move(inked), *drawing.found, options, stats);
    if (std::string means = note_on_means(stats); !means.empty()) notes.push_back(std::move(means));
    const PictureSettings& picture = drawing.scene.picture;
    paths.paper = picture.background;
    if (!paths.paper && !picture.transparent) paths.paper = glm::vec3(1.0f);
    // Without chains it is not known which edges lines are of.
    return vector_file_of(paths, format, {.names_paths = drawing.found->has_chains}, notes);
}

/// What can be written of a picture in this format.
void check_layers(const burin_picture& picture, const NamedFormat& format) {
    if (format.format != OutputFormat::exr && picture.image().find("R") == nullptr) {
        throw UsageError("the picture has no layer beauty, which this format shows; ask for it by options.layers");
    }
}

OutputOptions options_of(const burin_picture& picture, const NamedFormat& format, const std::string& name) {
    OutputOptions options;
    options.path = name;
    options.format = format.format;
    options.bits = format.bits;
    options.threads = resolve_thread_count(picture.threads);
    return options;
}

}  // namespace
}  // namespace burin

using namespace burin;

int burin_encode(const void* picture_or_drawing, const char* format, const char* style, uint8_t** bytes,
                 uint64_t* count) {
    return guarded([&] {
        const NamedFormat& as = format_named(&required(format, "format"));
        required(bytes, "bytes");
        required(count, "count");
        MemorySink file;
        std::vector<std::string> notes;
        if (is_vector(as.format)) {
            const std::string text = vector_text(picture_or_drawing, as.format, style, notes);
            file.write(text.data(), text.size());
        } else {
            const GivenPicture given(picture_or_drawing, style);
            const burin_picture& from = *given;
            check_layers(from, as);
            const std::string name = "picture" + std::string(as.suffix);
            write_output(file, from.settings, from.image(), from.exr, options_of(from, as, name));
            notes = given.notes();
        }
        auto* const copy = static_cast<uint8_t*>(std::malloc(std::max<std::size_t>(file.bytes().size(), 1)));
        if (copy == nullptr) throw std::bad_alloc();
        std::memcpy(copy, file.bytes().data(), file.bytes().size());
        *bytes = copy;
        *count = file.bytes().size();
        t_notes.swap(notes);
        return int{BURIN_DONE};
    });
}

int burin_write(const void* picture_or_drawing, const char* format, const char* style, const char* path) {
    return guarded([&] {
        const std::string file_path = &required(path, "path");
        const NamedFormat& as = format == nullptr ? format_of_path(file_path) : format_named(format);
        std::vector<std::string> notes;
        if (is_vector(as.format)) {
            const std::string text = vector_text(picture_or_drawing, as.format, style, notes);
            AtomicFile file(file_path);
            file.write(text.data(), text.size());
            file.commit();
        } else {
            const GivenPicture given(picture_or_drawing, style);
            const burin_picture& from = *given;
            check_layers(from, as);
            const OutputOptions options = options_of(from, as, file_path);
            if (as.format != OutputFormat::exr)
                check_display_writer("picture" + std::string(as.suffix));  // before there is a file
            AtomicFile file(file_path);
            write_output(file, from.settings, from.image(), from.exr, options);
            file.commit();
            notes = given.notes();
        }
        t_notes.swap(notes);
        return int{BURIN_DONE};
    });
}

const char* burin_file_note(int index) { return note_at(t_notes, index); }

void burin_bytes_free(uint8_t* bytes) { std::free(bytes); }
