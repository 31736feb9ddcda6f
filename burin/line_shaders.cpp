#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "burin/failure.h"
#include "burin/mesh_input.h"
#include "burin/scene_state.h"
#include "mesh/text_scan.h"
#include "shading/expression/error.h"
#include "shading/expression/unknown_word.h"
#include "shading/line_shader.h"

// Line shaders and line tests that a program gives as functions.

namespace burin {
namespace {

constexpr std::size_t kMostColumns = 256;

/// A column of numbers that a program wants.
struct WantedColumn {
    Variable variable;
    std::size_t component = 0;
    std::string name;  ///< "depth", "N.x"
};

std::string_view components_of(ValueType type) { return type == ValueType::color ? "rgb" : "xyz"; }

std::string_view without_spaces(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\n')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\n')) text.remove_suffix(1);
    return text;
}

[[noreturn]] void fail_of_name(std::string_view name) {
    const auto later = names_of_later_versions();
    if (std::find(later.begin(), later.end(), name) != later.end())
        throw UsageError("variables: " + in_quotes(name) + " is not in this version");
    std::vector<std::string> known;
    for (const VariableRow& row : variable_table()) known.emplace_back(row.name);
    throw UsageError("variables: unknown variable " + in_quotes(name) + suggestion_of(name, known));
}

/// Adds the columns of "depth", "N" (all three) or "N.x".
void add_columns(std::string_view word, std::vector<WantedColumn>& columns) {
    const std::size_t dot = word.find('.');
    const std::string_view name = word.substr(0, dot);
    const auto variable = variable_named(name);
    if (!variable) fail_of_name(name);
    const ValueType type = row_of(*variable).type;
    if (dot == std::string_view::npos && type == ValueType::number) {
        columns.push_back({*variable, 0, std::string(name)});
        return;
    }
    const std::string_view components = components_of(type);
    if (dot != std::string_view::npos) {
        const std::string_view part = word.substr(dot + 1);
        const std::size_t component = part.size() == 1 ? components.find(part) : std::string_view::npos;
        if (type == ValueType::number || component == std::string_view::npos) {
            throw UsageError(
                "variables: there is no " + in_quotes(word) + "; " + std::string(name) +
                (type == ValueType::number ? " is a number" : " has the parts " + std::string(components)));
        }
        columns.push_back({*variable, component, std::string(word)});
        return;
    }
    for (std::size_t k = 0; k < 3; ++k) columns.push_back({*variable, k, std::string(name) + "." + components[k]});
}

std::vector<WantedColumn> read_variables(std::string_view text) {
    std::vector<WantedColumn> columns;
    if (without_spaces(text).empty()) return columns;
    for (;;) {
        const std::size_t comma = text.find(',');
        const std::string_view word = without_spaces(text.substr(0, comma));
        if (word.empty()) throw UsageError("variables: a name is missing beside a comma");
        add_columns(word, columns);
        if (columns.size() > kMostColumns)
            throw UsageError("variables: are more than " + std::to_string(kMostColumns) + " columns");
        if (comma == std::string_view::npos) return columns;
        text.remove_prefix(comma + 1);
    }
}

/// What a function of the program reads, and how it is called.
class Called {
  public:
    /// `kind`: "line shader".
    Called(const char* kind, std::string name, std::vector<WantedColumn> columns)
        : kind_(kind), name_(std::move(name)), columns_(std::move(columns)) {
        for (const WantedColumn& column : columns_) {
            needs_.add(column.variable, column.component);
            names_.push_back(column.name.c_str());
        }
    }
    Called(const Called&) = delete;
    Called& operator=(const Called&) = delete;

    const VariableSet& needs() const { return needs_; }

    /// Calls function(samples), which returns 0 if all is well.
    template <typename Function>
    void call(const StrokeSamples& in, const Function& function) const {
        std::vector<const float*> columns;
        columns.reserve(columns_.size());
        for (const WantedColumn& column : columns_)
            columns.push_back(in.column(column.variable, column.component).data());
        std::array<char, 256> message{};
        const std::string style(in.style());
        burin_line_samples samples = {};
        samples.size = sizeof samples;
        samples.count = static_cast<std::uint32_t>(in.count());
        samples.columns = columns.data();
        samples.names = names_.data();
        samples.column_count = static_cast<std::uint32_t>(columns.size());
        samples.message_size = message.size();
        samples.style = style.c_str();
        samples.message = message.data();
        const int result = function(samples);
        if (result == 0) return;
        message.back() = 0;
        const std::string said = printable(message.data(), message.size());
        throw UsageError("style " + style + ": the " + kind_ + " '" + name_ + "' " +
                         (said.empty() ? "returned " + std::to_string(result) : "failed: " + said));
    }

  private:
    const char* kind_;
    std::string name_;
    std::vector<WantedColumn> columns_;
    std::vector<const char*> names_;
    VariableSet needs_;
};

class CalledShader final : public LineShader {
  public:
    CalledShader(std::string name, std::vector<WantedColumn> columns, burin_line_shader function, void* user)
        : called_("line shader", std::move(name), std::move(columns)), function_(function), user_(user) {}
    VariableSet needs() const override { return called_.needs(); }
    void shade(const StrokeSamples& in, StrokeInk& out) const override {
        called_.call(in, [&](const burin_line_samples& samples) {
            burin_line_ink ink = {};
            ink.size = sizeof ink;
            ink.width_px = out.width_px.data();
            ink.offset_px = out.offset_px.data();
            ink.opacity = out.opacity.data();
            ink.red = out.red.data();
            ink.green = out.green.data();
            ink.blue = out.blue.data();
            return function_(&samples, &ink, user_);
        });
    }

  private:
    Called called_;
    burin_line_shader function_;
    void* user_;
};

class CalledTest final : public LineTest {
  public:
    CalledTest(std::string name, std::vector<WantedColumn> columns, burin_line_test function, void* user)
        : called_("line test", std::move(name), std::move(columns)), function_(function), user_(user) {}
    VariableSet needs() const override { return called_.needs(); }
    void test(const StrokeSamples& in, std::span<float> strength) const override {
        called_.call(in,
                     [&](const burin_line_samples& samples) { return function_(&samples, strength.data(), user_); });
    }

  private:
    Called called_;
    burin_line_test function_;
    void* user_;
};

std::string checked_name(const char* name) {
    const std::string given = &required(name, "name");
    constexpr std::string_view kKnown = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
    if (given.empty() || given.size() > 100 || given.find_first_not_of(kKnown) != std::string::npos)
        throw UsageError("name: has letters, digits, _ and - only, at most 100 of them, not " + in_quotes(given));
    if (given == "none") throw UsageError("name: \"none\" stands for no shader in a style sheet; choose another name");
    return given;
}

/// Puts a function of a program into the scene, or takes it away.
template <typename Made, typename Function, typename Named>
int add(burin_scene* scene, const char* name, const char* variables, Function function, void* user,
        Named LineShaders::*where) {
    return guarded([&] {
        required(scene, "scene");
        const std::string key = checked_name(name);
        LineShaders changed = *scene->line_shaders;
        if (function == nullptr) {
            (changed.*where).erase(key);
        } else {
            std::vector<WantedColumn> columns = read_variables(text_or_empty(variables));
            (changed.*where)[key] = std::make_shared<const Made>(key, std::move(columns), function, user);
        }
        scene->line_shaders = std::make_shared<const LineShaders>(std::move(changed));
        return int{BURIN_DONE};
    });
}

}  // namespace
}  // namespace burin

using namespace burin;

int burin_add_line_shader(burin_scene* scene, const char* name, const char* variables, burin_line_shader callback,
                          void* user) {
    return add<CalledShader>(scene, name, variables, callback, user, &LineShaders::shaders);
}

int burin_add_line_test(burin_scene* scene, const char* name, const char* variables, burin_line_test callback,
                        void* user) {
    return add<CalledTest>(scene, name, variables, callback, user, &LineShaders::tests);
}
