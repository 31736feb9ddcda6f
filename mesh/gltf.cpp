#include "mesh/gltf.h"

#include <algorithm>
#include <array>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <optional>

#include "base/interrupt.h"
#include "base/mapped_file.h"
#include "mesh/gltf_buffers.h"
#include "mesh/gltf_container.h"
#include "mesh/gltf_json.h"

namespace burin {
namespace {

class GltfReader {
  public:
    explicit GltfReader(const std::string& path)
        : path_(path),
          file_(path),
          container_(split_gltf_container(path, file_.bytes())),
          json_(parse_gltf_json(path, container_.json)),
          root_(path_, json_, "") {}

    GltfScene read() {
        if (!json_.is_object() || !root_.has("asset")) {
            throw InputError(path_ + ": this is no glTF file (it has no 'asset')");
        }
        const auto asset = root_.at("asset");
        // A text, but a number in some files of glTF 1.0.
        const std::string version = asset.has("version") ? asset.at("version").text_or_number() : "2.0";
        if (!version.starts_with("2")) {
            throw InputError(path_ + ": glTF version " + printable(version) +
                             " is not read; re-export the model as glTF 2.0");
        }
        check_extensions();
        buffers_.emplace(path_, root_, container_.binary);
        read_materials();
        for (std::size_t i = 0; i < root_.size_of("meshes"); ++i) {
            read_mesh(root_.at("meshes").element(i));
        }
        walk_nodes();
        if (scene_.objects.empty()) {
            throw InputError(path_ + ": no node shows a mesh; burin draws the lines of surfaces");
        }
        buffers_->check_are_whole();
        scene_.buffer_files = buffers_->files();
        return std::move(scene_);
    }

  private:
    /// Extensions that change the geometry must be known; those about looks may be ignored.
    void check_extensions() const {
        for (std::size_t i = 0; i < root_.size_of("extensionsRequired"); ++i) {
            const std::string name = root_.at("extensionsRequired").element(i).text();
            const bool harmless = name == "KHR_mesh_quantization" ||
                                  name.starts_with("KHR_materials_") ||
                                  name.starts_with("KHR_texture_") || name.starts_with("EXT_texture_") ||
                                  name.starts_with("KHR_lights_") || name == "EXT_lights_image_based";
            if (!harmless) {
                throw InputError(path_ + ": needs the glTF extension " + printable(name, 80) +
                                 ", which burin cannot read; re-export the model without it");
            }
        }
    }

    void read_materials() {
        for (std::size_t i = 0; i < root_.size_of("materials"); ++i) {
            const JsonPlace place = root_.at("materials").element(i);
            Material material;
            material.name = place.text_or("name", "material" + std::to_string(i));
            material.color = glm::vec3(1.0f);
            if (place.has("pbrMetallicRoughness") &&
                place.at("pbrMetallicRoughness").has("baseColorFactor")) {
                const JsonPlace color = place.at("pbrMetallicRoughness").at("baseColorFactor");
                for (int c = 0; c < 3; ++c) {
                    const double value = color.element(static_cast<std::size_t>(c)).number();
                    material.color[c] = static_cast<float>(std::clamp(value, 0.0, 1.0));
                }
                if (place.text_or("alphaMode", "OPAQUE") == "BLEND" && color.size() > 3) {
                    material.opacity =
                        static_cast<float>(std::clamp(color.element(3).number(), 0.0, 1.0));
                }
            }
            scene_.materials.push_back(material);
        }
        scene_.materials.push_back(Material{.name = "default"});
    }

    void read_mesh(const JsonPlace& place) {
        PolygonSoup soup;
        const std::string name =
            place.text_or("name", "mesh" + std::to_string(scene_.meshes.size()));
        soup.object_names = {name};
        const JsonPlace primitives = place.at("primitives");
        known_positions_.clear();
        for (std::size_t i = 0; i < primitives.size(); ++i) {
            throw_if_interrupted();
            read_primitive(primitives.element(i), soup);
        }
        scene_.mesh_names.push_back(name);
        scene_.meshes.push_back(std::move(soup));
    }

    void read_primitive(const JsonPlace& place, PolygonSoup& soup) {
        const std::uint64_t mode = place.integer_or("mode", 4);
        if (mode > 6) place.fail("unknown mode " + std::to_string(mode));
        if (mode < 4 || !place.at("attributes").has("POSITION")) {
            ++scene_.skipped_primitives;
            return;
        }
        const PositionRange positions = read_positions(place.at("attributes").at("POSITION"), soup);
        const std::uint32_t material =
            place.has("material")
                ? place.at("material").index_below(scene_.materials.size() - 1, "material")
                : static_cast<std::uint32_t>(scene_.materials.size() - 1);
        add_triangles(place, mode, positions, soup);
        soup.polygon_material.resize(soup.polygon_count(), material);
    }

    /// Vertices [first, first + count) of a mesh.
    struct PositionRange {
        std::size_t first = 0;
        std::uint64_t count = 0;
    };

    /// Appends an accessor's vertices. Primitives of one mesh often share an accessor: then its
    /// vertices are there already.
    PositionRange read_positions(const JsonPlace& attribute, PolygonSoup& soup) {
        const std::uint32_t number = attribute.index_below(root_.size_of("accessors"), "accessor");
        const auto known = known_positions_.find(number);
        if (known != known_positions_.end()) return known->second;
        const GltfAccessor positions = buffers_->accessor(attribute, 3);
        const std::size_t first = soup.positions.size();
        if (first + positions.count > 0xFFFFFFFFu) attribute.fail("more than 4 billion vertices");
        soup.positions.reserve(first + positions.count);
        for (std::uint64_t i = 0; i < positions.count; ++i) {
            const glm::dvec3 p(positions.number(i, 0), positions.number(i, 1), positions.number(i, 2));
            if (!(std::abs(p.x) <= kLargestCoordinate && std::abs(p.y) <= kLargestCoordinate &&
                  std::abs(p.z) <= kLargestCoordinate)) {
                attribute.fail("vertex " + std::to_string(i) + " is not finite or beyond 1e30");
            }
            soup.positions.push_back(p);
        }
        return known_positions_[number] = {first, positions.count};
    }

    void add_triangles(const JsonPlace& place, std::uint64_t mode, const PositionRange& vertices,
                       PolygonSoup& soup) {
        GltfAccessor indices;
        const bool indexed = place.has("indices");
        if (indexed) {
            indices = buffers_->accessor(place.at("indices"), 1);
            indices.normalized = false;  // means nothing here
            if (indices.component_type == 5126) place.at("indices").fail("indices must be integers");
        }
        const std::uint64_t count = indexed ? indices.count : vertices.count;
        const auto vertex = [&](std::uint64_t i) {
            const double index = indexed ? indices.number(i, 0) : static_cast<double>(i);
            if (index < 0 || index >= static_cast<double>(vertices.count)) {
                place.at("indices").fail("vertex " + std::to_string(static_cast<std::int64_t>(index)) +
                                         " does not exist (there are " +
                                         std::to_string(vertices.count) + ")");
            }
            return static_cast<std::uint32_t>(vertices.first + static_cast<std::uint64_t>(index));
        };
        const std::uint64_t triangles = mode == 4 ? count / 3 : (count < 3 ? 0 : count - 2);
        if (soup.corners.size() + 3 * triangles > PolygonSoup::kMaxCorners) {
            place.fail("more than 4 billion polygon corners");
        }
        for (std::uint64_t t = 0; t < triangles; ++t) {
            std::array<std::uint64_t, 3> corner{};
            if (mode == 4) {
                corner = {3 * t, 3 * t + 1, 3 * t + 2};
            } else if (mode == 5) {  // strip: every second triangle is turned
                corner = {t + t % 2, t + 1 - t % 2, t + 2};
            } else {  // fan
                corner = {0, t + 1, t + 2};
            }
            for (const std::uint64_t c : corner) soup.corners.push_back(vertex(c));
        }
    }

    glm::dmat4 local_matrix(const JsonPlace& node) const {
        if (node.has("matrix")) {
            const JsonPlace numbers = node.at("matrix");
            if (numbers.size() != 16) numbers.fail("a matrix has 16 numbers");
            glm::dmat4 matrix;
            for (std::size_t i = 0; i < 16; ++i) {
                matrix[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = numbers.element(i).number();
            }
            return matrix;
        }
        const auto vector = [&](const char* key, glm::dvec4 value, std::size_t size) {
            if (!node.has(key)) return value;
            const JsonPlace numbers = node.at(key);
            if (numbers.size() != size) numbers.fail("needs " + std::to_string(size) + " numbers");
            for (std::size_t i = 0; i < size; ++i) value[static_cast<int>(i)] = numbers.element(i).number();
            return value;
        };
        const glm::dvec4 t = vector("translation", glm::dvec4(0.0), 3);
        const glm::dvec4 r = vector("rotation", glm::dvec4(0.0, 0.0, 0.0, 1.0), 4);
        const glm::dvec4 s = vector("scale", glm::dvec4(1.0), 3);
        glm::dmat4 matrix = glm::mat4_cast(glm::dquat(r.w, r.x, r.y, r.z));
        for (int axis = 0; axis < 3; ++axis) matrix[axis] *= s[axis];
        matrix[3] = glm::dvec4(t.x, t.y, t.z, 1.0);
        return matrix;
    }

    /// Visits the nodes of the default scene. Each node has one place in the tree: a second visit
    /// is a cycle, or a node with two parents, which glTF forbids.
    void walk_nodes() {
        const std::size_t node_count = root_.size_of("nodes");
        std::vector<bool> visited(node_count, false);
        struct Pending {
            std::uint32_t node;
            glm::dmat4 parent;
        };
        std::vector<Pending> pending;
        const auto push_list = [&](const JsonPlace& list, const glm::dmat4& parent) {
            for (std::size_t i = list.size(); i-- > 0;) {  // the first one ends up on top
                pending.push_back({list.element(i).index_below(node_count, "node"), parent});
            }
        };
        push_roots(push_list, node_count, pending);
        while (!pending.empty()) {
            const Pending next = pending.back();
            pending.pop_back();
            const JsonPlace node = root_.at("nodes").element(next.node);
            if (visited[next.node]) {
                node.fail("the node is reached twice: it is its own ancestor or has two parents");
            }
            visited[next.node] = true;
            const glm::dmat4 to_world = next.parent * local_matrix(node);
            for (int i = 0; i < 16; ++i) {
                if (std::abs(to_world[i / 4][i % 4]) <= kLargestCoordinate) continue;
                node.fail("its transform, with those of its parents, is not finite or beyond 1e30");
            }
            const std::string name = node.text_or("name", "node" + std::to_string(next.node));
            if (node.has("mesh")) {
                const std::uint32_t mesh = node.at("mesh").index_below(scene_.meshes.size(), "mesh");
                scene_.objects.push_back({name, mesh, to_world});
            }
            if (node.has("camera")) read_camera(node, name, to_world);
            if (node.has("children")) push_list(node.at("children"), to_world);
        }
    }

    template <typename PushList, typename Pending>
    void push_roots(const PushList& push_list, std::size_t node_count, std::vector<Pending>& pending) {
        const std::size_t scene_count = root_.size_of("scenes");
        if (scene_count > 0) {
            const std::uint32_t number =
                root_.has("scene") ? root_.at("scene").index_below(scene_count, "scene") : 0;
            const JsonPlace scene = root_.at("scenes").element(number);
            if (scene.has("nodes")) push_list(scene.at("nodes"), glm::dmat4(1.0));
            return;
        }
        // Without scenes, every node without a parent is a root.
        std::vector<bool> is_child(node_count, false);
        for (std::size_t i = 0; i < node_count; ++i) {
            const JsonPlace node = root_.at("nodes").element(i);
            for (std::size_t k = 0; k < node.size_of("children"); ++k) {
                is_child[node.at("children").element(k).index_below(node_count, "node")] = true;
            }
        }
        for (std::size_t i = node_count; i-- > 0;) {
            if (!is_child[i]) pending.push_back({static_cast<std::uint32_t>(i), glm::dmat4(1.0)});
        }
    }

    void read_camera(const JsonPlace& node, const std::string& node_name, const glm::dmat4& to_world) {
        const std::uint32_t number =
            node.at("camera").index_below(root_.size_of("cameras"), "camera");
        const JsonPlace place = root_.at("cameras").element(number);
        GltfCamera camera;
        camera.name = place.text_or("name", node_name);
        camera.to_world = to_world;
        if (place.at("type").text() == "orthographic") {
            camera.orthographic = true;
            camera.height = 2 * place.at("orthographic").at("ymag").number();
        } else {
            camera.fov_deg = glm::degrees(place.at("perspective").at("yfov").number());
        }
        scene_.cameras.push_back(camera);
    }

    std::string path_;
    MappedFile file_;
    GltfContainer container_;
    nlohmann::json json_;
    JsonPlace root_;
    std::optional<GltfBuffers> buffers_;
    std::map<std::uint32_t, PositionRange> known_positions_;  // by accessor; of the mesh being read
    GltfScene scene_;
};

}  // namespace

GltfScene read_gltf(const std::string& path) { return GltfReader(path).read(); }

}  // namespace burin
