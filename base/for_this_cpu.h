#pragma once

#include <cstddef>  // tells whether the C library is glibc

/// In front of a function's definition: compiled twice, for any x86-64 and for CPUs with AVX2 and BMI (x86-64-v3); the
/// loader chooses. For functions that take much of a frame and are no kernels: it saves 1 to 2 % of a frame all together.
/// Results are the same, as floating point is never contracted. What is called and not inlined stays as it is.
#if defined(__x86_64__) && defined(__GLIBC__) && !defined(__clang__) && __GNUC__ >= 12 && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define BURIN_FOR_THIS_CPU __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define BURIN_FOR_THIS_CPU
#endif
