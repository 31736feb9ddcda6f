#include "mesh/model_player.h"

#include "base/interrupt.h"

namespace burin {

ModelMoment ModelPlayer::at(double time_s) const {
    ModelMoment moment;
    const std::vector<glm::dmat4> to_world = rig_.to_world(time_s);
    for (const RiggedObject& object : objects_) moment.objects.push_back(object.to_model(to_world));
    for (const std::uint32_t node : cameras_) moment.cameras.push_back(to_world[node]);
    for (const Part& part : parts_) {
        throw_if_interrupted();
        moment.meshes.emplace_back(part.mesh, part.surface.at(part.mover.positions(rig_, to_world, time_s)));
    }
    return moment;
}

}  // namespace burin
