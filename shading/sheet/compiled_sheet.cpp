#include "shading/sheet/compiled_sheet.h"

namespace burin {

CompiledSheet::CompiledSheet(const StyleSheet&, const SheetContext&) {
    throw InputError("style sheets cannot be compiled yet");
}

SetMatches CompiledSheet::match(const MatchInput&) const { return {}; }

}  // namespace burin
