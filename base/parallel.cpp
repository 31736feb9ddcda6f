#include "base/parallel.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "base/helper_threads.h"
#include "base/interrupt.h"

namespace burin {
namespace {

std::size_t count_workers(std::size_t count, int threads) {
    return std::min(count, static_cast<std::size_t>(resolve_thread_count(threads)));
}

/// Calls work(worker, stop) once on each of `workers` threads, or fewer, one of them this one. The first exception sets
/// `stop` and is rethrown.
template <typename Work>
void on_workers(std::size_t workers, const Work& work) {
    std::atomic<bool> stop{false};
    std::exception_ptr failure;
    std::mutex failure_mutex;
    const StopFlag& stop_flag = stop_flag_of_thread();
    const std::function<void(int)> run = [&](int worker) {
        const StopScope scope(stop_flag);
        try {
            work(worker, stop);
        } catch (...) {
            const std::lock_guard lock(failure_mutex);
            if (!failure) failure = std::current_exception();
            stop.store(true, std::memory_order_relaxed);
        }
    };
    {
        const HelperThreads helpers(std::max<std::size_t>(workers, 1) - 1, run);
        run(0);
    }
    if (failure) std::rethrow_exception(failure);
}

/// A range of indices from which one worker takes at the front, and others at the back.
class IndexRange {
  public:
    void set(std::size_t begin, std::size_t end) { bits_ = std::uint64_t{begin} << 32 | end; }
    /// Takes an index, and says whether there was one.
    bool take(bool from_front, std::size_t& index) {
        std::uint64_t bits = bits_.load(std::memory_order_relaxed), rest;
        do {
            const std::uint64_t begin = bits >> 32, end = bits & 0xFFFFFFFFu;
            if (begin >= end) return false;
            index = from_front ? begin : end - 1;
            rest = from_front ? bits + (std::uint64_t{1} << 32) : bits - 1;
        } while (!bits_.compare_exchange_weak(bits, rest, std::memory_order_relaxed));
        return true;
    }

  private:
    alignas(64) std::atomic<std::uint64_t> bits_;  // begin, end
};

}  // namespace

int resolve_thread_count(int threads) {
    if (threads > 0) return threads;
    return static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t, int)>& work) {
    const std::size_t workers = count_workers(count, threads);
    std::atomic<std::size_t> next{0};
    on_workers(workers, [&](int worker, const std::atomic<bool>& stop) {
        for (;;) {
            // Neighbours write to the same cache lines and read much alike, but the last ones are to end at about the
            // same time.
            constexpr std::size_t kShares = 8;
            std::size_t index = next.load(std::memory_order_relaxed), some;
            do {
                if (index >= count) return;
                some = std::clamp<std::size_t>((count - index) / (kShares * workers), 1, kMostInARow);
            } while (!next.compare_exchange_weak(index, index + some, std::memory_order_relaxed));
            for (const std::size_t end = index + some; index < end; ++index) {
                if (stop.load(std::memory_order_relaxed)) return;
                throw_if_interrupted();
                work(index, worker);
            }
        }
    });
}

void parallel_for_parts(std::size_t count, int threads, const std::function<void(std::size_t, int)>& work) {
    const std::size_t workers = count_workers(count, threads);
    std::vector<IndexRange> parts(workers);
    for (std::size_t w = 0; w < workers; ++w) parts[w].set(w * count / workers, (w + 1) * count / workers);
    on_workers(workers, [&](int worker, const std::atomic<bool>& stop) {
        for (std::size_t k = 0; k < workers; ++k) {
            IndexRange& part = parts[(static_cast<std::size_t>(worker) + k) % workers];
            for (std::size_t index; part.take(k == 0, index);) {
                if (stop.load(std::memory_order_relaxed)) return;
                throw_if_interrupted();
                work(index, worker);
            }
        }
    });
}

}  // namespace burin
