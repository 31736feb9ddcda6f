#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace burin {

/// Collects the objects of a PDF file, and writes them with the table of their places.
class PdfFile {
  public:
    /// Numbers are from 1. An object may be referred to before it is set.
    std::size_t reserve() {
        objects_.emplace_back();
        return objects_.size();
    }
    void set(std::size_t number, std::string object) { objects_[number - 1] = std::move(object); }
    std::size_t add(std::string object) {
        objects_.push_back(std::move(object));
        return objects_.size();
    }
    /// `entries`: of its dictionary, beside the length.
    std::size_t add_stream(std::string_view bytes, const std::string& entries, bool is_compressed);

    /// `minor_version`: of version 1.
    std::string text(int minor_version, std::size_t root, std::size_t info) const;

    static std::string reference(std::size_t number) { return std::to_string(number) + " 0 R"; }
    /// A text string: names of objects and layers. What is no UTF-8 becomes U+FFFD.
    static std::string text_string(std::string_view utf8);

  private:
    std::vector<std::string> objects_;
};

}  // namespace burin
