#pragma once

#include <burin/burin.h>

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <string>

namespace burin::test {

/// Arguments of the library's functions, of which most make sense. `Choices`: see LibraryCaller.
template <typename Choices>
class AnyArguments {
  public:
    explicit AnyArguments(Choices& random) : random_(random) {}

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
    std::uint64_t any_count(std::size_t right) {
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

    std::string setting() {
        const char* const key = one_of({"lines.width",
                                        "lines.draw",
                                        "lines.crease_angle",
                                        "lines.hidden.style",
                                        "lines.hidden.width",
                                        "lines.dash",
                                        "lines.side",
                                        "lines.filter",
                                        "lines.contours",
                                        "surfaces.shading",
                                        "abuffer.samples",
                                        "camera.fov",
                                        "camera.eye",
                                        "camera.shift",
                                        "camera.pixel_aspect",
                                        "camera.lens_radius",
                                        "lines",
                                        "",
                                        "picture.background",
                                        "picture.paper",
                                        "picture.size",
                                        "x.y.z",
                                        "style.width",
                                        "style.i.opacity",
                                        "surfaces.bands",
                                        "frame.number",
                                        "frames.range"});
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
                       "[[object]]\nshape = \"sphere\"\nscale = [1, 1e20, 1]\n",
                       "[[camera]]\npixel_aspect = 0.1\nshift = [-2, 1]\n", "[[light]]\ndirection = [1, 1, 1]\n",
                       "[[object]]\nshape = \"torus\"\nsegments = 8\ntube_segments = 6\n"
                       "[[object.key]]\nframe = 3\ntranslate = [1, 0, 0]\n"});
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

  private:
    Choices& random_;
};

}  // namespace burin::test
