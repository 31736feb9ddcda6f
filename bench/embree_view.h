#pragma once

#include <embree3/rtcore.h>

#include <cstddef>

#include "render/frame.h"

namespace burin::bench {

/// The yardstick of frame times, E: Embree 3's rtcIntersect8 with one primary ray per pixel, on one
/// thread. Building its tree does not count.
class EmbreeView {
  public:
    explicit EmbreeView(const Frame& frame);
    ~EmbreeView();
    EmbreeView(const EmbreeView&) = delete;
    EmbreeView& operator=(const EmbreeView&) = delete;

    /// Traces the rays of all pixels; returns how many hit something.
    std::size_t trace() const;

  private:
    const Frame& frame_;
    RTCDevice device_;
    RTCScene scene_;
};

}  // namespace burin::bench
