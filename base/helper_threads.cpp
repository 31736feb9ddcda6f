#include "base/helper_threads.h"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>

namespace burin {
namespace {

/// How long a thread looks out for what it waits for before it sleeps. The gaps of a frame between two uses of helpers
/// are shorter.
constexpr std::chrono::microseconds kAwake{200};

/// Waits until a number is no longer `old`.
void wait_for_change(const std::atomic<int>& number, int old) {
    const auto end = std::chrono::steady_clock::now() + kAwake;
    do {
        for (int i = 0; i < 64; ++i) {
            if (number.load(std::memory_order_acquire) != old) return;
#ifdef __SSE2__
            __builtin_ia32_pause();
#endif
        }
        std::this_thread::yield();  // there may be fewer cores than threads
    } while (std::chrono::steady_clock::now() < end);
    number.wait(old, std::memory_order_acquire);
}

}  // namespace

class HelperThread {
  public:
    HelperThread() {
        std::thread([this] { help(); }).detach();
    }

    void start(const std::function<void(int)>& work, int number) {
        work_ = &work;
        number_ = number;
        change_to(kBusy);
    }
    void wait() const { wait_for_change(state_, kBusy); }

  private:
    static constexpr int kIdle = 0, kBusy = 1;

    [[noreturn]] void help() {
        for (;;) {
            wait_for_change(state_, kIdle);
            (*work_)(number_);
            change_to(kIdle);
        }
    }
    void change_to(int state) {
        state_.store(state);  // in one order with what notify_one() asks: whether the other one sleeps
        state_.notify_one();
    }

    std::atomic<int> state_ = kIdle;
    const std::function<void(int)>* work_ = nullptr;
    int number_ = 0;
};

namespace {

/// The helper threads that nobody uses at present.
class IdleHelpers {
  public:
    /// The process's own. Never destroyed: they wait on when it ends.
    static IdleHelpers& of_process() {
        static std::atomic<IdleHelpers*> current = nullptr;
        IdleHelpers* helpers = current.load(std::memory_order_acquire);
        while (helpers == nullptr || helpers->process_ != ::getpid()) {  // a fork copies no other thread
            auto own = std::make_unique<IdleHelpers>();
            if (current.compare_exchange_strong(helpers, own.get(), std::memory_order_acq_rel)) helpers = own.release();
        }
        return *helpers;
    }

    std::vector<HelperThread*> take(std::size_t count) {
        std::vector<HelperThread*> taken;
        taken.reserve(count);
        const std::lock_guard lock(mutex_);
        idle_.reserve(made_ + count);  // giving back is not to fail
        for (; taken.size() < count && !idle_.empty(); idle_.pop_back()) taken.push_back(idle_.back());
        try {
            for (; taken.size() < count; ++made_) taken.push_back(std::make_unique<HelperThread>().release());
        } catch (const std::exception&) {
            // The system has no more threads, or no memory for them.
        }
        return taken;
    }
    void give_back(const std::vector<HelperThread*>& helpers) {
        const std::lock_guard lock(mutex_);
        idle_.insert(idle_.end(), helpers.rbegin(), helpers.rend());  // taken in the same order again
    }

  private:
    const pid_t process_ = ::getpid();
    std::mutex mutex_;
    std::vector<HelperThread*> idle_;
    std::size_t made_ = 0;
};

}  // namespace

HelperThreads::HelperThreads(std::size_t count, const std::function<void(int)>& work) {
    if (count == 0) return;
    helpers_ = IdleHelpers::of_process().take(count);
    int number = 0;
    for (HelperThread* const helper : helpers_) helper->start(work, ++number);
}

HelperThreads::~HelperThreads() {
    if (helpers_.empty()) return;
    for (const HelperThread* const helper : helpers_) helper->wait();
    IdleHelpers::of_process().give_back(helpers_);
}

}  // namespace burin
