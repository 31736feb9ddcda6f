#include "scene/animation/frame_pattern.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "scene/animation/frame_list.h"

namespace burin {
namespace {

constexpr std::size_t kMostDigits = 32;

/// Where a pattern stands in a name.
struct Place {
    std::size_t begin, end;
    std::size_t digits, digits_behind_point = 0;
};

std::size_t count_of(const std::string& name, std::size_t begin, bool (*is_one)(char)) {
    std::size_t end = begin;
    while (end < name.size() && is_one(name[end])) ++end;
    return end - begin;
}

std::optional<Place> hashes_at(const std::string& name, std::size_t begin, FramePattern::SingleHash single) {
    const auto is_hash = [](char c) { return c == '#'; };
    const std::size_t digits = count_of(name, begin, is_hash);
    if (digits == 0) return std::nullopt;
    Place place{begin, begin + digits, digits};
    if (place.end < name.size() && name[place.end] == '.') {
        place.digits_behind_point = count_of(name, place.end + 1, is_hash);
        if (place.digits_behind_point > 0) place.end += 1 + place.digits_behind_point;
    }
    if (place.end - place.begin == 1) {
        if (single == FramePattern::SingleHash::letter) return std::nullopt;
        place.digits = 4;
    }
    return place;
}

/// "%04d", "$F4".
std::optional<Place> number_at(const std::string& name, std::size_t begin) {
    const bool is_printf = name[begin] == '%', is_houdini = name.compare(begin, 2, "$F") == 0;
    if (!is_printf && !is_houdini) return std::nullopt;
    const std::size_t from = begin + (is_printf ? 1 : 2);
    const std::size_t length = count_of(name, from, [](char c) { return c >= '0' && c <= '9'; });
    if (length == 0 || (is_printf && (from + length >= name.size() || name[from + length] != 'd'))) return std::nullopt;
    std::size_t digits = 0;
    for (std::size_t i = from; i < from + length; ++i)
        digits = std::min(kMostDigits + 1, digits * 10 + static_cast<std::size_t>(name[i] - '0'));
    return Place{begin, from + length + (is_printf ? 1 : 0), std::max<std::size_t>(digits, 1)};
}

}  // namespace

std::optional<FramePattern> FramePattern::find(const std::string& path, SingleHash single) {
    const std::size_t slash = path.rfind('/');
    const std::string folder = slash == std::string::npos ? "" : path.substr(0, slash + 1);
    const std::string name = path.substr(folder.size());
    std::optional<Place> found;
    for (std::size_t i = 0; i < name.size();) {
        std::optional<Place> place = hashes_at(name, i, single);
        if (!place) place = number_at(name, i);
        if (!place) {
            ++i;
            continue;
        }
        if (found) throw InputError("a name has one pattern for the frame's number; remove the others");
        found = place;
        i = place->end;
    }
    if (!found) return std::nullopt;
    if (found->digits > kMostDigits || found->digits_behind_point > kMostDigits)
        throw InputError("a pattern has at most " + std::to_string(kMostDigits) + " digits");
    FramePattern pattern;
    pattern.before_ = folder + name.substr(0, found->begin);
    pattern.behind_ = name.substr(found->end);
    pattern.digits_ = found->digits;
    pattern.digits_behind_point_ = found->digits_behind_point;
    return pattern;
}

std::string FramePattern::path_of(double frame) const {
    const std::string text = text_of_frame(std::abs(frame));
    const std::size_t point = text.find('.');
    std::string whole = text.substr(0, point), fraction = point == std::string::npos ? "" : text.substr(point + 1);
    if (whole.size() < digits_) whole.insert(0, digits_ - whole.size(), '0');
    if (fraction.size() < digits_behind_point_) fraction.append(digits_behind_point_ - fraction.size(), '0');
    return before_ + (frame < 0 ? "-" : "") + whole + (fraction.empty() ? "" : "." + fraction) + behind_;
}

}  // namespace burin
