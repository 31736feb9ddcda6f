#include "scene/animation/played_model.h"

#include <utility>

#include "base/error.h"

namespace burin {

ModelMotion::Pose PlayedModel::at(double frame) const {
    try {
        ModelMoment moment = player_->at(frame / fps_);
        return {std::move(moment.objects), std::move(moment.cameras), std::move(moment.meshes), {}};
    } catch (const InputError& error) {
        throw InputError(file_ + ": " + error.what());
    }
}

}  // namespace burin
