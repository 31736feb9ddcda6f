#include "compare/difference_picture.h"

namespace burin {
namespace {

constexpr float kTruthGrey = 0.82f;

}  // namespace

DisplayImage difference_picture(const Plane& result, const Plane& truth) {
    DisplayImage picture;
    picture.width = result.width;
    picture.height = result.height;
    picture.channels = 3;
    for (std::size_t i = 0; i < result.values.size(); ++i) {
        const float difference = result.values[i] - truth.values[i];
        const glm::vec3 paper(glm::mix(1.0f, kTruthGrey, glm::clamp(truth.values[i], 0.0f, 1.0f)));
        const glm::vec3 color = glm::mix(paper, difference > 0 ? kTooMuchColor : kMissingColor,
                                         glm::clamp(glm::abs(difference), 0.0f, 1.0f));
        for (int c = 0; c < 3; ++c) {
            picture.pixels.push_back(static_cast<std::uint16_t>(color[c] * 65535.0f + 0.5f));
        }
    }
    return picture;
}

}  // namespace burin
