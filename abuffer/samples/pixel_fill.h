#pragma once

#include <array>
#include <optional>
#include <vector>

#include "abuffer/samples/surface_tile.h"
#include "render/film.h"
#include "render/mattes.h"
#include "shading/surface/fragment_shader.h"

namespace burin {

/// Fills the pixels of a tile from its samples, without lines. One per thread; buffers are used again.
class PixelFiller {
  public:
    /// `shaded`: of a shading that varies over surfaces, else nullptr.
    PixelFiller(const Frame& frame, const ScreenSurfaces& screen, const TileKernels& kernels,
                const ShadedSurfaces* shaded);

    /// Puts the pixels of a tile that lie in the frame's crop.
    void fill(const SurfaceTile& tile, Film& film);
    /// Puts the background into a rectangle.
    void clear(PixelRect rect, Film& film) const;

  private:
    PixelRect in_crop(PixelRect rect) const;

    static constexpr int kWidth = TileGrid::kTileSamples / 2;  // the widest tile, in pixels

    /// The sample next to a pixel's centre stands for the pixel in depth, normal and numbers: finds the
    /// triangles there, and their geometries.
    void find_geometries(const SampleTile& samples, PixelRect rect);
    void make_geometries();
    TriangleGeometry geometry_of(std::uint32_t number) const;
    void fill_ids(std::uint32_t number, TriangleGeometry& geometry) const;

    /// Puts the pixels of a part that has anything but background.
    void fill_part(const SampleTile& samples, PixelRect part, Film& film);
    void put_geometry(PixelRect rect, int y, Film& film);
    void put_paper(const SampleTile& samples, PixelRect rect, Film& film);
    void put_shaded(const SampleTile& samples, PixelRect rect, int y, Film& film);
    glm::vec4 color(std::uint32_t number, int x, int y);
    /// Puts the colours of a part whose shading varies over surfaces.
    void find_fragments(const SampleTile& samples, PixelRect rect);
    void put_fragments(const SampleTile& samples, PixelRect rect, Film& film);
    /// Says whose a part's pixels are.
    void add_mattes(const SampleTile& samples, PixelRect rect, Mattes& mattes);
    void find_owners(const SampleTile& samples, int x, int y);
    /// Says what a deep file has of a part's surfaces.
    void add_deep(const SampleTile& samples, PixelRect rect, Mattes& mattes);
    void find_deep(const SampleTile& samples, int x, int y, std::size_t first_fragment);
    const MatteOwner& owner_of(std::uint32_t number);
    void put_motion(const SampleTile& samples, PixelRect rect, int y, Film& film) const;
    void add_fragments(const SampleTile& samples, int x, int y);

    const Frame& frame_;
    const ScreenSurfaces& screen_;
    const TileKernels& kernels_;
    const PlaceKernels& place_kernels_;
    std::vector<std::uint32_t> numbers_;         // of triangles; the first one is none
    std::vector<TriangleGeometry> geometries_;   // of them
    std::vector<std::uint16_t> geometry_at_;     // per pixel of the tile, which of them
    std::vector<HalfColor> paper_;               // by the number of covered samples
    std::uint32_t shaded_number_ = 0xFFFFFFFFu;  // whose geometry is:
    TriangleGeometry shaded_geometry_{};
    std::optional<FragmentShader> fragment_shader_;
    std::vector<SurfaceFragment> fragments_;  // of a part, pixel by pixel
    enum class RowKind : std::uint8_t { of_one, mixed };
    std::vector<RowKind> row_kinds_;          // of a part: whether one triangle has all samples of a row
    std::vector<std::uint8_t> samples_of_;    // of each of them: how many
    std::vector<std::uint8_t> fragments_of_;  // of each pixel: how many
    FragmentColors colors_;                   // of each fragment
    MatteBatch matte_batch_;
    std::uint32_t owned_number_ = 0xFFFFFFFFu;  // whose owner is:
    MatteOwner owner_;
    struct Owned {
        MatteOwner owner;
        int samples;
        bool operator==(const Owned&) const = default;
    };
    std::vector<Owned> owned_;  // of a pixel
    struct Seen {
        MatteOwner owner;
        int samples = 0;
        double distance = 0;    // the sum of its samples
        glm::vec3 color{0.0f};  // in the same way
    };
    std::vector<Seen> seen_;                   // of a pixel
    std::vector<std::uint32_t> numbers_seen_;  // of triangles, in the order of its fragments
    struct Row {
        std::uint16_t color[4][kWidth];
        static_assert(kWidth % 4 == 0 && kWidth % kRoomBehindHalves == 0);  // see GeometryRow, PlaceKernels
        float sum[4][kWidth];
        float distance[kWidth], normal[3][kWidth];
        std::uint32_t ids[3][kWidth];
    } row_;
};

}  // namespace burin
