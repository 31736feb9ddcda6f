#include "output/pdf.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/interrupt.h"
#include "output/path_data.h"
#include "output/paths/arc.h"
#include "output/pdf_file.h"
#include "output/srgb_profile.h"
#include "output/vector_layers.h"

namespace burin {
namespace {

constexpr double kPtPerMm = 72 / 25.4;
/// Programs take no larger pages; these have a larger unit.
constexpr double kLargestPage = 14400;

/// A number that takes what it is rounded to less than programs see.
std::string fine_number(double value) {
    // More decimals than short_number() has, for scales.
    const auto whole = static_cast<long long>(std::floor(std::abs(value)));
    auto rest = static_cast<long long>(std::llround((std::abs(value) - static_cast<double>(whole)) * 1e9));
    std::string digits = std::to_string(rest);
    if (rest >= 1000000000) return std::to_string(value < 0 ? -whole - 1 : whole + 1);
    digits.insert(0, 9 - digits.size(), '0');
    while (!digits.empty() && digits.back() == '0') digits.pop_back();
    return (value < 0 ? "-" : "") + std::to_string(whole) + (digits.empty() ? "" : "." + digits);
}

std::string place(glm::dvec2 p) {
    const auto hundredths = [](double v) { return std::llround(std::clamp(v, -1e13, 1e13) * 100); };
    return text_of_hundredths(hundredths(p.x)) + " " + text_of_hundredths(hundredths(p.y)) + " ";
}

/// Writes the operators of a page.
class PdfContent {
  public:
    PdfContent(const VectorDrawing& drawing, bool has_transparency)
        : drawing_(drawing), has_transparency_(has_transparency) {}

    void begin(const ShownArea& area, double pt_per_px) {
        // Pixels of the picture, y downwards.
        const glm::dvec2 low = area.low_px * pt_per_px;
        out_ += fine_number(pt_per_px) + " 0 0 " + fine_number(-pt_per_px) + " " + fine_number(-low.x) + " " +
                fine_number(area.size_px.y * pt_per_px + low.y) + " cm\n1 j\n";
        if (drawing_.paper && srgb_codes(*drawing_.paper) != glm::ivec3(255)) {
            set_fill(*drawing_.paper);
            out_ += fine_number(area.low_px.x) + " " + fine_number(area.low_px.y) + " " + fine_number(area.size_px.x) +
                    " " + fine_number(area.size_px.y) + " re f\n";
        }
    }
    void begin_layer(std::size_t number) { out_ += "/OC /L" + std::to_string(number) + " BDC\n"; }
    void end_layer() { out_ += "EMC\n"; }

    void add(const VectorPath& path) {
        throw_if_interrupted();
        const VectorStyle& style = drawing_.styles[path.style];
        set_look(style, path);
        out_ += place(path.start) + "m\n";
        glm::dvec2 at = path.start;
        const std::span<const PathStep> steps = drawing_.steps_of(path);
        for (std::size_t i = 0; i < steps.size(); ++i) {
            const PathStep& step = steps[i];
            const bool closes = path.is_closed && i + 1 == steps.size() && i > 0;
            if (step.kind == PathStep::Kind::arc) {
                for (const PathStep& part : cubics_of_arc(at, step, 2)) add_cubic(part);
            } else if (step.kind == PathStep::Kind::cubic) {
                add_cubic(step);
            } else if (!closes) {
                out_ += place(step.to) + "l\n";
            }
            at = step.to;
        }
        if (path.is_closed) out_ += "h ";
        out_ += style.is_outline() ? "f\n" : "S\n";
    }

    const std::map<std::pair<std::string, bool>, std::size_t>& states() const { return states_; }
    std::size_t opaque_count() const { return opaque_count_; }
    const std::string& text() const { return out_; }

  private:
    void add_cubic(const PathStep& step) { out_ += place(step.a) + place(step.b) + place(step.to) + "c\n"; }

    static std::string color(glm::vec3 linear, const char* gray, const char* rgb) {
        const glm::ivec3 codes = srgb_codes(linear);
        if (codes == glm::ivec3(0)) return std::string("0 ") + gray + "\n";
        std::string text;
        for (int k = 0; k < 3; ++k) text += short_number(codes[k] / 255.0) + " ";
        return text + rgb + "\n";
    }
    void change(std::string& now, const std::string& wanted) {
        if (now == wanted) return;
        now = wanted;
        out_ += wanted;
    }
    void set_fill(glm::vec3 linear) { change(fill_, color(linear, "g", "rg")); }

    void set_look(const VectorStyle& style, const VectorPath& path) {
        glm::vec3 ink = style.color;
        if (has_transparency_) {
            set_transparency(style);
        } else if (style.opacity < 1 || style.blend != InkBlend::over) {
            ++opaque_count_;
            ink = glm::mix(drawing_.paper.value_or(glm::vec3(1.0f)), ink, std::clamp(style.opacity, 0.0f, 1.0f));
        }
        if (style.is_outline()) return set_fill(ink);
        change(stroke_, color(ink, "G", "RG"));
        change(width_, short_number(static_cast<double>(style.width_px)) + " w\n");
        change(caps_, style.caps == StrokeCaps::round ? "1 J\n" : "0 J\n");
        DashPattern pattern = dash_pattern(style, path.dash_phase_px);
        std::string dashes = "[";
        double length = 0;
        for (const double part : pattern.lengths) {
            dashes += (dashes.size() == 1 ? "" : " ") + short_number(part);
            length += part;
        }
        if (length > 0) pattern.phase -= length * std::floor(pattern.phase / length);
        change(dashes_, dashes + "] " + short_number(length > 0 ? pattern.phase : 0) + " d\n");
    }

    void set_transparency(const VectorStyle& style) {
        const std::pair<std::string, bool> key(short_number(static_cast<double>(style.opacity)),
                                               style.blend == InkBlend::multiply);
        if (key == state_) return;
        state_ = key;
        out_ += "/G" + std::to_string(states_.try_emplace(key, states_.size() + 1).first->second) + " gs\n";
    }

    const VectorDrawing& drawing_;
    bool has_transparency_;
    std::string out_, fill_ = "0 g\n", stroke_ = "0 G\n", width_, caps_ = "0 J\n", dashes_ = "[] 0 d\n";
    std::pair<std::string, bool> state_{"1", false};
    std::map<std::pair<std::string, bool>, std::size_t> states_;  ///< opacity and whether it multiplies: its number
    std::size_t opaque_count_ = 0;
};

/// Metadata as XMP has them.
std::string metadata(int part, const std::string& fingerprint) {
    return "<?xpacket begin=\"\xEF\xBB\xBF\" id=\"W5M0MpCehiHzreSzNTczkc9d\"?>\n"
           "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\">\n"
           "<rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">\n"
           "<rdf:Description rdf:about=\"\" xmlns:pdf=\"http://ns.adobe.com/pdf/1.3/\" "
           "xmlns:pdfaid=\"http://www.aiim.org/pdfa/ns/id/\">\n"
           "<pdf:Producer>Burin</pdf:Producer>\n" +
           (fingerprint.empty() ? "" : "<pdf:Keywords>burin/fingerprint " + fingerprint + "</pdf:Keywords>\n") +
           "<pdfaid:part>" + std::to_string(part) +
           "</pdfaid:part>\n<pdfaid:conformance>B</pdfaid:conformance>\n"
           "</rdf:Description>\n</rdf:RDF>\n</x:xmpmeta>\n<?xpacket end=\"w\"?>";
}

class PdfWriter {
  public:
    PdfWriter(const VectorDrawing& drawing, const PdfOptions& options)
        : drawing_(drawing), options_(options), content_(drawing, !options.is_plain) {}

    std::string text(std::vector<std::string>& notes) {
        const std::size_t root = file_.reserve(), pages = file_.reserve(), page = file_.reserve();
        const ShownArea area = shown_area(drawing_);
        const glm::dvec2 size_pt = area.size_mm() * kPtPerMm;
        const double unit =
            options_.is_plain ? 1 : std::max(1.0, std::ceil(std::max(size_pt.x, size_pt.y) / kLargestPage));
        content_.begin(area, area.mm_per_px * kPtPerMm / unit);
        add_groups();
        const std::size_t content = file_.add_stream(content_.text(), "", true);

        std::string entries = "/Type /Page /Parent " + PdfFile::reference(pages) + " /MediaBox [0 0 " +
                              fine_number(size_pt.x / unit) + " " + fine_number(size_pt.y / unit) + "]";
        if (unit > 1) entries += " /UserUnit " + fine_number(unit);
        entries += " /Resources << /ProcSet [/PDF]";
        if (!content_.states().empty()) entries += " /ExtGState << " + states() + ">>";
        if (!properties_.empty()) entries += " /Properties << " + properties_ + ">>";
        entries += " >>";
        if (!content_.states().empty()) entries += " /Group << /Type /Group /S /Transparency /CS /DeviceRGB >>";
        file_.set(page, "<< " + entries + " /Contents " + PdfFile::reference(content) + " >>");
        file_.set(pages, "<< /Type /Pages /Kids [" + PdfFile::reference(page) + "] /Count 1 >>");
        const std::size_t profile = file_.add_stream(srgb_profile(), "/N 3", true);
        const std::size_t xmp = file_.add_stream(metadata(options_.is_plain ? 1 : 2, options_.fingerprint),
                                                 "/Type /Metadata /Subtype /XML", false);
        const std::size_t info = file_.add("<< /Producer (Burin) >>");
        std::string catalog = "/Type /Catalog /Pages " + PdfFile::reference(pages) + " /Metadata " +
                              PdfFile::reference(xmp) +
                              " /OutputIntents [<< /Type /OutputIntent /S /GTS_PDFA1 /OutputConditionIdentifier "
                              "(sRGB IEC61966-2.1) /Info (sRGB IEC61966-2.1) /DestOutputProfile " +
                              PdfFile::reference(profile) + " >>]";
        if (!all_groups_.empty()) {
            catalog += " /OCProperties << /OCGs [" + all_groups_ + "] /D << /Name (Layers) /Order [" + order_ +
                       "] /ON [" + all_groups_ + "] >> >> /PageMode /UseOC";
        }
        file_.set(root, "<< " + catalog + " >>");
        if (content_.opaque_count() > 0) {
            notes.push_back("PDF/A-1b has no transparency: the colours of " + std::to_string(content_.opaque_count()) +
                            (content_.opaque_count() == 1 ? " path are" : " paths are") + " mixed with the paper's");
        }
        return file_.text(options_.is_plain ? 4 : 6, root, info);
    }

  private:
    void add_groups() {
        const auto& groups = drawing_.groups;
        for (std::size_t i = 0; i < groups.size();) {
            const VectorGroup& first = groups[i];
            begin_layer(label_of_layer(first));
            order_ += " [";
            for (; i < groups.size() && is_one_layer(groups[i], first); ++i) {
                begin_layer(label_of_group(drawing_, groups[i]));
                for (const VectorPath& path : drawing_.paths_of(groups[i])) content_.add(path);
                end_layer();
            }
            order_ += "] ";
            end_layer();
        }
    }
    void begin_layer(const std::string& label) {
        if (options_.is_plain) return;
        const std::size_t group = file_.add("<< /Type /OCG /Name " + PdfFile::text_string(label) + " >>");
        properties_ += "/L" + std::to_string(group) + " " + PdfFile::reference(group) + " ";
        all_groups_ += (all_groups_.empty() ? "" : " ") + PdfFile::reference(group);
        order_ +=
            (order_.empty() || order_.back() == '[' || order_.back() == ' ' ? "" : " ") + PdfFile::reference(group);
        content_.begin_layer(group);
    }
    void end_layer() {
        if (!options_.is_plain) content_.end_layer();
    }
    std::string states() const {
        std::string text;
        for (const auto& [state, number] : content_.states()) {
            text += "/G" + std::to_string(number) + " << /Type /ExtGState /CA " + state.first + " /ca " + state.first +
                    " /BM " + (state.second ? "/Multiply" : "/Normal") + " >> ";
        }
        return text;
    }

    const VectorDrawing& drawing_;
    const PdfOptions& options_;
    PdfFile file_;
    PdfContent content_;
    std::string properties_, all_groups_, order_;
};

}  // namespace

std::string pdf_of(const VectorDrawing& drawing, const PdfOptions& options, std::vector<std::string>& notes) {
    return PdfWriter(drawing, options).text(notes);
}

}  // namespace burin
