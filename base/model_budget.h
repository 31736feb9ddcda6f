#pragma once

#include <cstdint>
#include <string>
#include <string_view>

// A budget counts what a few words of a file will take, before anything is made, and refuses what is too much.

namespace burin {

/// A size as messages say it: "1.5 GB", "700 MB". 1 GB is 1024 MB.
std::string size_text(std::uint64_t bytes);

/// How much memory models may take beyond the size of their files.
///
/// A few words of a file can ask for gigabytes: 4096 segments, 8 subdivisions, an accessor that is
/// used again and again. Who reads such words counts what they will take before anything is made.
/// What a file spells out itself, such as its vertices and polygons, is not counted. One budget
/// serves all models of a scene, on one thread at a time.
class ModelBudget {
  public:
    static constexpr std::uint64_t kDefaultLimit = std::uint64_t{2} << 30;

    /// `option`: what raises the limit, as messages name it; empty: nothing does.
    explicit ModelBudget(std::uint64_t limit_bytes = kDefaultLimit, std::string_view option = {})
        : limit_bytes_(limit_bytes), option_(option) {}

    /// Counts bytes that are about to be taken. Throws InputError once they are more than the
    /// limit, with those counted before; `what` takes them, and is the subject of the message:
    /// "object 'ball', with 4096 segments and 4096 rings,".
    void add(std::uint64_t bytes, const std::string& what);
    /// Tells how many bytes are about to be counted, one after the other, so that a refusal names what all of them
    /// need.
    void foresee(std::uint64_t bytes);

    std::uint64_t counted_bytes() const { return counted_bytes_; }
    std::uint64_t limit_bytes() const { return limit_bytes_; }

  private:
    std::uint64_t limit_bytes_;
    std::string_view option_;  // a literal
    std::uint64_t counted_bytes_ = 0;
    std::uint64_t foreseen_bytes_ = 0;  // what will have been counted
};

/// Products for add(), which stay at the largest number instead of passing it.
constexpr std::uint64_t saturating_product(std::uint64_t a, std::uint64_t b) {
    return a != 0 && b > UINT64_MAX / a ? UINT64_MAX : a * b;
}

}  // namespace burin
