// Reads its input as a model of the format BURIN_FUZZ_KIND. Anything must end in a model or in an
// InputError. An input of kind "mtl" is the material file of a small OBJ. Animations of glTF are played.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/error.h"
#include "fuzz/scratch_folder.h"
#include "mesh/model.h"
#include "mesh/model_player.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static constexpr std::string_view kKind = BURIN_FUZZ_KIND;
    static const burin::fuzz::ScratchFolder folder;
    std::string path = folder.write("input." + std::string(kKind), {data, size});
    if (kKind == "mtl")
        path = folder.write("model.obj", "mtllib input.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
    try {
        burin::MeshOptions options;
        if (size % 2 == 1) options.attributes = burin::AttributeWish::all();
        burin::AnimationWish animations;
        animations.plays = animations.lists = kKind == "gltf" || kKind == "glb";
        const burin::Model model = burin::read_model(path, options, animations);
        if (model.player) {
            for (const double time_s : {-1.0, 0.0, 0.3, 0.5, 1.0, 1e9}) model.player->at(time_s);
        }
    } catch (const burin::InputError&) {
    }
    return 0;
}
