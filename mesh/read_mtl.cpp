#include "mesh/read_mtl.h"

#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>
#include <utility>

#include "base/interrupt.h"
#include "base/mapped_file.h"
#include "mesh/model_path.h"
#include "mesh/text_scan.h"

namespace burin {
namespace {

using MaterialLibrary = std::map<std::string, Material, std::less<>>;

/// Statements that are left out, and where the first one is.
struct Misunderstood {
    std::size_t count = 0;
    SourcePosition first;

    void add(const std::string& path, std::size_t line) {
        if (count++ == 0) first = {path, line};
    }
};

/// The next statement: lines that end in a backslash go on in the next one. False at the end.
bool next_statement(LineReader& lines, std::string_view& statement, std::string& joined) {
    if (!lines.next(statement)) return false;
    if (!statement.ends_with('\\')) return true;
    joined.clear();
    bool has_more = true;
    while (has_more && statement.ends_with('\\')) {
        joined.append(statement.substr(0, statement.size() - 1)).append(" ");
        has_more = lines.next(statement);
    }
    if (has_more) joined.append(statement);
    statement = joined;
    return true;
}

/// The file that a statement for a texture names: the last word behind options, or all, for names have blanks.
std::string_view texture_name(std::string_view arguments) {
    if (!arguments.starts_with('-')) return arguments;
    const std::size_t blank = arguments.find_last_of(" \t");
    return blank == std::string_view::npos ? std::string_view() : arguments.substr(blank + 1);
}

bool names_texture(std::string_view keyword) {
    return keyword.starts_with("map_") || keyword == "bump" || keyword == "disp" || keyword == "decal" ||
           keyword == "refl" || keyword == "norm";
}

/// `textures`: gets the names of pictures, which are not read.
void read_material_file(const std::string& path, MaterialLibrary& library, Misunderstood& misunderstood,
                        std::set<std::string>& textures) {
    const MappedFile file(path);
    if (file.bytes().starts_with("\xFF\xFE") || file.bytes().starts_with("\xFE\xFF"))
        throw InputError(path + ": the text is UTF-16");
    LineReader lines(without_byte_order_mark(file.bytes()));
    std::string joined;
    Material* current = nullptr;
    bool has_dissolve = false;
    std::string_view line;
    while (next_statement(lines, line, joined)) {
        if ((lines.line_number() & 0xFFFF) == 0) throw_if_interrupted();
        LineScanner scan(line);
        const std::string keyword = lower_case(scan.word());
        if (keyword == "newmtl") {
            const std::string name(scan.rest());
            current = &library[name];
            current->name = name;
            has_dissolve = false;
        } else if (current == nullptr) {
            continue;
        } else if (keyword == "kd") {
            glm::dvec3 color;
            if (scan.number(color.r) && scan.number(color.g) && scan.number(color.b)) {
                color = glm::clamp(color, 0.0, 1.0);
                if (!glm::any(glm::isnan(color))) {
                    current->color = glm::vec3(color);
                    continue;
                }
            }
            misunderstood.add(path, lines.line_number());
        } else if (keyword == "d" || keyword == "tr") {
            // "d -halo 0.5" depends on the direction of view; it is no opacity of a surface.
            double value = 1;
            const bool is_dissolve = keyword == "d";
            const bool is_number = scan.number(value) && !std::isnan(value);
            if (!is_number || value < 0 || value > 1) misunderstood.add(path, lines.line_number());
            if (!is_number) continue;
            if (has_dissolve && !is_dissolve) continue;
            has_dissolve = is_dissolve;
            const double opacity = is_dissolve ? value : value < 1 ? 1 - value : 1;
            current->opacity = static_cast<float>(std::clamp(opacity, 0.0, 1.0));
        } else if (names_texture(keyword)) {
            textures.emplace(texture_name(scan.rest()));
        }
    }
}

/// Reads the material files of an OBJ, each once, by whatever names it is called.
class MaterialFiles {
  public:
    MaterialFiles(const std::string& obj_path, OtherFiles* files) : obj_path_(obj_path), files_(files) {
        folder_ = std::filesystem::path(obj_path).parent_path().string();
        if (folder_.empty()) folder_ = ".";
        if (const auto obj = file_at(obj_path)) outcomes_[*obj] = false;
    }

    /// Reads a file; returns false if there is no such file, or it is none to be read.
    bool read(std::string_view name) {
        if ((++tries_ & 0xFF) == 0) throw_if_interrupted();
        if (const auto known = names_.find(name); known != names_.end()) return known->second;
        return names_.emplace(std::string(name), read_new(std::string(name))).first->second;
    }
    MaterialLibrary take() { return std::move(library_); }
    const Misunderstood& misunderstood() const { return misunderstood_; }

  private:
    using FileNumber = std::pair<dev_t, ino_t>;

    static std::optional<FileNumber> file_at(const std::string& path) {
        struct stat info {};
        if (::stat(path.c_str(), &info) != 0 || !S_ISREG(info.st_mode)) return std::nullopt;
        return FileNumber(info.st_dev, info.st_ino);
    }

    bool read_new(const std::string& name) {
        if (name.find('\0') != std::string::npos || !may_exist(name)) return false;
        const auto file = file_at(folder_ + "/" + name);  // first, as the other steps take longer
        if (!file) {
            ++missing_;
            return false;
        }
        const auto [outcome, is_new] = outcomes_.try_emplace(*file, false);
        if (is_new) outcome->second = read_file(path_inside_model_folder(obj_path_, name));
        return outcome->second;
    }
    /// Where very many files are missing, their names are looked for in a list of what the folder
    /// holds: asking the system for each takes seconds.
    bool may_exist(const std::string& name) {
        constexpr std::size_t kManyMissing = 256;
        if (missing_ < kManyMissing) return true;
        if (entries_.empty()) {
            std::error_code error;
            for (std::filesystem::directory_iterator it(folder_, error), end; !error && it != end;
                 it.increment(error)) {
                entries_.insert(it->path().filename().string());
            }
            entries_.insert({"", ".", ".."});
        }
        return entries_.contains(name.substr(0, name.find('/')));
    }
    bool read_file(const std::string& path) {
        if (path.empty()) return false;
        if (files_ != nullptr) files_->read.push_back(path);
        try {
            std::set<std::string> textures;
            read_material_file(path, library_, misunderstood_, textures);
            add_textures(path, textures);
            return true;
        } catch (const InputError&) {
            // A missing material file is so common that it must not stop the drawing.
            return false;
        }
    }

    void add_textures(const std::string& path, const std::set<std::string>& textures) {
        if (files_ == nullptr) return;
        const std::filesystem::path folder = std::filesystem::path(path).parent_path();
        for (std::string name : textures) {
            if (name.empty() || name.find('\0') != std::string::npos) continue;
            std::replace(name.begin(), name.end(), '\\', '/');  // as it is written on Windows
            files_->pictures.push_back((folder / name).string());
        }
    }

    const std::string& obj_path_;
    OtherFiles* files_;
    std::string folder_;
    MaterialLibrary library_;
    Misunderstood misunderstood_;
    std::map<std::string, bool, std::less<>> names_;  // whether it names a file that was read
    std::map<FileNumber, bool> outcomes_;
    std::set<std::string> entries_;  // of the folder; empty: not looked at
    std::size_t tries_ = 0, missing_ = 0;
};

}  // namespace

MaterialLibrary read_material_files(const std::string& obj_path, const std::vector<std::string>& file_names,
                                    OtherFiles* other_files, std::vector<std::string>* notes) {
    MaterialFiles files(obj_path, other_files);
    std::size_t unread = 0;
    std::string first_unread;
    for (const std::string& names : file_names) {
        if (files.read(names)) continue;  // one name, perhaps with blanks in it
        LineScanner scan(names);
        bool is_any_read = false;
        for (std::string_view name = scan.word(); !name.empty(); name = scan.word())
            is_any_read = files.read(name) || is_any_read;
        if (!is_any_read && unread++ == 0) first_unread = names;
    }
    if (notes != nullptr && unread > 0) {
        notes->push_back("material files that are not read: " + std::to_string(unread) + "; the first one is '" +
                         printable(first_unread) + "'; materials have the default colour");
    }
    if (const Misunderstood& wrong = files.misunderstood(); notes != nullptr && wrong.count > 0) {
        notes->push_back("values of Kd, d and Tr that are not understood: " + std::to_string(wrong.count) +
                         "; the first one is at " + to_string(wrong.first));
    }
    return files.take();
}

}  // namespace burin
