#pragma once

#include <cstdint>
#include <tuple>
#include <vector>

#include "render/mattes.h"

namespace burin {

/// MatteSums makes the mean of the mattes of several pictures: per pixel, of what each surface and each kind of line
/// has of it as it is seen. Sums are in double precision, in the order of the pictures.
class MatteSums {
  public:
    /// `crop`: of the pictures, `mean`: whose wishes count.
    MatteSums(PixelRect crop, const Mattes& mean);

    /// Adds the rows of one band of a picture, or of all. Different threads may add different bands at once.
    void add(const Mattes& picture, std::size_t band);
    void add_all(const Mattes& picture, int threads);
    /// Puts the mean of `count` pictures into mattes that have begun one.
    void put_mean(int count, Mattes& mean, int threads);

  private:
    /// A surface or a line in a pixel of a band.
    struct Key {
        std::uint32_t pixel = 0;
        bool is_line = false, is_hidden = false, is_behind = false, is_opaque = false;
        LineClass drawn_as = LineClass::silhouette;
        std::uint16_t set = 0;
        std::uint8_t invisibility = 0;
        MatteOwner owner;

        auto rank() const {
            return std::tuple(pixel, is_line, is_hidden, is_behind, is_opaque, drawn_as, set, invisibility,
                              owner.object, owner.material);
        }
    };
    struct Sum {
        Key key;
        double share = 0, distance = 0;  // times the share
        glm::dvec3 color{0.0};           // times the share
        double alone = 0;                // of a surface: the share that it would have without lines
    };
    /// Sorted by their keys, each once.
    using Sums = std::vector<Sum>;
    struct Band {
        Sums flat, deep;
    };
    PixelRect rows_of(std::size_t band) const;
    void add_flat(const Mattes& picture, PixelRect rows, Sums& sums) const;
    void add_deep(const Mattes& picture, PixelRect rows, Sums& sums) const;
    void put_flat(const Sums& sums, PixelRect rows, double count, const Mattes& mean, MatteBatch& batch) const;
    void put_deep(const Sums& sums, PixelRect rows, double count, const Mattes& mean, MatteBatch& batch) const;
    static void merge(Sums& more, Sums& sums);

    PixelRect crop_;
    bool wants_shares_, wants_deep_;
    std::vector<Band> bands_;
};

}  // namespace burin
