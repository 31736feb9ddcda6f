#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>

// Work on many indices is handed out to threads; nothing may depend on which thread does what.

namespace burin {

/// Number of threads to use for a request of `threads`; 0 asks for all cores.
int resolve_thread_count(int threads);

/// Most indices in a row that parallel_for() hands out to one worker.
constexpr std::size_t kMostInARow = 8;

/// Calls work(index, worker) once for every index in [0, count), on `threads` threads, or on fewer if the system has no
/// more
/// (`worker` in [0, threads) tells which), and returns when all are done.
///
/// Indices are handed out in increasing order, some in a row to one worker, which calls work() in that order. Nothing
/// may depend on which worker gets which index. The first exception stops the others and is rethrown. An interrupt
/// throws `Interrupted`: helpers look at the flag of the calling thread (base/interrupt.h).
void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t index, int worker)>& work);

/// parallel_for() in any order of the indices, for a count below 2^32: each worker begins with its own part of the
/// indices, the same one whenever there are as many, so that what it wrote at an index is mostly in its own caches when
/// it reads there. Then it helps the others, from the ends of their parts.
void parallel_for_parts(std::size_t count, int threads, const std::function<void(std::size_t index, int worker)>& work);

/// Cuts [0, count) into batches of `size` indices, the last one shorter, and calls work(batch, begin, end) once for
/// each.
template <typename Work>
void parallel_for_batches(std::size_t count, std::size_t size, int threads, const Work& work) {
    parallel_for((count + size - 1) / size, threads,
                 [&](std::size_t batch, int) { work(batch, batch * size, std::min(count, (batch + 1) * size)); });
}

/// Calls work(i) once for every i in [0, count), many in a row on one thread: for work that is little by itself.
template <typename Work>
void parallel_for_each(std::size_t count, int threads, const Work& work) {
    constexpr std::size_t kAtOnce = 1 << 14;
    parallel_for_batches(count, kAtOnce, threads, [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) work(i);
    });
}

}  // namespace burin
