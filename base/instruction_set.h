#pragma once

// Kernels ask here which vector instructions they may use, so that tests can draw with each set on one machine.

namespace burin {

/// The sets of vector instructions that some kernels are compiled for, from the least to the most.
/// Each set includes those before it.
enum class InstructionSet { baseline, avx2, avx512 };

/// Whether this processor has a set.
bool has_instruction_set(InstructionSet set);

/// The most that kernels may use. Usually avx512, which means: all that this processor has. The
/// environment variable BURIN_KERNELS (baseline, avx2 or avx512) lowers it, so that tests can draw
/// with each set on one machine; pictures are the same to the bit. Read once; an unknown word
/// counts as if the variable were not there.
InstructionSet allowed_instruction_set();

/// Throws UsageError if BURIN_KERNELS is set to something else, or to a set that this processor
/// does not have: a test that names a set must not run with another one.
void check_instruction_set();

}  // namespace burin
