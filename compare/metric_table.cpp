#include "compare/metric_table.h"

namespace burin {
namespace {

constexpr std::array<MetricInfo, kMetricCount> kTable = {{
    {"rmse", "scene", "RMSE", "Root mean square error of line coverage over the line pixels.", Better::lower, 4},
    {"psnr_db", "scene", "PSNR dB", "20 log10(1 / RMSE).", Better::higher, 2},
    {"psnr98_db", "scene", "PSNR98 dB", "PSNR without the worst 2 % of the line pixels.", Better::higher, 2},
    {"max_error", "scene", "max error", "The largest error of coverage of any pixel.", Better::lower, 3},
    {"ssim", "scene", "SSIM", "Structural similarity of the drawings.", Better::higher, 4},
    {"ms_ssim", "scene", "MS-SSIM", "Structural similarity over five scales.", Better::higher, 4},
    {"flip_mean", "scene", "FLIP", "Mean visible difference when flipping between result and truth.", Better::lower, 4},
    {"flip_p95", "scene", "FLIP p95", "95th percentile of the visible difference.", Better::lower, 4},
    {"missed_share", "scene", "missed", "Share of the true lines with nothing drawn within a pixel.", Better::lower, 4},
    {"false_share", "scene", "false", "Lines drawn with no true line within a pixel, as a share of the true lines.",
     Better::lower, 4},
    {"width_px", "chart", "width px", "Mean integrated width of the chart's lines.", Better::none, 3},
    {"width_bias", "chart", "bias", "Mean width over the truth's width, less 1.", Better::near_zero, 3},
    {"width_ripple", "chart", "ripple", "Largest less smallest width over all angles, over the mean.", Better::lower,
     3},
    {"offset_px", "chart", "offset px", "Mean distance of the profile's centroid from the true line.", Better::lower,
     3},
    {"beading", "chart", "beading", "Deviation of the width along a line, over its mean.", Better::lower, 3},
    {"angle_rmse", "chart", "chart RMSE", "Error against the exact area of a stroke, over all angles.", Better::lower,
     4},
    {"within_bin_sd", "chart", "aliasing sd", "How much pixels at equal distance from a line differ.", Better::lower,
     4},
    {"mtf50_cycles_per_px", "chart", "MTF50 c/px", "Frequency at which the line's modulation falls to one half.",
     Better::none, 3},
    {"energy_above_nyquist_share", "chart", "alias energy", "Share of the line's energy beyond .5 cycles per pixel.",
     Better::lower, 4},
    {"stippled_share", "chart", "stippled", "Share of a line on a slope that is drawn at under half of its width.",
     Better::lower, 4},
    {"leak_share", "chart", "leak", "Share of the ink of hidden lines that shows through covers.", Better::lower, 4},
    {"silhouette_ratio", "chart", "silh. ratio", "Width of silhouettes over the width of interior lines.",
     Better::near_one, 3},
    {"coverage_levels", "chart", "levels", "Number of different coverages, in steps of 1/255.", Better::none, 0},
    {"flicker_sd", "motion", "flicker", "Deviation over the frames of the error, mean near the lines.", Better::lower,
     4},
    {"energy_sd", "motion", "energy sd", "Deviation over the frames of the total coverage, over its mean.",
     Better::lower, 4},
    {"pop", "motion", "pop", "Largest jump of a pixel between frames beyond the truth's.", Better::lower, 3},
    {"time_s", "cost", "time s", "Wall seconds for the picture.", Better::lower, 3},
    {"cpu_time_s", "cost", "CPU s", "Processor seconds for the picture, all threads together.", Better::lower, 3},
    {"memory_bytes_per_px", "cost", "bytes / px", "Peak memory of the method beyond the loaded scene; a coarse number.",
     Better::none, 0},
    {"passes", "cost", "passes", "Times the geometry or the picture is gone through.", Better::none, 0},
}};

}  // namespace

std::span<const MetricInfo, kMetricCount> metric_table() { return kTable; }

}  // namespace burin
