// Motion blur and depth of field by the program.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "image/exr_reader.h"
#include "image/half.h"
#include "tests/cli/pieces.h"
#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

namespace burin::test::blur_test {
namespace {

using Arguments = std::vector<std::string>;

constexpr const char* kMoving = R"([[camera]]
eye = [0, 1, 8]
target = [0, 0, 0]
[[object]]
shape = "box"
[[object.key]]
frame = 1
translate = [-2, 0, 0]
[[object.key]]
frame = 9
translate = [2, 0, 0]
rotate = [0, 90, 0]
[[object]]
shape = "sphere"
segments = 16
translate = [0, 0, -3]
)";

class Blur : public ::testing::Test {
  protected:
    ProgramResult run(const std::string& scene, const Arguments& options) {
        folder_.write("scene.toml", scene);
        Arguments arguments = {"render", "scene.toml"};
        if (std::find(options.begin(), options.end(), "-r") == options.end())
            arguments.insert(arguments.end(), {"-r", "90x60"});
        arguments.insert(arguments.end(), options.begin(), options.end());
        return run_burin(folder_.path(), arguments);
    }
    std::string bytes(const std::string& scene, Arguments options) {
        options.insert(options.end(), {"-o", "out.exr"});
        const ProgramResult result = run(scene, options);
        EXPECT_EQ(result.status, 0) << result.err;
        return read_file(folder_.file("out.exr"));
    }
    Image image(const std::string& scene, Arguments options) {
        bytes(scene, std::move(options));
        return read_exr(folder_.file("out.exr"));
    }

    TemporaryFolder folder_;
};

TEST_F(Blur, IsTheMeanOfFramesRenderedOneByOne) {
    const std::string opened = std::string("[shutter]\nopen = 0\nclose = 1\nsamples = 4\n") + kMoving;
    const Image blurred = image(opened, {"--frame", "4", "--layers", "beauty,lines,Z"});
    std::vector<Image> frames;
    for (const char* frame : {"4.125", "4.375", "4.625", "4.875"}) {
        const ProgramResult result = run(kMoving, {"-f", frame, "-o", "one_##.###.exr", "--layers", "beauty,lines,Z"});
        ASSERT_EQ(result.status, 0) << result.err;
        frames.push_back(read_exr(folder_.file(std::string("one_0") + frame + ".exr")));
    }
    for (const char* name : {"R", "A", "lines.A"}) {
        for (std::size_t i = 0; i < blurred.pixel_count(); ++i) {
            float sum = 0;
            for (const Image& frame : frames) sum += float_from_half(frame.find(name)->as<std::uint16_t>()[i]);
            ASSERT_EQ(blurred.find(name)->as<std::uint16_t>()[i], half_from_float(sum / 4)) << name << " " << i;
        }
    }
    const ProgramResult middle = run(kMoving, {"-f", "4.5", "-o", "mid_#.#.exr"});
    ASSERT_EQ(middle.status, 0) << middle.err;
    EXPECT_EQ(read_exr(folder_.file("mid_4.5.exr")).find("Z")->bytes, blurred.find("Z")->bytes);
}

TEST_F(Blur, AtRestHasTheBytesOfNone) {
    const std::string still = "[[object]]\nshape = \"teapot\"\n";
    const std::string sharp = bytes(still, {});
    EXPECT_EQ(bytes("[shutter]\n" + still, {}), sharp);
    EXPECT_EQ(bytes(still, {"--shutter", "-0.5,0.5"}), sharp);
    EXPECT_EQ(bytes(still, {"--lens", "0"}), sharp);
    EXPECT_EQ(bytes(still, {"--lens", "1e-5"}), sharp);
    EXPECT_EQ(bytes(still, {"--lens", "0.2", "--blur-samples", "1"}), sharp);
    EXPECT_NE(bytes(still, {"--lens", "0.2"}), sharp);
    // Keys without frames: the scene is at rest.
    EXPECT_EQ(bytes(std::string("[shutter]\n") + kMoving, {}), bytes(kMoving, {}));
}

TEST_F(Blur, FramesThreadsAndAnyMethod) {
    const std::string scene = std::string("[shutter]\nsamples = 3\n") + kMoving;
    for (const char* method : {"abuffer", "patel", "simple"}) {
        const std::string still = bytes(scene, {"--frame", "5", "-m", method, "-j", "1", "--lens", "0.1"});
        EXPECT_EQ(bytes(scene, {"--frame", "5", "-m", method, "-j", "3", "--lens", "0.1"}), still) << method;
        const Image first = read_exr(folder_.file("out.exr"));
        const ProgramResult frames = run(scene, {"-f", "4-6", "-m", method, "--lens", "0.1", "-o", "f.#.exr"});
        ASSERT_EQ(frames.status, 0) << frames.err;
        const Image one = read_exr(folder_.file("f.0005.exr"));
        for (const Channel& channel : first.channels()) {
            EXPECT_EQ(one.find(channel.name)->bytes, channel.bytes) << method << " " << channel.name;
        }
    }
}

TEST_F(Blur, ViewsOfASheetAreSharp) {
    folder_.write("views.toml", std::string("[shutter]\n") + kMoving);
    for (const char* name : {"a.svg", "a.png"}) {
        const ProgramResult result = run_burin(folder_.path(), {"render", "views.toml", "-r", "64x64", "-q", "--views",
                                                                "front,top", "--blur-samples", "1", "-o", name});
        EXPECT_EQ(result.status, 0) << result.err;
    }
}

TEST_F(Blur, MistakesAreNamed) {
    const std::string still = "[[object]]\nshape = \"box\"\n";
    const auto expect = [&](const std::string& scene, Arguments options, int status, const std::string& words) {
        const ProgramResult result = run(scene, options);
        EXPECT_EQ(result.status, status) << words;
        EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
    };
    expect(still, {"--shutter", "0.5,0.5"}, 2, "--shutter: must open before it closes");
    expect(still, {"--shutter", "0.5"}, 2, "--shutter: must be OPEN,CLOSE");
    expect(still, {"--shutter", "nan,1"}, 2, "--shutter:");
    expect(still, {"--lens", "-1"}, 2, "--lens: must be from 0");
    expect(still, {"--lens", "1", "--ortho", "3"}, 2, "--lens: an orthographic camera has no lens");
    expect("[[camera]]\nheight = 2\n" + still, {"--lens", "1"}, 2, "--lens: an orthographic camera has no lens");
    expect(still, {"--focus", "2"}, 2, "--focus: the camera has no lens");
    expect(still, {"--focus", "0", "--lens", "1"}, 2, "--focus: must be greater than 0");
    expect(still, {"--blur-samples", "4"}, 2, "--blur-samples: nothing is blurred");
    expect(still, {"--lens", "1", "--blur-samples", "5000"}, 2, "--blur-samples: must be from 1 to 4096");
    expect(still, {"--lens", "1", "-o", "out.svg"}, 2, "--lens: a vector file has no blur");
    expect("[shutter]\n" + still, {"-o", "out.svg"}, 2, "[shutter]: a vector file has no blur");
    expect(still, {"--lens", "1", "--style", "technical", "--save-lines", "a.lines"}, 2, "--lens: saved lines");
    expect(still, {"--lens", "1", "--views", "front"}, 2, "--lens: the views of a sheet");
    expect("[shutter]\nopen = 1\nclose = 0\n" + still, {}, 1,
           "scene.toml:3:9: [shutter] close: must open before it closes");
    expect("[shutter]\ncurve = [0.7, 0.7]\n" + still, {}, 1, "[shutter] curve: must be \"box\"");
    expect("[shutter]\nsamples = 0\n" + still, {}, 1, "[shutter] samples");
    expect("[[camera]]\nlens_radius = 1\nheight = 2\n" + still, {}, 1,
           "lens_radius: an orthographic camera has no lens");
    expect("[[camera]]\nshift = [101, 0]\n" + still, {}, 1, "shift: must be from -100 to 100");
    expect("[[camera]]\neye = [0, 0, 9]\nshift = [99, 0]\n" + still, {"-r", "2000x2000"}, 1,
           "the camera's shift moves");
    EXPECT_FALSE(std::filesystem::exists(folder_.file("out.svg")));
}

TEST_F(Blur, MattesAreMeans) {
    for (const Arguments& blur : std::vector<Arguments>{{"--shutter", "-0.5,0.5"},
                                                        {"--lens", "0.2", "--focus", "8"},
                                                        {"--shutter", "-0.5,0.5", "--style", "technical"}}) {
        Arguments options = blur;
        options.insert(options.end(), {"--frame", "5", "--blur-samples", "9", "--layers", "beauty,lines,crypto"});
        const Image mean = image(kMoving, options);
        for (const auto& [layer, sum_of] :
             {std::pair("CryptoObject", "A"), std::pair("CryptoMaterial", "A"), std::pair("CryptoLine", "lines.A"),
              std::pair("CryptoLineObject", "lines.A")}) {
            const auto whole = mean.find(sum_of)->as<std::uint16_t>();
            std::vector<double> sums(whole.size(), 0.0);
            bool has_soft = false;
            for (const char* const channel : {"00.G", "00.A", "01.G", "01.A", "02.G", "02.A"}) {
                const auto shares = mean.find(std::string(layer) + channel)->as<float>();
                for (std::size_t i = 0; i < sums.size(); ++i) {
                    sums[i] += static_cast<double>(shares[i]);
                    has_soft = has_soft || (shares[i] > 0.05f && shares[i] < 0.45f);
                }
            }
            EXPECT_TRUE(has_soft) << layer;
            for (std::size_t i = 0; i < sums.size(); ++i)
                ASSERT_NEAR(sums[i], static_cast<double>(float_from_half(whole[i])), 1e-3) << layer << " " << i;
        }
        const std::string once = bytes(kMoving, options);
        for (const Arguments& other : std::vector<Arguments>{{"-j", "1"}, {"-j", "7"}}) {
            Arguments again = options;
            again.insert(again.end(), other.begin(), other.end());
            EXPECT_TRUE(bytes(kMoving, again) == once) << blur.front() << other.front();
        }
        // In pieces, which a picture as small as that does not have.
        options.insert(options.end(), {"-r", "480x320"});
        Arguments picture = {"scene.toml", "-o", "x.exr"};
        picture.insert(picture.end(), options.begin(), options.end());
        const Arguments capped = in_pieces(folder_.path(), picture);
        ASSERT_FALSE(capped.empty()) << blur.front();
        const std::string whole = bytes(kMoving, options);
        options.insert(options.end(), capped.begin(), capped.end());
        EXPECT_TRUE(bytes(kMoving, options) == whole) << blur.front();
    }
}

TEST_F(Blur, LineAndMotionAreThoseOfTheMiddle) {
    const Arguments plain = {"--frame", "5", "--layers", "Z,line,motion"};
    Arguments blurred = plain;
    blurred.insert(blurred.end(), {"--shutter", "-0.5,0.5", "--blur-samples", "4"});
    const Image sharp = image(kMoving, plain), mean = image(kMoving, blurred);
    double most = 0;
    for (const Channel& channel : sharp.channels()) {
        const Channel* const other = mean.find(channel.name);
        ASSERT_NE(other, nullptr) << channel.name;
        EXPECT_TRUE(std::equal(channel.bytes.begin(), channel.bytes.end(), other->bytes.begin())) << channel.name;
    }
    for (const float u : mean.find("forward.u")->as<float>()) most = std::max(most, static_cast<double>(u));
    EXPECT_GT(most, 1) << "of a whole frame";
}

}  // namespace
}  // namespace burin::test::blur_test
