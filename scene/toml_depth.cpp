#include "scene/toml_depth.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "base/interrupt.h"

namespace burin {
namespace {

class DepthScanner {
  public:
    DepthScanner(std::string_view text, std::size_t most_depth, std::size_t most_values)
        : text_(text), most_depth_(most_depth), most_values_(most_values) {}

    /// The first line on which there is too much.
    std::optional<std::size_t> run() {
        bool is_line_start = true;  // but for blanks
        for (std::size_t i = 0; i < text_.size();) {
            if ((++steps_ & 0xFFFF) == 0) throw_if_interrupted();
            const char c = text_[i];
            if (c == '"' || c == '\'') {
                i = end_of_string(i);
            } else if (c == '#') {
                i = std::min(text_.find('\n', i), text_.size());
                continue;
            } else {
                ++i;
                if (c == '\n') {
                    ++line_;
                    if (!open_.empty()) continue;  // a list goes on
                    if (is_header_) header_ = kLevelsPerPart * (dots_ + 1);
                    is_header_ = false;
                    dots_ = 0;
                    is_line_start = true;
                    continue;
                }
                if (c == '[' && is_line_start) is_header_ = true;
                if (!is_header_) bracket(c);
                if (c == '.') ++dots_;
                count(c);
            }
            if (c != ' ' && c != '\t') is_line_start = false;
            if (depth() > most_depth_ || values_ > most_values_) return line_;
        }
        return std::nullopt;
    }

  private:
    /// A part of a header may be a list of tables, and so is each part before it that is one.
    static constexpr std::size_t kLevelsPerPart = 2;

    std::size_t depth() const { return is_header_ ? kLevelsPerPart * (dots_ + 1) : header_ + around_ + dots_ + 1; }

    void bracket(char c) {
        if (c == '[' || c == '{') {
            open_.push_back(dots_);
            around_ += dots_ + 1;
            dots_ = 0;
        } else if ((c == ']' || c == '}') && !open_.empty()) {
            dots_ = open_.back();
            open_.pop_back();
            around_ -= dots_ + 1;
        } else if (c == ',') {
            dots_ = 0;  // the next key, or the next value
        }
    }

    void count(char c) {
        if (c == '=' || c == '[' || c == '{') values_ += kValuesPerTable;
        if (c == ',') ++values_;
    }

    /// The place behind the string that begins at `i`.
    std::size_t end_of_string(std::size_t i) {
        const char quote = text_[i];
        const std::string_view three = quote == '"' ? "\"\"\"" : "'''";
        const bool has_lines = text_.substr(i, 3) == three;
        for (i += has_lines ? 3 : 1; i < text_.size(); ++i) {
            const char c = text_[i];
            if (c == '\n') {
                if (!has_lines) return i;  // an error: where the text ends for toml++
                ++line_;
            } else if (c == '\\' && quote == '"') {
                if (i + 1 < text_.size() && text_[i + 1] != '\n') ++i;
            } else if (c == quote && !has_lines) {
                return i + 1;
            } else if (c == quote && text_.substr(i, 3) == three) {
                i += 3;
                // Up to two quotes may stand before the three that end it.
                for (int more = 0; more < 2 && i < text_.size() && text_[i] == quote; ++more) ++i;
                return i;
            }
        }
        return i;
    }

    std::string_view text_;
    const std::size_t most_depth_, most_values_;
    std::size_t values_ = 0;
    std::size_t steps_ = 0;
    std::size_t line_ = 1;
    bool is_header_ = false;
    std::size_t header_ = 0;         // depth of the table that keys belong to
    std::vector<std::size_t> open_;  // dots before each bracket that is open
    std::size_t around_ = 0;         // depth within these
    std::size_t dots_ = 0;           // of the key, or value, that is read
};

}  // namespace

std::optional<std::size_t> line_nested_too_deep(std::string_view text) {
    return DepthScanner(text, kMaxTomlDepth, std::numeric_limits<std::size_t>::max()).run();
}

std::optional<std::size_t> line_with_too_many_values(std::string_view text, std::size_t most) {
    return DepthScanner(text, std::numeric_limits<std::size_t>::max(), most).run();
}

}  // namespace burin
