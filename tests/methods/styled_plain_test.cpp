// A sheet with the look of [lines] makes the picture that [lines] makes.

#include <gtest/gtest.h>

#include "tests/support/shaded_scene.h"

namespace burin {
namespace {

using namespace test;

std::string classes_of(LineClassSet classes) {
    std::string text;
    for (std::size_t c = 0; c < kLineClassCount; ++c) {
        if (classes.has(static_cast<LineClass>(c)))
            text += (text.empty() ? "\"" : ", \"") + std::string(kLineClassNames[c]) + "\"";
    }
    return text;
}

struct Difference {
    std::size_t count = 0;
    double most = 0, sum_a = 0, sum_b = 0;
    std::string where;
};
Difference difference(const Image& a, const Image& b) {
    Difference d;
    for (const Channel& channel : a.channels()) {
        const Channel* other = b.find(channel.name);
        if (other == nullptr) continue;
        for (int y = 0; y < a.height(); ++y) {
            for (int x = 0; x < a.width(); ++x) {
                const double p = a.value(channel, x, y), q = b.value(*other, x, y);
                if (channel.name == "lines.A") d.sum_a += p, d.sum_b += q;
                if (p == q) continue;
                ++d.count;
                if (std::abs(p - q) > d.most) {
                    d.most = std::abs(p - q);
                    d.where = channel.name + " " + std::to_string(x) + "," + std::to_string(y) + ": " +
                              std::to_string(p) + " " + std::to_string(q);
                }
            }
        }
    }
    return d;
}

struct PlainLook {
    std::string name, sheet;
    std::vector<Override> overrides;
};

std::vector<PlainLook> plain_looks() {
    const std::string set = "[[set]]\nname='visible'\nstyle='ink'\nclasses=[CLASSES]\n";
    const std::string behind = "[[set]]\nname='behind'\nstyle='behind'\nqi=[1,255]\nclasses=[CLASSES]\n";
    return {
        {"plain", set + "[style.ink]\nwidth=1\n", {}},
        {"wide", set + "[style.ink]\nwidth=6\n", {{"lines.width", "6"}}},
        {"hidden",
         set + behind + "[style.ink]\nwidth=1\n[style.behind]\nwidth=2\ncolor='#808080'\n",
         {{"lines.hidden.style", "\"solid\""}, {"lines.hidden.width", "2"}, {"lines.hidden.color", "\"#808080\""}}},
        {"inside", set + "[style.ink]\nwidth=6\nside='inside'\n", {{"lines.side", "\"inside\""}, {"lines.width", "6"}}},
        {"outside",
         set + "[style.ink]\nwidth=6\nside='outside'\n",
         {{"lines.side", "\"outside\""}, {"lines.width", "6"}}},
        {"fading",
         "crease_angle=[20,60]\n" + set + "[style.ink]\nwidth=2\n",
         {{"lines.crease_angle", "[20, 60]"}, {"lines.width", "2"}}},
    };
}

TEST(StyledPlain, DISABLED_Explore) {
    for (const char* scene_name : {"cube", "still_life", "crossing", "flange", "teapot", "star", "cage"}) {
        const std::string path = BURIN_SOURCE_FOLDER "/scenes/" + std::string(scene_name) + ".toml";
        for (const PlainLook& look : plain_looks()) {
            std::vector<Override> overrides = look.overrides;
            overrides.push_back({"lines.color", "\"#000000\""});
            for (const std::string_view c : kLineClassNames)
                overrides.push_back({"lines.colors." + std::string(c), "\"#000000\""});
            Scene scene = load_scene(read_scene_file(path, overrides));
            const Camera camera = resolve_camera(scene.cameras.front(), scene_points(scene), 200.0 / 160);
            Frame frame = make_frame(scene, camera, 200, 160, {0, 0, 200, 160});
            frame.needs.whole_picture = true;
            LayerSet layers{true, true, true, true, true, true, true, true};
            Film film({0, 0, 200, 160}, frame.crop, layers, frame.criteria.classes);
            RunOptions options;
            options.threads = 1;
            render_abuffer(frame, options, film);
            const Image plain = film.image();
            std::string sheet = look.sheet;
            for (std::size_t at; (at = sheet.find("CLASSES")) != std::string::npos;)
                sheet.replace(at, 7, classes_of(scene.lines.classes));
            SceneDescription description = read_scene_file(path, {{"lines.draw", "\"all\""}});
            const ShadedScene styled(std::move(description), sheet, 200, 160);
            const Difference d = difference(plain, styled.draw());
            std::printf("%-12s %-8s %zu differ, most %.4f (%s), mass %.2f %.2f\n", scene_name, look.name.c_str(),
                        d.count, d.most, d.where.c_str(), d.sum_a, d.sum_b);
        }
    }
}

TEST(StyledPlain, DISABLED_Classes) {
    for (const char* scene_name : {"teapot", "cage"}) {
        const std::string path = BURIN_SOURCE_FOLDER "/scenes/" + std::string(scene_name) + ".toml";
        const ShadedScene styled(read_scene_file(path, {}),
                                 "[style.ink]\n[[set]]\nname='a'\nstyle='ink'\nclasses=['border','silhouette','crease',"
                                 "'object','intersection']\n",
                                 200, 160);
        const FoundLines f = styled.found();
        for (const RunPiece& p : f.runs.pieces) {
            if ((p.piece.classes & f.classes).first() != p.piece.drawn_as)
                std::printf("%s %x %x drawn %d at %f %f line %lx\n", scene_name, p.piece.classes.bits, f.classes.bits,
                            (int)p.piece.drawn_as, p.piece.from.x, p.piece.from.y, p.piece.line.bits);
        }
    }
}

TEST(StyledPlain, DISABLED_Boundaries) {
    const std::string path = BURIN_SOURCE_FOLDER "/scenes/teapot.toml";
    Scene scene = load_scene(read_scene_file(path, {}));
    const Camera camera = resolve_camera(scene.cameras.front(), scene_points(scene), 200.0 / 160);
    Frame frame = make_frame(scene, camera, 200, 160, {0, 0, 200, 160});
    frame.needs.whole_picture = true;
    Film film({0, 0, 200, 160}, frame.crop, LayerSet{}, frame.criteria.classes);
    RunOptions options;
    LineDrawing d = find_drawing(frame, options, film);
    const auto near = [](glm::dvec2 p) { return glm::distance(p, glm::dvec2(134.5, 56.5)) < 3; };
    for (const auto& list : d.visible())
        for (const LinePiece& p : list)
            if (near(p.from))
                std::printf("P %f %f - %f %f occ %d drawn %d as %d cl %x near %g left %d\n", p.from.x, p.from.y, p.to.x,
                            p.to.y, p.occludes, p.is_drawn, (int)p.drawn_as, p.classes.bits, p.nearness_from,
                            p.front_on_left);
    const ShadedScene styled(read_scene_file(path, {}),
                             "[style.ink]\n[[set]]\nname='a'\nstyle='ink'\nclasses=['border','silhouette','crease','"
                             "object','intersection']\n",
                             200, 160);
    InkedLines f = styled.inked();
    for (const InkBoundary& p : f.boundaries)
        if (near(p.from))
            std::printf("B %f %f - %f %f drawn %d as %d near %g left %d\n", p.from.x, p.from.y, p.to.x, p.to.y,
                        p.is_drawn, (int)p.order.drawn_as, p.nearness_from, p.front_on_left);
    for (const InkStroke& s : f.strokes)
        for (std::size_t i = 0; i + 1 < s.point_count; ++i) {
            const InkPoint& p = f.points[s.first_point + i];
            if (near(p.place))
                std::printf("S %f %f as %d near %g occ %d left %d behind %d w %f\n", p.place.x, p.place.y,
                            (int)s.order.drawn_as, p.nearness, p.occludes, p.front_on_left, s.is_behind, p.width_px);
        }
}

}  // namespace
}  // namespace burin
