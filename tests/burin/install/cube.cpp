// Draws a cube: a user's first program.
#include <burin/burin.hpp>
#include <cstdio>

int main(int argc, char** argv) try {
    const std::vector<float> points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
    const std::vector<std::int32_t> corners = {0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7};
    const std::vector<std::int32_t> sizes(6, 4);
    burin::Scene scene;
    scene.add({.name = "cube", .points = points, .corners = corners, .polygon_sizes = sizes});
    scene.set("lines.width=2");
    const burin::Picture picture = scene.render({.width = 320, .height = 240});
    picture.write(argc > 1 ? argv[1] : "cube.png");
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
