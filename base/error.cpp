#include "base/error.h"

namespace burin {

std::string to_string(const SourcePosition& position) {
    std::string text = position.file;
    if (position.line > 0) text += ":" + std::to_string(position.line);
    if (position.line > 0 && position.column > 0) text += ":" + std::to_string(position.column);
    return text;
}

}  // namespace burin
