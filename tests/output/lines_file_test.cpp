// Files of lines: what is read back is what was written, and nothing that stands in one can do harm.

#include "output/lines_file.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/parallel.h"
#include "base/stream_store.h"
#include "shading/ink/found_needs.h"
#include "shading/surface/shadow_casters.h"
#include "tests/support/random.h"
#include "tests/support/shaded_scene.h"
#include "tests/support/temporary_folder.h"

namespace burin {
namespace {

using namespace test;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kFew = true;  // trials, which take many times as long
#else
constexpr bool kFew = false;
#endif

constexpr std::string_view kScene = R"(
[[object]]
shape = "box"
name = "box"
[[object]]
shape = "sphere"
name = "ball"
translate = [0.6, 0.3, 0.9]
[lines]
)";
constexpr std::string_view kSheet = R"sheet(
[[set]]
name = "seen"
classes = ["silhouette", "border", "crease", "intersection", "object"]
style = "ink"
[[set]]
name = "behind"
classes = ["silhouette", "crease"]
qi = [1, 255]
style = "dots"
[style.ink]
width = "=1 + 3*light + min(gap_px, 10)/10 + 0.5*facing2"
taper = { start = 20, end = 20 }
wobble = { amplitude = 1 }
copies = 2
color = "=mix(C, C2, 0.3)"
[style.dots]
dash = [1, 3]
width = "=1.2 * 0.8^qi + 0.3*rand_chain + 0.2*rand_object"
)sheet";

std::string bytes_of(const FoundLines& lines, const KeptSurface& surface = {}) {
    MemorySink file;
    write_lines_file(file, lines, surface);
    return {reinterpret_cast<const char*>(file.bytes().data()), file.bytes().size()};
}

/// The picture that a scene's sheet makes of lines.
Image drawn(const ShadedScene& scene, const FoundLines& lines) {
    const Frame frame = scene.frame(scene.whole());
    Film film(scene.whole(), scene.whole(), {true, true, false, false, false, true, false, true, {}},
              frame.criteria.classes);
    for (int y = 0; y < film.display().height(); ++y) film.put_background(0, film.display().width(), y);
    finish_stream_stores();
    std::vector<std::string> notes;
    draw_found_lines(frame, lines, 1, film, notes);
    return film.image();
}

void expect_equal(const Image& a, const Image& b) {
    ASSERT_EQ(a.channels().size(), b.channels().size());
    for (std::size_t i = 0; i < a.channels().size(); ++i) {
        const auto &p = a.channels()[i].bytes, &q = b.channels()[i].bytes;
        ASSERT_EQ(p.size(), q.size());
        EXPECT_EQ(std::memcmp(p.data(), q.data(), p.size()), 0) << a.channels()[i].name;
    }
}

TEST(LinesFile, IsReadBackToTheBit) {
    const ShadedScene scene(kScene, kSheet);
    FoundLines lines = scene.found();
    ASSERT_GT(lines.runs.pieces.size(), 50u);
    const TemporaryFolder folder;
    KeptSurface surface{lines.width_px, lines.height_px, {}};
    surface.pixels.resize(static_cast<std::size_t>(lines.width_px * lines.height_px), {0.25f, 0.5f, 1, 1});
    const std::string bytes = bytes_of(lines, surface);
    LinesFile read = read_lines_file(folder.write("a.lines", bytes));
    EXPECT_EQ(bytes_of(read.lines, read.surface), bytes);
    read.lines.light = lines.light;
    expect_equal(drawn(scene, lines), drawn(scene, read.lines));
}

/// Chains that only hidden lines have are kept as such: a sheet that needs those of visible ones is refused.
TEST(LinesFile, KnowsWhichLinesHaveChains) {
    const auto sheet = [](const std::string& visible, const std::string& hidden) {
        return "[[set]]\nname = \"seen\"\nclasses = [\"crease\"]\nstyle = \"ink\"\n"
               "[[set]]\nname = \"behind\"\nclasses = [\"crease\"]\nqi = [1, 255]\nstyle = \"dots\"\n"
               "[style.ink]\n" +
               visible + "\n[style.dots]\n" + hidden + "\n";
    };
    const std::string kDash = "dash = [3, 2]";
    const TemporaryFolder folder;
    for (const bool of_visible : {false, true}) {
        for (const bool of_hidden : {false, true}) {
            const ShadedScene scene(kScene, sheet(of_visible ? kDash : "", of_hidden ? kDash : ""));
            const LinesFile read = read_lines_file(folder.write("a.lines", bytes_of(scene.found())));
            EXPECT_EQ(read.lines.has_chains, of_visible);
            EXPECT_EQ(read.lines.has_hidden_chains, of_visible || of_hidden);
            expect_equal(drawn(scene, scene.found()), drawn(scene, read.lines));
            for (const bool visible_too : {false, true}) {
                const ShadedScene other(kScene, sheet(visible_too ? kDash : "", kDash));
                const Frame frame = other.frame(other.whole());
                const bool has_all = of_visible || (of_hidden && !visible_too);
                EXPECT_EQ(missing_for(*frame.scene->sheet, frame.sheet->needs(), read.lines), has_all ? "" : "chains");
            }
        }
    }
}

TEST(LinesFile, HasTheLayoutOfSafetensors) {
    const std::string bytes = bytes_of(ShadedScene(kScene, kSheet).found());
    std::uint64_t size = 0;
    std::memcpy(&size, bytes.data(), sizeof size);
    EXPECT_EQ((size + sizeof size) % 64, 0u);
    const auto directory = nlohmann::ordered_json::parse(bytes.substr(sizeof size, size));
    EXPECT_EQ(directory["__metadata__"]["format"], "burin-lines 1");
    std::uint64_t at = 0;
    std::size_t width = 8;
    for (const auto& [name, entry] : directory.items()) {
        if (name == "__metadata__") continue;
        EXPECT_EQ(entry["data_offsets"][0], at) << name;
        at = entry["data_offsets"][1].get<std::uint64_t>();
        const std::string type = entry["dtype"];
        const std::size_t bytes_of_number = static_cast<std::size_t>(std::stoi(type.substr(1))) / 8;
        EXPECT_LE(bytes_of_number, width) << name << ": arrays of wide numbers come first";
        width = bytes_of_number;
    }
    EXPECT_EQ(sizeof size + size + at, bytes.size());
}

TEST(LinesFile, AnEmptyPictureIsAFileToo) {
    ShadedScene scene(kScene, kSheet);
    FoundLines lines = scene.found();
    lines.runs = {};
    lines.sides.clear();
    lines.boundaries.clear();
    const TemporaryFolder folder;
    EXPECT_TRUE(read_lines_file(folder.write("a.lines", bytes_of(lines))).lines.runs.runs.empty());
}

/// A strip of two squares with texture coordinates, colours and an attribute, and a ball beside it.
std::string scene_with_values(const TemporaryFolder& folder) {
    const std::string model = folder.write(
        "strip.ply",
        "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
        "property float s\nproperty float t\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
        "property float heat\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0 0 0 0 90 255 1\n1 0 0 0.5 0 80 90 0 2\n2 0 -1 1 0 160 90 255 3\n0 1 0 0 1 0 20 9 4\n"
        "1 1 0 0.5 1 0 20 9 5\n2 1 -1 1 1 0 20 9 6\n4 0 1 4 3\n4 1 2 5 4\n");
    return "[[object]]\nfile = \"" + model + "\"\n[[object]]\nshape = \"sphere\"\ntranslate = [1, 1.5, 0]\n";
}
constexpr const char* kReads =
    "width = \"=1 + min(isophote(0.2), 5) + 3*u + v + attr(\\\"heat\\\") / 4\"\n"
    "color = \"=Cv\"";

TEST(LinesFile, KeepsWhatTheSheetReadsOfSurfaces) {
    const TemporaryFolder folder;
    const ShadedScene scene(scene_with_values(folder), sheet_of(R"("silhouette", "border", "crease")", kReads));
    const FoundLines lines = scene.found();
    EXPECT_EQ(lines.surface.column_count(), 7u);
    const std::string bytes = bytes_of(lines);
    const LinesFile read = read_lines_file(folder.write("a.lines", bytes));
    EXPECT_EQ(read.lines.surface, lines.surface);
    EXPECT_EQ(bytes_of(read.lines), bytes);
    expect_equal(drawn(scene, lines), drawn(scene, read.lines));
}

void expect_error(const std::string& bytes, const std::string& message) {
    const TemporaryFolder folder;
    try {
        read_lines_file(folder.write("a.lines", bytes));
        FAIL() << "read: " << message;
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("a.lines"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    }
}

/// A file with a change of its directory.
template <typename Change>
std::string with_directory(const std::string& bytes, const Change& change) {
    std::uint64_t size = 0;
    std::memcpy(&size, bytes.data(), sizeof size);
    auto directory = nlohmann::ordered_json::parse(bytes.substr(sizeof size, size));
    change(directory);
    const std::string text = directory.dump();
    size = text.size();
    std::string changed(reinterpret_cast<const char*>(&size), sizeof size);
    return changed + text +
           bytes.substr(sizeof size + static_cast<std::size_t>(*reinterpret_cast<const std::uint64_t*>(bytes.data())));
}

TEST(LinesFile, WhatIsWrongIsNamed) {
    const FoundLines lines = ShadedScene(kScene, kSheet).found();
    const std::string bytes = bytes_of(lines);
    expect_error("abc", "too short");
    expect_error(std::string(64, '\xff'), "its directory is longer than the file");
    expect_error(bytes.substr(0, bytes.size() - 1), "lies beyond the end");
    expect_error(bytes + "x", "has bytes that no array has");
    using Json = nlohmann::ordered_json;
    expect_error(with_directory(bytes, [](Json& d) { d["__metadata__"]["format"] = "burin-lines 9"; }), "format");
    expect_error(with_directory(bytes, [](Json& d) { d["xy"]["dtype"] = "F32"; }), "xy: dtype must be F64");
    expect_error(with_directory(bytes, [](Json& d) { d["qi"]["shape"] = {3}; }), "qi: must have");
    expect_error(with_directory(bytes, [](Json& d) { d["__metadata__"]["width"] = "0"; }), "width");
    expect_error(with_directory(bytes, [](Json& d) { d["__metadata__"]["objects"] = "[\"box\"]"; }),
                 "object_from_view");
    expect_error(with_directory(bytes, [](Json& d) { d["s"]["data_offsets"] = d["xy"]["data_offsets"]; }), "overlap");
    FoundLines wrong = lines;
    wrong.sides[5].front_object = 77;
    expect_error(bytes_of(wrong), "owners: row 5");
    wrong = lines;
    wrong.runs.pieces[3].piece.from.x = std::numeric_limits<double>::quiet_NaN();
    expect_error(bytes_of(wrong), "xy: row 6 is not finite");
    wrong = lines;
    wrong.runs.runs[1].first = 0;
    expect_error(bytes_of(wrong), "chain_first: row 1");
}

TEST(LinesFile, WhatIsWrongWithValuesOfSurfacesIsNamed) {
    const TemporaryFolder folder;
    const ShadedScene scene(scene_with_values(folder), sheet_of(R"("silhouette", "border", "crease")", kReads));
    const FoundLines lines = scene.found();
    FoundLines wrong = lines;
    wrong.surface_values[3] = std::numeric_limits<float>::infinity();
    expect_error(bytes_of(wrong), "Cv: row 0 is not finite");
    using Json = nlohmann::ordered_json;
    const std::string bytes = bytes_of(lines);
    const auto with_names = [&](const char* names) {
        return with_directory(bytes, [&](Json& d) { d["__metadata__"]["attributes"] = names; });
    };
    expect_error(with_names("[]"), "ascending order");
    expect_error(with_names(R"(["b", "a"])"), "ascending order");
    expect_error(with_names(R"(["a", "a"])"), "ascending order");
    expect_error(with_names(R"(["a", "b"])"), "attributes: shape must have 2 numbers");
    expect_error(with_directory(bytes, [](Json& d) { d["uv"]["shape"][0] = 2; }), "uv: must have");
    expect_error(with_directory(bytes, [](Json& d) { d["kr"]["dtype"] = "F64"; }), "kr: dtype");
}

/// The file of some lines, of which a few bytes at a time are others.
class ChangedFile {
  public:
    explicit ChangedFile(const std::string& bytes) : bytes_(bytes), path_(folder_.write("a.lines", bytes)) {}

    /// Changes up to four bytes of the directory, or behind it, and sometimes how long the file is.
    const std::string& change(Random& random) {
        std::uint64_t size = 0;
        std::memcpy(&size, bytes_.data(), sizeof size);
        const bool is_in_directory = random.integer(0, 1) == 0;
        if (was_cut_) folder_.write("a.lines", bytes_);
        std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
        const auto put = [&](std::size_t at, char byte) { file.seekp(static_cast<std::streamoff>(at)).put(byte); };
        for (const std::size_t at : changed_) put(at, bytes_[at]);
        changed_.clear();
        for (int k = random.integer(1, 4); k > 0; --k) {
            const std::size_t low = is_in_directory ? 0 : sizeof size + size;
            const std::size_t high = is_in_directory ? sizeof size + size : bytes_.size();
            changed_.push_back(low + random.bits() % (high - low));
            put(changed_.back(), static_cast<char>(is_in_directory && random.integer(0, 3) > 0
                                                       ? "0123456789[]{}\",:-e"[random.integer(0, 18)]
                                                       : static_cast<int>(random.bits() & 0xFF)));
        }
        file.close();
        was_cut_ = random.integer(0, 9) == 0;
        if (was_cut_) std::filesystem::resize_file(path_, random.bits() % bytes_.size());
        return path_;
    }

  private:
    const TemporaryFolder folder_;
    const std::string bytes_, path_;
    std::vector<std::size_t> changed_;
    bool was_cut_ = false;
};

/// A ball that casts its shadow on a box, so that lines run from light into shadow.
std::string lit_scene(const char* light = "direction = [-0.4, 0.3, 1]") {
    return std::string("[[light]]\n") + light +
           "\n[[object]]\nshape = \"box\"\nname = \"box\"\n[[object]]\nshape = \"sphere\"\nradius = 0.4\n"
           "segments = 12\nrings = 6\ntranslate = [-0.2, 0.4, 1.2]\n";
}
const std::string kLitInk = "width = \"=1 + 3 * lit\"\ntaper = { start = 4 }";

TEST(LinesFile, KeepsWhatCastsShadowsIfTheSheetReadsIt) {
    const TemporaryFolder folder;
    const std::string classes = R"("silhouette", "crease", "polygon")", plain = "width = 2";
    for (const char* light : {"direction = [-0.4, 0.3, 1]", "position = [-1, 1.5, 4]"}) {
        const ShadedScene scene(lit_scene(light), sheet_of(classes, kLitInk));
        const FoundLines lines = scene.found();
        const std::string bytes = bytes_of(lines);
        const LinesFile read = read_lines_file(folder.write("a.lines", bytes));
        EXPECT_EQ(bytes_of(read.lines), bytes);
        expect_equal(drawn(scene, lines), drawn(scene, read.lines));
        // Another sheet has its samples elsewhere; and what is lit differs from what is not.
        for (const char* ink : {"width = \"=2 + 2 * lit * s / 10\"", "width = 4"}) {
            const ShadedScene other(lit_scene(light), sheet_of(classes, ink));
            const Frame frame = other.frame(other.whole());
            EXPECT_EQ(missing_for(*frame.scene->sheet, frame.sheet->needs(), read.lines), "");
            expect_equal(drawn(other, lines), drawn(other, read.lines));
        }
        FoundLines all_lit = lines;
        all_lit.casters = nullptr;
        EXPECT_FALSE(same_bits(drawn(scene, lines), drawn(scene, all_lit)));
    }
    // Nothing of it is kept where nobody reads it.
    const std::string bytes = bytes_of(ShadedScene(lit_scene(), sheet_of(classes, plain)).found());
    EXPECT_EQ(bytes.find("casters"), std::string::npos);
    EXPECT_EQ(bytes.find("shadow_"), std::string::npos);
}

TEST(LinesFile, SaysWhereShadowsAreOfAnotherLight) {
    const TemporaryFolder folder;
    const std::string classes = R"("silhouette", "crease", "polygon")", other_light = "light = [1, 1, 1]\n";
    const auto missing = [&](const std::string& saved, const std::string& asked) {
        const LinesFile read =
            read_lines_file(folder.write("a.lines", bytes_of(ShadedScene(lit_scene(), saved).found())));
        const ShadedScene scene(lit_scene(), asked);
        const Frame frame = scene.frame(scene.whole());
        return missing_for(*frame.scene->sheet, frame.sheet->needs(), read.lines);
    };
    const std::string own = sheet_of(classes, kLitInk), turned = other_light + own;
    EXPECT_EQ(missing(own, own), "");
    EXPECT_EQ(missing(turned, turned), "");
    EXPECT_EQ(missing(own, turned), "what casts shadows (lit) in the light of this sheet");
    EXPECT_EQ(missing(turned, own), "what casts shadows (lit) in the light of this sheet");
    EXPECT_EQ(missing(sheet_of(classes, "width = \"=1 + light\"\ntaper = { start = 4 }"), own),
              "what casts shadows (lit)");
}

TEST(LinesFile, WhatIsWrongWithShadowsIsNamed) {
    const std::string bytes = bytes_of(ShadedScene(lit_scene(), sheet_of(R"("crease")", kLitInk)).found());
    using Json = nlohmann::ordered_json;
    const auto with = [&](const char* key, const char* value) {
        return with_directory(bytes, [&](Json& d) { d["__metadata__"][key] = value; });
    };
    expect_error(with("shadow_light", "[0, 0, 0, 2]"), "the direction must have the length 1");
    expect_error(with("shadow_light", "[1, 0, 1e300, 2]"), "shadow_light[2]");
    expect_error(with("shadow_distance", "-1"), "shadow_distance: is out of range");
    expect_error(with_directory(bytes, [](Json& d) { d["__metadata__"].erase("shadow_distance"); }), "shadow_distance");
    expect_error(with_directory(bytes, [](Json& d) { d["casters"]["dtype"] = "F32"; }), "casters: dtype must be F64");
    expect_error(with_directory(bytes, [](Json& d) { d["casters"]["shape"][0] = 2; }), "casters: its shape");
    FoundLines wrong = ShadedScene(lit_scene(), sheet_of(R"("crease")", kLitInk)).found();
    std::vector<ShadowCasters::Caster> casters(wrong.casters->casters().begin(), wrong.casters->casters().end());
    casters[2].edges[1].y = 1e60;
    wrong.casters = std::make_shared<const ShadowCasters>(casters, wrong.casters->light(), 0.0);
    expect_error(bytes_of(wrong), "casters: row 2 is out of range");
}

/// Bytes of numbers and of the directory are changed: the file is refused, or its lines can be drawn.
void expect_no_harm(const ShadedScene& scene, std::uint64_t trials) {
    const std::string bytes = bytes_of(scene.found());
    const Frame frame = scene.frame(scene.whole());
    constexpr std::uint64_t kAtOnce = 500;
    std::atomic<std::uint64_t> read{0};
    parallel_for(trials / kAtOnce, 2, [&](std::size_t batch, int) {
        ChangedFile file(bytes);
        for (std::uint64_t seed = batch * kAtOnce; seed < (batch + 1) * kAtOnce; ++seed) {
            SCOPED_TRACE("seed " + std::to_string(seed));
            Random random(seed);
            const std::string& path = file.change(random);
            try {
                const LinesFile lines = read_lines_file(path);
                ++read;
                if (seed % 8 != 0) continue;
                std::vector<std::string> notes;
                ink_lines(lines.lines, *frame.sheet, 1, notes);
            } catch (const InputError& error) {
                ASSERT_NE(std::string(error.what()).find("a.lines"), std::string::npos) << error.what();
            }
        }
    });
    EXPECT_GT(read, trials / 100);
    EXPECT_LT(read, trials - trials / 100);
}

TEST(LinesFileMutations, DoNoHarm) { expect_no_harm(ShadedScene(kScene, kSheet, 30, 25), kFew ? 5000 : 60000); }

TEST(LinesFileMutations, OfValuesOfSurfacesDoNoHarm) {
    const TemporaryFolder folder;
    const ShadedScene scene(scene_with_values(folder), sheet_of(R"("silhouette", "border", "crease")", kReads), 30, 25);
    expect_no_harm(scene, kFew ? 5000 : 40000);
}

TEST(LinesFileMutations, OfShadowsDoNoHarm) {
    expect_no_harm(ShadedScene(lit_scene(), sheet_of(R"("silhouette", "crease", "polygon")", kLitInk), 60, 50), 2000);
    expect_no_harm(
        ShadedScene(lit_scene("position = [-1, 1.5, 4]"), sheet_of(R"("silhouette", "crease")", kLitInk), 60, 50),
        1000);
}

}  // namespace
}  // namespace burin
