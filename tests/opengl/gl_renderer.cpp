#include "tests/opengl/gl_renderer.h"

#define GL_GLEXT_PROTOTYPES
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/glcorearb.h>

#include <algorithm>
#include <stdexcept>

namespace burin::test {
namespace {

[[noreturn]] void fail(const std::string& what) { throw std::runtime_error("OpenGL: " + what); }

/// Window row 0 is the top of the picture: y is turned here, so that OpenGL's rules for ties see
/// the picture as the rasterizers under test do.
constexpr const char* kVertexShader = R"(#version 450 core
layout(location = 0) in vec3 position;
uniform mat4 to_clip;
void main() { gl_Position = to_clip * vec4(position, 1) * vec4(1, -1, 1, 1); }
)";

constexpr const char* kFlatShader = R"(#version 450 core
uniform float line;
out vec4 color;
void main() { color = vec4(line); }
)";

/// Single-pass wireframe rendering, Baerentzen et al., SIGGRAPH 2006 sketch: at each corner the
/// height over the opposite edge, interpolated linearly on the screen.
constexpr const char* kHeightsShader = R"(#version 450 core
layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;
uniform vec2 half_viewport;
noperspective out vec3 distances;
void main() {
    vec2 p[3];
    for (int k = 0; k < 3; ++k) p[k] = half_viewport * gl_in[k].gl_Position.xy / gl_in[k].gl_Position.w;
    vec2 u = p[1] - p[0], v = p[2] - p[0];
    float area = abs(u.x * v.y - u.y * v.x);
    for (int k = 0; k < 3; ++k) {
        distances = vec3(0);
        distances[k] = area / length(p[(k + 2) % 3] - p[(k + 1) % 3]);
        gl_Position = gl_in[k].gl_Position;
        EmitVertex();
    }
    EndPrimitive();
}
)";

constexpr const char* kDistanceShader = R"(#version 450 core
noperspective in vec3 distances;
out vec4 color;
void main() {
    float d = min(distances.x, min(distances.y, distances.z));
    color = vec4(exp2(-2 * d * d));
}
)";

GLuint compile(GLenum type, const char* text) {
    const GLuint shader = glCreateShader(type);
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    GLint ok = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (ok == 0) {
        char log[1000] = "";
        glGetShaderInfoLog(shader, sizeof log, nullptr, log);
        fail(log);
    }
    return shader;
}

GLuint link(const std::vector<GLuint>& shaders) {
    const GLuint program = glCreateProgram();
    for (const GLuint shader : shaders) glAttachShader(program, shader);
    glLinkProgram(program);
    for (const GLuint shader : shaders) glDeleteShader(shader);
    GLint ok = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &ok);
    if (ok == 0) fail("a program does not link");
    return program;
}

/// Polygons as triangles and as lines, in one buffer of indices.
struct Batches {
    struct Range {
        GLsizei count;
        std::size_t first;
        const void* offset() const { return reinterpret_cast<const void*>(first * sizeof(std::uint32_t)); }
    };
    std::vector<std::uint32_t> indices;
    std::vector<Range> triangles, lines;  // per polygon

    explicit Batches(const GlMesh& mesh) {
        for (const auto& p : mesh.polygons) {
            const std::size_t first = indices.size();
            for (std::size_t k = 2; k < p.size(); ++k) indices.insert(indices.end(), {p[0], p[k - 1], p[k]});
            triangles.push_back({static_cast<GLsizei>(indices.size() - first), first});
        }
        for (const auto& p : mesh.polygons) {
            const std::size_t first = indices.size();
            for (std::size_t k = 0; k < p.size(); ++k) {
                const auto [a, b] = std::minmax(p[k], p[(k + 1) % p.size()]);
                indices.insert(indices.end(), {a, b});
            }
            lines.push_back({static_cast<GLsizei>(indices.size() - first), first});
        }
    }
};

}  // namespace

struct GlRenderer::Context {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
    GLuint flat_program = 0, distance_program = 0;

    Context() {
        const auto get_display =
            reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
        if (get_display == nullptr) fail("EGL has no eglGetPlatformDisplayEXT");
        display = get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE) {
            fail("no surfaceless display; install libgl1-mesa-dri and libegl-mesa0");
        }
        eglBindAPI(EGL_OPENGL_API);
        const EGLint attributes[] = {
            EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
        context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
        if (context == EGL_NO_CONTEXT ||
            eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_FALSE) {
            fail("no context of version 4.5");
        }
        const auto vertex = [] { return compile(GL_VERTEX_SHADER, kVertexShader); };
        flat_program = link({vertex(), compile(GL_FRAGMENT_SHADER, kFlatShader)});
        distance_program =
            link({vertex(), compile(GL_GEOMETRY_SHADER, kHeightsShader), compile(GL_FRAGMENT_SHADER, kDistanceShader)});
    }
    ~Context() {
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display, context);
        eglTerminate(display);
    }

    void use(GLuint program, const glm::mat4& to_clip) const {
        glUseProgram(program);
        glUniformMatrix4fv(glGetUniformLocation(program, "to_clip"), 1, GL_FALSE, &to_clip[0][0]);
    }
    void draw_triangles(const Batches::Range& range) const {
        glUniform1f(glGetUniformLocation(flat_program, "line"), 0);
        glDrawElements(GL_TRIANGLES, range.count, GL_UNSIGNED_INT, range.offset());
    }
    void draw_lines(const Batches::Range& range) const {
        glUniform1f(glGetUniformLocation(flat_program, "line"), 1);
        glDrawElements(GL_LINES, range.count, GL_UNSIGNED_INT, range.offset());
    }

    void draw_simple(const Batches& batches, bool offset) const {
        if (offset) glEnable(GL_POLYGON_OFFSET_FILL);
        glPolygonOffset(1, 1);
        glDepthFunc(GL_LESS);
        for (const auto& range : batches.triangles) draw_triangles(range);
        glDisable(GL_POLYGON_OFFSET_FILL);
        glDepthFunc(GL_LEQUAL);
        for (const auto& range : batches.lines) draw_lines(range);
    }

    /// Herrell, Baldwin, Wilcox 1995, their OpenGL form.
    void draw_stencil(const Batches& batches) const {
        glEnable(GL_STENCIL_TEST);
        for (std::size_t i = 0; i < batches.triangles.size(); ++i) {
            glDepthFunc(GL_LESS);
            glStencilFunc(GL_ALWAYS, 1, 1);
            glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
            draw_triangles(batches.triangles[i]);
            glDepthFunc(GL_LEQUAL);
            glStencilFunc(GL_NOTEQUAL, 1, 1);
            glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
            draw_lines(batches.lines[i]);
            glDepthFunc(GL_ALWAYS);
            glStencilFunc(GL_EQUAL, 1, 1);
            draw_lines(batches.lines[i]);
            glDepthFunc(GL_NEVER);
            glStencilFunc(GL_ALWAYS, 0, 1);
            glStencilOp(GL_KEEP, GL_REPLACE, GL_KEEP);
            draw_triangles(batches.triangles[i]);
        }
        glDisable(GL_STENCIL_TEST);
    }
};

GlRenderer::GlRenderer() : context_(std::make_unique<Context>()) {}
GlRenderer::~GlRenderer() = default;

std::string GlRenderer::description() const {
    const auto text = [](GLenum name) { return std::string(reinterpret_cast<const char*>(glGetString(name))); };
    return text(GL_RENDERER) + ", OpenGL " + text(GL_VERSION);
}

std::vector<float> GlRenderer::line_alpha(const GlMesh& mesh, const glm::mat4& to_clip, int width, int height,
                                          GlMethod method) {
    const Batches batches(mesh);
    GLuint frame_buffer = 0, images[2] = {}, array = 0, buffers[2] = {};
    glGenFramebuffers(1, &frame_buffer);
    glBindFramebuffer(GL_FRAMEBUFFER, frame_buffer);
    glGenRenderbuffers(2, images);
    glBindRenderbuffer(GL_RENDERBUFFER, images[0]);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA32F, width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, images[0]);
    glBindRenderbuffer(GL_RENDERBUFFER, images[1]);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, images[1]);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) fail("the frame buffer is incomplete");

    glGenVertexArrays(1, &array);
    glBindVertexArray(array);
    glGenBuffers(2, buffers);
    glBindBuffer(GL_ARRAY_BUFFER, buffers[0]);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.positions.size() * sizeof(glm::vec3)),
                 mesh.positions.data(), GL_STATIC_DRAW);
    glEnableVertexAttribArray(0);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(batches.indices.size() * sizeof(std::uint32_t)),
                 batches.indices.data(), GL_STATIC_DRAW);

    glViewport(0, 0, width, height);
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    if (method == GlMethod::single_pass) {
        const GLuint program = context_->distance_program;
        context_->use(program, to_clip);
        glUniform2f(glGetUniformLocation(program, "half_viewport"), 0.5f * static_cast<float>(width),
                    0.5f * static_cast<float>(height));
        for (const auto& range : batches.triangles) {
            glDrawElements(GL_TRIANGLES, range.count, GL_UNSIGNED_INT, range.offset());
        }
    } else {
        context_->use(context_->flat_program, to_clip);
        if (method == GlMethod::stencil) {
            context_->draw_stencil(batches);
        } else {
            context_->draw_simple(batches, method == GlMethod::slope_offset);
        }
    }
    std::vector<float> result(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width, height, GL_RED, GL_FLOAT, result.data());
    const GLenum error = glGetError();
    glDeleteBuffers(2, buffers);
    glDeleteVertexArrays(1, &array);
    glDeleteRenderbuffers(2, images);
    glDeleteFramebuffers(1, &frame_buffer);
    if (error != GL_NO_ERROR) fail("error " + std::to_string(error));
    return result;
}

}  // namespace burin::test
