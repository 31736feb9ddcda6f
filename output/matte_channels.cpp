#include "output/matte_channels.h"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <limits>
#include <span>

#include "base/murmur_hash.h"

namespace burin {
namespace {

/// The channel of a layer that has the name of a rank, or its share.
std::string rank_channel(CryptoLayer layer, std::size_t rank, bool is_share) {
    const std::string number = (rank < 20 ? "0" : "") + std::to_string(rank / 2) + ".";
    const char* const letters = rank % 2 == 0 ? "RG" : "BA";
    return std::string(kCryptoLayerNames[static_cast<std::size_t>(layer)]) + number + letters[is_share ? 1 : 0];
}

constexpr const char* kLineNumbers[] = {"line.object", "line.material", "line.class", "line.qi"};

}  // namespace

MatteChannels::MatteChannels(const Frame& frame, const Film& film)
    : mattes_(*film.mattes()),
      ranks_(static_cast<std::size_t>(film.layers().crypto_ranks)),
      has_line_(film.layers().line) {
    for (int i = 0; i < kCryptoLayerCount; ++i) {
        const auto layer = static_cast<CryptoLayer>(i);
        if (film.layers().crypto.has(layer)) layers_.push_back({layer, matte_names_of(layer, frame)});
    }
}

std::vector<ChannelFormat> MatteChannels::formats() const {
    std::vector<ChannelFormat> formats;
    for (const Layer& layer : layers_) {
        for (std::size_t rank = 0; rank < ranks_; ++rank) {
            for (const bool is_share : {false, true})
                formats.push_back({rank_channel(layer.layer, rank, is_share), PixelType::float32});
        }
    }
    if (!has_line_) return formats;
    for (const char* const name : kLineNumbers) formats.push_back({name, PixelType::uint32});
    formats.push_back({"line.Z", PixelType::float32});
    formats.push_back({"line.width", PixelType::float16});
    return formats;
}

std::vector<CryptoAttributes> MatteChannels::attributes() const {
    std::vector<CryptoAttributes> all;
    for (const Layer& layer : layers_) {
        const std::string name(kCryptoLayerNames[static_cast<std::size_t>(layer.layer)]);
        char digits[16];
        std::snprintf(digits, sizeof digits, "%08x", murmur_hash(name));
        const std::string key = "cryptomatte/" + std::string(digits, 7) + "/";
        all.push_back({name,
                       {{key + "name", name},
                        {key + "hash", "MurmurHash3_32"},
                        {key + "conversion", "uint32_to_float32"},
                        {key + "manifest", layer.names.manifest()}}});
    }
    return all;
}

void MatteChannels::find_shares(const Layer& layer, const Mattes::Pixel& pixel, std::vector<Share>& shares) const {
    shares.clear();
    const auto add = [&](std::size_t number, float share) {
        if (number >= layer.names.ids.size() || !(share > 0)) return;
        const std::uint32_t id = layer.names.ids[number];
        const auto known = std::find_if(shares.begin(), shares.end(), [&](const Share& s) { return s.id == id; });
        if (known == shares.end()) {
            shares.push_back({id, share});
        } else {
            known->share += share;
        }
    };
    const auto of_object = [](const MatteOwner& owner) { return std::size_t{owner.object} - 1; };
    const auto of_material = [](const MatteOwner& owner) { return std::size_t{owner.material} - 1; };
    if (layer.layer == CryptoLayer::object) {
        for (const SurfaceShare& s : pixel.surfaces) add(of_object(s.owner), s.share);
    } else if (layer.layer == CryptoLayer::material) {
        for (const SurfaceShare& s : pixel.surfaces) add(of_material(s.owner), s.share);
    }
    for (const LineShare& s : pixel.lines) {
        switch (layer.layer) {
            case CryptoLayer::object:
            case CryptoLayer::line_object:
                add(of_object(s.owner), s.share);
                break;
            case CryptoLayer::material:
                add(of_material(s.owner), s.share);
                break;
            case CryptoLayer::line:
                add(line_name_number(s.drawn_as, s.is_hidden), s.share);
                break;
            case CryptoLayer::line_set:
                add(s.set, s.share);
                break;
        }
    }
    std::sort(shares.begin(), shares.end(),
              [](const Share& a, const Share& b) { return a.share != b.share ? a.share > b.share : a.id < b.id; });
}

void MatteChannels::add_to(Image& image) const {
    for (const ChannelFormat& format : formats()) image.add(format.name, format.type);
    std::vector<std::span<float>> planes;  // names and shares of each rank, layer by layer
    for (const Layer& layer : layers_) {
        for (std::size_t i = 0; i < 2 * ranks_; ++i)
            planes.push_back(image.find(rank_channel(layer.layer, i / 2, i % 2 != 0))->as<float>());
    }
    std::vector<std::span<std::uint32_t>> numbers;
    std::span<float> distances;
    std::span<std::uint16_t> widths;
    if (has_line_) {
        for (const char* const name : kLineNumbers) numbers.push_back(image.find(name)->as<std::uint32_t>());
        distances = image.find("line.Z")->as<float>();
        widths = image.find("line.width")->as<std::uint16_t>();
        std::fill(distances.begin(), distances.end(), std::numeric_limits<float>::infinity());
    }
    std::vector<Share> shares;
    std::uint64_t dropped = 0;
    const PixelRect rows = image.data();
    mattes_.for_pixels(rows, [&](const Mattes::Pixel& pixel) {
        const std::size_t i = static_cast<std::size_t>(pixel.y - rows.y0) * static_cast<std::size_t>(rows.width()) +
                              static_cast<std::size_t>(pixel.x - rows.x0);
        for (std::size_t k = 0; k < layers_.size(); ++k) {
            find_shares(layers_[k], pixel, shares);
            for (std::size_t rank = 0; rank < std::min(shares.size(), ranks_); ++rank) {
                planes[2 * (k * ranks_ + rank)][i] = std::bit_cast<float>(shares[rank].id);
                planes[2 * (k * ranks_ + rank) + 1][i] = shares[rank].share;
            }
            if (shares.size() > ranks_) dropped += shares.size() - ranks_;
        }
        if (!has_line_ || pixel.line == nullptr) return;
        const LineSpot& line = *pixel.line;
        numbers[0][i] = line.owner.object;
        numbers[1][i] = line.owner.material;
        numbers[2][i] = static_cast<std::uint32_t>(line.drawn_as) + 1;
        numbers[3][i] = line.invisibility;
        distances[i] = line.distance;
        widths[i] = Film::to_half(line.width_px);
    });
    dropped_ += dropped;
}

}  // namespace burin
