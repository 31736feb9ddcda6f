/// The library's interface in C++20: what burin.h has, with owners, spans and exceptions. Only headers; see
/// docs/library.md.
#pragma once

#include <burin/burin.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace burin {
inline namespace v1 {

/// What a call threw that failed. what() says what is wrong and what to do.
class Error : public std::runtime_error {
  public:
    Error(int kind, const char* text) : std::runtime_error(text), kind_(kind) {}
    /// A burin_result, such as BURIN_BAD_INPUT.
    int kind() const noexcept { return kind_; }
    bool was_stopped() const noexcept { return kind_ == BURIN_STOPPED; }

  private:
    int kind_;
};

/// Throws the last failure of this thread.
[[noreturn]] inline void throw_error() {
    if (burin_error_kind() == BURIN_NO_MEMORY) throw std::bad_alloc();
    throw Error(burin_error_kind(), burin_error());
}
/// Passes on what a call returned, unless it failed.
inline int checked(int result) {
    if (result < 0) throw_error();
    return result;
}
template <typename T>
T* checked(T* result) {
    if (result == nullptr) throw_error();
    return result;
}

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
    int frame = 0;
};

/// How to work; see burin_options.
struct Options {
    int threads = 0;
    std::uint64_t memory_bytes = 0;
    std::string layers{};
    /// Gets the part that is done. Returns true to stop. What it throws stops, too, and comes out of the call.
    std::function<bool(double)> progress{};
};

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

/// The lines of a picture, found once: to be read as columns and drawn. See burin_find_lines().
class Drawing {
  public:
    explicit Drawing(burin_drawing* owned) : drawing_(owned) {}

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
        std::vector<const char*> names;
        for (const std::string& name : mesh.object_names) names.push_back(name.c_str());
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

    Picture render(const View& view = {}, const Options& options = {}) {
        return Picture(call(burin_render, view, options));
    }
    /// The lines that render() would draw, as data.
    Drawing find_lines(const View& view = {}, const Options& options = {}) {
        return Drawing(call(burin_find_lines, view, options));
    }
    /// From any thread: see burin_cancel().
    void cancel() noexcept { burin_cancel(get()); }
    burin_scene* get() const noexcept { return scene_.get(); }

  private:
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
    template <typename Result>
    Result* call(Result* (*work)(burin_scene*, const burin_view*, const burin_options*), const View& view,
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
        v.frame = view.frame;
        Teller teller{options.progress, nullptr};
        burin_options o = {};
        o.size = sizeof o;
        o.threads = options.threads;
        o.memory_bytes = options.memory_bytes;
        o.layers = options.layers.empty() ? nullptr : options.layers.c_str();
        o.progress = options.progress ? &Teller::tell : nullptr;
        o.user = &teller;
        Result* const result = work(get(), &v, &o);
        if (result == nullptr && teller.thrown) std::rethrow_exception(teller.thrown);
        return checked(result);
    }

    struct Free {
        void operator()(burin_scene* scene) const noexcept { burin_scene_free(scene); }
    };
    std::unique_ptr<burin_scene, Free> scene_;
};

}  // namespace v1
}  // namespace burin
