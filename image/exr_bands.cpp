#include "image/exr_bands.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <string_view>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/interrupt.h"
#include "base/mapped_file.h"
#include "image/exr_container.h"

namespace burin {
namespace {

struct Band {
    std::unique_ptr<MappedFile> file;
    ExrContainer container;

    const std::string& path() const { return file->path(); }
    PixelRect data() const { return container.parts.front().data; }
};

/// What differs between bands of one picture, and from the whole.
bool is_of_band(const ContainedAttribute& a) { return a.name == "dataWindow" || a.name == "chunkCount"; }

Band open_band(const std::string& path) {
    Band band;
    band.file = std::make_unique<MappedFile>(path);
    band.container = parse_exr_container(path, band.file->bytes());
    for (const ContainedPart& part : band.container.parts) {
        if (part.data.y0 != band.data().y0 || part.data.y1 != band.data().y1)
            throw InputError(path + ": its parts have different rows");
    }
    return band;
}

/// An attribute that only one of the parts has, or in which they differ.
std::optional<std::string_view> first_difference(const ContainedPart& a, const ContainedPart& b) {
    const std::size_t count = std::max(a.attributes.size(), b.attributes.size());
    for (std::size_t i = 0; i < count; ++i) {
        if (i >= a.attributes.size()) return b.attributes[i].name;
        if (i >= b.attributes.size()) return a.attributes[i].name;
        const ContainedAttribute &x = a.attributes[i], &y = b.attributes[i];
        if (x.name != y.name || x.type != y.type) return x.name;
        if (!is_of_band(x) && x.value != y.value) return x.name;
    }
    return std::nullopt;
}

void check_headers(const Band& first, const Band& band) {
    const ExrContainer &a = first.container, &b = band.container;
    if (a.magic_and_version != b.magic_and_version || a.parts.size() != b.parts.size())
        throw InputError(band.path() + ": has other parts than " + first.path());
    for (std::size_t p = 0; p < a.parts.size(); ++p) {
        if (const auto differs = first_difference(a.parts[p], b.parts[p])) {
            throw InputError(band.path() + ": its attribute '" + std::string(*differs) + "' differs from that of " +
                             first.path() +
                             "; render all bands by the same version, from the same scene and with the same options");
        }
        if (a.parts[p].data.x0 != b.parts[p].data.x0 || a.parts[p].data.x1 != b.parts[p].data.x1)
            throw InputError(band.path() + ": has other columns than " + first.path());
    }
}

/// Sorted bands must follow each other, whole chunks apart.
void check_rows(const std::vector<Band>& bands) {
    for (std::size_t i = 1; i < bands.size(); ++i) {
        const Band &above = bands[i - 1], &band = bands[i];
        const int y = band.data().y0, expected = above.data().y1;
        const std::string begins = band.path() + ": begins at row " + std::to_string(y);
        if (y > expected) {
            throw InputError(begins + ", but " + above.path() + " ends before row " + std::to_string(expected) +
                             "; the rows between are missing");
        }
        if (y < expected) throw InputError(begins + ", which " + above.path() + " has, too");
        for (const ContainedPart& part : bands.front().container.parts) {
            if ((y - bands.front().data().y0) % part.rows_per_chunk == 0) continue;
            const int first = bands.front().data().y0;
            throw InputError(begins + ", not at a multiple of " + std::to_string(part.rows_per_chunk) +
                             (first == 0 ? "" : " below row " + std::to_string(first)));
        }
    }
}

void append_window(std::string& header, const ContainedAttribute& window, int last_row) {
    std::array<std::int32_t, 4> corners{};
    std::memcpy(corners.data(), window.value.data(), sizeof(corners));
    corners[3] = last_row;
    header.append(reinterpret_cast<const char*>(corners.data()), sizeof(corners));
}

/// The headers of the joined file.
std::string joined_header(const std::vector<Band>& bands, const std::vector<std::size_t>& chunk_counts) {
    const ExrContainer& first = bands.front().container;
    std::string header(first.magic_and_version);
    for (std::size_t p = 0; p < first.parts.size(); ++p) {
        for (const ContainedAttribute& a : first.parts[p].attributes) {
            header.append(a.name).push_back('\0');
            header.append(a.type).push_back('\0');
            const auto size = static_cast<std::int32_t>(a.value.size());
            header.append(reinterpret_cast<const char*>(&size), sizeof(size));
            if (a.name == "dataWindow") {
                append_window(header, a, bands.back().data().y1 - 1);
            } else if (a.name == "chunkCount" && a.value.size() == sizeof(std::int32_t)) {
                const auto count = static_cast<std::int32_t>(chunk_counts[p]);
                header.append(reinterpret_cast<const char*>(&count), sizeof(count));
            } else {
                header.append(a.value);
            }
        }
        header.push_back('\0');
    }
    if (first.has_parts) header.push_back('\0');
    return header;
}

/// A chunk of the joined file.
struct JoinedChunk {
    std::size_t part = 0, number = 0;  // of the part, from the top of the joined picture
    std::string_view bytes;
};

/// Whether the chunks of a file stand part after part, not row after row.
bool goes_part_by_part(const ExrContainer& file) {
    for (std::size_t p = 1; p < file.parts.size(); ++p) {
        const auto &above = file.parts[p - 1].chunks, &below = file.parts[p].chunks;
        if (above.back().data() > below.front().data()) return false;
    }
    return true;
}

/// All chunks in the order in which one file would have them.
std::vector<JoinedChunk> joined_chunks(const std::vector<Band>& bands, std::vector<std::size_t>& chunk_counts) {
    std::vector<JoinedChunk> chunks;
    chunk_counts.assign(bands.front().container.parts.size(), 0);
    bool part_by_part = true;
    for (const Band& band : bands) {
        part_by_part = part_by_part && goes_part_by_part(band.container);
        const std::size_t begin = chunks.size();
        for (std::size_t p = 0; p < chunk_counts.size(); ++p) {
            for (const std::string_view bytes : band.container.parts[p].chunks)
                chunks.push_back({p, chunk_counts[p]++, bytes});
        }
        std::sort(chunks.begin() + static_cast<std::ptrdiff_t>(begin), chunks.end(),
                  [](const JoinedChunk& a, const JoinedChunk& b) { return a.bytes.data() < b.bytes.data(); });
    }
    if (part_by_part) {
        std::stable_sort(chunks.begin(), chunks.end(),
                         [](const JoinedChunk& a, const JoinedChunk& b) { return a.part < b.part; });
    }
    return chunks;
}

}  // namespace

JoinedBands join_exr_bands(const std::vector<std::string>& band_paths, const std::string& output_path) {
    if (band_paths.empty()) throw InputError("there are no bands to join");
    std::vector<Band> bands;
    for (const std::string& path : band_paths) {
        throw_if_interrupted();
        bands.push_back(open_band(path));
        check_headers(bands.front(), bands.back());
    }
    std::stable_sort(bands.begin(), bands.end(),
                     [](const Band& a, const Band& b) { return a.data().y0 < b.data().y0; });
    check_rows(bands);

    std::vector<std::size_t> chunk_counts;
    const std::vector<JoinedChunk> chunks = joined_chunks(bands, chunk_counts);
    const std::string header = joined_header(bands, chunk_counts);

    std::vector<std::size_t> first_entry(chunk_counts.size(), 0);
    for (std::size_t p = 1; p < chunk_counts.size(); ++p) first_entry[p] = first_entry[p - 1] + chunk_counts[p - 1];
    std::vector<std::uint64_t> table(chunks.size());
    std::uint64_t place = header.size() + sizeof(std::uint64_t) * table.size();
    for (const JoinedChunk& chunk : chunks) {
        table[first_entry[chunk.part] + chunk.number] = place;
        place += chunk.bytes.size();
    }

    AtomicFile file(output_path);
    file.write(header.data(), header.size());
    file.write(table.data(), sizeof(std::uint64_t) * table.size());
    for (const JoinedChunk& chunk : chunks) {
        throw_if_interrupted();
        file.write(chunk.bytes.data(), chunk.bytes.size());
    }
    for (const Band& band : bands) band.file->check_is_whole();
    file.commit();
    const ContainedPart& first = bands.front().container.parts.front();
    JoinedBands joined{first.display, first.data, first.text("burin/fingerprint").has_value()};
    joined.data.y1 = bands.back().data().y1;
    return joined;
}

}  // namespace burin
