#include "output/path_data.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace burin {
namespace {

long long hundredths(double value) { return std::llround(std::clamp(value, -1e13, 1e13) * 100); }

/// Writes the commands of one path.
class PathText {
  public:
    void move(glm::dvec2 to) {
        command('M');
        at_ = {hundredths(to.x), hundredths(to.y)};
        add(at_.x);
        add(at_.y);
    }
    /// Returns whether anything was written: nothing is for a step that ends where it began.
    bool line(glm::dvec2 to) {
        const Place p = place(to);
        if (p == at_) return false;
        command('l');
        add_relative(p);
        at_ = p;
        return true;
    }
    void dot() {
        command('l');
        add(0);
        add(0);
    }
    bool cubic(const PathStep& step) {
        const Place a = place(step.a), b = place(step.b), to = place(step.to);
        if (a == at_ && b == at_ && to == at_) return false;
        command('c');
        add_relative(a);
        add_relative(b);
        add_relative(to);
        at_ = to;
        return true;
    }
    bool arc(const PathStep& step) {
        const Place to = place(step.to);
        if (to == at_) return false;
        command('a');
        add(std::max(hundredths(step.a.x), 1LL));
        add(std::max(hundredths(step.a.y), 1LL));
        add(hundredths(step.b.x));
        add(step.is_large ? 100 : 0);
        add(step.is_clockwise ? 100 : 0);
        add_relative(to);
        at_ = to;
        return true;
    }
    void close() { text_ += 'z'; }
    std::string& text() { return text_; }

  private:
    struct Place {
        long long x = 0, y = 0;
        bool operator==(const Place&) const = default;
    };
    static Place place(glm::dvec2 p) { return {hundredths(p.x), hundredths(p.y)}; }
    void command(char c) {
        if (last_ == c && c != 'M') return;
        text_ += c;
        last_ = c;
    }
    void add_relative(Place to) {
        add(to.x - at_.x);
        add(to.y - at_.y);
    }
    void add(long long number) {
        const std::string digits = text_of_hundredths(number);
        const char before = text_.empty() ? ' ' : text_.back();
        if (digits[0] != '-' && (before == '.' || (before >= '0' && before <= '9'))) text_ += ' ';
        text_ += digits;
    }

    std::string text_;
    char last_ = 0;
    Place at_;
};

}  // namespace

std::string text_of_hundredths(long long value) {
    std::string text = value < 0 ? "-" : "";
    const unsigned long long size =
        value < 0 ? 0 - static_cast<unsigned long long>(value) : static_cast<unsigned long long>(value);
    const unsigned long long whole = size / 100, rest = size % 100;
    if (whole > 0 || rest == 0) text += std::to_string(whole);
    if (rest > 0) {
        text += '.';
        text += static_cast<char>('0' + rest / 10);
        if (rest % 10 > 0) text += static_cast<char>('0' + rest % 10);
    }
    return text;
}

std::string short_number(double value, int decimals) {
    char text[400];
    const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, decimals).ptr;
    std::string number(text, end);
    while (number.back() == '0') number.pop_back();
    if (number.back() == '.') number.pop_back();
    return number == "-0" ? "0" : number;
}

DashPattern dash_pattern(const VectorStyle& style, float phase_px) {
    DashPattern pattern;
    if (style.dash_px.empty()) return pattern;
    const double ends = style.caps == StrokeCaps::round ? static_cast<double>(style.width_px) : 0;
    double first = 0;
    for (std::size_t i = 0; i + 1 < style.dash_px.size(); i += 2) {
        const auto on = static_cast<double>(style.dash_px[i]), off = static_cast<double>(style.dash_px[i + 1]);
        const double shorter = std::min(on, ends);
        if (i == 0) first = shorter;
        const double next =
            std::min(static_cast<double>(style.dash_px[i + 2 < style.dash_px.size() ? i + 2 : 0]), ends);
        pattern.lengths.push_back(on - shorter);
        pattern.lengths.push_back(off + 0.5 * (shorter + next));
    }
    pattern.phase = static_cast<double>(phase_px) - 0.5 * first;
    return pattern;
}

std::string path_data(const VectorPath& path, std::span<const PathStep> steps) {
    PathText text;
    text.move(path.start);
    bool has_length = false;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const PathStep& step = steps[i];
        // The line that closes a path goes without saying.
        const bool is_last = i + 1 == steps.size() || steps[i + 1].kind == PathStep::Kind::move;
        if (path.is_closed && is_last && step.kind == PathStep::Kind::line && has_length) continue;
        if (step.kind == PathStep::Kind::move) {
            text.close();
            text.move(step.to);
            continue;
        }
        const bool is_written = step.kind == PathStep::Kind::line    ? text.line(step.to)
                                : step.kind == PathStep::Kind::cubic ? text.cubic(step)
                                                                     : text.arc(step);
        has_length = has_length || is_written;
    }
    if (!has_length) text.dot();
    if (path.is_closed) text.close();
    return std::move(text.text());
}

}  // namespace burin
