#include "burin/picture.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "burin/failure.h"
#include "burin/running.h"
#include "methods/abuffer.h"
#include "output/film_files.h"
#include "render/layer_names.h"
#include "render/picture_notes.h"

namespace burin {
Film film_of(const Frame& frame, const OptionsInput& options) {
    const LayerSet layers = with_layer_option([&] { return layers_of(*frame.scene, options.layers); });
    Film film(PixelRect{0, 0, frame.width, frame.height}, frame.crop, layers, frame.criteria.classes);
    if (film.channels().empty() && film.mattes() == nullptr) {
        throw UsageError("options.layers: coverage has a channel per line class, and no class is drawn");
    }
    return film;
}

namespace {

const Image& image_with_beauty(const burin_picture& picture) {
    const Image& image = picture.image();
    if (image.find("R") == nullptr) {
        throw UsageError("the picture has no layer beauty; ask for it by options.layers");
    }
    return image;
}

std::uint8_t eight_bits(std::uint32_t code) { return static_cast<std::uint8_t>((code * 255 + 32767) / 65535); }

/// Luminance weights of Rec. 709, of code values; what is grey stays as it is.
std::uint32_t luma(const std::uint16_t* rgb) {
    return (2126u * rgb[0] + 7152u * rgb[1] + 722u * rgb[2] + 5000u) / 10000u;
}

}  // namespace
}  // namespace burin

using namespace burin;

burin_picture* burin_render(burin_scene* scene, const burin_view* view, const burin_options* options) {
    return guarded_pointer([&] {
        const FrameCall call(scene, view, options);
        const Frame& frame = call.ready().frame();
        Film film = film_of(frame, call.given());
        std::vector<std::string> notes = call.ready().notes();
        const RenderStats stats = call.draw(film, [&] { return render_abuffer(frame, call.run(), film); });
        const auto& instances = frame.surfaces.instances;
        const bool has_lines = std::any_of(instances.begin(), instances.end(),
                                           [](const SurfaceInstance& i) { return !i.mesh->loose_edges.empty(); });
        const bool is_whole = frame.crop.width() == frame.width && frame.crop.height() == frame.height;
        if (stats.fragments == 0 && is_whole && !has_lines) notes.emplace_back(kNoSurfaceIsSeen);
        notes.insert(notes.end(), stats.notes.begin(), stats.notes.end());
        return new burin_picture(frame, std::move(film), call.given().threads, std::move(notes));
    });
}

void burin_cancel(burin_scene* scene) {
    if (scene != nullptr) scene->stop.store(true);
}

void burin_picture_free(burin_picture* picture) { delete picture; }

const void* burin_channel(const burin_picture* picture, const char* name, int32_t* type, int32_t size[2]) {
    return guarded_pointer([&]() -> const void* {
        const Image& image = required(picture, "picture").image();
        const Channel* const channel = image.find(&required(name, "name"));
        if (channel == nullptr) throw UsageError("the picture has no channel '" + std::string(name) + "'");
        if (type != nullptr) {
            *type = channel->type == PixelType::float16   ? BURIN_HALF
                    : channel->type == PixelType::float32 ? BURIN_FLOAT
                                                          : BURIN_UINT32;
        }
        if (size != nullptr) {
            size[0] = image.width();
            size[1] = image.height();
        }
        return channel->bytes.data();
    });
}

const char* burin_channel_name(const burin_picture* picture, int index) {
    return guarded_pointer([&]() -> const char* {
        const std::vector<Channel>& channels = required(picture, "picture").image().channels();
        if (index < 0 || static_cast<std::size_t>(index) >= channels.size()) return nullptr;
        return channels[static_cast<std::size_t>(index)].name.c_str();
    });
}

const char* burin_picture_note(const burin_picture* picture, int index) {
    return guarded_pointer([&]() -> const char* { return note_at(required(picture, "picture").notes, index); });
}

int burin_picture_size(const burin_picture* picture, int32_t size[2]) {
    return guarded([&] {
        const PixelRect display = required(picture, "picture").film.image().display();
        required(size, "size");
        size[0] = display.width();
        size[1] = display.height();
        return int{BURIN_DONE};
    });
}

int burin_pixels(const burin_picture* picture, uint8_t* out, int channels) {
    return guarded([&] {
        const Image& image = image_with_beauty(required(picture, "picture"));
        required(out, "out");
        if (channels != 1 && channels != 3 && channels != 4) throw UsageError("channels: must be 1, 3 or 4");
        PictureSettings paper = picture->settings;
        paper.transparent = channels == 4;
        if (channels == 4) paper.background.reset();
        const DisplayImage shown = displayed(paper, image);
        if (channels == 1) {
            for (std::size_t i = 0; i < shown.pixels.size(); i += 3) *out++ = eight_bits(luma(&shown.pixels[i]));
        } else {
            for (const std::uint16_t code : shown.pixels) *out++ = eight_bits(code);
        }
        return int{BURIN_DONE};
    });
}
