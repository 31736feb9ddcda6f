#include "cli/page_options.h"

#include <algorithm>

#include "cli/option_values.h"

namespace burin {
namespace {

using namespace option_values;

void fill_page(const std::string& name, Arguments& a) {
    if (name.empty()) return;
    const auto* const page =
        std::find_if(std::begin(kPages) + 1, std::end(kPages), [&](const Page& p) { return p.name == name; });
    if (page == std::end(kPages)) fail("--page", "must be iso128, patent, plotter or laser");
    a.page = page->preset;
    if (a.style.empty()) {
        a.style = page->style;
        a.has_style_of_page = true;
        // What is given by --set is stronger.
        std::vector<Override> settings;
        for (const PageSetting& s : page->settings) settings.push_back({std::string(s.key), std::string(s.value)});
        a.overrides.insert(a.overrides.begin(), settings.begin(), settings.end());
    }
}

std::array<double, 4> margins(const std::string& text) {
    const auto parts = split(text, text.find(',') == std::string::npos ? ' ' : ',');
    std::array<double, 4> margin{};
    if (parts.size() != 1 && parts.size() != 4) {
        fail("--margin", "must be one number or TOP,RIGHT,BOTTOM,LEFT in mm, got '" + printable(text) + "'");
    }
    for (std::size_t i = 0; i < 4; ++i) {
        margin[i] = number("--margin", parts[parts.size() == 1 ? 0 : i]);
        if (!(margin[i] >= 0 && margin[i] <= 5000)) fail("--margin", "must be from 0 to 5000 mm");
    }
    return margin;
}

void fill_paper(const PageTexts& t, Arguments& a) {
    if (!t.paper.empty()) {
        a.paper_mm = paper_named(t.paper);
        if (!a.paper_mm) fail("--paper", "'" + printable(t.paper) + "' is none of " + names_of_papers());
    }
    if (!t.dpi.empty()) {
        a.dpi = number("--dpi", t.dpi);
        if (!(*a.dpi >= 1 && *a.dpi <= 100000)) fail("--dpi", "must be from 1 to 100000 pixels per inch");
    }
    if (a.dpi && (a.paper_mm || a.page != PagePreset::none)) {
        fail("--dpi", std::string("cannot stand beside ") + (a.paper_mm ? "--paper" : "--page") +
                          ": the size of paper and that in pixels (-r) say it; remove one");
    }
    if (!t.margin.empty()) a.margin_mm = margins(t.margin);
    if (!t.scale.empty()) {
        a.scale = scale_named(t.scale);
        if (!a.scale) fail("--scale", "must be a scale like 1:2 or 5:1, got '" + printable(t.scale) + "'");
        if (a.ortho_height) fail("--scale", "cannot stand beside --ortho, which says the same; remove one");
        if (a.fov_deg) fail("--scale", "a perspective view (--fov) has no scale; remove one");
    }
    if (!t.unit.empty()) {
        a.unit_mm = unit_named(t.unit);
        if (!a.unit_mm) fail("--unit", "must be mm, cm, m, in or ft, got '" + printable(t.unit) + "'");
    }
}

/// Behind the name of a view.
constexpr std::string_view kWithHidden = "+hidden", kWithoutHidden = "-hidden";

bool take_end(std::string_view& text, std::string_view end) {
    if (!text.ends_with(end)) return false;
    text.remove_suffix(end.size());
    return true;
}

void fill_views(const PageTexts& t, Arguments& a) {
    if (!t.projection.empty() && t.projection != "first" && t.projection != "third")
        fail("--projection", "must be first or third");
    if (!t.projection.empty() && t.views.empty()) fail("--projection", "needs --views");
    a.view_projection = t.projection == "third" ? ViewProjection::third : ViewProjection::first;
    if (t.views.empty()) return;
    for (const std::string_view wish : split(t.views, ',')) {
        std::string_view name = wish;
        const bool asks_for_hidden = take_end(name, kWithHidden), leaves_hidden = take_end(name, kWithoutHidden);
        const auto view = standard_view_named(name);
        if (!view) {
            std::string known;
            for (const std::string_view n : kStandardViewNames) known += (known.empty() ? "" : ", ") + std::string(n);
            fail("--views", "unknown view '" + printable(name) + "'; known are " + known);
        }
        if (std::find(a.views.begin(), a.views.end(), *view) != a.views.end())
            fail("--views", std::string(name) + " is given more than once");
        if (asks_for_hidden && a.hidden == HiddenStyle::none)
            fail("--views", std::string(wish) + " cannot stand beside --hidden none; remove one");
        a.views.push_back(*view);
        a.hidden_in_views.push_back(asks_for_hidden || (!leaves_hidden && !is_pictorial(*view)));
    }
    const auto refuse = [](bool is_given, const char* option) {
        if (is_given) fail("--views", std::string("cannot stand beside ") + option + "; remove one");
    };
    refuse(a.eye.has_value(), "--eye");
    refuse(a.target.has_value(), "--target");
    refuse(a.fov_deg.has_value(), "--fov");
    refuse(a.ortho_height.has_value(), "--ortho");
    refuse(!a.camera.empty(), "--camera");
    refuse(a.crop.has_value(), "--crop");
    refuse(!a.save_lines.empty(), "--save-lines");
}

}  // namespace

void fill_page_options(const PageTexts& t, Arguments& a) {
    fill_page(t.page, a);
    fill_paper(t, a);
    fill_views(t, a);
}

void refuse_option_of_view(const std::string& name) {
    constexpr std::string_view kOfView = " --paper --margin --scale --unit --dpi --views --size -r --camera ";
    if (kOfView.find(" " + name + " ") == std::string_view::npos) return;
    throw UsageError("restyle: '" + name + "' is that of the picture whose lines were saved; render it again with " +
                     name + " and --save-lines");
}

}  // namespace burin
