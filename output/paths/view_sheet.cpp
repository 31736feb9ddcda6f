#include "output/paths/view_sheet.h"

#include <algorithm>
#include <utility>

namespace burin {
namespace {

bool is_below(const VectorGroup& a, const VectorGroup& b) {
    if (a.is_surface != b.is_surface) return a.is_surface;
    if (a.is_hidden != b.is_hidden) return a.is_hidden;
    return a.invisibility > b.invisibility;
}

}  // namespace

void add_view(VectorDrawing view, const std::string& name, VectorDrawing& sheet) {
    if (sheet.views.empty()) {
        sheet = view;
        sheet.steps.clear();
        sheet.edges.clear();
        sheet.paths.clear();
        sheet.groups.clear();
        sheet.styles.clear();
    }
    sheet.views.push_back(name);
    const bool is_sorted = std::is_sorted(view.groups.begin(), view.groups.end(), is_below) &&
                           std::is_sorted(sheet.groups.begin(), sheet.groups.end(), is_below);
    const auto first_path = sheet.paths.size(), first_step = sheet.steps.size(), first_edge = sheet.edges.size();
    const auto first_style = static_cast<std::uint32_t>(sheet.styles.size());
    for (VectorPath& path : view.paths) {
        path.first_step += first_step;
        path.first_edge += first_edge;
        path.style += first_style;
    }
    for (VectorGroup& group : view.groups) {
        group.first_path += first_path;
        group.view = static_cast<std::uint32_t>(sheet.views.size());
    }
    const auto add = [](auto& to, auto& from) {
        to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
    };
    add(sheet.steps, view.steps);
    add(sheet.edges, view.edges);
    add(sheet.paths, view.paths);
    add(sheet.styles, view.styles);
    add(sheet.groups, view.groups);
    if (is_sorted) std::stable_sort(sheet.groups.begin(), sheet.groups.end(), is_below);
}

}  // namespace burin
