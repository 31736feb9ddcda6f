#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include "abuffer/screen/screen_surfaces.h"
#include "lines/whole_line.h"
#include "mesh/mesh.h"

// What was found for a border is remembered for all tiles and threads, since it takes long where borders lie in heaps.

namespace burin {

/// The lines of borders, as the threads of one pass find them. Long borders are in many tiles, and may have many others
/// beside them. It may forget some.
class KnownBorders {
  public:
    /// Puts the lines of a border into `lines`: those that are known, or what find(lines) adds.
    template <typename Find>
    void lines_of(std::uint32_t instance, HalfEdge h, std::vector<WholeLine>& lines, const Find& find) {
        lines.clear();
        std::call_once(has_room_, [&] { borders_.resize(kMost); });  // most meshes have no borders
        const std::size_t place = (h + std::size_t{7919} * instance) % kMost;
        Border& border = borders_[place];
        std::mutex& mutex = mutexes_[place % kMutexes];
        {
            const std::lock_guard lock(mutex);
            if (border.half_edge == h && border.instance == instance) {
                lines = border.lines;
                return;
            }
        }
        find(lines);  // two threads may do so at a time, and find the same
        const std::lock_guard lock(mutex);
        border.instance = instance;
        border.half_edge = h;
        border.lines = lines;
    }

  private:
    static constexpr std::size_t kMost = std::size_t{1} << 17, kMutexes = 256;
    struct Border {
        std::uint32_t instance = 0;
        HalfEdge half_edge = kNoHalfEdge;
        std::vector<WholeLine> lines;
    };
    std::once_flag has_room_;
    std::vector<Border> borders_;
    std::array<std::mutex, kMutexes> mutexes_;
};

}  // namespace burin
