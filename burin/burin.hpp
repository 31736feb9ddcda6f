/// The library's interface in C++20: what burin.h has, with owners, spans and exceptions. Only headers; see
/// docs/library.md.
#pragma once

#include <burin/burin.h>
#include <burin/error.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace burin {
inline namespace v1 {

/// 16 numbers, row by row. All 0: see the field.
using Matrix = std::array<double, 16>;

/// See burin_material.
struct Material {
    std::string name{};
    std::array<float, 3> color{0.8f, 0.8f, 0.8f};
    float opacity = 1;
};

/// See burin_mesh. The spans have to live during the call alone.
struct Mesh {
    std::string name{};
    std::span<const float> points{};  ///< x y z of each
    std::span<const std::int32_t> corners{};
    std::span<const std::int32_t> polygon_sizes{};      ///< empty: all are triangles
    std::span<const std::int32_t> polygon_materials{};  ///< empty: none has one
    std::span<const std::int32_t> polygon_objects{};    ///< empty: all are one
    std::vector<std::string> object_names{};            ///< of the parts that polygon_objects numbers
    std::span<const std::int32_t> marked_edges{};       ///< two points each
    std::span<const float> corner_uv{};                 ///< two for each corner; empty: none
    std::span<const float> point_colors{};              ///< red green blue of each point, linear; empty: none
    /// A name, and a number for each point.
    std::vector<std::pair<std::string, std::span<const float>>> attributes{};
};

/// How a scene is seen; see burin_view. Without anything: as the scene says.
struct View {
    int width = 0, height = 0;
    std::array<std::int32_t, 4> crop{};
    int samples = 0;
    std::string camera{};
    Matrix camera_to_world{};
    double fov_deg = 0;
    double ortho_height = 0;
    std::array<double, 2> shift{};  ///< with a matrix: of the lens, to the right and up, in heights of the picture
    double pixel_aspect = 0;        ///< a pixel's width / its height; 0: as the camera says
    int frame = 0;
};

/// How to work; see burin_options.
struct Options {
    int threads = 0;
    std::uint64_t memory_bytes = 0;
    std::string layers{};
    /// Gets the part that is done. Returns true to stop. What it throws stops, too, and comes out of the call.
    std::function<bool(double)> progress{};
    bool for_paths = false, find_all = false;
};

/// What the file that this thread made last does not have as it stands; see burin_file_note().
inline std::vector<std::string> file_notes() {
    std::vector<std::string> notes;
    for (int i = 0; const char* const note = burin_file_note(i); ++i) notes.emplace_back(note);
    return notes;
}

/// The bytes of a file of a picture or a drawing.
inline std::vector<std::byte> encoded(const void* picture_or_drawing, const std::string& format,
                                      const char* style = nullptr) {
    std::uint8_t* bytes = nullptr;
    std::uint64_t count = 0;
    checked(burin_encode(picture_or_drawing, format.c_str(), style, &bytes, &count));
    const std::unique_ptr<std::uint8_t, void (*)(std::uint8_t*)> owner(bytes, burin_bytes_free);
    const auto* const first = reinterpret_cast<const std::byte*>(bytes);
    return {first, first + count};
}

/// A picture's channels, which it owns.
class Picture {
  public:
    explicit Picture(burin_picture* owned) : picture_(owned) {}

    struct Size {
        std::int32_t width = 0, height = 0;
    };
    /// Of the channels: that of the crop.
    Size size() const {
        std::int32_t size[2] = {};
        checked(burin_channel(get(), checked(burin_channel_name(get(), 0)), nullptr, size));
        return {size[0], size[1]};
    }
    std::vector<std::string> channel_names() const {
        std::vector<std::string> names;
        for (int i = 0; const char* const name = burin_channel_name(get(), i); ++i) names.emplace_back(name);
        return names;
    }
    /// The values of a channel. T: float, std::uint32_t, or std::uint16_t for the bits of half precision.
    template <typename T>
    std::span<const T> channel(const std::string& name) const {
        std::int32_t type = 0, size[2] = {};
        const void* const values = checked(burin_channel(get(), name.c_str(), &type, size));
        if (type != type_of(T{})) throw Error(BURIN_BAD_ARGUMENT, ("channel " + name + " has another type").c_str());
        return {static_cast<const T*>(values), static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1])};
    }
    /// What drawing found that its user should know; see burin_picture_note().
    std::vector<std::string> notes() const {
        std::vector<std::string> notes;
        for (int i = 0; const char* const note = burin_picture_note(get(), i); ++i) notes.emplace_back(note);
        return notes;
    }
    /// The whole picture for a display, of the view's size; see burin_pixels().
    void pixels(std::uint8_t* out, int channels) const { checked(burin_pixels(get(), out, channels)); }
    /// The bytes of a file: "exr", "png", "png16", "tif", "tif16"; of a drawing also "svg", "pdf", "dxf".
    std::vector<std::byte> encode(const std::string& format) const { return encoded(get(), format); }
    /// Into a file, whose suffix says the format.
    void write(const std::string& path) const { checked(burin_write(get(), nullptr, nullptr, path.c_str())); }
    burin_picture* get() const noexcept { return picture_.get(); }

  private:
    static int type_of(float) { return BURIN_FLOAT; }
    static int type_of(std::uint16_t) { return BURIN_HALF; }
    static int type_of(std::uint32_t) { return BURIN_UINT32; }
    struct Free {
        void operator()(burin_picture* picture) const noexcept { burin_picture_free(picture); }
    };
    std::unique_ptr<burin_picture, Free> picture_;
};

/// Places on lines that one style draws, with what is known there; see burin_line_samples.
class LineSamples {
  public:
    explicit LineSamples(const burin_line_samples& samples) : samples_(samples) {}

    std::size_t count() const { return samples_.count; }
    /// The values of a variable that needs() names, one for each place: "depth", "N.x", "C.r".
    std::span<const float> column(std::string_view name) const {
        for (std::uint32_t i = 0; i < samples_.column_count; ++i) {
            if (samples_.names[i] == name) return {samples_.columns[i], count()};
        }
        throw Error(BURIN_BAD_ARGUMENT, ("needs() has no column '" + std::string(name) + "'").c_str());
    }
    std::string_view style() const { return samples_.style; }

  private:
    const burin_line_samples& samples_;
};

/// The ink at these places: the style's before, what is drawn after; see burin_line_ink.
struct LineInk {
    std::span<float> width_px, offset_px, opacity, red, green, blue;
};

/// Changes the ink of lines; see burin_add_line_shader(). Several threads call shade() at once. What it throws ends the
/// call that draws: as an Error that has its message.
class LineShader {
  public:
    virtual ~LineShader() = default;
    /// The variables that it reads, "depth, N, light".
    virtual std::string needs() const { return {}; }
    virtual void shade(const LineSamples& in, LineInk& out) const = 0;
};

/// Says how much of a line there is, 0 to 1; see burin_add_line_test(). All else as for LineShader.
class LineTest {
  public:
    virtual ~LineTest() = default;
    virtual std::string needs() const { return {}; }
    virtual void test(const LineSamples& in, std::span<float> strength) const = 0;
};

/// The lines of a picture, found once: to be read as columns and drawn. See burin_find_lines().
class Drawing {
  public:
    /// `used`: what drawing it calls, and so must live as long.
    explicit Drawing(burin_drawing* owned, std::vector<std::shared_ptr<const void>> used = {})
        : used_(std::move(used)), drawing_(owned) {}

    /// How many straight pieces it has: as many values each column.
    std::size_t piece_count() const {
        std::uint64_t count = 0;
        checked(burin_column(get(), "line", nullptr, &count));
        return static_cast<std::size_t>(count);
    }
    /// A column; see burin_column(). T: the column's type. It is made when it is first asked for: by one thread at a
    /// time.
    template <typename T>
    std::span<const T> column(const std::string& name) const {
        std::int32_t type = 0;
        std::uint64_t count = 0;
        const void* const values = checked(burin_column(get(), name.c_str(), &type, &count));
        if (type != type_of(T{})) throw Error(BURIN_BAD_ARGUMENT, ("column " + name + " has another type").c_str());
        return {static_cast<const T*>(values), static_cast<std::size_t>(count)};
    }
    /// The picture that the scene's look makes of it.
    Picture draw(int threads = 0) const { return drawn(nullptr, threads); }
    /// The one that a style sheet makes of it: its text, name or file; see burin_draw().
    Picture draw(const std::string& style, int threads = 0) const { return drawn(style.c_str(), threads); }
    /// The bytes of a file, and a file, of the picture that draw() makes; see Picture.
    std::vector<std::byte> encode(const std::string& format) const { return encoded(get(), format); }
    std::vector<std::byte> encode(const std::string& format, const std::string& style) const {
        return encoded(get(), format, style.c_str());
    }
    void write(const std::string& path) const { checked(burin_write(get(), nullptr, nullptr, path.c_str())); }
    void write(const std::string& path, const std::string& style) const {
        checked(burin_write(get(), nullptr, style.c_str(), path.c_str()));
    }
    burin_drawing* get() const noexcept { return drawing_.get(); }

  private:
    Picture drawn(const char* style, int threads) const {
        burin_options o = {};
        o.size = sizeof o;
        o.threads = threads;
        return Picture(checked(burin_draw(get(), style, &o)));
    }

    static int type_of(double) { return BURIN_DOUBLE; }
    static int type_of(float) { return BURIN_FLOAT; }
    static int type_of(std::uint64_t) { return BURIN_UINT64; }
    static int type_of(std::uint32_t) { return BURIN_UINT32; }
    static int type_of(std::uint16_t) { return BURIN_UINT16; }
    static int type_of(std::uint8_t) { return BURIN_UINT8; }
    struct Free {
        void operator()(burin_drawing* drawing) const noexcept { burin_drawing_free(drawing); }
    };
    std::vector<std::shared_ptr<const void>> used_;
    std::unique_ptr<burin_drawing, Free> drawing_;
};

/// Objects, materials, cameras and settings. What takes numbers and returns them is as in burin.h.
class Scene {
  public:
    Scene() : scene_(checked(burin_scene_new())) {}
    /// The scene of a file.
    static Scene load(const std::string& path) {
        Scene scene;
        scene.add_file(path);
        return scene;
    }

    /// What a file or a text holds beside what is there: see burin_load(). Returns the number of its first object.
    int add_file(const std::string& path) { return checked(burin_load(get(), path.c_str())); }
    int add_text(const std::string& toml, const std::string& base_folder = {}) {
        return checked(burin_load_text(get(), toml.c_str(), base_folder.c_str()));
    }
    std::vector<std::string> notes() const {
        std::vector<std::string> notes;
        for (int i = 0; const char* const note = burin_note(get(), i); ++i) notes.emplace_back(note);
        return notes;
    }

    int add(const Material& material) {
        burin_material m = {};
        m.size = sizeof m;
        m.name = material.name.c_str();
        m.opacity = material.opacity;
        for (std::size_t i = 0; i < 3; ++i) m.color[i] = material.color[i];
        return checked(burin_add_material(get(), &m));
    }
    /// A mesh that no object shows so far.
    int add_mesh(const Mesh& mesh) {
        if (mesh.points.size() % 3 != 0 || mesh.marked_edges.size() % 2 != 0) {
            throw Error(BURIN_BAD_ARGUMENT, "mesh: points have three numbers each, marked edges two");
        }
        const std::size_t polygons = mesh.polygon_sizes.empty() ? mesh.corners.size() / 3 : mesh.polygon_sizes.size();
        for (const std::span<const std::int32_t> per_polygon : {mesh.polygon_materials, mesh.polygon_objects}) {
            if (!per_polygon.empty() && per_polygon.size() != polygons) {
                throw Error(BURIN_BAD_ARGUMENT, "mesh: materials and objects are given for each polygon or for none");
            }
        }
        std::vector<const char*> names, attribute_names;
        for (const std::string& name : mesh.object_names) names.push_back(name.c_str());
        std::vector<const float*> attributes;
        bool fits = (mesh.corner_uv.empty() || mesh.corner_uv.size() == 2 * mesh.corners.size()) &&
                    (mesh.point_colors.empty() || mesh.point_colors.size() == mesh.points.size());
        for (const auto& [name, numbers] : mesh.attributes) {
            fits = fits && numbers.size() == mesh.points.size() / 3;
            attribute_names.push_back(name.c_str());
            attributes.push_back(numbers.data());
        }
        if (!fits) throw Error(BURIN_BAD_ARGUMENT, "mesh: attributes are given for each corner or point, or for none");
        burin_mesh m = {};
        m.size = sizeof m;
        m.name = mesh.name.c_str();
        m.points = mesh.points.data();
        m.point_count = mesh.points.size() / 3;
        m.corners = mesh.corners.data();
        m.corner_count = mesh.corners.size();
        m.polygon_sizes = mesh.polygon_sizes.empty() ? nullptr : mesh.polygon_sizes.data();
        m.polygon_count = polygons;
        m.polygon_materials = mesh.polygon_materials.empty() ? nullptr : mesh.polygon_materials.data();
        m.polygon_objects = mesh.polygon_objects.empty() ? nullptr : mesh.polygon_objects.data();
        m.object_count = names.size();
        if (names.empty()) {  // parts without names
            for (const std::int32_t part : mesh.polygon_objects) {
                m.object_count = std::max(m.object_count, static_cast<std::uint64_t>(std::max(part, 0)) + 1);
            }
        }
        m.object_names = names.empty() ? nullptr : names.data();
        m.marked_edges = mesh.marked_edges.data();
        m.marked_edge_count = mesh.marked_edges.size() / 2;
        m.corner_uv = mesh.corner_uv.empty() ? nullptr : mesh.corner_uv.data();
        m.point_colors = mesh.point_colors.empty() ? nullptr : mesh.point_colors.data();
        m.attribute_names = attribute_names.data();
        m.point_attributes = attributes.data();
        m.attribute_count = attribute_names.size();
        return checked(burin_add_mesh(get(), &m));
    }
    void remove_mesh(int mesh) { checked(burin_remove_mesh(get(), mesh)); }
    /// An object that shows a mesh.
    int add_object(int mesh, const std::string& name = {}, const Matrix& to_world = {}, int material = 0) {
        burin_object o = {};
        o.size = sizeof o;
        o.mesh = mesh;
        o.material = material;
        o.name = name.empty() ? nullptr : name.c_str();
        for (std::size_t i = 0; i < 16; ++i) o.to_world[i] = to_world[i];
        return checked(burin_add_object(get(), &o));
    }
    /// A mesh and an object that shows it.
    int add(const Mesh& mesh, const Matrix& to_world = {}) {
        const int number = add_mesh(mesh);
        const int object = add_object(number, mesh.name, to_world);
        remove_mesh(number);  // the object goes on showing it
        return object;
    }
    void move(int object, const Matrix& to_world) { checked(burin_move_object(get(), object, to_world.data())); }
    void remove(int object) { checked(burin_remove_object(get(), object)); }
    void clear() { checked(burin_clear_objects(get())); }
    int object_of_id(std::uint32_t id) const { return checked(burin_object_of_id(get(), id)); }
    std::string object_name(int object) const { return checked(burin_object_name(get(), object)); }

    void set(const std::string& key_and_value) { checked(burin_set(get(), key_and_value.c_str())); }
    void set_toml(const std::string& toml) { checked(burin_set_toml(get(), toml.c_str())); }
    /// A style sheet: its text, name or file; see burin_set_style().
    void set_style(const std::string& text_or_name) { checked(burin_set_style(get(), text_or_name.c_str())); }

    /// Style sheets have it by `shader = "NAME"`. nullptr takes it away.
    void add_line_shader(const std::string& name, std::shared_ptr<const LineShader> shader) {
        add_called(shaders_, name, std::move(shader), burin_add_line_shader, &shade);
    }
    /// Style sheets have it by `test = "NAME"`. nullptr takes it away.
    void add_line_test(const std::string& name, std::shared_ptr<const LineTest> test) {
        add_called(tests_, name, std::move(test), burin_add_line_test, &test_lines);
    }

    Picture render(const View& view = {}, const Options& options = {}) {
        return Picture(call(burin_render, view, options));
    }
    /// The lines that render() would draw, as data.
    Drawing find_lines(const View& view = {}, const Options& options = {}) {
        std::vector<std::shared_ptr<const void>> used;
        for (const auto& named : shaders_) used.push_back(named.second);
        for (const auto& named : tests_) used.push_back(named.second);
        return Drawing(call(burin_find_lines, view, options), std::move(used));
    }
    /// Why a pixel looks as it does: "text" or "json"; see burin_explain().
    std::string explain(int x, int y, const View& view = {}, const std::string& format = "text",
                        const Options& options = {}) {
        const auto explained = [&](burin_scene* scene, const burin_view* v, const burin_options* o) {
            return burin_explain(scene, v, o, x, y, format.c_str());
        };
        return call(explained, view, options);
    }
    void cancel() noexcept { burin_cancel(get()); }  ///< from any thread
    burin_scene* get() const noexcept { return scene_.get(); }

  private:
    template <typename Called>
    using Named = std::map<std::string, std::shared_ptr<const Called>>;

    template <typename Called, typename Function>
    void add_called(Named<Called>& all, const std::string& name, std::shared_ptr<const Called> called,
                    int (*give)(burin_scene*, const char*, const char*, Function, void*),
                    std::type_identity_t<Function> function) {
        const auto at = all.try_emplace(name).first;  // before the scene calls it
        const std::string needs = called ? called->needs() : std::string();
        checked(
            give(get(), name.c_str(), needs.c_str(), called ? function : nullptr, const_cast<Called*>(called.get())));
        at->second = std::move(called);
    }
    static int shade(const burin_line_samples* samples, burin_line_ink* ink, void* user) noexcept {
        return without_exceptions(*samples, [&] {
            const auto part = [&](float* values) { return std::span<float>(values, samples->count); };
            LineInk out{part(ink->width_px), part(ink->offset_px), part(ink->opacity),
                        part(ink->red),      part(ink->green),     part(ink->blue)};
            static_cast<const LineShader*>(user)->shade(LineSamples(*samples), out);
        });
    }
    static int test_lines(const burin_line_samples* samples, float* strength, void* user) noexcept {
        return without_exceptions(*samples, [&] {
            static_cast<const LineTest*>(user)->test(LineSamples(*samples), {strength, samples->count});
        });
    }
    template <typename Work>
    static int without_exceptions(const burin_line_samples& samples, const Work& work) noexcept {
        const auto failed = [&](std::string_view why) {
            samples.message[why.copy(samples.message, samples.message_size - 1)] = 0;
            return 1;
        };
        try {
            work();
            return 0;
        } catch (const std::exception& error) {
            return failed(error.what());
        } catch (...) {
            return failed("it threw what is no std::exception");
        }
    }
    struct Teller {
        const std::function<bool(double)>& progress;
        std::exception_ptr thrown;

        static int tell(double done, void* user) noexcept {
            auto& self = *static_cast<Teller*>(user);
            if (self.thrown) return 1;
            try {
                return self.progress(done) ? 1 : 0;
            } catch (...) {
                self.thrown = std::current_exception();
                return 1;
            }
        }
    };
    template <typename Work>
    std::invoke_result_t<Work, burin_scene*, const burin_view*, const burin_options*> call(const Work& work,
                                                                                           const View& view,
                                                                                           const Options& options) {
        burin_view v = {};
        v.size = sizeof v;
        v.width = view.width;
        v.height = view.height;
        for (std::size_t i = 0; i < 4; ++i) v.crop[i] = view.crop[i];
        v.samples = view.samples;
        v.camera = view.camera.empty() ? nullptr : view.camera.c_str();
        for (std::size_t i = 0; i < 16; ++i) v.camera_to_world[i] = view.camera_to_world[i];
        v.fov_deg = view.fov_deg;
        v.ortho_height = view.ortho_height;
        std::copy(view.shift.begin(), view.shift.end(), v.shift);
        v.pixel_aspect = view.pixel_aspect;
        v.frame = view.frame;
        Teller teller{options.progress, nullptr};
        burin_options o = {.size = sizeof o,
                           .threads = options.threads,
                           .memory_bytes = options.memory_bytes,
                           .layers = options.layers.empty() ? nullptr : options.layers.c_str(),
                           .progress = options.progress ? &Teller::tell : nullptr,
                           .user = &teller,
                           .for_paths = options.for_paths,
                           .find_all = options.find_all};
        auto* const result = work(get(), &v, &o);
        if (result == nullptr && teller.thrown) std::rethrow_exception(teller.thrown);
        return checked(result);
    }
    struct Free {
        void operator()(burin_scene* scene) const noexcept { burin_scene_free(scene); }
    };
    Named<LineShader> shaders_;  // the scene calls them
    Named<LineTest> tests_;
    std::unique_ptr<burin_scene, Free> scene_;
};

}  // namespace v1
}  // namespace burin
