#pragma once

#include <memory>
#include <string>

#include "mesh/model_player.h"
#include "scene/animation/scene_animation.h"

namespace burin {

/// PlayedModel is a model that an animation of its file moves.
class PlayedModel : public ModelMotion {
  public:
    /// `file`: for messages. Seconds of the animation are frames divided by `fps`.
    PlayedModel(std::string file, std::shared_ptr<const ModelPlayer> player, double fps)
        : file_(std::move(file)), player_(std::move(player)), fps_(fps) {}

    Pose at(double frame) const override;

  private:
    std::string file_;
    std::shared_ptr<const ModelPlayer> player_;
    double fps_;
};

}  // namespace burin
