// Calls the library's interface in the order and with the arguments that its input chooses: on two scenes at once, of
// which the first byte says how many bytes the first one gets. Each thread may stop the other one's scene.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

#include "fuzz/scratch_folder.h"
#include "tests/burin/library_caller.h"

namespace {

/// Takes numbers from bytes.
class ByteChoices {
  public:
    ByteChoices(const std::uint8_t* data, const std::uint8_t* end) : data_(data), end_(end) {}

    bool has_more() const { return data_ != end_; }
    int integer(int low, int high) {
        const auto count = static_cast<std::uint64_t>(std::int64_t{high} - low) + 1;
        return static_cast<int>(low + static_cast<std::int64_t>(bits(count <= 256 ? 1 : 4) % count));
    }
    double real(double low, double high) { return low + (high - low) * static_cast<double>(bits(3)) / 0x1p24; }
    std::uint64_t bits64() { return bits(8); }
    void fail(const std::string& text) {
        std::fprintf(stderr, "%s\n", text.c_str());
        std::abort();
    }

  private:
    std::uint64_t bits(int bytes) {
        std::uint64_t value = 0;
        for (int i = 0; i < bytes; ++i) value = value << 8 | (has_more() ? *data_++ : std::uint8_t{0});
        return value;
    }

    const std::uint8_t* data_;
    const std::uint8_t* end_;
};

/// Counts what was called, and says so when the process ends.
struct Counts {
    std::atomic<std::uint64_t> calls = 0, pictures = 0;
    ~Counts() {
        std::fprintf(stderr, "calls: %llu, with %llu pictures\n", static_cast<unsigned long long>(calls),
                     static_cast<unsigned long long>(pictures));
    }
};
Counts counts;

void call_all(ByteChoices& choices, burin::test::LibraryCaller<ByteChoices>& caller, burin_scene* other) {
    while (choices.has_more()) {
        if (choices.integer(0, 31) == 0) burin_cancel(other);
        caller.call();
        ++counts.calls;
    }
    counts.pictures += static_cast<std::uint64_t>(caller.pictures());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const burin::fuzz::ScratchFolder folder;
    if (size == 0) return 0;
    const std::uint8_t* const middle = data + 1 + (size - 1) * data[0] / 256;
    ByteChoices first_choices(data + 1, middle), second_choices(middle, data + size);
    burin::test::LibraryCaller first(first_choices, folder.path()), second(second_choices, folder.path());
    std::thread beside([&] { call_all(second_choices, second, first.scene()); });
    call_all(first_choices, first, second.scene());
    beside.join();
    return 0;
}
