// Calls the library's interface in the order and with the arguments that its input chooses.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "tests/burin/library_caller.h"

namespace {

/// Takes numbers from bytes.
class ByteChoices {
  public:
    ByteChoices(const std::uint8_t* data, std::size_t size) : data_(data), end_(data + size) {}

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

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    ByteChoices choices(data, size);
    burin::test::LibraryCaller caller(choices);
    while (choices.has_more()) caller.call();
    return 0;
}
