#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <string_view>
#include <utility>

#include "mesh/ply_header.h"
#include "mesh/row_kernels.h"
#include "mesh/row_scan.h"
#include "mesh/text_scan.h"

// The body of a PLY file is a sequence of values, as text or as bytes.

namespace burin {

/// A real that stands for an integer, as some writers put vertex numbers.
inline bool to_integer(double number, std::int64_t& value) {
    if (!(std::abs(number) <= 9e15) || number != std::floor(number)) return false;
    value = static_cast<std::int64_t>(number);
    return true;
}

/// Neither infinite nor NaN, and not too large either.
inline bool is_coordinate(const glm::dvec3& p) {
    return std::abs(p.x) <= kLargestCoordinate && std::abs(p.y) <= kLargestCoordinate &&
           std::abs(p.z) <= kLargestCoordinate;
}

/// Values of an ASCII body, in order. The values of one item stand on one line by convention, but
/// readers everywhere take any white space, so this does too.
class AsciiValues {
  public:
    /// `margin`: how many line feeds stand in front of the body and behind it, which may be read.
    AsciiValues(std::string_view body, std::size_t first_line, std::size_t margin = 0)
        : p_(body.data()),
          end_(p_ + body.size()),
          readable_begin_(p_ - margin),
          readable_end_(end_ + margin),
          line_(first_line) {}

    bool number(PlyType, double& value) {
        skip_space();
        const char* const next = scan_number(p_, end_, value);
        return accept(next);
    }
    /// Goes to the end of this line. Returns whether anything but blanks stood there.
    bool skip_rest_of_line() {
        p_ = skip_blanks(p_);
        if (p_ == end_ || is_line_end(*p_)) return false;
        p_ = find_line_end(p_, end_);
        return true;
    }
    bool integer(PlyType type, std::int64_t& value) {
        if (type >= PlyType::float32) {
            skip_space();
            double number_value = 0;
            const char* const next = scan_number(p_, end_, number_value);
            return next != nullptr && to_integer(number_value, value) && accept(next);
        }
        skip_space();
        if (has_scan_reach(p_)) {
            std::uint32_t plain = 0;
            if (const char* const next = scan_plain_integer(p_, plain)) {
                value = plain;
                return accept(next);
            }
        }
        return accept(scan_integer(p_, end_, value));
    }
    bool skip(PlyType, std::uint64_t count) {
        for (; count > 0; --count) {
            skip_space();
            if (p_ == end_) return false;
            while (p_ < end_ && !is_space(*p_)) ++p_;
        }
        return true;
    }
    /// How many values the rest can hold at most: each takes a character and a space.
    std::uint64_t room() const { return static_cast<std::uint64_t>(end_ - p_ + 1) / 2; }
    bool at_end() {
        skip_space();
        return p_ == end_;
    }
    std::size_t line() const { return line_; }
    /// All of the text that is left.
    std::string_view rest() const { return {p_, static_cast<std::size_t>(end_ - p_)}; }

    /// Reads rows of plain numbers from here on, as many as `rows` holds, and returns how many.
    /// Stops in front of the first row that is not plain, for number() and skip() to have a look
    /// at. `axis_of` says for every value of a row which coordinate it is, or -1.
    std::size_t plain_positions(std::span<const int> axis_of, std::span<glm::dvec3> rows) {
        const bool begins_with_xyz = axis_of[0] == 0 && axis_of[1] == 1 && axis_of[2] == 2;
        const bool is_xyz = begins_with_xyz && axis_of.size() == 3;
        const auto read_some = [&](std::size_t row) {
            return is_xyz ? read_lines(kernels_->positions, rows.size() - row, &rows[row].x) : 0;
        };
        return plain_rows(rows.size(), read_some, [&](const char* p, std::size_t row, std::size_t) {
            std::size_t column = 0;
            if (begins_with_xyz && has_reach(p)) {
                if (const char* const next = scan_three_decimals(p, &rows[row].x)) {
                    p = next;
                    column = 3;
                }
            }
            for (; column < axis_of.size(); ++column) {
                p = skip_blanks(p);
                if (!has_scan_reach(p)) return kNotPlain;
                if (const int axis = axis_of[column]; axis >= 0) {
                    p = scan_plain_decimal(p, rows[row][axis]);
                    if (p == nullptr || !is_space(*p)) return kNotPlain;
                } else {
                    if (p >= end_ || is_space(*p)) return kNotPlain;  // it stands on the next line
                    while (p < end_ && !is_space(*p)) ++p;
                }
            }
            return p;
        });
    }

    /// Reads one row in any form. False where it has something else than numbers; `this` is anywhere in it then.
    bool position(std::span<const int> axis_of, glm::dvec3& position) {
        for (const int axis : axis_of) {
            double value = 0;
            if (!(axis < 0 ? skip(PlyType::float64, 1) : number(PlyType::float64, value))) return false;
            if (axis >= 0) position[axis] = value;
        }
        return true;
    }

    /// Reads plain rows of triangles, each of them the number 3 and three vertex numbers on one line, and returns how
    /// many there were.
    std::size_t plain_triangles(std::span<std::uint32_t> corners) {
        const std::size_t max_count = corners.size() / 3;
        const auto read_some = [&](std::size_t row) {
            return read_lines(kernels_->triangles, max_count - row, corners.data() + 3 * row);
        };
        return plain_rows(max_count, read_some, [&](const char* p, std::size_t row, std::size_t) {
            if (!has_scan_reach(p) || p[0] != '3' || !is_blank(p[1])) return kNotPlain;
            ++p;
            for (std::size_t k = 0; k < 3; ++k) {
                p = skip_blanks(p);
                if (!has_scan_reach(p)) return kNotPlain;
                p = scan_plain_integer(p, corners[3 * row + k]);
                if (p == nullptr || !is_space(*p)) return kNotPlain;
            }
            return p;
        });
    }

  private:
    static constexpr const char* kNotPlain = nullptr;

    /// Rows that are a line each, from here on; how many there were.
    template <typename Value>
    std::size_t read_lines(std::size_t (*read)(const char*&, const char*, std::size_t, Value*), std::size_t max_count,
                           Value* values) {
        skip_space();
        if (!has_reach(p_) || max_count == 0) return 0;
        const std::size_t count = read(p_, std::min(end_, readable_end_ - kRowReach), max_count, values);
        line_ += count > 0 ? count - 1 : 0;
        return count;
    }
    /// Calls read_some(row), which reads rows from that one on and returns how many, and where it can go no further
    /// read_row(place, row, line), which reads one and returns the place behind it.
    template <typename ReadSome, typename ReadRow>
    std::size_t plain_rows(std::size_t max_count, const ReadSome& read_some, const ReadRow& read_row) {
        constexpr std::size_t kOneByOne = 32;  // before some are tried again
        for (std::size_t row = 0; row < max_count;) {
            row += read_some(row);
            const char* p = p_;  // in a register, and so is the line: each row waits for the one before
            std::size_t line = line_;
            const std::size_t end = std::min(max_count, row + kOneByOne);
            bool is_plain = true;
            for (; row < end; ++row) {
                p = behind_space(p, line);
                const char* const next = read_row(p, row, line);
                is_plain = next != kNotPlain;
                if (!is_plain) break;
                p = next;
            }
            p_ = p;
            line_ = line;
            if (!is_plain) return row;
        }
        return max_count;
    }
    bool has_reach(const char* p) const {
        return p - readable_begin_ >= kRowReachBack && readable_end_ - p >= kRowReach;
    }
    bool has_scan_reach(const char* p) const { return readable_end_ - p >= kScanReach; }
    const char* skip_blanks(const char* p) const {
        while (p < end_ && (*p == ' ' || *p == '\t')) ++p;
        return p;
    }
    static bool is_space(char c) { return is_blank(c) || c == '\n'; }
    void skip_space() { p_ = behind_space(p_, line_); }
    const char* behind_space(const char* p, std::size_t& line) const {
        for (; p < end_ && static_cast<unsigned char>(*p) <= ' ' && is_space(*p); ++p) {
            line += *p == '\n' || is_lone_carriage_return(p, end_) ? 1 : 0;
        }
        return p;
    }
    bool accept(const char* next) {
        if (next == nullptr || (next < end_ && !is_space(*next))) return false;
        p_ = next;
        return true;
    }

    const RowKernels* kernels_ = &best_row_kernels();
    const char* p_;
    const char* end_;
    const char* readable_begin_;
    const char* readable_end_;
    std::size_t line_;
};

/// Values of a binary body, in order.
class BinaryValues {
  public:
    BinaryValues(std::string_view body, bool big_endian)
        : p_(body.data()), end_(body.data() + body.size()), big_endian_(big_endian) {}

    bool number(PlyType type, double& value) {
        if (room_bytes() < size_of(type)) return reach_end();
        switch (type) {
            case PlyType::int8:
                value = load<std::int8_t>();
                break;
            case PlyType::uint8:
                value = load<std::uint8_t>();
                break;
            case PlyType::int16:
                value = load<std::int16_t>();
                break;
            case PlyType::uint16:
                value = load<std::uint16_t>();
                break;
            case PlyType::int32:
                value = load<std::int32_t>();
                break;
            case PlyType::uint32:
                value = load<std::uint32_t>();
                break;
            case PlyType::int64:
                value = static_cast<double>(load<std::int64_t>());
                break;
            case PlyType::uint64:
                value = static_cast<double>(load<std::uint64_t>());
                break;
            case PlyType::float32:
                value = static_cast<double>(load<float>());
                break;
            case PlyType::float64:
                value = load<double>();
                break;
        }
        return true;
    }
    bool integer(PlyType type, std::int64_t& value) {
        if (type == PlyType::int64 || type == PlyType::uint64) {
            if (room_bytes() < size_of(type)) return reach_end();
            value = load<std::int64_t>();
            // Beyond the largest there is: no count and no number of a vertex either.
            if (type == PlyType::uint64 && value < 0) value = std::numeric_limits<std::int64_t>::max();
            return true;
        }
        const char* const start = p_;
        double number_value = 0;  // 32-bit integers fit exactly
        if (!number(type, number_value)) return false;
        if (to_integer(number_value, value)) return true;
        p_ = start;
        return false;
    }
    bool skip(PlyType type, std::uint64_t count) {
        if (count > room_bytes() / size_of(type)) return reach_end();
        p_ += count * size_of(type);
        return true;
    }
    std::uint64_t room() const { return room_bytes(); }
    bool at_end() const { return p_ == end_; }
    std::size_t line() const { return 0; }
    /// All that is left.
    std::string_view rest() const { return {p_, room_bytes()}; }

  private:
    /// Ends reading at a value that the file has only a part of.
    bool reach_end() {
        p_ = end_;
        return false;
    }
    std::size_t room_bytes() const { return static_cast<std::size_t>(end_ - p_); }
    template <typename T>
    T load() {
        char bytes[sizeof(T)];
        std::memcpy(bytes, p_, sizeof(T));
        p_ += sizeof(T);
        const bool swap = big_endian_ == (std::endian::native == std::endian::little);
        if (swap) {
            for (std::size_t i = 0; i < sizeof(T) / 2; ++i) {
                std::swap(bytes[i], bytes[sizeof(T) - 1 - i]);
            }
        }
        T value;
        std::memcpy(&value, bytes, sizeof(T));
        return value;
    }

    const char* p_;
    const char* end_;
    bool big_endian_;
};

}  // namespace burin
