#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace burin {

/// A name of files, one per frame: a part of its last component stands for the frame's number.
class FramePattern {
  public:
    enum class SingleHash : std::uint8_t {
        letter,  ///< a # by itself is a letter like others
        digits,  ///< it stands for four digits
    };

    /// The pattern in a path: a run of #, each of which is a digit, "####.##" with digits behind the point, "%04d" or
    /// "$F4"; nothing if there is none. Throws InputError (message without a place) for more than one.
    static std::optional<FramePattern> find(const std::string& path, SingleHash single);

    /// The path of a frame. Numbers that are too long are written out; a minus stands in front.
    std::string path_of(double frame) const;

  private:
    std::string before_, behind_;
    std::size_t digits_ = 0, digits_behind_point_ = 0;
};

}  // namespace burin
