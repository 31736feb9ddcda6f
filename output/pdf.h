#pragma once

#include <string>
#include <vector>

#include "output/paths/vector_drawing.h"

namespace burin {

struct PdfOptions {
    /// PDF/A-1b, which patent offices take: version 1.4, without layers, and without transparency, for which colours
    /// are mixed with the paper's. Else PDF/A-2b, version 1.6.
    bool is_plain = false;
    std::string fingerprint = {};
};

/// Writes a PDF file of one page: optional content groups for hidden and visible lines, in these those of the drawing's
/// groups. It has no dates; its identifier is a hash of its content, so equal drawings give equal bytes. `notes`: gets
/// what the file cannot say.
std::string pdf_of(const VectorDrawing& drawing, const PdfOptions& options, std::vector<std::string>& notes);

}  // namespace burin
