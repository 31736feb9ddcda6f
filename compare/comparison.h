#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "compare/metric_table.h"
#include "compare/metrics_profile.h"
#include "render/method.h"

// A comparison has all that was measured, method by method.

namespace burin {

/// What the test chart shows as curves.
struct ChartCurves {
    std::vector<double> width_px;       ///< per degree, 0 to 179
    std::vector<double> rmse;           ///< per degree
    std::vector<double> within_bin_sd;  ///< per degree
    LineSpread profile;                 ///< over all angles
    std::vector<double> modulation;     ///< every 1/32 cycle per pixel
    std::vector<double> gaps_px;        ///< per gap in front of a hidden line ...
    std::vector<double> leak_share;     ///< ... the share of it that shows through
};

/// A method measured in one way of asking for the line's width.
struct ComparisonRow {
    double asked_width_px = 0;  ///< what the method was asked for
    double truth_width_px = 0;  ///< width of the truth that it is measured against
    MetricValues values;
    std::optional<ChartCurves> curves;
    std::vector<double> frame_coverage;  ///< total coverage per frame over the truth's mean
};

struct MethodResult {
    const Method* method = nullptr;
    LineClassSet drawn;               ///< classes that were asked for and that the method can draw
    LineClassSet not_drawn;           ///< classes that were asked for and that it cannot find
    LineClassSet truth;               ///< classes of its truth: drawn, and found by other names
    ComparisonRow published;          ///< asked for the width, as the method's source would draw it
    ComparisonRow equal_width;        ///< at equal integrated width
    std::string picture, difference;  ///< file names; empty if the method draws none of the classes
};

/// All that a comparison found out.
struct Comparison {
    std::string input;
    int width = 0, height = 0;
    PixelRect crop;
    LineClassSet classes;
    double line_width_px = 1;
    std::uint64_t triangles = 0;
    glm::ivec2 focus{0};  ///< a place with many lines, counted from the crop's corner
    int frames = 0;
    PixelRect frames_crop;  ///< the part of the picture that moves, if there are frames
    int threads = 1;
    std::string truth_method;
    std::string truth_picture;
    double truth_time_s = 0;
    double chart_width_px = 0;  ///< line width of the chart; 0: no chart (the lines are too wide)
    std::vector<double> truth_frame_coverage;
    std::vector<MethodResult> methods;
    bool complete = false;  ///< false while methods are missing
};

}  // namespace burin
