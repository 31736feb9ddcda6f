// burin._core: scenes, pictures and drawings of the library for Python, with arrays of NumPy. The package around it
// (python/burin) says what users call; here is only what needs C++. Nothing is checked here that the library checks.
#include <burin/burin.hpp>

#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <optional>
#include <thread>

#include "line_functions.h"

namespace py = pybind11;

namespace {

using burin::python::Floats;
using burin::python::PythonLineShader;
using burin::python::PythonLineTest;
using burin::python::Thrown;

using Integers = py::array_t<std::int32_t, py::array::c_style | py::array::forcecast>;

template <typename T>
std::span<const T> span_of(const std::optional<py::array_t<T, py::array::c_style | py::array::forcecast>>& array) {
    if (!array) return {};
    return {array->data(), static_cast<std::size_t>(array->size())};
}

/// Whether the interpreter is about to end. Other threads than its own, which are all daemons then, must not come back
/// to Python: waiting for its lock would end the process.
std::atomic<bool> is_ending = false;
const std::thread::id main_thread = std::this_thread::get_id();
void stay_away_at_the_end() {
    while (is_ending && std::this_thread::get_id() != main_thread) std::this_thread::sleep_for(std::chrono::hours(1));
}
std::atomic<int> calls_at_work = 0;

/// A call that draws: other threads of Python run meanwhile, Ctrl-C stops it, and so does `progress` by returning True.
struct Work {
    burin::View view;
    burin::Options options;

    Work(std::array<int, 2> size, std::array<std::int32_t, 4> crop, int samples, const std::string& camera,
         const burin::Matrix& camera_to_world, double fov_deg, double ortho_height, const std::array<double, 2>& shift,
         double pixel_aspect, int frame, int threads, std::uint64_t memory_bytes, const std::string& layers,
         bool for_paths, bool find_all, py::object progress) {
        view.width = size[0];
        view.height = size[1];
        view.crop = crop;
        view.samples = samples;
        view.camera = camera;
        view.camera_to_world = camera_to_world;
        view.fov_deg = fov_deg;
        view.ortho_height = ortho_height;
        view.shift = shift;
        view.pixel_aspect = pixel_aspect;
        view.frame = frame;
        options.threads = threads;
        options.memory_bytes = memory_bytes;
        options.layers = layers;
        options.for_paths = for_paths;
        options.find_all = find_all;
        options.progress = [progress = std::move(progress)](double done) {
            if (is_ending) return true;
            const py::gil_scoped_acquire python;
            if (PyErr_CheckSignals() != 0) throw py::error_already_set();
            return !progress.is_none() && py::cast<bool>(py::bool_(progress(done)));
        };
    }
};

/// A scene that one call at a time uses.
class PythonScene : public burin::Scene {
  public:
    std::shared_ptr<Thrown> thrown() const { return thrown_; }

    /// Runs a call, if no other one is at work.
    template <typename Work>
    auto in_turn(const Work& work) {
        stay_away_at_the_end();
        if (is_busy_.exchange(true))
            throw burin::Error(BURIN_BAD_ARGUMENT,
                               "the scene is at work; one call at a time may use it, but for cancel()");
        const Turn turn{is_busy_};
        return thrown_->rethrowing(work);
    }

  private:
    struct Turn {
        std::atomic<bool>& flag;
        explicit Turn(std::atomic<bool>& busy) : flag(busy) { ++calls_at_work; }
        Turn(const Turn&) = delete;
        Turn& operator=(const Turn&) = delete;
        ~Turn() {
            flag = false;
            --calls_at_work;
            stay_away_at_the_end();
        }
    };
    std::atomic<bool> is_busy_ = false;
    std::shared_ptr<Thrown> thrown_ = std::make_shared<Thrown>();
};

/// A member function of the scene, in turn.
template <typename Result, typename... Parts>
auto in_turn(Result (burin::Scene::*function)(Parts...)) {
    return [function](PythonScene& self, Parts... parts) -> Result {
        return self.in_turn([&] { return (self.*function)(std::forward<Parts>(parts)...); });
    };
}
template <typename Result, typename... Parts>
auto in_turn(Result (burin::Scene::*function)(Parts...) const) {
    return [function](PythonScene& self, Parts... parts) -> Result {
        return self.in_turn([&] { return (self.*function)(std::forward<Parts>(parts)...); });
    };
}

/// Stops all that draws, and waits for it, before the interpreter ends.
void end() {
    is_ending = true;
    const py::gil_scoped_release others_run;
    constexpr int kMostWaits = 500;
    for (int i = 0; i < kMostWaits && calls_at_work > 0; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
}

/// Arrays of one mesh; burin._mesh has brought them to these types and shapes.
int add_mesh(PythonScene& scene, const std::string& name, const Floats& points, const Integers& corners,
             const std::optional<Integers>& polygon_sizes, const std::optional<Integers>& polygon_materials,
             const std::optional<Integers>& polygon_objects, std::vector<std::string> object_names,
             const std::optional<Integers>& marked_edges, const std::optional<Floats>& corner_uv,
             const std::optional<Floats>& point_colors, const std::map<std::string, Floats>& attributes) {
    burin::Mesh mesh;
    mesh.name = name;
    mesh.points = {points.data(), static_cast<std::size_t>(points.size())};
    mesh.corners = {corners.data(), static_cast<std::size_t>(corners.size())};
    mesh.polygon_sizes = span_of(polygon_sizes);
    mesh.polygon_materials = span_of(polygon_materials);
    mesh.polygon_objects = span_of(polygon_objects);
    mesh.object_names = std::move(object_names);
    mesh.marked_edges = span_of(marked_edges);
    mesh.corner_uv = span_of(corner_uv);
    mesh.point_colors = span_of(point_colors);
    for (const auto& [attribute, values] : attributes)
        mesh.attributes.emplace_back(attribute, std::span(values.data(), static_cast<std::size_t>(values.size())));
    const py::gil_scoped_release others_run;
    return scene.in_turn([&] { return scene.add_mesh(mesh); });
}

/// An array over values that `owner` keeps; it cannot be written.
py::array view_of(const void* values, const char* type, std::vector<py::ssize_t> shape, const py::object& owner) {
    const py::dtype dtype(type);
    // A null pointer would have NumPy make memory of its own.
    static const double nothing = 0;
    py::array array(dtype, std::move(shape), values == nullptr ? &nothing : values, owner);
    array.attr("setflags")(py::arg("write") = false);
    return array;
}

const char* numpy_type(std::int32_t type) {
    switch (type) {
        case BURIN_HALF:
            return "float16";
        case BURIN_FLOAT:
            return "float32";
        case BURIN_UINT32:
            return "uint32";
        case BURIN_DOUBLE:
            return "float64";
        case BURIN_UINT64:
            return "uint64";
        case BURIN_UINT16:
            return "uint16";
        default:
            return "uint8";
    }
}

py::array channel(const py::object& self, const std::string& name) {
    const auto& picture = self.cast<const burin::Picture&>();
    std::int32_t type = 0, size[2] = {};
    const void* const values = burin::checked(burin_channel(picture.get(), name.c_str(), &type, size));
    return view_of(values, numpy_type(type), {size[1], size[0]}, self);
}

py::array column(const py::object& self, const std::string& name) {
    const auto& drawing = self.cast<const burin::Drawing&>();
    std::int32_t type = 0;
    std::uint64_t count = 0;
    const void* const values = burin::checked(burin_column(drawing.get(), name.c_str(), &type, &count));
    return view_of(values, numpy_type(type), {static_cast<py::ssize_t>(count)}, self);
}

py::bytes encoded(const void* what, const std::string& format, const std::optional<std::string>& style) {
    std::vector<std::byte> bytes;
    {
        const py::gil_scoped_release others_run;
        bytes = burin::encoded(what, format, style ? style->c_str() : nullptr);
    }
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void write(const void* what, const std::string& path, const std::optional<std::string>& style) {
    const py::gil_scoped_release others_run;
    burin::checked(burin_write(what, nullptr, style ? style->c_str() : nullptr, path.c_str()));
}

/// What the library throws, as exceptions of Python.
void translate_errors(py::module_& module) {
    static py::exception<burin::Error> input_error(module, "InputError", PyExc_ValueError);
    static py::exception<burin::Error> usage_error(module, "UsageError", PyExc_ValueError);
    static py::exception<burin::Error> cancelled(module, "Cancelled", PyExc_RuntimeError);
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const burin::Error& error) {
            switch (error.kind()) {
                case BURIN_BAD_INPUT:
                    input_error(error.what());
                    return;
                case BURIN_BAD_ARGUMENT:
                    usage_error(error.what());
                    return;
                case BURIN_STOPPED:
                    cancelled(error.what());
                    return;
                default:
                    PyErr_SetString(PyExc_RuntimeError, error.what());
            }
        }
    });
}

}  // namespace

PYBIND11_MODULE(_core, module) {
    module.doc() = "What the package burin is made of; see burin.";
    module.def("version", [] { return std::string(burin_version()); });
    module.def("abi", &burin_abi);
    module.def("file_notes", &burin::file_notes);
    translate_errors(module);
    py::module_::import("atexit").attr("register")(py::cpp_function(&end));
    using Unlocked = py::call_guard<py::gil_scoped_release>;

    py::class_<Work>(module, "Work")
        .def(py::init<std::array<int, 2>, std::array<std::int32_t, 4>, int, const std::string&, const burin::Matrix&,
                      double, double, const std::array<double, 2>&, double, int, int, std::uint64_t, const std::string&,
                      bool, bool, py::object>(),
             py::arg("size"), py::arg("crop"), py::arg("samples"), py::arg("camera"), py::arg("camera_to_world"),
             py::arg("fov_deg"), py::arg("ortho_height"), py::arg("shift"), py::arg("pixel_aspect"), py::arg("frame"),
             py::arg("threads"), py::arg("memory_bytes"), py::arg("layers"), py::arg("for_paths"), py::arg("find_all"),
             py::arg("progress"));

    py::class_<burin::Picture>(module, "Picture")
        .def("channel_names", &burin::Picture::channel_names)
        .def("channel", &channel, py::arg("name"))
        .def("notes", &burin::Picture::notes)
        .def(
            "pixels",
            [](const burin::Picture& self, int channels) {
                std::int32_t size[2] = {};
                burin::checked(burin_picture_size(self.get(), size));
                py::array_t<std::uint8_t> pixels(channels == 1 ? std::vector<py::ssize_t>{size[1], size[0]}
                                                               : std::vector<py::ssize_t>{size[1], size[0], channels});
                std::uint8_t* const out = pixels.mutable_data();
                const py::gil_scoped_release others_run;
                self.pixels(out, channels);
                return pixels;
            },
            py::arg("channels"))
        .def(
            "encode",
            [](const burin::Picture& self, const std::string& format) {
                return encoded(self.get(), format, std::nullopt);
            },
            py::arg("format"))
        .def(
            "write", [](const burin::Picture& self, const std::string& path) { write(self.get(), path, std::nullopt); },
            py::arg("path"));

    py::class_<burin::Drawing>(module, "Drawing")
        .def("piece_count", &burin::Drawing::piece_count)
        .def("column", &column, py::arg("name"))
        .def(
            "draw",
            [](const burin::Drawing& self, const std::optional<std::string>& style, int threads) {
                return style ? self.draw(*style, threads) : self.draw(threads);
            },
            Unlocked(), py::arg("style"), py::arg("threads"))
        .def(
            "encode",
            [](const burin::Drawing& self, const std::string& format, const std::optional<std::string>& style) {
                return encoded(self.get(), format, style);
            },
            py::arg("format"), py::arg("style"))
        .def(
            "write",
            [](const burin::Drawing& self, const std::string& path, const std::optional<std::string>& style) {
                write(self.get(), path, style);
            },
            py::arg("path"), py::arg("style"));

    py::class_<PythonScene>(module, "Scene")
        .def(py::init<>())
        .def("add_file", in_turn(&burin::Scene::add_file), Unlocked(), py::arg("path"))
        .def("add_text", in_turn(&burin::Scene::add_text), Unlocked(), py::arg("toml"), py::arg("base_folder"))
        .def("notes", in_turn(&burin::Scene::notes))
        .def(
            "add_material",
            [](PythonScene& self, const std::string& name, const std::array<float, 3>& color, float opacity) {
                return self.in_turn([&] { return self.add(burin::Material{name, color, opacity}); });
            },
            py::arg("name"), py::arg("color"), py::arg("opacity"))
        .def("add_mesh", &add_mesh, py::arg("name"), py::arg("points"), py::arg("corners"), py::arg("polygon_sizes"),
             py::arg("polygon_materials"), py::arg("polygon_objects"), py::arg("object_names"), py::arg("marked_edges"),
             py::arg("corner_uv"), py::arg("point_colors"), py::arg("attributes"))
        .def("remove_mesh", in_turn(&burin::Scene::remove_mesh), py::arg("mesh"))
        .def("add_object", in_turn(&burin::Scene::add_object), py::arg("mesh"), py::arg("name"), py::arg("to_world"),
             py::arg("material"))
        .def("move", in_turn(&burin::Scene::move), py::arg("object"), py::arg("to_world"))
        .def("remove", in_turn(&burin::Scene::remove), py::arg("object"))
        .def("clear", in_turn(&burin::Scene::clear))
        .def("object_of_id", in_turn(&burin::Scene::object_of_id), py::arg("id"))
        .def("object_name", in_turn(&burin::Scene::object_name), py::arg("object"))
        .def("set", in_turn(&burin::Scene::set), py::arg("key_and_value"))
        .def("set_toml", in_turn(&burin::Scene::set_toml), py::arg("toml"))
        .def("set_style", in_turn(&burin::Scene::set_style), py::arg("text_or_name"))
        .def(
            "add_line_shader",
            [](PythonScene& self, const std::string& name, std::vector<std::string> variables, py::function function) {
                auto called =
                    std::make_shared<PythonLineShader>(std::move(variables), std::move(function), self.thrown());
                self.in_turn([&] { self.add_line_shader(name, std::move(called)); });
            },
            py::arg("name"), py::arg("variables"), py::arg("function"))
        .def(
            "add_line_test",
            [](PythonScene& self, const std::string& name, std::vector<std::string> variables, py::function function) {
                auto called =
                    std::make_shared<PythonLineTest>(std::move(variables), std::move(function), self.thrown());
                self.in_turn([&] { self.add_line_test(name, std::move(called)); });
            },
            py::arg("name"), py::arg("variables"), py::arg("function"))
        .def(
            "render",
            [](PythonScene& self, const Work& work) {
                return self.in_turn([&] { return self.render(work.view, work.options); });
            },
            Unlocked(), py::arg("work"))
        .def(
            "find_lines",
            [](PythonScene& self, const Work& work) {
                return self.in_turn([&] { return self.find_lines(work.view, work.options); });
            },
            Unlocked(), py::arg("work"))
        .def(
            "explain",
            [](PythonScene& self, int x, int y, const std::string& format, const Work& work) {
                return self.in_turn([&] { return self.explain(x, y, work.view, format, work.options); });
            },
            Unlocked(), py::arg("x"), py::arg("y"), py::arg("format"), py::arg("work"))
        .def("box",
             [](PythonScene& self) {
                 std::array<double, 3> low{}, high{};
                 self.in_turn([&] { return burin::checked(burin_scene_box(self.get(), low.data(), high.data())); });
                 return std::pair(low, high);
             })
        .def(
            "cancel", [](PythonScene& self) { self.cancel(); }, Unlocked());
}
