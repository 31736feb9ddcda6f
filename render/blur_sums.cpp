#include "render/blur_sums.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>

#include "base/error.h"
#include "base/parallel.h"
#include "image/half.h"

namespace burin {
namespace {

constexpr std::size_t kRowsAtOnce = 16;

typedef std::uint16_t EightHalves __attribute__((vector_size(16)));

void add_four(const FourFloats& values, float* to) {
    FourFloats sum;
    std::memcpy(&sum, to, sizeof sum);
    sum += values;
    std::memcpy(to, &sum, sizeof sum);
}

/// Adds numbers in half precision. Most of a picture is background, whose zeros change nothing.
void add_halves(const std::uint16_t* from, std::size_t count, float* to) {
    constexpr std::size_t kEight = 8;
    std::size_t i = 0;
    std::uint64_t last[2] = {};
    FourFloats low = {}, high = {};  // of `last`: surfaces are mostly of one colour
    for (; i + kEight <= count; i += kEight) {
        std::uint64_t bits[2];
        std::memcpy(bits, from + i, sizeof bits);
        if ((bits[0] | bits[1]) == 0) continue;
        if (bits[0] != last[0] || bits[1] != last[1]) {
            std::memcpy(last, bits, sizeof last);
            const EightHalves halves = std::bit_cast<EightHalves>(bits), zero = {};
            low = floats_from_halves(
                std::bit_cast<FourHalves>(__builtin_shufflevector(halves, zero, 0, 8, 1, 9, 2, 10, 3, 11)));
            high = floats_from_halves(
                std::bit_cast<FourHalves>(__builtin_shufflevector(halves, zero, 4, 12, 5, 13, 6, 14, 7, 15)));
        }
        add_four(low, to + i);
        add_four(high, to + i + 4);
    }
    for (; i < count; ++i) to[i] += float_from_half(from[i]);
}

void put_means(const float* sums, std::size_t count, float pictures, std::uint16_t* to) {
    std::size_t i = 0;
    for (; i + 4 <= count; i += 4) {
        FourFloats sum;
        std::memcpy(&sum, sums + i, sizeof sum);
        const FourHalves halves = halves_from_floats(sum / pictures);
        for (unsigned k = 0; k < 4; ++k) to[i + k] = static_cast<std::uint16_t>(halves[k]);
    }
    for (; i < count; ++i) to[i] = half_from_float(sums[i] / pictures);
}

}  // namespace

LayerSet layers_with_mean(LayerSet layers) {
    layers.depth = layers.normal = layers.ids = layers.line = layers.motion = false;
    return layers;
}

bool has_mean(const ChannelFormat& channel) {
    return channel.type == PixelType::float16 && !channel.name.starts_with("line.");  // those tell of one line
}

void BlurSums::Free::operator()(float* memory) const { std::free(memory); }

BlurSums::BlurSums(PixelRect rect, const std::vector<ChannelFormat>& channels) : rect_(rect) {
    const std::size_t pixels = static_cast<std::size_t>(rect.width()) * static_cast<std::size_t>(rect.height());
    for (std::size_t i = 0; i < channels.size(); ++i) {
        if (!has_mean(channels[i])) continue;
        // What no picture has anything in stays as the system gives it: zero, and without memory.
        auto* const zeros = static_cast<float*>(std::calloc(pixels, sizeof(float)));
        if (zeros == nullptr)
            throw InputError("not enough memory for a blurred picture; make it smaller, or less of it");
        sums_.push_back({channels[i].name, i, std::unique_ptr<float[], Free>(zeros)});
    }
}

void BlurSums::add_rows(const Image& picture, int y0, int y1) {
    const auto stride = static_cast<std::size_t>(rect_.width()), count = static_cast<std::size_t>(picture.width());
    for (Sum& sum : sums_) {
        const auto values = picture.channels()[sum.channel].as<std::uint16_t>();
        for (int y = y0; y < y1; ++y) {
            const std::size_t from = static_cast<std::size_t>(y - picture.data().y0) * count;
            const std::size_t to = static_cast<std::size_t>(y - rect_.y0) * stride +
                                   static_cast<std::size_t>(picture.data().x0 - rect_.x0);
            add_halves(values.data() + from, count, sum.values.get() + to);
        }
    }
}

void BlurSums::add(const ImageStrip& rows) {
    for (const Image* const block : rows.blocks) {
        if (block != nullptr) add_rows(*block, rows.data.y0, rows.data.y1);
    }
}

void BlurSums::add(const Image& picture, int threads) {
    const auto rows = static_cast<std::size_t>(picture.height());
    parallel_for((rows + kRowsAtOnce - 1) / kRowsAtOnce, threads, [&](std::size_t i, int) {
        const std::size_t end = std::min(rows, (i + 1) * kRowsAtOnce);
        add_rows(picture, picture.data().y0 + static_cast<int>(i * kRowsAtOnce),
                 picture.data().y0 + static_cast<int>(end));
    });
}

void BlurSums::put_mean(int count, Image& picture, int threads) const {
    const auto rows = static_cast<std::size_t>(rect_.height()), width = static_cast<std::size_t>(rect_.width()),
               stride = static_cast<std::size_t>(picture.width());
    std::vector<std::uint16_t*> planes;
    for (const Sum& sum : sums_) {
        planes.push_back(picture.find(sum.name)->as<std::uint16_t>().data() +
                         static_cast<std::size_t>(rect_.y0 - picture.data().y0) * stride +
                         static_cast<std::size_t>(rect_.x0 - picture.data().x0));
    }
    parallel_for((rows + kRowsAtOnce - 1) / kRowsAtOnce, threads, [&](std::size_t i, int) {
        for (std::size_t k = 0; k < sums_.size(); ++k) {
            for (std::size_t row = i * kRowsAtOnce; row < std::min(rows, (i + 1) * kRowsAtOnce); ++row) {
                put_means(sums_[k].values.get() + row * width, width, static_cast<float>(count),
                          planes[k] + row * stride);
            }
        }
    });
}

}  // namespace burin
