#include "output/vector_files.h"

#include "output/dxf.h"
#include "output/pdf.h"
#include "output/svg.h"

namespace burin {

std::string vector_file_of(const VectorDrawing& drawing, OutputFormat format, const VectorFileOptions& options,
                           std::vector<std::string>& notes) {
    if (format == OutputFormat::pdf) return pdf_of(drawing, {options.is_plain_pdf, options.fingerprint}, notes);
    if (format == OutputFormat::dxf) return dxf_of(drawing, {options.tolerance_px, options.fingerprint}, notes);
    return svg_of(drawing, {options.names_paths, options.fingerprint});
}

}  // namespace burin
