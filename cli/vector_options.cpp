#include "cli/vector_options.h"

#include "cli/option_values.h"

namespace burin {

using namespace option_values;

void fill_vector_options(const VectorTexts& t, Arguments& a) {
    if (!t.tolerance.empty()) {
        a.tolerance_px = number("--tolerance", t.tolerance);
        if (!(a.tolerance_px >= 0.001 && a.tolerance_px <= 10)) fail("--tolerance", "must be from 0.001 to 10 pixels");
    }
    a.chord_sag_px = a.tolerance_px;
    if (!t.chord_sag.empty()) {
        a.chord_sag_px = number("--chord-sag", t.chord_sag);
        if (!(a.chord_sag_px >= 0 && a.chord_sag_px <= 10)) fail("--chord-sag", "must be from 0 to 10 pixels");
    }
    if (!t.dashes.empty() && t.dashes != "pattern" && t.dashes != "real") fail("--dashes", "must be pattern or real");
    a.cuts_dashes = t.dashes.empty() ? page_of(a.page).cuts_dashes : t.dashes == "real";
    if (t.group == "object") {
        a.grouping = VectorGrouping::object;
    } else if (t.group == "qi") {
        a.grouping = VectorGrouping::invisibility;
    } else if (!t.group.empty() && t.group != "class") {
        fail("--group", "must be class, object or qi");
    }
    if (!t.ids.empty() && t.ids != "all" && t.ids != "none") fail("--ids", "must be all or none");
    a.names_paths = t.ids != "none";
    a.merges_paths = t.merge;
    a.has_vector_options = t.merge || !(t.tolerance.empty() && t.chord_sag.empty() && t.dashes.empty() &&
                                        t.group.empty() && t.ids.empty());
}

}  // namespace burin
