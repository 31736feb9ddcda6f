/* Draws a cube: a user's first program. */
#include <burin/burin.h>
#include <stdio.h>

static int failed(void) {
    fprintf(stderr, "%s\n", burin_error());
    return 1;
}

int main(int argc, char** argv) {
    static const float points[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
    static const int32_t corners[] = {0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7};
    static const int32_t sizes[] = {4, 4, 4, 4, 4, 4};
    burin_mesh mesh = {sizeof mesh};
    burin_object object = {sizeof object};
    burin_view view = {sizeof view};
    burin_scene* scene = burin_scene_new();
    burin_picture* picture;

    mesh.points = points, mesh.point_count = 8;
    mesh.corners = corners, mesh.corner_count = 24;
    mesh.polygon_sizes = sizes, mesh.polygon_count = 6;
    object.mesh = burin_add_mesh(scene, &mesh);
    object.name = "cube";
    if (burin_add_object(scene, &object) < 0 || burin_set(scene, "lines.width=2") < 0) return failed();
    view.width = 320, view.height = 240;
    picture = burin_render(scene, &view, NULL);
    if (picture == NULL || burin_write(picture, NULL, NULL, argc > 1 ? argv[1] : "cube.png") < 0) return failed();
    burin_picture_free(picture);
    burin_scene_free(scene);
    return 0;
}
