#pragma once

#include <cstdint>
#include <string>

// Which animation of a model file is played.

namespace burin {

/// The animation of a file that moves what the file shows.
struct AnimationChoice {
    enum class By : std::uint8_t { order /* the first one, if there is any */, number, name, none };
    By by = By::order;
    std::uint32_t number = 0;  ///< counted from 0
    std::string name;

    auto operator<=>(const AnimationChoice&) const = default;
};

/// What is wanted of a file's animations.
struct AnimationWish {
    bool plays = false;  ///< the model's motion is needed; else it stands as the file puts it, and no key is read
    bool lists = false;  ///< the names and lengths of all are needed
    AnimationChoice choice;
};

/// What a file says of an animation.
struct AnimationSummary {
    std::string name;
    double seconds = 0;  ///< to the last key
    std::uint64_t channels = 0;
};

}  // namespace burin
