#pragma once

#include <cstddef>
#include <cstdint>

// Rows of plain numbers, which most lines of model files are, are read by kernels for vector instructions.

namespace burin {

/// Rows of three plain numbers, each row a line: many at once. There is a set of them per instruction set; all read
/// the same values from what they read.
///
/// They read from `p` on, as many rows as `max_rows`, and none that begins at `limit` or behind it; they end in front
/// of the first row that is no such line, and return how many they read. A line may end in one space. `p` becomes the
/// place behind the last number that was read. kRowReachBack bytes in front of `p` and kRowReach behind `limit` must be
/// there to be looked at. What lies behind the values of `max_rows` stays as it is.
struct RowKernels {
    /// Rows "3 A B C" as scan_three_integers() reads them.
    std::size_t (*triangles)(const char*& p, const char* limit, std::size_t max_rows, std::uint32_t* values);
    /// Rows "X Y Z" as scan_three_decimals() reads them.
    std::size_t (*positions)(const char*& p, const char* limit, std::size_t max_rows, double* values);
};

const RowKernels& baseline_row_kernels();
/// nullptr where compiler or machine lack AVX2 and BMI2.
const RowKernels* avx2_row_kernels();
/// nullptr where compiler or machine lack AVX-512 with VBMI2.
const RowKernels* avx512_row_kernels();
/// The fastest ones that this machine has and allowed_instruction_set() permits.
const RowKernels& best_row_kernels();

}  // namespace burin
