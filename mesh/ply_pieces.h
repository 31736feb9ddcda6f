#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <mutex>
#include <span>
#include <string_view>

#include "base/interrupt.h"
#include "base/parallel.h"
#include "mesh/ply_values.h"
#include "mesh/text_pieces.h"

namespace burin {

/// The largest vertex number so far, and where it stands first.
struct LargestIndex {
    std::int64_t index = -1;
    std::size_t line = 0;
    std::uint64_t item = 0;
};

/// Up to `count` rows of plain triangles into `corners`; how many.
inline std::uint64_t read_triangle_rows(AsciiValues& values, std::uint64_t first_item,
                                        std::uint64_t count, std::uint32_t* corners,
                                        LargestIndex& largest) {
    AsciiValues::PlainTriangles rows;
    for (std::uint64_t done = 0; done < count;) {
        throw_if_interrupted();
        const std::uint64_t wanted = std::min<std::uint64_t>(count - done, rows.kMax);
        const std::size_t got = values.plain_triangles(wanted, rows);
        const std::span read = std::span(rows.corners).first(3 * got);
        std::copy(read.begin(), read.end(), corners + 3 * done);
        std::uint32_t most = 0;
        for (const std::uint32_t v : read) most = std::max(most, v);
        if (got > 0 && most > largest.index) {
            const auto at =
                static_cast<std::size_t>(std::find(read.begin(), read.end(), most) - read.begin()) /
                3;
            largest = {most, rows.lines[at], first_item + done + at};
        }
        done += got;
        if (got < wanted) return done;
    }
    return count;
}

/// Reads rows of positions in any form into `rows`, from here on, until one has something else than numbers or one
/// that is no coordinate; how many.
inline std::size_t read_position_rows(AsciiValues& values, std::span<const int> axis_of, std::span<glm::dvec3> rows) {
    for (std::size_t count = 0;; ++count) {
        count += values.plain_positions(axis_of, rows.subspan(count));
        if (count == rows.size()) return count;
        AsciiValues behind = values;
        glm::dvec3 position;
        if (!behind.position(axis_of, position) || !is_coordinate(position)) return count;
        rows[count] = position;
        values = behind;
    }
}

/// Reads rows, up to `rows` of them, in pieces of the text on all threads, each piece taken
/// to have a row per line: read(values, first row, count, largest) reads a piece's and returns how
/// many it could. Ends with the first piece that has anything else, and leaves `values` there.
/// Returns how many rows were read. `cutter` cuts the text that `values` is in.
template <typename ReadPiece>
std::uint64_t read_in_pieces(AsciiValues& values, LineCutter& cutter,
                             std::uint64_t rows, int threads, LargestIndex& largest,
                             const ReadPiece& read) {
    values.at_end();  // goes to the first row
    const std::string_view text = values.rest();
    const std::size_t first_line = values.line();
    struct Piece {
        AsciiValues values;
        std::uint64_t first_row, row_count;
        const char* begin = nullptr;  // of its first row
        std::uint64_t read = 0;
        LargestIndex largest{};
    };
    std::deque<Piece> pieces;
    std::mutex taking;
    const auto take = [&]() -> Piece* {
        const std::lock_guard lock(taking);
        if (pieces.empty()) {
            pieces.push_back({values, 0, rows});
            while (cutter.next() != nullptr && cutter.next()->line <= first_line) cutter.take();
        } else {
            const TextPiece* const next = cutter.next();
            if (next == nullptr || next->line - first_line >= rows) return nullptr;
            const std::string_view from_here = text.substr(static_cast<std::size_t>(next->begin - text.data()));
            const std::uint64_t row = next->line - first_line;
            pieces.push_back({AsciiValues(from_here, next->line), row, rows - row});
            cutter.take();
        }
        Piece& piece = pieces.back();
        if (cutter.next() != nullptr) piece.row_count = std::min<std::uint64_t>(cutter.next()->line - first_line, rows) - piece.first_row;
        return &piece;
    };
    parallel_for(cutter.most_left() + 1, threads, [&](std::size_t, int) {
        Piece* const taken = take();
        if (taken == nullptr) return;
        Piece& p = *taken;
        p.values.at_end();  // goes to the first row
        p.begin = p.values.rest().data();
        p.read = read(p.values, p.first_row, p.row_count, p.largest);
        p.values.at_end();
    });
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const Piece& p = pieces[i];
        count += p.read;
        if (p.largest.index > largest.index) largest = p.largest;
        values = p.values;
        // The place tells, not the line: a row may have ended in the middle of one.
        const bool leads_on = i + 1 < pieces.size() && p.read == p.row_count && p.values.rest().data() == pieces[i + 1].begin;
        if (!leads_on) break;
    }
    return count;
}

}  // namespace burin
