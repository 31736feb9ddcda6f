#include "lines/dashes_behind.h"

#include <algorithm>
#include <cmath>

#include "lines/shared_dashes.h"

namespace burin {

DashesBehind::DashesBehind(std::span<const WholeLine> lines, const SurfaceSet& surfaces, PixelRect picture,
                           std::array<double, 2> dash_px, double width_px)
    : lines_(lines), index_(lines), pen_(dash_px, width_px), group_(lines.size()), number_(lines.size()) {
    SharedDashes shared(picture, SharedDashes::reach_of_pen_px(width_px));
    for (const bool are_features : {true, false}) {
        std::vector<WholeLine> chosen;
        for (std::size_t i = 0; i < lines.size(); ++i) {
            if (is_feature(lines[i]) != are_features) continue;
            group_[i] = static_cast<std::uint8_t>(groups_.size());
            number_[i] = static_cast<std::uint32_t>(chosen.size());
            chosen.push_back(lines[i]);
        }
        groups_.emplace_back(chosen, surfaces, pen_.period_px(), shared);
    }
}

void DashesBehind::add(const LinePiece& piece, CourseIndex* visible, std::vector<LinePiece>& dashes) const {
    const std::optional<std::uint32_t> number = index_.find(piece);
    if (!number) return;
    const double begin = WholeLineIndex::share_of(lines_[*number], piece.from);
    const double end = WholeLineIndex::share_of(lines_[*number], piece.to);
    if (visible == nullptr) return add_between(piece, *number, begin, end, dashes);
    for_uncovered(visible->find(piece.from, piece.to), [&](double from, double to) {
        add_between(piece, *number, begin + (end - begin) * from, begin + (end - begin) * to, dashes);
    });
}

void DashesBehind::add_between(const LinePiece& piece, std::uint32_t number, double from, double to,
                               std::vector<LinePiece>& dashes) const {
    const WholeLine& line = lines_[number];
    groups_[group_[number]].for_parts(number_[number], [&](const DashPart& part) {
        const double begin = std::max(from, part.begin), end = std::min(to, part.end);
        if (!(begin < end)) return;
        const double share = part.end - part.begin, length = part.at_end - part.at_begin;
        const auto at = [&](double of_line) { return part.at_begin + length * ((of_line - part.begin) / share); };
        const auto place = [&](double along) {
            return to_pixels(line.at(part.begin + share * ((along - part.at_begin) / length)));
        };
        const double per_px = std::abs(length) / (share * line.length_px());
        pen_.for_dashes(at(begin), at(end), per_px, [&](double first, double last) {
            LinePiece& dash = dashes.emplace_back(piece);
            dash.from = place(first);
            dash.to = place(last);
        });
    });
}

}  // namespace burin
