#include "output/vector_files.h"

#include <cassert>

#include "output/dxf.h"
#include "output/pdf.h"
#include "output/svg.h"

namespace burin {

std::string vector_file_of(const VectorDrawing& drawing, OutputFormat format, const VectorFileOptions& options,
                           std::vector<std::string>& notes) {
    switch (format) {
        case OutputFormat::svg:
            return svg_of(drawing, {options.names_paths, options.fingerprint});
        case OutputFormat::pdf:
            return pdf_of(drawing, {options.is_plain_pdf, options.fingerprint}, notes);
        case OutputFormat::dxf:
            return dxf_of(drawing, {options.tolerance_px, options.fingerprint}, notes);
        case OutputFormat::exr:
        case OutputFormat::png:
        case OutputFormat::tiff:
            break;
    }
    assert(false && "a format of pixels");
    return {};
}

}  // namespace burin
