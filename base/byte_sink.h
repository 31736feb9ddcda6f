#pragma once

#include <cstddef>
#include <cstring>
#include <vector>

namespace burin {

/// Where the bytes of a file go: to a file, or to memory.
class ByteSink {
  public:
    virtual ~ByteSink() = default;
    /// Writes at the current position.
    virtual void write(const void* data, std::size_t size) = 0;
    virtual void seek(std::size_t position) = 0;
    virtual std::size_t position() const = 0;
};

/// A file in memory.
class MemorySink final : public ByteSink {
  public:
    void write(const void* data, std::size_t size) override {
        if (position_ + size > bytes_.size()) bytes_.resize(position_ + size);
        if (size > 0) std::memcpy(bytes_.data() + position_, data, size);
        position_ += size;
    }
    void seek(std::size_t position) override { position_ = position; }
    std::size_t position() const override { return position_; }
    const std::vector<std::byte>& bytes() const { return bytes_; }

  private:
    std::vector<std::byte> bytes_;
    std::size_t position_ = 0;
};

}  // namespace burin
