#include "scene/animation/frame_list.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <unordered_set>

#include "base/error.h"
#include "mesh/text_scan.h"

namespace burin {
namespace {

// Numbers of frames are counted in millionths, so that 1-2x0.1 has exactly the frames that it says.
constexpr std::int64_t kPerFrame = 1000000;
constexpr std::int64_t kMostMillionths = static_cast<std::int64_t>(kLargestFrame) * kPerFrame;

double frame_of(std::int64_t millionths) { return static_cast<double>(millionths) / kPerFrame; }

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Reads one part of a list from its left to its right.
class PartReader {
  public:
    explicit PartReader(std::string_view part) : part_(part), rest_(part) {}

    bool is_at_end() const { return rest_.empty(); }
    bool begins_with(char c) const { return rest_.starts_with(c); }
    bool take(std::string_view word) {
        if (!rest_.starts_with(word)) return false;
        rest_.remove_prefix(word.size());
        return true;
    }
    std::int64_t number() {
        const bool is_negative = take("-");
        if (!is_negative) take("+");
        std::int64_t whole = 0, fraction = 0, unit = kPerFrame;
        std::size_t digits = 0;
        for (; !rest_.empty() && is_digit(rest_[0]); rest_.remove_prefix(1), ++digits) {
            whole = whole * 10 + (rest_[0] - '0');
            if (whole > kMostMillionths / kPerFrame) fail("a frame is at most " + text_of_frame(kLargestFrame));
        }
        if (rest_.size() > 1 && rest_[0] == '.' && is_digit(rest_[1])) {
            for (rest_.remove_prefix(1); !rest_.empty() && is_digit(rest_[0]); rest_.remove_prefix(1), ++digits) {
                unit /= 10;
                if (unit == 0 && rest_[0] != '0') fail("a frame has at most six digits behind the point");
                fraction += unit * (rest_[0] - '0');
            }
        }
        if (digits == 0) fail("is no list of frames, such as 1-100, 1-100x2 or 1,5,9-12");
        const std::int64_t value = whole * kPerFrame + fraction;
        return is_negative ? -value : value;
    }
    [[noreturn]] void fail(const std::string& what) const {
        throw InputError(printable(std::string(part_)) + ": " + what);
    }

  private:
    std::string_view part_, rest_;
};

}  // namespace

std::vector<double> parse_frame_list(std::string_view text) {
    std::vector<double> frames;
    std::unordered_set<std::int64_t> seen;
    const bool is_single = text.find(',') == std::string_view::npos;
    for (std::size_t begin = 0, end = 0; end != std::string_view::npos; begin = end + 1) {
        end = text.find(',', begin);
        std::string_view part = text.substr(begin, end == std::string_view::npos ? end : end - begin);
        while (part.starts_with(' ')) part.remove_prefix(1);
        while (part.ends_with(' ')) part.remove_suffix(1);
        PartReader reader(part.empty() ? text : part);
        if (part.empty()) reader.fail("is no list of frames, such as 1-100, 1-100x2 or 1,5,9-12");
        const std::int64_t first = reader.number();
        std::int64_t last = first, step = kPerFrame;
        if (reader.take("-") || reader.take(":") || reader.take("..")) {
            if (reader.begins_with('.')) reader.fail("two points stand between the frames of a range, not more");
            last = reader.number();
            if (reader.take("x")) {
                step = reader.number();
                if (step == 0) reader.fail("a step must not be 0");
                if (step < 0) reader.fail("a step must be positive; a range whose first number is larger counts down");
            }
        }
        if (!reader.is_at_end()) reader.fail("is no list of frames, such as 1-100, 1-100x2 or 1,5,9-12");
        const std::int64_t count = (first < last ? last - first : first - last) / step + 1;
        if (count > static_cast<std::int64_t>(kMostFrames - frames.size()))
            reader.fail("a list has at most " + std::to_string(kMostFrames) + " frames");
        for (std::int64_t i = 0; i < count; ++i) {
            const std::int64_t frame = first < last ? first + i * step : first - i * step;
            // A single range has each frame once.
            if (is_single || seen.insert(frame).second) frames.push_back(frame_of(frame));
        }
    }
    return frames;
}

std::string text_of_frames(const std::vector<double>& frames) {
    std::string text;
    for (std::size_t i = 0, end = 0; i < frames.size(); i = end) {
        for (end = i + 1; end < frames.size() && frames[end] == frames[end - 1] + 1;) ++end;
        if (end - i == 2) end = i + 1;
        text += (text.empty() ? "" : ",") + text_of_frame(frames[i]);
        if (end - i > 2) text += "-" + text_of_frame(frames[end - 1]);
    }
    return text;
}

std::string text_of_frame(double frame) {
    char text[64];
    const auto [end, error] = std::to_chars(text, text + sizeof text, frame + 0.0, std::chars_format::fixed);
    return error == std::errc() ? std::string(text, end) : std::to_string(frame);
}

double parse_frame_rate(std::string_view text) {
    const auto number = [&](std::string_view part) {
        double value = 0;
        const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
        const bool is_number = error == std::errc() && end == part.data() + part.size();
        if (!is_number || !(value > 0 && value <= 1e9)) {
            throw InputError("must be frames per second, such as 24 or 24000/1001, got '" +
                             printable(std::string(text)) + "'");
        }
        return value;
    };
    const std::size_t slash = text.find('/');
    const double rate =
        slash == std::string_view::npos ? number(text) : number(text.substr(0, slash)) / number(text.substr(slash + 1));
    if (!(rate <= 1e6)) throw InputError("must be at most 1000000 frames per second");
    return rate;
}

}  // namespace burin
