#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "image/image.h"
#include "lines/drawing_needs.h"
#include "lines/surface_walk.h"
#include "render/prepared.h"
#include "scene/scene.h"
#include "shading/surface/light.h"
#include "view/surface_set.h"

namespace burin {

class CompiledSheet;
struct SurfaceLook;

/// A Frame is a scene seen through one camera: the one input of every method. It borrows the scene and what is prepared
/// for it, and does not change once it is made.
struct Frame {
    const Scene* scene = nullptr;
    const PreparedScene* prepared = nullptr;  ///< of the scene; nullptr: nothing is prepared
    Camera camera;
    int width = 0;  ///< of the whole picture, in pixels
    int height = 0;
    PixelRect crop;  ///< the part to render
    SurfaceSet surfaces;
    /// The same surfaces one frame later, for the layer `motion`: the same instances, whose meshes have the same
    /// triangles. nullptr: nothing moves.
    const SurfaceSet* next = nullptr;
    LineCriteria criteria;
    /// The scene's style sheet, made ready for this picture; nullptr: the scene's line style says how lines look.
    std::shared_ptr<const CompiledSheet> sheet;
    /// How surfaces look; nullptr: their shading does not vary over them.
    std::shared_ptr<const SurfaceLook> surface_look;
    DrawingNeeds needs;  ///< what the looks of the scene ask for

    /// The picture, with what is rendered beside it.
    PixelRect reach() const {
        return {std::min(crop.x0, 0), std::min(crop.y0, 0), std::max(crop.x1, width), std::max(crop.y1, height)};
    }
    const Material& material_of(SurfaceId s) const { return scene->materials[surfaces.material_id(s) - 1]; }
};

/// The lights of a scene in view space: the key light first, which a style sheet may give; one at the eye if there is
/// none.
std::vector<ViewLight> lights_of(const Frame& frame);

/// What the settings of a scene make a line, in all methods.
LineCriteria criteria_of(const LineSettings& lines);

/// Throws InputError when the scene has more than 4 billion polygons or coordinates out of range.
Frame make_frame(const Scene& scene, const Camera& camera, int width, int height, PixelRect crop,
                 const PreparedScene* prepared = nullptr);

}  // namespace burin
