#include "abuffer/samples/contests.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <tuple>

namespace burin {

namespace {

/// Orders contests: near ones first, of equally near ones the one with the smaller number. Ids have a bit more, which
/// does not count.
bool is_nearer(const Contest& a, const Contest& b) {
    return a.nearness != b.nearness ? a.nearness > b.nearness : a.loser >> 1 < b.loser >> 1;
}

/// Leaves the contests of one sample that take part, in no order. Returns where they end.
template <typename Iterator>
Iterator select_nearest(Iterator begin, Iterator end) {
    constexpr auto kMost = static_cast<std::ptrdiff_t>(Contests::kMostAtSample);
    if (end - begin <= kMost) return end;
    std::nth_element(begin, begin + (kMost - 1), end, is_nearer);
    return begin + kMost;
}

}  // namespace

void Contests::begin_selecting(std::size_t sample_count) {
    count_ = 0;
    is_selecting_ = true;
    noted_.resize(std::max({noted_.size(), most_, 2 * kMostAtSample * sample_count}));
    last_nearness_.assign(sample_count, -std::numeric_limits<float>::infinity());
    last_ids_.assign(sample_count, ~0u);
}

/// Forgets contests that take no part.
void Contests::keep_nearest() {
    first_of_sample_.assign(last_ids_.size() + 1, 0);
    for (std::uint32_t i = 0; i < count_; ++i) ++first_of_sample_[noted_[i].sample + 1];
    std::partial_sum(first_of_sample_.begin(), first_of_sample_.end(), first_of_sample_.begin());
    by_sample_.resize(noted_.size());
    for (std::uint32_t i = 0; i < count_; ++i)
        by_sample_[first_of_sample_[noted_[i].sample]++] = noted_[i];  // up to where they end
    auto kept = noted_.begin();
    for (auto begin = by_sample_.begin(); begin != by_sample_.begin() + count_;) {
        const auto end = by_sample_.begin() + first_of_sample_[begin->sample],
                   end_of_nearest = select_nearest(begin, end);
        if (end_of_nearest - begin == static_cast<std::ptrdiff_t>(kMostAtSample)) {
            const Contest& last = *std::max_element(begin, end_of_nearest, is_nearer);
            last_nearness_[last.sample] = last.nearness;
            last_ids_[last.sample] = last.loser | 1;
        }
        kept = std::copy(begin, end_of_nearest, kept);
        begin = end;
    }
    count_ = static_cast<std::uint32_t>(kept - noted_.begin());
}

void Contests::settle(SampleTile& samples) {
    if (is_selecting_) keep_nearest();
    // Mostly nothing is to be done: contests of samples where nothing takes the winner's place are left out.
    if (is_open_.size() < samples.ids.size()) is_open_.assign(samples.ids.size(), 0);
    bool has_open = false;
    for (std::uint32_t i = 0; i < count_; ++i) {
        const std::uint32_t winner = samples.ids[noted_[i].sample] >> 1, loser = noted_[i].loser >> 1;
        if (loser == winner || !relation(loser, winner).any()) continue;
        is_open_[noted_[i].sample] = 1;
        has_open = true;
    }
    if (!has_open) return;
    const auto end_of_open = std::remove_if(noted_.begin(), noted_.begin() + count_,
                                            [&](const Contest& c) { return is_open_[c.sample] == 0; });
    // After keep_nearest() the contests of a sample follow each other.
    const auto is_before = [](const Contest& a, const Contest& b) {
        return std::tie(a.sample, a.loser) < std::tie(b.sample, b.loser);
    };
    if (!is_selecting_) std::sort(noted_.begin(), end_of_open, is_before);
    for (auto begin = noted_.begin(), end = begin; begin != end_of_open; begin = end) {
        const std::uint32_t sample = begin->sample;
        std::uint32_t winner = samples.ids[sample] >> 1;
        while (end != end_of_open && end->sample == sample) ++end;
        const auto end_of_nearest = select_nearest(begin, end);
        if (end_of_nearest != end || is_selecting_)
            std::sort(begin, end_of_nearest, [](const Contest& a, const Contest& b) { return a.loser < b.loser; });
        const auto for_losers = [&](const auto& wins) {  // in the order of their numbers
            for (auto contest = begin; contest != end_of_nearest; ++contest) {
                const std::uint32_t loser = contest->loser >> 1;
                if (loser == winner || !wins(loser)) continue;
                winner = loser;
                samples.ids[sample] = loser << 1;
            }
        };
        const auto put_folds_in_front = [&] {
            for_losers([&](std::uint32_t loser) { return relation(loser, winner).folds_over; });
        };
        for_losers([&](std::uint32_t loser) { return relation(loser, winner).is_in_front; });
        put_folds_in_front();
        bool settled = false;
        for_losers([&](std::uint32_t loser) {
            if (settled) return false;
            settled = relation(loser, winner).comes_first;
            return settled;
        });
        if (settled) put_folds_in_front();
        is_open_[sample] = 0;
    }
}

/// The same two are mostly asked about for one sample after the other.
const Contests::Relation& Contests::relation(std::uint32_t loser, std::uint32_t winner) {
    constexpr std::size_t kAtFirst = 512, kMost = std::size_t{1} << 16;
    // In a heap of nearly equal surfaces each is asked about each, for every sample: room for all saves most of the
    // time.
    if (relations_.empty() || (forgotten_ > relations_.size() && relations_.size() < kMost)) {
        relations_.assign(std::clamp(4 * relations_.size(), kAtFirst, kMost), {});
        forgotten_ = 0;
    }
    const std::uint64_t mixed = (std::uint64_t{loser} << 32 | winner) * 0x9E3779B97F4A7C15u;
    Relation& r = relations_[(mixed >> 32) % relations_.size()];
    if (r.loser == loser && r.winner == winner) return r;
    if (r.loser != r.winner) ++forgotten_;
    SurfaceOrder o;
    if (loser < winner || may_be_in_front(loser, winner)) o = order(loser, winner);
    r = {loser, winner, o.is_in_front(), is_fold_over(loser, winner), loser < winner && o.are_coincident()};
    return r;
}

/// Whether a part of `back` is behind the plane of `front`: else the order of the two, which takes longer, need not be
/// asked for. What is in front by less than snapping does may be so for certain.
bool Contests::may_be_in_front(std::uint32_t front, std::uint32_t back) const {
    if (screen_.facing(front) == off_screen || screen_.facing(back) == off_screen) return true;
    if (screen_.facing(front) == edge_on) return false;
    const ScreenTriangle plane = screen_.triangle(screen_.surface_of(front)),
                         other = screen_.triangle(screen_.surface_of(back));
    return std::any_of(std::begin(other.corners), std::end(other.corners), [&](const ScreenVertex& corner) {
        return extended_nearness(plane, corner.x, corner.y) - static_cast<double>(corner.nearness) > 0;
    });
}

/// Whether two neighbours lie on one side of their common edge, and `front` in front of the other one.
bool Contests::is_fold_over(std::uint32_t front, std::uint32_t back) const {
    const SurfaceId a = screen_.surface_of(front), b = screen_.surface_of(back);
    if (a.instance != b.instance || a.triangle == b.triangle) return false;
    const auto& s = screen_.surfaces().mesh_of(a).triangles[a.triangle];
    const auto& t = screen_.surfaces().mesh_of(a).triangles[b.triangle];
    const ScreenVertex* const vertices = screen_.vertices(a.instance);
    ScreenTriangle own;
    std::array<ScreenVertex, 2> edge;
    std::size_t common = 0;
    std::uint32_t apex = 0, other_apex = t[0] ^ t[1] ^ t[2];
    for (std::size_t k = 0; k < 3; ++k) {
        own.corners[k] = vertices[s[k]];
        if (own.corners[k].x == ScreenVertex::kOffScreen) return false;
        if (std::find(t.begin(), t.end(), s[k]) == t.end()) {
            apex = s[k];
        } else {
            if (common < 2) edge[common] = own.corners[k];
            ++common;
            other_apex ^= s[k];
        }
    }
    if (common != 2 || vertices[other_apex].x == ScreenVertex::kOffScreen) return false;
    const ScreenVertex& beyond = vertices[other_apex];
    const std::int64_t side = doubled_area(edge[0], edge[1], vertices[apex]),
                       other_side = doubled_area(edge[0], edge[1], beyond);
    if ((side < 0) != (other_side < 0) || side == 0 || other_side == 0) return false;
    return extended_nearness(own, beyond.x, beyond.y) > static_cast<double>(beyond.nearness);
}

SurfaceOrder Contests::order(std::uint32_t loser, std::uint32_t winner) {
    const SurfaceId a = screen_.surface_of(loser), b = screen_.surface_of(winner);
    if (a.instance == b.instance) {
        // Neighbours that fold over are level along their edge, and no more.
        const auto& s = screen_.surfaces().mesh_of(a).triangles[a.triangle];
        const auto& t = screen_.surfaces().mesh_of(a).triangles[b.triangle];
        for (const std::uint32_t v : s) {
            if (std::find(t.begin(), t.end(), v) != t.end()) return {};
        }
    }
    return screen_.surfaces().order(a, b, &orders_);
}

}  // namespace burin
