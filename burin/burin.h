/* Burin: 3D models as lines. The library's interface in C; burin.hpp wraps it for C++. See docs/library.md.
 *
 * Rules that hold for all of it:
 * - A function that returns a number returns a negative one (burin_result) on failure, one that returns a pointer NULL;
 *   burin_error() then says why. What failed has changed nothing.
 * - A struct begins with its own size: burin_view view = {sizeof view}; the rest is 0, which always means "as usual".
 *   Later versions add fields at the end; programs built for older ones go on working.
 * - What is given is copied or read during the call; nothing of it has to live on. Texts are UTF-8 and end with 0.
 * - Matrices have 16 numbers, row by row; the last row is 0 0 0 1. They take columns (x, y, z, 1). All 0: see there.
 * - Numbers of materials, meshes and objects count from 1 and are not used twice in a scene; 0 stands for none.
 * - Axes, units and channels are those of docs/conventions.md: world right-handed, +Y up unless the camera says
 *   otherwise, row 0 of a picture is the top, colours are linear, angles in degrees.
 * - Different scenes, drawings and pictures may be used on different threads at once, one of them by one at a time.
 *   burin_cancel() may be called at any time. */
#ifndef BURIN_BURIN_H
#define BURIN_BURIN_H

#include <stddef.h>
#include <stdint.h>

#ifdef __GNUC__
#define BURIN_API __attribute__((visibility("default")))
#else
#define BURIN_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- version and errors ---- */

/** The version of this interface. It counts up with every change; a library works for programs that were built with
 * the same number or a smaller one. */
#define BURIN_ABI 6
/** BURIN_ABI of the library that is loaded. */
BURIN_API int burin_abi(void);
/** Its version, "0.1.0". */
BURIN_API const char* burin_version(void);

/** What a function that fails returns. */
enum burin_result {
    BURIN_DONE = 0,
    BURIN_BAD_INPUT = -1,    /**< a file, a text or an array is wrong or cannot be read or written */
    BURIN_BAD_ARGUMENT = -2, /**< the call or a setting makes no sense */
    BURIN_STOPPED = -3,      /**< by burin_cancel() or the progress function */
    BURIN_NO_MEMORY = -4,
    BURIN_FAILED = -5 /**< a fault of the library; please report it */
};

/** Why the last call that failed on this thread did: one line that says what is wrong and what to do. "" if none has.
 * Valid until the next failure on this thread. */
BURIN_API const char* burin_error(void);
/** The same as a burin_result: what kind of failure it was. */
BURIN_API int burin_error_kind(void);

/* ---- scenes ---- */

/** Objects with their meshes and materials, cameras, and settings. */
typedef struct burin_scene burin_scene;

BURIN_API burin_scene* burin_scene_new(void);
/** NULL is allowed. Pictures of the scene live on. */
BURIN_API void burin_scene_free(burin_scene* scene);

/** Adds what a file holds: a scene (.toml), of which the settings and cameras, too, or a model (.obj .ply .stl .off
 * .gltf .glb). Uses all cores. Each object gets a number, in the order of the file. Returns the first one. */
BURIN_API int burin_load(burin_scene* scene, const char* path);
/** The same for the text of a scene file (docs/scene-format.md). Paths in it are relative to `base_folder`; NULL: to
 * the current one. */
BURIN_API int burin_load_text(burin_scene* scene, const char* toml, const char* base_folder);
/** What readers left out of the files or did not take as it stands, "path: what": note `index`, from 0; NULL behind the
 * last one, which is no failure. Valid until the scene is changed. */
BURIN_API const char* burin_note(const burin_scene* scene, int index);

/** What a polygon looks like when it is shaded, and how much it hides. */
typedef struct burin_material {
    uint32_t size;
    float opacity;    /**< 0 to 1; 1 is opaque */
    float color[3];   /**< linear red, green, blue, 0 to 1 */
    const char* name; /**< NULL: none */
} burin_material;

/** Adds a material. Returns its number: the one in the channel id.material. */
BURIN_API int burin_add_material(burin_scene* scene, const burin_material* material);

/** Polygons as they lie in memory: open or closed, convex or not, of any winding. Vertices with equal coordinates are
 * one, polygons without area are dropped: all as if the mesh came from a file (docs/conventions.md, Models). */
typedef struct burin_mesh {
    uint32_t size;
    const char* name;                 /**< of its objects that have no name of their own; NULL: none */
    const float* points;              /**< x y z of each point: finite, at most 1e30 */
    uint64_t point_count;             /**< at most 2^31 - 1 */
    const int32_t* corners;           /**< points of the polygons' corners, from 0, one polygon after the other */
    uint64_t corner_count;            /**< at most 2^32 - 1 */
    const int32_t* polygon_sizes;     /**< corners of each polygon; NULL: all are triangles */
    uint64_t polygon_count;           /**< 0 will do without polygon_sizes */
    const int32_t* polygon_materials; /**< number of each one's material; 0: light grey, which gets a
                                           number of its own when it is first needed; NULL: all 0 */
    const int32_t* polygon_objects;   /**< which part each one belongs to, from 0: parts are welded on their own, and
                                           where they touch is a line of class `object`; NULL: all are one */
    uint64_t object_count;            /**< how many parts; 0 will do without polygon_objects */
    const char* const* object_names;  /**< of the parts; NULL: they have none */
    const int32_t* marked_edges;      /**< pairs of points: edges of class `mark`, lines by themselves if no polygon has
                                           them; NULL: none */
    uint64_t marked_edge_count;       /**< how many pairs */
    const float* corner_uv;    /**< two texture coordinates of each corner, u and v of style sheets; NULL: none */
    const float* point_colors; /**< red green blue of each point, linear: Cv of style sheets; NULL: none */
    const char* const* attribute_names;   /**< of further numbers of points: attr("name") of style sheets */
    const float* const* point_attributes; /**< for each name an array with a number for each point */
    uint64_t attribute_count;             /**< how many names, 64 at most */
} burin_mesh;

/** Adds a mesh, for objects to show. Returns its number. */
BURIN_API int burin_add_mesh(burin_scene* scene, const burin_mesh* mesh);
/** Forgets the number of a mesh. Objects that show it go on doing so; its memory is freed with the last of them. */
BURIN_API int burin_remove_mesh(burin_scene* scene, int mesh);

/** A mesh at a place. */
typedef struct burin_object {
    uint32_t size;
    int32_t mesh;        /**< its number */
    int32_t material;    /**< of all its polygons; 0: their own ones */
    const char* name;    /**< NULL: the mesh's; parts have theirs behind it: "name/part" */
    double to_world[16]; /**< all 0: the mesh stands where its points say */
} burin_object;

/** Adds an object. Returns its number. */
BURIN_API int burin_add_object(burin_scene* scene, const burin_object* object);
/** Puts an object that was added or loaded somewhere else: `to_world` replaces its matrix. All 0: as in burin_object.
 */
BURIN_API int burin_move_object(burin_scene* scene, int object, const double to_world[16]);
BURIN_API int burin_remove_object(burin_scene* scene, int object);
/** Removes all objects. Meshes and materials that were added, settings and cameras stay. */
BURIN_API int burin_clear_objects(burin_scene* scene);
/** The box of all objects: `low` and `high` get its corners in the world. Fails with BURIN_BAD_INPUT if there are no
 * points. */
BURIN_API int burin_scene_box(const burin_scene* scene, double low[3], double high[3]);
/** Which object has a number `id` in the channel id.object of a picture of the scene as it is now: ids count the parts
 * of all objects, in the order in which these were added, from 1. */
BURIN_API int burin_object_of_id(const burin_scene* scene, uint32_t id);
/** Its name; NULL if there is no such object. Valid until the scene is changed. */
BURIN_API const char* burin_object_name(const burin_scene* scene, int object);

/** Changes a setting, as --set of the program does: "lines.width=2", "lines.draw=silhouette,crease",
 * "picture.background=transparent". Objects and materials are no settings. */
BURIN_API int burin_set(burin_scene* scene, const char* key_and_value);
/** Changes all settings that a text names: tables of a scene file but [[object]] and [[material]]. What it does not
 * name stays; a list of cameras replaces the one before. */
BURIN_API int burin_set_toml(burin_scene* scene, const char* toml);
/** Has lines look as a style sheet says (docs/shading/sheets.md), as --style of the program does: it takes the place of
 * all looks of the scene, and of the sheet before with its changes. `text_or_name`: the text of a sheet, which has
 * several lines; or a name, or a file that has a / or ends in .toml, which is read now. burin_set() then changes its
 * values: "style.width=3". NULL or "": takes the sheet away, that of the scene's file, too. */
BURIN_API int burin_set_style(burin_scene* scene, const char* text_or_name);

/* ---- pictures ---- */

/** How a scene is seen. */
typedef struct burin_view {
    uint32_t size;
    int32_t width, height; /**< pixels of the whole picture, 1 to 65535; both 0: as the scene says */
    int32_t crop[4];       /**< x0 y0 x1 y1: the part that is drawn, x1 and y1 excluded; all 0: all */
    int32_t samples;       /**< per pixel, along either axis: 2, 4 or 8; 0: as the scene says */
    int32_t frame;         /**< number of the frame, for style sheets: -1000000000 to 1000000000; must be 0 where what
                                was loaded moves, which is shown at rest in this version (burin_note()) */
    const char* camera;    /**< name of one of the scene's cameras, if there is no matrix; NULL: the first, or one that
                                has all of the scene in view if there is none */
    double camera_to_world[16]; /**< the camera's x is to the right, y up, and it looks along -z; a rotation and a
                                     position, exact to single precision; all 0: one of the scene's cameras */
    double fov_deg;             /**< with a matrix: vertical field of view, between 0 and 180; 0: 35, or ortho_height */
    double ortho_height;        /**< with a matrix: visible height in world units, orthographic; 0: perspective */
    double shift[2];     /**< with a matrix: the lens is shifted, so that the picture shows what is so much farther
                              to the right and up, in heights of the picture, -100 to 100 */
    double pixel_aspect; /**< the width of a pixel / its height, as a display shows it, 0.1 to 10; 0: as the camera
                              says, 1 with a matrix. Widths of lines are in pixels along either axis. Vector files can
                              be made with 1 only */
} burin_view;

/** How to work. Nothing here changes a pixel. */
typedef struct burin_options {
    uint32_t size;
    int32_t threads;       /**< 0: as many as there are cores; at most 1024 */
    uint64_t memory_bytes; /**< cap for what drawing takes beyond scene and picture; 0: none */
    const char* layers;    /**< which channels the picture gets, as --layers of the program: "beauty,lines,Z"; NULL:
                                "beauty,lines,Z,N,ids", lines_hidden if hidden lines are drawn, and those that sets of
                                a style sheet have of their own */
    /** Is called about ten times a second with the part that is done, 0 to 1, on the thread that made the call. It
     * returns 0 to go on and anything else to stop. It must not use the scene, but for burin_cancel(). NULL: none. */
    int (*progress)(double done, void* user);
    void* user;        /**< for `progress` */
    int32_t for_paths; /**< of burin_find_lines(), not 0: a drawing can be written as a vector file without a style
                            sheet, too: the look of the scene then counts as one, which draws the same lines, though
                            not to the bit. With a style sheet: paths of an SVG say their edges, as the program's do,
                            whatever the sheet asks for */
    int32_t find_all;  /**< of burin_find_lines(), not 0: lines are found as if a style sheet asked for all that there
                            is, so that burin_draw() takes any sheet of the same crease_angle and contours; without a
                            sheet for_paths is meant, too */
} burin_options;

/** Channels of pixels, independent of the scene. */
typedef struct burin_picture burin_picture;

/** Draws a scene. `view`, `options`: NULL for all as usual. The same scene and view give the same bits, whatever the
 * options and the machine, and those that the program writes. */
BURIN_API burin_picture* burin_render(burin_scene* scene, const burin_view* view, const burin_options* options);
/** Stops what a scene is doing (burin_render(), burin_find_lines(), burin_load() ...): that call soon
 * fails with BURIN_STOPPED. From any thread. A call that begins later is not stopped. */
BURIN_API void burin_cancel(burin_scene* scene);
/** NULL is allowed. */
BURIN_API void burin_picture_free(burin_picture* picture);

/** What a channel's values are. */
enum burin_type {
    BURIN_HALF = 1,
    BURIN_FLOAT = 2,
    BURIN_UINT32 = 3,
    BURIN_DOUBLE = 4,
    BURIN_UINT64 = 5,
    BURIN_UINT16 = 6,
    BURIN_UINT8 = 7
};

/** What drawing found that its user should know, such as a value of a style sheet that is not a number at some places:
 * note `index`, from 0, as the program prints it; NULL behind the last one, which is no failure. */
BURIN_API const char* burin_picture_note(const burin_picture* picture, int index);

/** The values of a channel ("R", "lines.A", "Z", "id.object" ...: docs/conventions.md, Images), row by row from the
 * top, without gaps. `type`: gets its burin_type; `size`: gets columns and rows, those of the crop. Either may be
 * NULL. The picture owns them. */
BURIN_API const void* burin_channel(const burin_picture* picture, const char* name, int32_t* type, int32_t size[2]);
/** The name of channel `index`, from 0; NULL behind the last one, which is no failure. */
BURIN_API const char* burin_channel_name(const burin_picture* picture, int index);
/** The size of the whole picture in pixels, whatever the crop: `size` gets width and height. */
BURIN_API int burin_picture_size(const burin_picture* picture, int32_t size[2]);
/** The whole picture as a display shows it, 8 bits per value, sRGB: width x height x channels bytes, row by row from
 * the top. `channels`: 1 grey, 3 red green blue, both over the scene's background or white paper; 4 with alpha, which
 * is not multiplied in. Pixels outside of the crop are background. Needs the layer `beauty`. */
BURIN_API int burin_pixels(const burin_picture* picture, uint8_t* out, int channels);

/* ---- lines as data ---- */

/** The lines of a picture, found once, independent of the scene: to be read as columns of numbers, and drawn. */
typedef struct burin_drawing burin_drawing;

/** Finds the lines that burin_render() would draw: visible ones, and those that surfaces hide where the scene draws
 * them ("lines.hidden.style=solid" or "dashed"); with a style sheet, all that it asks for. `options.layers`: of the
 * pictures that are drawn of it. */
BURIN_API burin_drawing* burin_find_lines(burin_scene* scene, const burin_view* view, const burin_options* options);
/** Draws a drawing's lines over its surfaces: the bits of burin_render(). `style`: NULL, the look of the scene when the
 * lines were found; or a style sheet, as for burin_set_style(), which needs no more than the sheet that the scene had
 * then: its classes, its hidden lines, its crease_angle and contours. What it leaves open of these and of the filter is
 * as it was. Where it needs less, some pixels may differ from those of burin_render(): what is found depends a little
 * on what is looked for. Of `options` only `threads` counts; `layers` must be NULL, for the drawing has its own. It
 * cannot be stopped. */
BURIN_API burin_picture* burin_draw(const burin_drawing* drawing, const char* style, const burin_options* options);
/** NULL is allowed. Pictures live on. */
BURIN_API void burin_drawing_free(burin_drawing* drawing);

/* clang-format off */
/** A column of a drawing: a value for each of its straight pieces. `type` gets its burin_type, `count` the number of
 * pieces; either may be NULL. It is made when it is first asked for, and lives as long as the drawing, which owns it.
 *
 * Pieces are lines as they were found: contours run along edges of the mesh, also where the scene draws smooth ones, and
 * nothing is cut into dashes. A line comes in many of them, in no order and either way round; its number joins them.
 * Where a line ends at a vertex or is covered, a visible piece may end early or late, or leave the line, by about the
 * distance of two samples: half a pixel at 2 samples. Some pieces lie beside the crop or the picture, as strokes from
 * there may reach into it; with dashes those of the whole picture are found, whatever the crop. None is shorter than
 * 1/1024 pixel.
 * Those that no surface is in front of come first, then hidden ones and those seen through transparent surfaces.
 *
 *     name                 type    meaning
 *     x0 y0 x1 y1          double  the piece's ends, in pixels from the upper left corner of the whole picture, y down
 *     nearness0 nearness1  float   of the line's surface at the ends: 1 / depth along the view axis; orthographic: -depth
 *     line                 uint64  which line it is part of, an edge or where two surfaces meet: equal numbers, one line
 *     object               uint32  the line's object, as in the channel id.object
 *     material             uint32  the line's material, as in the channel id.material; 0: an edge without any polygon
 *     classes              uint16  the line classes that apply, of those that the scene draws ("lines.draw"), as bits:
 *                                  1 mark, 2 border, 4 silhouette, 8 intersection, 16 object, 32 material, 64 crease,
 *                                  128 polygon; the lowest one is what the line is called and drawn as
 *     invisibility         uint8   how many opaque surfaces are in front; 0: none; 255: that many or more; beside a style
 *                                  sheet that does not ask how many: 0, or any other number */
BURIN_API const void* burin_column(burin_drawing* drawing, const char* name, int32_t* type, uint64_t* count);
/* clang-format on */

/** Why a pixel of a scene with a style sheet looks as it does, as `burin explain` of the program says it: the strokes
 * in it, the topmost first, each with its set and why earlier sets did not take it, its style, its line, and the values
 * with the variables that they read; then the lines near it that leave no ink there, and why. `x`, `y`: from the upper
 * left corner of the whole picture, within the crop. `format`: "text", or "json" (docs/shading/sheets.md). Of `options`
 * only `threads` counts. Valid until the next call for this scene, which owns it. */
BURIN_API const char* burin_explain(burin_scene* scene, const burin_view* view, const burin_options* options, int x,
                                    int y, const char* format);

/* ---- looks that a program computes ---- */

/** Places on lines that one style of a style sheet draws, with what is known there: what a line shader and a line test
 * read. */
typedef struct burin_line_samples {
    uint32_t size;
    uint32_t count;              /**< how many places: 1 to 1024 */
    const float* const* columns; /**< one for each variable that was asked for, in that order, with `count` values */
    const char* const* names;    /**< theirs: "depth", "N.x" */
    uint32_t column_count;       /**< how many of both */
    uint32_t message_size;       /**< bytes of `message`, with the final 0: 256 */
    const char* style;           /**< the name of the style */
    char* message;               /**< to be filled before something else than 0 is returned: why */
} burin_line_samples;

/** The ink at the same places: `count` values each, those of the style before and those that are drawn after. They are
 * brought to their ranges; one that is not a number counts as 0 (a colour as a whole), and a note says how often that
 * was (burin_picture_note()). */
typedef struct burin_line_ink {
    uint32_t size;
    float* width_px;           /**< full width, 0 to 4096 */
    float* offset_px;          /**< across, -4096 to 4096; > 0: away from the front surface */
    float* opacity;            /**< 0 to 1 */
    float *red, *green, *blue; /**< linear, 0 to 65504 */
} burin_line_ink;

/** Changes the ink of lines. Returns 0; anything else ends the call that draws, which fails with BURIN_BAD_ARGUMENT and
 * a text that has `message`. Several threads call it at once, for batches that may be any; the same place must get the
 * same ink, whatever the batch, for only then are pictures the same. It must not use the scene or its drawings, but for
 * burin_cancel(). */
typedef int (*burin_line_shader)(const burin_line_samples* samples, burin_line_ink* ink, void* user);
/** Says how much of a line there is: `strength` gets `count` values from 0, nothing is drawn there, to 1, as all are
 * before. Opacity is multiplied by it. All else as for burin_line_shader. */
typedef int (*burin_line_test)(const burin_line_samples* samples, float* strength, void* user);

/** Adds a line shader: style sheets of the scene have it by `shader = "NAME"` in a style. It gets what the style's
 * width, offset, opacity and color say, and changes it; tapers, dashes and all else come after it. `name`: letters,
 * digits, _ and -; one that is there already gets the new callback. `variables`: those of docs/shading/variables.md
 * that it reads, "depth, N, light"; a triple such as N stands for its three columns N.x, N.y and N.z (a colour such as
 * C for C.r, C.g, C.b), each of which may also be named by itself; NULL: none. They are computed because it asks for
 * them, as if the style had them in an expression. `callback` NULL: takes the shader away.
 *
 * Drawings of burin_find_lines() keep the shaders that the scene had then; `callback` and `user` must last as long as
 * they do. */
BURIN_API int burin_add_line_shader(burin_scene* scene, const char* name, const char* variables,
                                    burin_line_shader callback, void* user);
/** Adds a line test: style sheets have it by `test = "NAME"` in a line set, and it weakens what that set draws. All
 * else as for burin_add_line_shader(). */
BURIN_API int burin_add_line_test(burin_scene* scene, const char* name, const char* variables, burin_line_test callback,
                                  void* user);

/* ---- files ---- */

/** A picture as the bytes of a file: the same that the program writes. `picture_or_drawing`: a burin_picture, or a
 * burin_drawing, which is drawn. `format`: "exr", "png", "png16", "tif", "tif16", the number is bits
 * per value; and of a drawing "svg", "pdf", "dxf".
 * `style`: as in burin_draw(); NULL for a picture. `bytes` and `count` get the file, to be freed by burin_bytes_free().
 */
BURIN_API int burin_encode(const void* picture_or_drawing, const char* format, const char* style, uint8_t** bytes,
                           uint64_t* count);
/** The same into a file, which appears under its name only when it is complete. `format` NULL: by the path's suffix. */
BURIN_API int burin_write(const void* picture_or_drawing, const char* format, const char* style, const char* path);
/** What the last burin_encode() or burin_write() of this thread that did not fail could not draw or say as it stands,
 * such as colours that vary along a path: note `index`, from 0, as the program prints it; NULL behind the last one,
 * which is no failure. Valid until the next of these calls on this thread. */
BURIN_API const char* burin_file_note(int index);
/** NULL is allowed. */
BURIN_API void burin_bytes_free(uint8_t* bytes);

#ifdef __cplusplus
}
#endif

#endif
