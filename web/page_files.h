#pragma once

#include <span>
#include <string_view>

// The page is compiled into the program.

namespace burin {

/// A file of the folder web/page. The one without a name is the page itself.
struct PageFile {
    std::string_view name, type, text;
};
std::span<const PageFile> page_files();

}  // namespace burin
