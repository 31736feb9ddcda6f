// Reads its input as a scene file and loads what it describes. Anything must end in a scene, an
// InputError or a UsageError.

#include <cstddef>
#include <cstdint>
#include <string>

#include "base/error.h"
#include "fuzz/scratch_folder.h"
#include "scene/camera.h"
#include "scene/scene_description.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const burin::fuzz::ScratchFolder folder;
    const std::string path = folder.write("input.toml", {data, size});
    try {
        const burin::Scene scene = burin::load_scene(burin::read_scene_file(path, {}));
        burin::resolve_camera(scene.cameras.front(), burin::scene_points(scene), 1.5);
    } catch (const burin::InputError&) {
    } catch (const burin::UsageError&) {  // a model per frame, and no frame
    }
    return 0;
}
