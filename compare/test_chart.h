#pragma once

#include <vector>

#include "compare/metrics_profile.h"
#include "scene/scene.h"

// The test chart is a scene whose lines are known exactly, so that widths and profiles can be measured.

namespace burin {

/// A built-in scene whose lines are known exactly: what a method does to lines of every direction,
/// on slopes, behind other surfaces and at silhouettes. One orthographic picture in which a world
/// unit is a pixel; every line stands in a cell of its own, so that no line touches another.
struct TestChart {
    struct HiddenLine {
        Segment segment;
        double gap_px = 0;  ///< how far it lies behind the surface that hides it
    };

    Scene scene;  ///< draws nothing until its line classes are set
    Camera camera;
    int width = 0;
    int height = 0;
    double reach_px = 0;  ///< how far beside a line nothing else is drawn
    /// One ridge per degree from 0 to 179 (counter-clockwise from the x axis), both faces falling
    /// away from it by 45 degrees, each at its own fraction of a pixel.
    std::vector<Segment> star;
    /// Edges whose two faces both slope the same way, by 20 and by 65 degrees.
    std::vector<Segment> slopes;
    /// Ridges at various gaps behind a cover: of 45 and of 75 degrees behind one that faces the eye; behind one of 60
    /// and one of 75 degrees, as near the limb of a round object, with a face parallel to it. Lines of equal gap follow
    /// each other.
    std::vector<HiddenLine> hidden;
    /// Outlines of pyramids in front of the background.
    std::vector<Segment> silhouettes;
};

/// Wider lines would need a chart of unreasonable size.
constexpr double kWidestChartLine_px = 32;

/// A chart for lines of up to `width_px` pixels.
TestChart make_test_chart(double width_px);

}  // namespace burin
