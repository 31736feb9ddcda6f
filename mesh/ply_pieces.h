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

// Rows of a PLY text are read in pieces, on all threads.

namespace burin {

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

/// Reads rows, up to `rows` of them, in pieces of the text on all threads, each piece taken to have a row per line, and
/// puts their values, `per_row` of each, behind those that `all` has: read(values, place for them) reads a piece's and
/// returns how many rows it could. Ends with the first piece that has anything else, and leaves `values` there.
/// Returns how many rows were read. `copy` copies what stands from a place in the rest of `values` on.
template <typename Value, typename ReadPiece>
std::uint64_t read_in_pieces(AsciiValues& values, const LineCutter::Copy& copy, std::size_t piece_size, int threads,
                             std::uint64_t rows, std::size_t per_row, std::vector<Value>& all, const ReadPiece& read) {
    const std::string_view text = values.rest();
    const std::size_t before = all.size();
    all.reserve(before + per_row * rows);
    struct Piece {
        std::uint64_t row_count = 0, read = 0;
        std::size_t end_place = 0, end_line = 0;  // behind what was read
        bool is_whole = false;
    };
    std::deque<Piece> pieces;
    std::mutex taking;
    LineCutter cutter(text.size(), values.line(), piece_size, copy);
    const int workers = resolve_thread_count(threads);
    parallel_for(static_cast<std::size_t>(workers), workers, [&](std::size_t, int) {
        std::vector<char> buffer;
        for (;;) {
            throw_if_interrupted();
            std::unique_lock lock(taking);
            const std::uint64_t first = (all.size() - before) / per_row;
            const std::optional<TextPiece> taken = first < rows ? cutter.take(buffer) : std::nullopt;
            if (!taken) return;
            Piece& piece = pieces.emplace_back();
            piece.row_count = cutter.at_end() ? rows - first : std::min<std::uint64_t>(taken->feeds, rows - first);
            all.resize(all.size() + per_row * piece.row_count);  // stays where it is
            const std::span own_place = std::span(all).last(per_row * piece.row_count);
            lock.unlock();
            AsciiValues own(taken->text, taken->line, TextPiece::kMargin);
            piece.read = read(own, own_place);
            piece.is_whole = piece.read == piece.row_count && own.at_end();
            piece.end_place = taken->place + taken->text.size() - own.rest().size();
            piece.end_line = own.line();
        }
    });
    std::uint64_t count = 0;
    for (const Piece& p : pieces) {
        count += p.read;
        values = AsciiValues(text.substr(p.end_place), p.end_line);
        if (!p.is_whole) break;
    }
    all.resize(before + per_row * count);
    return count;
}

}  // namespace burin
