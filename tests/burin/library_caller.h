#pragma once

#include <burin/burin.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <string>
#include <vector>

namespace burin::test {

/// Calls of one scene in any order, with whatever arguments. Pointers and the numbers of their elements are right, or
/// too many to be meant.
///
/// `Choices` chooses: integer(low, high) and real(low, high) between both, bits64(). Its fail(text) is told what must
/// not be.
template <typename Choices>
class LibraryCaller {
  public:
    explicit LibraryCaller(Choices& random) : random_(random), scene_(burin_scene_new()) {
        if (burin_set(scene_, "picture.size=[12, 9]") != 0) random_.fail("the size cannot be set");
        add_shaders();
    }
    LibraryCaller(const LibraryCaller&) = delete;
    LibraryCaller& operator=(const LibraryCaller&) = delete;
    ~LibraryCaller() {
        burin_picture_free(picture_);
        burin_scene_free(scene_);
    }

    void call() {
        switch (random_.integer(0, 16)) {
            case 0:
                return expect_told(add_mesh());
            case 1:
                return expect_told(add_object());
            case 2:
                return expect_told(add_material());
            case 3:
                return expect_told(move_object());
            case 4:
                return expect_told(burin_remove_object(scene_, number_of(9)));
            case 5:
                return expect_told(burin_remove_mesh(scene_, number_of(30)));
            case 6:
                return expect_told(random_.integer(0, 30) == 0 ? burin_clear_objects(scene_) : 0);
            case 7:
                return expect_told(burin_set(scene_, setting().c_str()));
            case 8:
                return expect_told(burin_set_toml(scene_, toml().c_str()));
            case 9:
                return expect_told(
                    random_.integer(0, 9) == 0
                        ? burin_load_text(scene_, toml().c_str(), random_.integer(0, 1) == 0 ? nullptr : "/none")
                        : 0);
            case 10:
                return expect_told(burin_object_of_id(scene_, static_cast<std::uint32_t>(integer())));
            case 11:
                burin_object_name(scene_, number_of(9));
                burin_note(scene_, static_cast<int>(integer()));
                explain();
                return burin_cancel(scene_);
            case 12:
                return encode();
            case 13:
                return look_at_channels();
            case 14:
                return expect_told(random_.integer(0, 3) == 0 ? burin_set_style(scene_, style()) : 0);
            default:
                return render();
        }
    }

    int pictures() const { return pictures_; }

  private:
    void expect_told(int result) {
        if (result >= 0) return;
        const std::string text = burin_error();
        if (result != burin_error_kind() || text.empty() || result == BURIN_FAILED) {
            random_.fail("result " + std::to_string(result) + ", error: " + text);
        }
    }

    template <typename T>
    T one_of(std::initializer_list<T> values) {
        return values.begin()[random_.integer(0, static_cast<int>(values.size()) - 1)];
    }
    double number() {
        using Limits = std::numeric_limits<double>;
        switch (random_.integer(0, 9)) {
            case 0:
                return one_of(
                    {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity(), Limits::max(), Limits::lowest()});
            case 1:
                return one_of(
                    {Limits::denorm_min(), Limits::min(), -0.0, 1e30, -1e30, 1e-30, 1e60, 180.0, 179.9999999, 1e-6});
            case 2:
                return std::ldexp(random_.real(-1, 1), random_.integer(-120, 120));
            case 3:
                return one_of({0.0, 1.0, -1.0, 0.5});
            default:
                return random_.real(-2, 2);
        }
    }
    std::int32_t integer() {
        using Limits = std::numeric_limits<std::int32_t>;
        return random_.integer(0, 3) == 0 ? one_of({Limits::min(), Limits::max(), -1, 0, 1, 65535, 65536})
                                          : random_.integer(-2, 12);
    }
    int number_of(int usual) { return random_.integer(0, 9) == 0 ? integer() : random_.integer(1, usual); }
    /// Now and then that of an older version, which ends behind a whole field.
    std::uint32_t size_of_struct(std::size_t right) {
        const auto size = static_cast<std::uint32_t>(right);
        return random_.integer(0, 19) == 0 ? size / 8 * static_cast<std::uint32_t>(random_.integer(0, 8)) / 8 * 8
                                           : size;
    }
    std::uint64_t count(std::size_t right) {
        if (random_.integer(0, 29) != 0) return right;
        return one_of({std::uint64_t{1} << 32, std::uint64_t{1} << 62, std::numeric_limits<std::uint64_t>::max(),
                       std::numeric_limits<std::uint64_t>::max() / 3 + 1});
    }
    /// Numbers that a field mostly takes.
    double mostly(double low, double high) { return random_.integer(0, 19) == 0 ? number() : random_.real(low, high); }
    void matrix(double (&to)[16]) {
        const int kind = random_.integer(0, 3);
        for (double& element : to) element = 0;
        if (kind == 0) return;
        for (int i = 0; i < 12; ++i) to[i] = kind == 1 ? number() : mostly(-2, 2);
        to[15] = random_.integer(0, 19) == 0 ? number() : 1;
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
        mesh.points = points.data(), mesh.point_count = count(points.size() / 3);
        mesh.corners = corners.data(), mesh.corner_count = count(corners.size());
        if (random_.integer(0, 4) != 0) mesh.polygon_sizes = sizes.data();
        mesh.polygon_count = mesh.polygon_sizes != nullptr || random_.integer(0, 1) == 0 ? count(sizes.size()) : 0;
        // One triangle more than there are polygons: without sizes, these arrays do not fit.
        materials.resize(64), objects.resize(64);
        if (random_.integer(0, 1) == 0) mesh.polygon_materials = materials.data();
        if (random_.integer(0, 2) == 0) mesh.polygon_objects = objects.data();
        mesh.object_count = mesh.polygon_objects == nullptr ? 0 : 3;
        if (random_.integer(0, 1) == 0) mesh.object_names = names;
        mesh.marked_edges = marks.data(), mesh.marked_edge_count = count(marks.size() / 2);
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
        return burin_add_mesh(scene_, &mesh);
    }
    int add_object() {
        burin_object object = {};
        object.size = size_of_struct(sizeof object);
        object.mesh = number_of(30);
        object.material = random_.integer(0, 2) == 0 ? integer() : 0;
        object.name = one_of<const char*>({nullptr, "", "object"});
        matrix(object.to_world);
        return burin_add_object(scene_, &object);
    }
    int add_material() {
        burin_material material = {};
        material.size = size_of_struct(sizeof material);
        material.opacity = static_cast<float>(mostly(0, 1));
        for (float& c : material.color) c = static_cast<float>(mostly(0, 1));
        return burin_add_material(scene_, &material);
    }
    int move_object() {
        double to_world[16];
        matrix(to_world);
        return burin_move_object(scene_, number_of(9), to_world);
    }
    std::string setting() {
        const char* const key = one_of(
            {"lines.width", "lines.draw", "lines.crease_angle", "lines.hidden.style", "lines.hidden.width",
             "lines.dash", "lines.side", "lines.filter", "lines.contours", "surfaces.shading", "abuffer.samples",
             "camera.fov", "camera.eye", "lines", "", "picture.background", "x.y.z", "style.width", "style.i.opacity"});
        const char* const value =
            one_of({"1",     "2.5",    "nan",       "-1",      "1e999",    "all",        "none",    "dashed",
                    "solid", "[3, 2]", "[1, 2, 3]", "smooth",  "mitchell", "inside",     "lambert", "8",
                    "[",     "\"",     "",          "{a = 1}", "\xff",     "transparent"});
        return std::string(key) + (random_.integer(0, 29) == 0 ? "" : "=") + value;
    }
    std::string toml() {
        return one_of({"", "[lines]\nwidth = 3\n", "[lines]\nwidth = inf\n", "[[camera]]\neye = [1, 2, 3]\n",
                       "[[object]]\nshape = \"box\"\n", "[[object]]\nfile = \"none.obj\"\n",
                       "[lines.hidden]\nstyle = \"dashed\"\n", "[lines]\ndash = [1, 2]\n", "[", "a = [[[[",
                       "[surfaces]\nshading = 3\n", "\xff\xfe",
                       "[[camera]]\nprojection = \"orthographic\"\ndirection = [0, 0, 1]\n",
                       "[[object]]\nshape = \"sphere\"\nscale = [1, 1e20, 1]\n"});
    }

    /// Of the sheets, some need much of lines and some little.
    const char* style() {
        return one_of<const char*>(
            {nullptr, "", "technical", "pencil", "patent", "wool", "none.toml", "[[set]]\n",
             "[[set]]\nname=\"a\"\nclasses=[\"crease\",\"border\"]\nstyle=\"i\"\n[style.i]\nwidth=\"=1/0*(x-x)+3\"\n",
             "[[set]]\nname=\"a\"\nclasses=[\"silhouette\"]\nlayer=true\nstyle=\"i\"\n[style.i]\nopacity=0.5\n"
             "color=\"=N\"\ntaper={start=9}\n",
             "[[set]]\nname=\"a\"\nclasses=[\"crease\"]\nstyle=\"i\"\n[style.i]\nwidth=\"=depht\"\n",
             "[[set]]\nname=\"a\"\nclasses=[\"crease\",\"silhouette\"]\ntest=\"wild\"\nstyle=\"i\"\n[style.i]\n"
             "shader=\"wild\"\n"});
    }

    /// Only now and then, since it takes long.
    void explain() {
        if (++explanations_ % 64 != 0) return;
        if (burin_explain(scene_, nullptr, nullptr, 6, 4, "json") == nullptr) expect_told(burin_error_kind());
    }
    /// Adds callbacks that leave numbers of any kind.
    void add_shaders() {
        const burin_line_shader shader = [](const burin_line_samples* in, burin_line_ink* out, void*) {
            fill(out->width_px, in->count, 0);
            // The widest lines would take most of the time.
            for (std::uint32_t i = 0; i < in->count; ++i) out->width_px[i] = std::min(out->width_px[i], 40.0f);
            fill(out->offset_px, in->count, 1);
            fill(out->opacity, in->count, 2);
            fill(out->blue, in->count, 5);
            return 0;
        };
        const burin_line_test test = [](const burin_line_samples* in, float* strength, void*) {
            fill(strength, in->count, 3);
            return 0;
        };
        if (burin_add_line_shader(scene_, "wild", "N, C.r, s", shader, nullptr) != 0 ||
            burin_add_line_test(scene_, "wild", "gap, facing, qi", test, nullptr) != 0)
            random_.fail("shaders cannot be added");
    }
    static void fill(float* to, std::uint32_t count, std::uint32_t from) {
        using Limits = std::numeric_limits<float>;
        constexpr float kNumbers[] = {
            Limits::quiet_NaN(), 3, Limits::infinity(), -Limits::infinity(), 0.5f, Limits::max(), -0.0f, 1e-40f, -7};
        for (std::uint32_t i = 0; i < count; ++i) to[i] = kNumbers[(i + from) % 9];
    }

    void render() {
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
        if (random_.integer(0, 29) == 0) view.pixel_aspect = number();
        if (random_.integer(0, 29) == 0) view.frame = integer();
        burin_options options = {};
        options.size = size_of_struct(sizeof options);
        options.threads =
            random_.integer(0, 29) == 0 ? one_of({-1, 1025, std::numeric_limits<int>::max()}) : random_.integer(1, 2);
        if (random_.integer(0, 4) == 0) options.memory_bytes = random_.bits64() >> random_.integer(0, 63);
        if (random_.integer(0, 4) == 0)
            options.layers = one_of(
                {"beauty", "Z,ids", "coverage,beauty", "", ",", "wool", "N,lines,surface,lines_hidden,beauty,Z"});
        const int stop = random_.integer(0, 3) == 0 ? 1 : 0;
        options.progress = [](double, void* user) { return *static_cast<const int*>(user); };
        options.user = const_cast<int*>(&stop);
        if (random_.integer(0, 2) == 0) return look_at_lines(burin_find_lines(scene_, &view, &options));
        burin_picture* const picture = burin_render(scene_, &view, &options);
        if (picture == nullptr) return expect_told(burin_error_kind());
        burin_picture_free(picture_);
        picture_ = picture;
        ++pictures_;
    }
    void look_at_lines(burin_drawing* drawing) {
        if (drawing == nullptr) return expect_told(burin_error_kind());
        for (int i = random_.integer(0, 3); i > 0; --i) {
            std::int32_t type = 0;
            std::uint64_t count = 0;
            burin_column(drawing, one_of({"x0", "line", "object", "invisibility", "", "width"}), &type, &count);
        }
        burin_picture* const picture = burin_draw(drawing, random_.integer(0, 9) == 0 ? style() : nullptr, nullptr);
        burin_drawing_free(drawing);
        if (picture == nullptr) return expect_told(burin_error_kind());
        burin_picture_free(picture_);
        picture_ = picture;
        ++pictures_;
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
        if (picture_ == nullptr) return;
        std::uint8_t* bytes = nullptr;
        std::uint64_t count = 0;
        expect_told(burin_encode(picture_, one_of({"png", "png16", "exr", "jpg", ""}),
                                 random_.integer(0, 9) == 0 ? style() : nullptr, &bytes, &count));
        burin_bytes_free(bytes);
    }
    void look_at_channels() {
        if (picture_ == nullptr) return;
        std::int32_t type = 0, size[2] = {};
        burin_channel(picture_, one_of({"R", "Z", "", "id.object", "lines.A"}), &type, size);
        burin_channel_name(picture_, integer());
    }

    Choices& random_;
    burin_scene* scene_;
    burin_picture* picture_ = nullptr;
    int pictures_ = 0, explanations_ = 0;
};

}  // namespace burin::test
