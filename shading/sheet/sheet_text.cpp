#include "shading/sheet/style_sheet.h"

namespace burin {
namespace {

[[noreturn]] void fail_at(const SourcePosition& where, bool is_from_command_line, const std::string& message) {
    if (is_from_command_line) throw UsageError(where.file + ": " + message);
    throw InputError(where, message);
}

}  // namespace

void SheetText::fail(std::size_t column, const std::string& message) const {
    if (first_column == 0) {
        fail_at(where, is_from_command_line,
                context + ", character " + std::to_string(skipped + column) + ": " + message);
    }
    fail_at({where.file, where.line, first_column + column - 1}, is_from_command_line, context + ": " + message);
}

void SheetText::fail(const std::string& message) const {
    fail_at(where, is_from_command_line, context + ": " + message);
}

LineClassSet classes_of(const StyleSheet& sheet) {
    LineClassSet classes;
    for (const LineSet& set : sheet.sets) {
        if (set.is_enabled) classes |= set.classes;
    }
    return classes;
}

}  // namespace burin
