#include "cli/output_files.h"

#include <sys/stat.h>

#include <filesystem>
#include <map>
#include <utility>

#include "base/error.h"

namespace burin {

bool has_frame_pattern(const std::string& name) {
    if (name.find("##") != std::string::npos) return true;
    const auto is_digit = [&](std::size_t i) { return i < name.size() && name[i] >= '0' && name[i] <= '9'; };
    for (std::size_t i = 0; i < name.size(); ++i) {
        if (name.compare(i, 2, "$F") == 0 && is_digit(i + 2)) return true;
        if (name[i] != '%' || !is_digit(i + 1)) continue;
        std::size_t end = i + 1;
        while (is_digit(end)) ++end;
        if (end < name.size() && name[end] == 'd') return true;
    }
    return false;
}

bool is_one_file(const std::string& a, const std::string& b) {
    namespace fs = std::filesystem;
    std::error_code error;
    if (a == b || fs::equivalent(a, b, error)) return true;
    const fs::path whole_a = fs::weakly_canonical(fs::absolute(a, error), error);
    if (error) return false;
    const fs::path whole_b = fs::weakly_canonical(fs::absolute(b, error), error);
    return !error && whole_a == whole_b;
}

void refuse_to_overwrite(const std::vector<OutputFile>& outputs, const std::vector<std::string>& inputs) {
    std::map<std::pair<dev_t, ino_t>, const OutputFile*> files;
    struct stat info {};
    for (const OutputFile& output : outputs) {
        if (::stat(output.path.c_str(), &info) == 0) files.emplace(std::pair(info.st_dev, info.st_ino), &output);
    }
    if (files.empty()) return;
    for (const std::string& input : inputs) {
        if (::stat(input.c_str(), &info) != 0) continue;
        const auto found = files.find({info.st_dev, info.st_ino});
        if (found == files.end()) continue;
        throw UsageError(found->second->option + ": would overwrite " + input + "; give another name");
    }
}

}  // namespace burin
