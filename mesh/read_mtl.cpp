#include "mesh/read_mtl.h"

#include <algorithm>
#include <cmath>

#include "base/mapped_file.h"
#include "mesh/model_path.h"
#include "mesh/text_scan.h"

namespace burin {
namespace {

using MaterialLibrary = std::map<std::string, Material, std::less<>>;

void read_material_file(const std::string& path, MaterialLibrary& library) {
    const MappedFile file(path);
    LineReader lines(without_byte_order_mark(file.bytes()));
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
                color = glm::clamp(color, 0.0, 1.0);
                if (!glm::any(glm::isnan(color))) current->color = glm::vec3(color);
            }
        } else if (keyword == "d" || keyword == "Tr") {
            double value = 1;
            if (scan.number(value) && !std::isnan(value)) {
                const double opacity = std::clamp(keyword == "d" ? value : 1 - value, 0.0, 1.0);
                current->opacity = static_cast<float>(opacity);
            }
        }
    }
}

}  // namespace

MaterialLibrary read_material_files(const std::string& obj_path,
                                    const std::vector<std::string>& file_names, std::vector<std::string>* files_read) {
    MaterialLibrary library;
    const auto read = [&](std::string_view name) {
        const std::string path = path_inside_model_folder(obj_path, name);
        if (path.empty()) return false;
        try {
            read_material_file(path, library);
            if (files_read != nullptr) files_read->push_back(path);
            return true;
        } catch (const InputError&) {
            // A missing material file is so common that it must not stop the drawing.
            return false;
        }
    };
    for (const std::string& names : file_names) {
        if (read(names)) continue;  // one name, perhaps with blanks in it
        LineScanner scan(names);
        for (std::string_view name = scan.word(); !name.empty(); name = scan.word()) read(name);
    }
    return library;
}

}  // namespace burin
