#pragma once

#include <unistd.h>

#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "base/helper_threads.h"
#include "render/film.h"

namespace burin {

/// Gives back the memory of a film that nobody needs any more beside what its owner does next: of gigabytes, which the
/// system takes page by page, that takes longer than a stopped call may.
class LateFilm {
  public:
    LateFilm() = default;
    ~LateFilm() { wait(); }
    LateFilm(const LateFilm&) = delete;
    LateFilm& operator=(const LateFilm&) = delete;

    /// Takes a film; waits for one that was taken before. Where the system has no more threads, wait() frees the film;
    /// where it has no more memory, the film is freed here, or stays with the caller.
    void take(Film&& film) noexcept {
        wait();
        try {
            taken_ = std::make_unique<Taken>(std::move(film));
        } catch (const std::exception&) {
        }
    }
    /// Returns when the memory of the film that was taken is given back.
    void wait() noexcept {
        if (taken_ != nullptr && taken_->process != ::getpid()) {  // a fork copies no other thread
            static_cast<void>(taken_.release());
        }
        taken_.reset();
    }

  private:
    struct Taken {
        explicit Taken(Film&& given) : film(std::move(given)), free([this](int) { film.reset(); }), helper(1, free) {}

        const pid_t process = ::getpid();
        std::optional<Film> film;
        const std::function<void(int)> free;
        const HelperThreads helper;
    };
    std::unique_ptr<Taken> taken_;
};

}  // namespace burin
