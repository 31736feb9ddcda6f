#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

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
/// Returns how many rows were read. `copy` copies what stands from a place in the rest of `values` on.
template <typename ReadPiece>
std::uint64_t read_in_pieces(AsciiValues& values, const LineCutter::Copy& copy, std::size_t piece_size,
                             std::uint64_t rows, int threads, LargestIndex& largest,
                             const ReadPiece& read) {
    const std::string_view text = values.rest();
    struct Piece {
        std::uint64_t first_row, row_count;
        std::size_t end_place = 0, end_line = 0;  // behind what was read
        bool is_whole = false;
        std::uint64_t read = 0;
        LargestIndex largest{};
    };
    std::deque<Piece> pieces;
    std::mutex taking;
    LineCutter cutter(text.size(), values.line(), piece_size, copy);
    std::uint64_t next_row = 0;
    const auto take = [&](std::vector<char>& buffer, TextPiece& taken) -> Piece* {
        const std::lock_guard lock(taking);
        if (next_row >= rows) return nullptr;
        const std::optional<TextPiece> next = cutter.take(buffer);
        if (!next) return nullptr;
        taken = *next;
        const std::uint64_t most = rows - next_row;
        pieces.push_back({next_row, cutter.at_end() ? most : std::min<std::uint64_t>(taken.feeds, most)});
        next_row += pieces.back().row_count;
        return &pieces.back();
    };
    const int workers = resolve_thread_count(threads);
    parallel_for(static_cast<std::size_t>(workers), workers, [&](std::size_t, int) {
        std::vector<char> buffer;
        TextPiece taken;
        while (Piece* const p = take(buffer, taken)) {
            throw_if_interrupted();
            AsciiValues own(taken.text, taken.line, TextPiece::kMargin);
            p->read = read(own, p->first_row, p->row_count, p->largest);
            p->is_whole = p->read == p->row_count && own.at_end();
            p->end_place = taken.place + taken.text.size() - own.rest().size();
            p->end_line = own.line();
        }
    });
    std::uint64_t count = 0;
    for (const Piece& p : pieces) {
        count += p.read;
        if (p.largest.index > largest.index) largest = p.largest;
        values = AsciiValues(text.substr(p.end_place), p.end_line);
        if (!p.is_whole) break;
    }
    return count;
}

}  // namespace burin
