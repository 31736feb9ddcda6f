#include "cli/output_files.h"

#include <sys/stat.h>

#include <filesystem>
#include <map>
#include <utility>

#include "base/error.h"
#include "base/interrupt.h"

namespace burin {

bool is_one_file(const std::string& a, const std::string& b) {
    namespace fs = std::filesystem;
    std::error_code error;
    if (a == b || fs::equivalent(a, b, error)) return true;
    const fs::path whole_a = fs::weakly_canonical(fs::absolute(a, error), error);
    if (error) return false;
    const fs::path whole_b = fs::weakly_canonical(fs::absolute(b, error), error);
    return !error && whole_a == whole_b;
}

void refuse_same_files(const std::vector<OutputFile>& outputs) {
    const auto refuse = [](const OutputFile& output, const OutputFile& other) {
        throw UsageError(output.option + ": would overwrite " + other.path + ", which " + other.option +
                         " writes; give another name");
    };
    std::map<std::string, std::vector<const OutputFile*>> by_name;    // in whatever folder
    std::map<std::pair<dev_t, ino_t>, const OutputFile*> that_exist;  // links may have any name
    for (const OutputFile& output : outputs) {
        std::vector<const OutputFile*>& known = by_name[std::filesystem::path(output.path).filename().string()];
        for (const OutputFile* other : known) {
            if (is_one_file(other->path, output.path)) refuse(output, *other);
        }
        known.push_back(&output);
        struct stat info {};
        if (stat(output.path.c_str(), &info) != 0 || !S_ISREG(info.st_mode)) continue;
        const auto [place, is_new] = that_exist.try_emplace({info.st_dev, info.st_ino}, &output);
        if (!is_new) refuse(output, *place->second);
    }
}

void refuse_to_overwrite(const std::vector<OutputFile>& outputs, const std::vector<std::string>& inputs) {
    std::map<std::pair<dev_t, ino_t>, const OutputFile*> files;
    struct stat info {};
    for (const OutputFile& output : outputs) {
        if (::stat(output.path.c_str(), &info) == 0) files.emplace(std::pair(info.st_dev, info.st_ino), &output);
    }
    if (files.empty()) return;
    for (const std::string& input : inputs) {
        throw_if_interrupted();
        if (::stat(input.c_str(), &info) != 0) continue;
        const auto found = files.find({info.st_dev, info.st_ino});
        if (found == files.end()) continue;
        throw UsageError(found->second->option + ": would overwrite " + input + "; give another name");
    }
}

}  // namespace burin
