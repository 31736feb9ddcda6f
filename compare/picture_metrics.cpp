#include "compare/picture_metrics.h"

#include <algorithm>

#include "compare/metrics_error.h"
#include "compare/metrics_flip.h"
#include "compare/metrics_structure.h"
#include "compare/render_lines.h"

namespace burin {

void measure_picture(const Plane& result, const Plane& truth, int threads, MetricValues& values) {
    const auto is_line = [](float v) { return v > 0; };
    if (std::none_of(truth.values.begin(), truth.values.end(), is_line)) return;
    if (const auto error = coverage_error(result, truth)) {
        values[Metric::rmse] = error->rmse;
        values[Metric::psnr_db] = error->psnr_db;
        values[Metric::psnr98_db] = error->psnr98_db;
        values[Metric::max_error] = error->max_error;
    }
    if (const auto mass = line_mass(result, truth)) {
        values[Metric::missed_share] = mass->missed;
        values[Metric::false_share] = mass->invented;
    }
    const Plane a = ink_on_paper(result), b = ink_on_paper(truth);
    values[Metric::ssim] = ssim(a, b, threads);
    values[Metric::ms_ssim] = ms_ssim(a, b, threads);
    const FlipError flip = flip_error({a, a, a}, {b, b, b}, threads);
    values[Metric::flip_mean] = flip.mean;
    values[Metric::flip_p95] = flip.p95;
}

}  // namespace burin
