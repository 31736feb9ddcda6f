#pragma once

#include <burin/burin.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "tests/burin/any_arguments.h"

namespace burin::test {

/// Calls of one scene in any order, with whatever arguments: all functions of burin.h. Pointers are right, or NULL, and
/// the numbers of their elements right, or too many to be meant. `folder`: where files are written; "": none are.
///
/// `Choices` chooses: integer(low, high) and real(low, high) between both, bits64(). Its fail(text) is told what must
/// not be.
template <typename Choices>
class LibraryCaller : private AnyArguments<Choices> {
  public:
    explicit LibraryCaller(Choices& random, std::string folder = {})
        : AnyArguments<Choices>(random), random_(random), folder_(std::move(folder)), scene_(burin_scene_new()) {
        if (burin_abi() != BURIN_ABI || burin_version() == nullptr) random_.fail("the library is of another version");
        if (burin_set(scene_, "picture.size=[12, 9]") != 0) random_.fail("the size cannot be set");
        add_shaders();
    }
    LibraryCaller(const LibraryCaller&) = delete;
    LibraryCaller& operator=(const LibraryCaller&) = delete;
    /// Pictures and drawings outlive their scene.
    ~LibraryCaller() {
        burin_scene_free(scene_);
        scene_ = nullptr;
        look_at_channels();
        look_at_lines();
        encode();
        burin_picture_free(picture_);
        burin_drawing_free(drawing_);
    }

    void call() {
        switch (random_.integer(0, 22)) {
            case 0:
                return expect_told(add_mesh());
            case 1:
                return expect_told(add_object());
            case 2:
                return expect_told(add_material());
            case 3:
                return expect_told(move_object());
            case 4:
                return expect_told(burin_remove_object(scene_or_null(), number_of(9)));
            case 5:
                return expect_told(burin_remove_mesh(scene_or_null(), number_of(30)));
            case 6:
                return expect_told(random_.integer(0, 30) == 0 ? burin_clear_objects(scene_) : 0);
            case 7:
                return expect_told(burin_set(scene_or_null(), setting().c_str()));
            case 8:
                return expect_told(burin_set_toml(scene_or_null(), toml().c_str()));
            case 9:
                return expect_told(
                    random_.integer(0, 9) == 0
                        ? burin_load_text(scene_, toml().c_str(), random_.integer(0, 1) == 0 ? nullptr : "/none")
                        : 0);
            case 10:
                return expect_told(burin_object_of_id(scene_or_null(), static_cast<std::uint32_t>(integer())));
            case 11:
                burin_object_name(scene_or_null(), number_of(9));
                burin_note(scene_or_null(), static_cast<int>(integer()));
                return burin_cancel(scene_or_null());
            case 12:
                return encode();
            case 13:
                return look_at_channels();
            case 14:
                return expect_told(random_.integer(0, 3) == 0 ? burin_set_style(scene_or_null(), style()) : 0);
            case 15:
                return expect_told(load());
            case 16:
                return scene_box();
            case 17:
                return look_at_lines();
            case 18:
                return expect_told(add_shader());
            case 19:
                return explain();
            case 20:
                return draw_again();
            default:
                return render();
        }
    }

    int pictures() const { return pictures_; }
    /// For burin_cancel() of other threads, as long as this lives.
    burin_scene* scene() const { return scene_; }

  private:
    using Any = AnyArguments<Choices>;
    using Any::any_count, Any::integer, Any::matrix, Any::mostly, Any::number, Any::number_of, Any::setting;
    using Any::size_of_struct, Any::style, Any::toml;

    template <typename T>
    T one_of(std::initializer_list<T> values) {
        return Any::template one_of<T>(values);
    }
    void expect_told(int result) {
        if (result >= 0) return;
        const std::string text = burin_error();
        if (result != burin_error_kind() || text.empty() || result == BURIN_FAILED) {
            random_.fail("result " + std::to_string(result) + ", error: " + text);
        }
    }

    burin_scene* scene_or_null() { return random_.integer(0, 99) == 0 ? nullptr : scene_; }
    /// What a function that returns a pointer has to say where it returned NULL.
    template <typename T>
    T* told(T* result) {
        if (result == nullptr && burin_error_kind() >= 0) random_.fail("NULL without an error");
        if (result == nullptr) expect_told(burin_error_kind());
        return result;
    }

    int add_mesh() {
        std::vector<float> points(static_cast<std::size_t>(3 * random_.integer(0, 12)));
        const bool is_wild = random_.integer(0, 2) == 0;
        for (float& p : points) {
            const double value = is_wild                      ? number()
                                 : random_.integer(0, 2) == 0 ? random_.integer(0, 2)
                                                              : random_.real(-1, 1);
            p = static_cast<float>(std::clamp(value, -3e38, 3e38));
            if (std::isnan(value)) p = std::numeric_limits<float>::quiet_NaN();
        }
        const int last = static_cast<int>(points.size() / 3) - 1;
        std::vector<std::int32_t> sizes(static_cast<std::size_t>(random_.integer(0, 8))), corners, materials, objects,
            marks;
        for (std::int32_t& size : sizes) {
            size = random_.integer(0, 6);
            for (int k = 0; k < size; ++k)
                corners.push_back(random_.integer(0, 99) == 0 ? integer() : random_.integer(0, std::max(last, 0)));
            if (random_.integer(0, 99) == 0) size = integer();
            materials.push_back(random_.integer(0, 9) == 0 ? integer() : random_.integer(0, 2));
            objects.push_back(random_.integer(0, 29) == 0 ? integer() : random_.integer(0, 2));
        }
        for (int i = random_.integer(0, 2) * 2; i > 0; --i)
            marks.push_back(random_.integer(0, 99) == 0 ? integer() : random_.integer(0, std::max(last, 0)));
        const char* const names[] = {"a", nullptr, "\xff\n"};
        burin_mesh mesh = {};
        mesh.size = size_of_struct(sizeof mesh);
        mesh.name = one_of<const char*>({nullptr, "", "name"});
        mesh.points = points.data(), mesh.point_count = any_count(points.size() / 3);
        mesh.corners = corners.data(), mesh.corner_count = any_count(corners.size());
        if (random_.integer(0, 4) != 0) mesh.polygon_sizes = sizes.data();
        mesh.polygon_count = mesh.polygon_sizes != nullptr || random_.integer(0, 1) == 0 ? any_count(sizes.size()) : 0;
        // One triangle more than there are polygons: without sizes, these arrays do not fit.
        materials.resize(64), objects.resize(64);
        if (random_.integer(0, 1) == 0) mesh.polygon_materials = materials.data();
        if (random_.integer(0, 2) == 0) mesh.polygon_objects = objects.data();
        mesh.object_count = mesh.polygon_objects == nullptr ? 0 : 3;
        if (random_.integer(0, 1) == 0) mesh.object_names = names;
        mesh.marked_edges = marks.data(), mesh.marked_edge_count = any_count(marks.size() / 2);
        // Attributes that are there have as many numbers as the counts say that they need.
        const std::vector<float> values(3 * std::max(corners.size(), points.size()) + 3,
                                        static_cast<float>(random_.real(-2, 2)));
        const float* const arrays[] = {values.data(), random_.integer(0, 9) == 0 ? nullptr : values.data()};
        const bool fits = mesh.corner_count <= corners.size() && mesh.point_count <= points.size() / 3;
        if (fits && random_.integer(0, 1) == 0) mesh.corner_uv = values.data();
        if (fits && random_.integer(0, 1) == 0) mesh.point_colors = values.data();
        if (fits && random_.integer(0, 2) == 0) {
            mesh.attribute_names = names, mesh.point_attributes = arrays;
            mesh.attribute_count = static_cast<std::uint64_t>(random_.integer(0, 2));
        }
        return burin_add_mesh(scene_or_null(), random_.integer(0, 99) == 0 ? nullptr : &mesh);
    }
    int add_object() {
        burin_object object = {};
        object.size = size_of_struct(sizeof object);
        object.mesh = number_of(30);
        object.material = random_.integer(0, 2) == 0 ? integer() : 0;
        object.name = one_of<const char*>({nullptr, "", "object"});
        matrix(object.to_world);
        return burin_add_object(scene_or_null(), &object);
    }
    int add_material() {
        burin_material material = {};
        material.size = size_of_struct(sizeof material);
        material.opacity = static_cast<float>(mostly(0, 1));
        for (float& c : material.color) c = static_cast<float>(mostly(0, 1));
        return burin_add_material(scene_or_null(), &material);
    }
    int move_object() {
        double to_world[16];
        matrix(to_world);
        return burin_move_object(scene_or_null(), number_of(9), random_.integer(0, 99) == 0 ? nullptr : to_world);
    }
    /// Only now and then, since it takes long.
    void explain() {
        if (++explanations_ % 16 != 0) return;
        const burin_view view = any_view();
        const int x = mostly_within(), y = mostly_within();
        told(burin_explain(scene_or_null(), random_.integer(0, 1) == 0 ? &view : nullptr, nullptr, x, y,
                           one_of<const char*>({"json", "text", "", nullptr})));
    }
    int mostly_within() { return random_.integer(0, 9) == 0 ? integer() : random_.integer(0, 8); }
    /// Callbacks that leave numbers of any kind.
    static int shade(const burin_line_samples* in, burin_line_ink* out, void*) {
        fill(out->width_px, in->count, 0);
        // The widest lines would take most of the time.
        for (std::uint32_t i = 0; i < in->count; ++i) out->width_px[i] = std::min(out->width_px[i], 40.0f);
        fill(out->offset_px, in->count, 1);
        fill(out->opacity, in->count, 2);
        fill(out->blue, in->count, 5);
        return 0;
    }
    static int test(const burin_line_samples* in, float* strength, void*) {
        fill(strength, in->count, 3);
        return 0;
    }
    void add_shaders() {
        if (burin_add_line_shader(scene_, "wild", "N, C.r, s", shade, nullptr) != 0 ||
            burin_add_line_test(scene_, "wild", "gap, facing, qi", test, nullptr) != 0)
            random_.fail("shaders cannot be added");
    }
    int add_shader() {
        const char* const name = one_of<const char*>({"wild", "wild", "other", "no name", "", nullptr});
        const char* const variables =
            one_of<const char*>({nullptr, "", "depth", "N, Cv, curvature", "nothing", "depth,,", "attr(\"a\")"});
        const int kind = random_.integer(0, 4);
        if (random_.integer(0, 2) == 0) {
            const burin_line_test fails = [](const burin_line_samples*, float*, void*) { return 7; };
            return burin_add_line_test(scene_or_null(), name, variables,
                                       kind == 0   ? nullptr
                                       : kind == 1 ? fails
                                                   : test,
                                       nullptr);
        }
        const burin_line_shader fails = [](const burin_line_samples* in, burin_line_ink*, void*) {
            std::fill_n(in->message, in->message_size, 'x');  // without an end
            burin_cancel(nullptr);
            return -1;
        };
        return burin_add_line_shader(scene_or_null(), name, variables,
                                     kind == 0   ? nullptr
                                     : kind == 1 ? fails
                                                 : shade,
                                     nullptr);
    }
    int load() {
        if (random_.integer(0, 9) != 0) return 0;
        const char* const name = one_of<const char*>({"/none.obj", "/", "", nullptr, "/none/\xff.toml", "a", "b.png"});
        if (name == nullptr || *name == '/' || folder_.empty()) return burin_load(scene_or_null(), name);
        return burin_load(scene_or_null(), (folder_ + "/" + name).c_str());
    }
    void scene_box() {
        double low[3], high[3];
        expect_told(burin_scene_box(scene_or_null(), random_.integer(0, 29) == 0 ? nullptr : low, high));
    }
    static void fill(float* to, std::uint32_t count, std::uint32_t from) {
        using Limits = std::numeric_limits<float>;
        constexpr float kNumbers[] = {
            Limits::quiet_NaN(), 3, Limits::infinity(), -Limits::infinity(), 0.5f, Limits::max(), -0.0f, 1e-40f, -7};
        for (std::uint32_t i = 0; i < count; ++i) to[i] = kNumbers[(i + from) % 9];
    }

    burin_view any_view() {
        burin_view view = {};
        view.size = size_of_struct(sizeof view);
        if (random_.integer(0, 3) != 0) {
            view.width = random_.integer(0, 19) == 0 ? one_of({-1, 0, 65536, std::numeric_limits<int>::max()})
                                                     : random_.integer(1, 20);
            view.height = random_.integer(0, 19) == 0 ? one_of({-1, 0, 65536, std::numeric_limits<int>::min()})
                                                      : random_.integer(1, 20);
        }
        if (random_.integer(0, 4) == 0) {
            for (int& c : view.crop) c = integer();
        }
        if (random_.integer(0, 4) == 0) view.samples = one_of({2, 4, 8, 3, -8});
        if (random_.integer(0, 29) == 0) view.camera = one_of<const char*>({"", "none"});
        if (random_.integer(0, 2) != 0) rigid_camera(view);
        if (random_.integer(0, 29) == 0) view.shift[random_.integer(0, 1)] = number();
        if (random_.integer(0, 9) == 0) view.pixel_aspect = mostly(0.1, 10);
        if (random_.integer(0, 29) == 0) view.frame = integer();
        return view;
    }
    void render() {
        const burin_view view = any_view();
        burin_options options = {};
        options.size = size_of_struct(sizeof options);
        options.threads =
            random_.integer(0, 29) == 0 ? one_of({-1, 1025, std::numeric_limits<int>::max()}) : random_.integer(1, 2);
        if (random_.integer(0, 4) == 0) options.memory_bytes = random_.bits64() >> random_.integer(0, 63);
        if (random_.integer(0, 4) == 0)
            options.layers = one_of(
                {"beauty", "Z,ids", "coverage,beauty", "", ",", "wool", "N,lines,surface,lines_hidden,beauty,Z"});
        const int stop = random_.integer(0, 3) == 0 ? 1 : 0;
        // Options that end before `user` have none.
        options.progress = [](double, void* user) { return user == nullptr ? 0 : *static_cast<const int*>(user); };
        options.user = const_cast<int*>(&stop);
        options.find_all = random_.integer(0, 9) == 0 ? integer() : 0;
        options.for_paths = random_.integer(0, 3) == 0 ? integer() : 0;
        if (random_.integer(0, 2) == 0) {
            burin_drawing* const drawing = told(burin_find_lines(scene_or_null(), &view, &options));
            if (drawing == nullptr) return;
            burin_drawing_free(drawing_);
            drawing_ = drawing;
            look_at_lines();
            return draw_again();
        }
        take(told(burin_render(scene_or_null(), &view, &options)));
    }
    void take(burin_picture* picture) {
        if (picture == nullptr) return;
        burin_picture_free(picture_);
        picture_ = picture;
        ++pictures_;
    }
    void draw_again() {
        burin_options options = {};
        options.size = size_of_struct(sizeof options);
        options.threads = random_.integer(0, 29) == 0 ? integer() : 1;
        if (random_.integer(0, 29) == 0) options.layers = "beauty";
        take(told(burin_draw(drawing_, random_.integer(0, 9) == 0 ? style() : nullptr,
                             random_.integer(0, 1) == 0 ? &options : nullptr)));
    }
    void look_at_lines() {
        for (int i = random_.integer(0, 3); i > 0; --i) {
            std::int32_t type = 0;
            std::uint64_t count = 0;
            const char* const name = one_of<const char*>({"x0", "y1", "nearness0", "line", "object", "material",
                                                          "classes", "invisibility", "", "width", nullptr});
            const void* const values =
                told(burin_column(drawing_, name, random_.integer(0, 9) == 0 ? nullptr : &type, &count));
            if (values == nullptr) continue;
            // All that is promised is there.
            constexpr int kBytes[] = {0, 2, 4, 4, 8, 8, 2, 1};
            if (type < 0 || type > BURIN_UINT8) return random_.fail("a column has no type");
            read(values, count * static_cast<std::uint64_t>(kBytes[type]));
        }
    }
    /// Reads memory, so that sanitizers see whether it is there.
    void read(const void* memory, std::uint64_t bytes) {
        for (std::uint64_t i = 0; i < bytes; ++i) sum_ += static_cast<const unsigned char*>(memory)[i];
    }
    /// Nearly always rigid, as much as single precision is.
    void rigid_camera(burin_view& view) {
        const double a = random_.real(-4, 4), b = random_.real(-2, 2);
        const double rows[12] = {std::cos(a),
                                 std::sin(a) * std::sin(b),
                                 std::sin(a) * std::cos(b),
                                 mostly(-3, 3),
                                 0,
                                 std::cos(b),
                                 -std::sin(b),
                                 mostly(-3, 3),
                                 -std::sin(a),
                                 std::cos(a) * std::sin(b),
                                 std::cos(a) * std::cos(b),
                                 mostly(-3, 5)};
        for (int i = 0; i < 12; ++i)
            view.camera_to_world[i] = i % 4 == 3 ? rows[i] : static_cast<double>(static_cast<float>(rows[i]));
        view.camera_to_world[15] = 1;
        if (random_.integer(0, 19) == 0) view.camera_to_world[random_.integer(0, 15)] = number();
        if (random_.integer(0, 1) == 0) view.fov_deg = mostly(1, 170);
        if (random_.integer(0, 2) == 0) view.ortho_height = mostly(0.1, 5);
    }
    void encode() {
        const void* const given = random_.integer(0, 2) == 0    ? static_cast<const void*>(drawing_)
                                  : random_.integer(0, 49) == 0 ? nullptr
                                                                : picture_;
        std::uint8_t* bytes = nullptr;
        std::uint64_t count = 0;
        const char* const format =
            one_of<const char*>({"png", "png16", "exr", "svg", "pdf", "dxf", "png", "exr", "svg", "jpg", "", nullptr});
        const char* const as = random_.integer(0, 9) == 0 ? style() : nullptr;
        if (!folder_.empty() && random_.integer(0, 19) == 0) {
            const char* const name = one_of({"/a.png", "/b.svg", "/none/a.exr", "/a", "/.", ""});
            return expect_told(
                burin_write(given, random_.integer(0, 1) == 0 ? nullptr : format, as, (folder_ + name).c_str()));
        }
        const int result = burin_encode(given, format, as, random_.integer(0, 99) == 0 ? nullptr : &bytes, &count);
        expect_told(result);
        if (result == 0) read(bytes, count);
        burin_file_note(integer());
        burin_bytes_free(bytes);
    }
    void look_at_channels() {
        std::int32_t type = 0, size[2] = {};
        const char* const name = one_of<const char*>({"R", "Z", "", "id.object", "lines.A", nullptr});
        if (const void* const values = told(burin_channel(picture_, name, &type, size))) {
            const auto pixels = static_cast<std::uint64_t>(size[0]) * static_cast<std::uint64_t>(size[1]);
            read(values, pixels * (type == BURIN_HALF ? 2 : 4));
        }
        burin_channel_name(picture_, integer());
        burin_picture_note(picture_, integer());
        if (picture_ == nullptr) return;
        expect_told(burin_picture_size(picture_, size));
        const int channels = random_.integer(0, 9) == 0 ? integer() : one_of({1, 3, 4});
        std::vector<std::uint8_t> bytes(4 * static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]));
        expect_told(burin_pixels(picture_, random_.integer(0, 49) == 0 ? nullptr : bytes.data(), channels));
    }

    Choices& random_;
    std::string folder_;
    burin_scene* scene_;
    burin_picture* picture_ = nullptr;
    burin_drawing* drawing_ = nullptr;
    int pictures_ = 0, explanations_ = 0;
    unsigned sum_ = 0;
};

}  // namespace burin::test
