#pragma once

#include <burin/burin.hpp>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <exception>
#include <memory>
#include <mutex>
#include <optional>

// Functions of Python as line shaders and line tests. The library calls them on threads of its own.

namespace burin::python {

namespace py = pybind11;

using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;

/// The values of variables at places on lines: an array each, of three columns for a triple such as N.
inline py::dict columns_of(const burin::LineSamples& in, const std::vector<std::string>& names) {
    const auto find = [&](const std::string& name) -> std::optional<std::span<const float>> {
        try {
            return in.column(name);
        } catch (const burin::Error&) {
            return std::nullopt;
        }
    };
    py::dict columns;
    for (const std::string& name : names) {
        const auto count = static_cast<py::ssize_t>(in.count());
        if (const auto values = find(name)) {
            columns[py::str(name)] = Floats(count, values->data());
            continue;
        }
        const char* const parts = find(name + ".x") ? "xyz" : "rgb";
        Floats triple({count, py::ssize_t{3}});
        for (py::ssize_t c = 0; c < 3; ++c) {
            const std::span<const float> values = in.column(name + '.' + parts[c]);
            for (py::ssize_t i = 0; i < count; ++i) triple.mutable_at(i, c) = values[static_cast<std::size_t>(i)];
        }
        columns[py::str(name)] = triple;
    }
    return columns;
}

/// What a function of Python returned: an array, or one number for all places.
inline void copy_returned(const py::handle& from, std::span<float> to) {
    const auto values = py::cast<Floats>(from);
    if (values.size() != 1 && values.size() != static_cast<py::ssize_t>(to.size()))
        throw std::runtime_error("returned " + std::to_string(values.size()) + " values for " +
                                 std::to_string(to.size()) + " places");
    for (std::size_t i = 0; i < to.size(); ++i) to[i] = values.data()[values.size() == 1 ? 0 : i];
}

/// What functions of Python threw that the library called: it comes out of the call that drew.
class Thrown {
  public:
    void keep() {
        const std::lock_guard lock(mutex_);
        if (!first_) first_ = std::current_exception();
    }
    /// Runs what draws.
    template <typename Work>
    auto rethrowing(const Work& work) {
        take();
        try {
            return work();
        } catch (const burin::Error&) {
            if (const std::exception_ptr thrown = take()) std::rethrow_exception(thrown);
            throw;
        }
    }

  private:
    std::exception_ptr take() {
        const std::lock_guard lock(mutex_);
        return std::exchange(first_, nullptr);
    }
    std::mutex mutex_;
    std::exception_ptr first_;
};

/// A function of Python that line shaders and line tests call.
class PythonFunction {
  public:
    PythonFunction(std::vector<std::string> variables, py::function function, std::shared_ptr<Thrown> thrown)
        : variables_(std::move(variables)), function_(std::move(function)), thrown_(std::move(thrown)) {}
    PythonFunction(const PythonFunction&) = delete;
    PythonFunction& operator=(const PythonFunction&) = delete;
    ~PythonFunction() {
        const py::gil_scoped_acquire python;
        function_ = py::function();
    }
    std::string needs() const {
        std::string text;
        for (const std::string& name : variables_) text += (text.empty() ? "" : ", ") + name;
        return text;
    }
    /// Calls it, and `use` with what it returns.
    template <typename Use, typename... More>
    void call(const burin::LineSamples& in, const Use& use, const More&... more) const {
        try {
            use(function_(columns_of(in, variables_), more...));
        } catch (const py::error_already_set&) {
            thrown_->keep();
            throw burin::Error(BURIN_BAD_ARGUMENT, "a function of Python has thrown");
        }
    }

  private:
    std::vector<std::string> variables_;
    py::function function_;
    std::shared_ptr<Thrown> thrown_;
};

class PythonLineShader final : public burin::LineShader {
  public:
    PythonLineShader(std::vector<std::string> variables, py::function function, std::shared_ptr<Thrown> thrown)
        : function_(std::move(variables), std::move(function), std::move(thrown)) {}
    std::string needs() const override { return function_.needs(); }
    void shade(const burin::LineSamples& in, burin::LineInk& out) const override {
        const py::gil_scoped_acquire python;
        const std::pair<const char*, std::span<float>> inks[] = {{"width", out.width_px},  {"offset", out.offset_px},
                                                                 {"opacity", out.opacity}, {"red", out.red},
                                                                 {"green", out.green},     {"blue", out.blue}};
        py::dict ink;
        for (const auto& [name, values] : inks)
            ink[name] = Floats(static_cast<py::ssize_t>(values.size()), values.data());
        const auto take = [&](const py::object& result) {
            const py::dict changed = result.is_none() ? ink : py::cast<py::dict>(result);
            std::size_t known = 0;
            for (const auto& value : inks) {
                if (!changed.contains(value.first)) continue;
                copy_returned(changed[value.first], value.second);
                ++known;
            }
            if (known != changed.size())
                throw std::runtime_error("returned more than width, offset, opacity, red, green and blue");
        };
        function_.call(in, take, ink);
    }

  private:
    PythonFunction function_;
};

class PythonLineTest final : public burin::LineTest {
  public:
    PythonLineTest(std::vector<std::string> variables, py::function function, std::shared_ptr<Thrown> thrown)
        : function_(std::move(variables), std::move(function), std::move(thrown)) {}
    std::string needs() const override { return function_.needs(); }
    void test(const burin::LineSamples& in, std::span<float> strength) const override {
        const py::gil_scoped_acquire python;
        function_.call(in, [&](const py::object& result) { copy_returned(result, strength); });
    }

  private:
    PythonFunction function_;
};

}  // namespace burin::python
