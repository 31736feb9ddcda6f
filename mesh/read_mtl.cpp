#include "mesh/read_mtl.h"

#include <algorithm>
#include <filesystem>

#include "base/mapped_file.h"
#include "mesh/model_path.h"
#include "mesh/text_scan.h"

namespace burin {
namespace {

using MaterialLibrary = std::map<std::string, Material, std::less<>>;

void read_material_file(const std::string& path, MaterialLibrary& library) {
    const MappedFile file(path);
    LineReader lines(file.bytes());
    Material* current = nullptr;
    std::string_view line;
    while (lines.next(line)) {
        LineScanner scan(line);
        const std::string_view keyword = scan.word();
        if (keyword == "newmtl") {
            const std::string name(scan.rest());
            current = &library[name];
            current->name = name;
        } else if (current == nullptr) {
            continue;
        } else if (keyword == "Kd") {
            glm::dvec3 color;
            if (scan.number(color.r) && scan.number(color.g) && scan.number(color.b)) {
                current->color = glm::clamp(glm::vec3(color), 0.0f, 1.0f);
            }
        } else if (keyword == "d" || keyword == "Tr") {
            double value = 1;
            if (scan.number(value)) {
                const double opacity = std::clamp(keyword == "d" ? value : 1 - value, 0.0, 1.0);
                current->opacity = static_cast<float>(opacity);
            }
        }
    }
}

}  // namespace

MaterialLibrary read_material_files(const std::string& obj_path,
                                    const std::vector<std::string>& file_names) {
    MaterialLibrary library;
    for (const std::string& name : file_names) {
        const std::string path = path_inside_model_folder(obj_path, name);
        if (path.empty()) continue;
        try {
            read_material_file(path, library);
        } catch (const InputError&) {
            // A missing material file is so common that it must not stop the drawing.
            continue;
        }
    }
    return library;
}

}  // namespace burin
