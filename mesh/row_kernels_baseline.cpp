#include <algorithm>
#include <array>

#include "base/instruction_set.h"
#include "mesh/row_kernels.h"
#include "mesh/row_scan.h"

namespace burin {
namespace {

/// scan(row, place) is called for one row after the other, and returns the place behind it or nullptr.
template <typename Scan>
std::size_t read_rows(const char*& p, const char* limit, std::size_t max_rows, const Scan& scan) {
    const char* row = p;
    for (std::size_t count = 0; count < max_rows; ++count) {
        const char* const next = row < limit ? scan(row, count) : nullptr;
        const char* const end = next != nullptr && *next == ' ' ? next + 1 : next;
        if (end == nullptr || *end != '\n') return count;
        p = next;
        row = end + 1;
    }
    return max_rows;
}

std::size_t triangles(const char*& p, const char* limit, std::size_t max_rows, std::uint32_t* values) {
    return read_rows(p, limit, max_rows, [&](const char* row, std::size_t i) -> const char* {
        if (row[0] != '3' || row[1] != ' ') return nullptr;
        std::array<std::uint32_t, 4> corners{};
        const char* const next = scan_three_integers(row + 2, corners.data());
        std::copy_n(corners.begin(), 3, values + 3 * i);
        return next;
    });
}

std::size_t positions(const char*& p, const char* limit, std::size_t max_rows, double* values) {
    return read_rows(p, limit, max_rows,
                     [&](const char* row, std::size_t i) { return scan_three_decimals(row, values + 3 * i); });
}

}  // namespace

const RowKernels& baseline_row_kernels() {
    static constexpr RowKernels kernels{triangles, positions};
    return kernels;
}

const RowKernels& best_row_kernels() {
    const InstructionSet allowed = allowed_instruction_set();
    const RowKernels* const avx512 = allowed >= InstructionSet::avx512 ? avx512_row_kernels() : nullptr;
    if (avx512 != nullptr) return *avx512;
    const RowKernels* const avx2 = allowed >= InstructionSet::avx2 ? avx2_row_kernels() : nullptr;
    return avx2 != nullptr ? *avx2 : baseline_row_kernels();
}

}  // namespace burin
