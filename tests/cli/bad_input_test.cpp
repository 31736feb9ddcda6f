// Broken input: exit status 1, one line on standard error that begins with the file's name, and
// nothing else anywhere.

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "tests/cli/models.h"
#include "tests/cli/program.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"

namespace burin::test::bad_input_test {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kExtensions = {".obj", ".ply", ".stl", ".off", ".gltf", ".glb", ".toml"};

ProgramResult render(const TemporaryFolder& folder, const std::string& input) {
    return run_burin(folder.path(), {"render", input, "-r", "16x12", "-o", "out.exr"});
}

/// Expects a failure that names the input, or another file in its place.
void expect_refused(const TemporaryFolder& folder, const std::string& input, const std::string& words = "",
                    const std::string& named = "") {
    const auto before = folder.names();
    const ProgramResult result = render(folder, input);
    EXPECT_FALSE(result.timed_out) << input;
    EXPECT_EQ(result.status, 1) << input << ": " << result.err;
    EXPECT_EQ(result.out, "") << input;
    EXPECT_TRUE(is_one_line(result.err)) << input << ": " << result.err;
    EXPECT_EQ(result.err.find(named.empty() ? input : named), 0u) << input << ": " << result.err;
    EXPECT_NE(result.err.find(words), std::string::npos) << input << ": " << result.err;
    EXPECT_EQ(folder.names(), before) << input;
}

TEST(BadInput, FilesThatAreNotThere) {
    const TemporaryFolder folder;
    for (const std::string& extension : kExtensions) {
        expect_refused(folder, "missing" + extension, "cannot open");
        expect_refused(folder, "no folder/missing" + extension, "cannot open");
        expect_refused(folder, folder.file("missing") + extension,
                       "cannot open");  // as it was typed
    }
    folder.write("model.xyz", "x");
    folder.write("model", "x");
    expect_refused(folder, "model.xyz", "unknown kind of input");
    expect_refused(folder, "model", "unknown kind of input");
    expect_refused(folder, "/dev/zero", "unknown kind of input");
    expect_refused(folder, "/dev/stdin", "standard input is not read");
}

TEST(BadInput, NamesWithLineFeedsStayOnOneLine) {
    const TemporaryFolder folder;
    for (const char* input : {"new\nline.obj", "new\nline.toml", "new\nline", "\x1b[31mred.obj"}) {
        const ProgramResult result = render(folder, input);
        EXPECT_EQ(result.status, 1);
        EXPECT_TRUE(is_one_line(result.err)) << result.err;
        EXPECT_EQ(result.err.find('\x1b'), std::string::npos) << result.err;
    }
}

TEST(BadInput, ThingsThatAreNoFiles) {
    const TemporaryFolder folder;
    for (const std::string& extension : kExtensions) {
        fs::create_directory(folder.file("folder" + extension));
        ASSERT_EQ(::mkfifo(folder.file("pipe" + extension).c_str(), 0600), 0);
        fs::create_symlink("/dev/zero", folder.file("zero" + extension));
        fs::create_symlink("/dev/null", folder.file("null" + extension));
        fs::create_symlink("loop" + extension, folder.file("loop" + extension));
        for (const char* name : {"folder", "pipe", "zero", "null"})
            expect_refused(folder, name + extension, "not a regular file");
        expect_refused(folder, "loop" + extension, "cannot open");
    }
}

TEST(BadInput, EmptyFilesAndGarbage) {
    const TemporaryFolder folder;
    Random random(1);
    std::string noise;
    for (int i = 0; i < 5000; ++i) noise += static_cast<char>(random.bits());
    for (const std::string& extension : kExtensions) {
        folder.write("empty" + extension, "");
        folder.write("blank" + extension, "\n \n");
        folder.write("zeros" + extension, std::string(1000, '\0'));
        folder.write("noise" + extension, noise);
        folder.write("text" + extension, "The quick brown fox jumps over the lazy dog.\nAnd again.\n");
        folder.write("png" + extension, "\x89PNG\r\n\x1a\n" + noise);
        expect_refused(folder, "empty" + extension, "the file is empty");
        for (const char* name : {"blank", "zeros", "noise", "text", "png"}) expect_refused(folder, name + extension);
    }
}

TEST(BadInput, TruncatedFiles) {
    const TemporaryFolder folder;
    for (const auto& [name, content] : tetrahedra()) folder.write(name, content);
    for (const auto& [name, content] : tetrahedra()) {
        if (name == "tetra.bin") continue;
        ASSERT_EQ(render(folder, name).status, 0) << name;
        fs::remove(folder.file("out.exr"));
        // Text without counts can be whole after a cut; everything else must be noticed.
        const bool may_be_whole = name == "tetra.obj" || name == "text.stl" || name == "scene.toml";
        const std::size_t step = std::max<std::size_t>(1, content.size() / 40);
        for (std::size_t size = content.size() - 2; size > 0; size -= std::min(size, step)) {
            const std::string cut = "cut" + fs::path(name).extension().string();
            folder.write(cut, content.substr(0, size));
            // Without its count, a binary STL of whole triangles is one: it is read with a note.
            const bool is_noted = name == "binary.stl" && size > 84 && (size - 84) % 50 == 0;
            if (is_noted) {
                EXPECT_NE(render(folder, cut).err.find("was it written completely?"), std::string::npos) << size;
                fs::remove(folder.file("out.exr"));
                continue;
            }
            if (!may_be_whole) {
                expect_refused(folder, cut);
                continue;
            }
            const ProgramResult result = render(folder, cut);
            EXPECT_TRUE(result.status == 0 ||
                        (result.status == 1 && is_one_line(result.err) && result.err.starts_with(cut)))
                << name << " cut at " << size << ": " << result.err;
            fs::remove(folder.file("out.exr"));
        }
    }
}

TEST(BadInput, DamagedBytesNeverCrash) {
    const TemporaryFolder folder;
    for (const auto& [name, content] : tetrahedra()) folder.write(name, content);
    for (const auto& [name, content] : tetrahedra()) {
        for (int trial = 0; trial < 12; ++trial) {
            Random random(static_cast<std::uint64_t>(trial) + 100 * content.size());
            std::string damaged = content;
            for (int i = 0; i < 1 + trial / 2; ++i) {
                damaged[static_cast<std::size_t>(random.integer(0, static_cast<int>(content.size()) - 1))] =
                    static_cast<char>(random.bits());
            }
            std::string input = "bad" + fs::path(name).extension().string();
            if (name == "tetra.bin") {
                folder.write("tetra.bin", damaged);
                input = "tetra.gltf";
            } else {
                folder.write(input, damaged);
            }
            const ProgramResult result = render(folder, input);
            EXPECT_FALSE(result.timed_out);
            EXPECT_TRUE(result.status == 0 ||
                        (result.status == 1 && is_one_line(result.err) && result.err.starts_with(input)))
                << name << ", trial " << trial << ": status " << result.status << ' ' << result.err;
            fs::remove(folder.file("out.exr"));
        }
        folder.write(name, content);
    }
}

TEST(BadInput, CountsOfFourBillion) {
    const TemporaryFolder folder;
    const std::string ply = "ply\nformat binary_little_endian 1.0\nelement vertex ";
    const std::string rest = "\nproperty float x\nproperty float y\nproperty float z\nelement face ";
    const std::string list = "\nproperty list uint int vertex_indices\nend_header\n";
    for (const char* count :
         {"4000000000", "4294967295", "4294967296", "18446744073709551615", "99999999999999999999", "-1"}) {
        folder.write("a.ply", ply + count + rest + "1" + list + std::string(100, 'x'));
        folder.write("b.ply", ply + "0" + rest + count + list + std::string(100, 'x'));
        folder.write("c.off", std::string("OFF\n") + count + " 1 0\n0 0 0\n");
        folder.write("d.off", std::string("OFF\n3 ") + count + " 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
        folder.write("e.off", std::string("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n") + count + " 0 1 2\n");
        folder.write("f.obj", std::string("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 ") + count + "\n");
        folder.write(
            "g.gltf",
            std::string(
                R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"componentType":5126,"count":)") +
                count + R"(,"type":"VEC3"}]})");
        for (const char* name : {"a.ply", "b.ply", "c.off", "d.off", "e.off", "g.gltf"}) expect_refused(folder, name);
        if (std::string(count) != "-1") expect_refused(folder, "f.obj");  // -1 is the last vertex
    }
    // The list of one face, and the triangles of an STL.
    folder.write("h.ply", ply + "3" + rest + "1" + list + std::string(36, '\0') + std::string(4, '\xff') +
                              std::string(20, '\0'));
    expect_refused(folder, "h.ply");
    folder.write("i.stl", std::string(80, ' ') + std::string(4, '\xff') + std::string(50, '\0'));
    expect_refused(folder, "i.stl");
    folder.write("j.glb", bytes_of(std::uint32_t{0x46546C67}, std::uint32_t{2}, std::uint32_t{0xFFFFFFFF}) +
                              std::string(40, ' '));
    expect_refused(folder, "j.glb");
}

TEST(BadInput, CoordinatesThatAreNoNumbers) {
    const TemporaryFolder folder;
    const std::uint32_t nan_bits = 0x7FC00000, infinity_bits = 0x7F800000;
    for (const char* value : {"nan", "inf", "-inf", "1e31", "1e400", "x", "1,5", "0x10"}) {
        const std::string v = value;
        folder.write("a.obj", "v 0 0 0\nv 1 0 " + v + "\nv 0 1 0\nf 1 2 3\n");
        expect_refused(folder, "a.obj", "", "a.obj:2: ");
        folder.write("a.off", "OFF\n3 1 0\n0 0 0\n1 0 " + v + "\n0 1 0\n3 0 1 2\n");
        expect_refused(folder, "a.off", "", "a.off:4: ");
        folder.write("a.stl", "solid\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 " + v +
                                  "\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n");
        expect_refused(folder, "a.stl", "", "a.stl:5: ");
        folder.write("a.ply",
                     "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float "
                     "y\nproperty float z\nelement face 1\nproperty list uchar int "
                     "vertex_indices\nend_header\n0 0 0\n1 0 " +
                         v + "\n0 1 0\n3 0 1 2\n");
        expect_refused(folder, "a.ply", "", "a.ply:11: ");
    }
    for (const std::uint32_t bits : {nan_bits, infinity_bits, infinity_bits | 0x80000000u}) {
        for (const auto& [name, content] : tetrahedra()) {
            if (name != "binary.ply" && name != "binary.stl" && name != "tetra.glb" && name != "tetra.bin") continue;
            // The coordinate 1.0f stands in each of them; put the odd number in its place.
            std::string bad = content;
            const std::size_t at = bad.find(bytes_of(1.0f));
            ASSERT_NE(at, std::string::npos);
            bad.replace(at, 4, bytes_of(bits));
            folder.write(name, bad);
            if (name == "tetra.bin") {
                for (const auto& [other, text] : tetrahedra()) {
                    if (other == "tetra.gltf") folder.write(other, text);
                }
                expect_refused(folder, "tetra.gltf");
            } else if (name == "binary.stl") {  // read without the triangles that have it
                EXPECT_NE(render(folder, name).err.find("triangles left out: "), std::string::npos);
                fs::remove(folder.file("out.exr"));
            } else {
                expect_refused(folder, name);
            }
        }
    }
}

TEST(BadInput, VertexNumbersOutOfRange) {
    const TemporaryFolder folder;
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (const char* face :
         {"f 1 2 4", "f 0 1 2", "f -4 -1 -2", "f 1 2 x", "f 1 2 3.5", "f 1//9 2 99999999999999999999"}) {
        folder.write("a.obj", vertices + face + "\n");
        expect_refused(folder, "a.obj", "", "a.obj:4: ");
    }
    folder.write("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n");
    expect_refused(folder, "a.off", "", "a.off:6: ");
    folder.write("b.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n");
    expect_refused(folder, "b.off", "", "b.off:6: ");
}

std::string gltf(const std::string& nodes, const std::string& uri = "tri.bin", const std::string& scene = "[0]") {
    return R"({"asset":{"version":"2.0"},"scenes":[{"nodes":)" + scene + R"(}],"nodes":)" + nodes +
           R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
           R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],)"
           R"("bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":")" +
           uri + R"("}]})";
}

TEST(BadInput, FilesOutsideOfTheModelsFolder) {
    const TemporaryFolder folder;
    const std::string triangle = bytes_of(0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f);
    folder.write("secret.bin", triangle);
    folder.write("model/tri.bin", triangle);
    folder.write("model/sub/tri.bin", triangle);
    fs::create_symlink("../secret.bin", folder.file("model/link.bin"));
    const std::string mesh = R"([{"mesh":0}])";
    for (const char* uri : {"tri.bin", "sub/tri.bin", "./sub/../tri.bin", "%74ri.bin"}) {
        folder.write("model/a.gltf", gltf(mesh, uri));
        EXPECT_EQ(render(folder, "model/a.gltf").status, 0) << uri;
        fs::remove(folder.file("out.exr"));
    }
    std::vector<std::string> bad_uris = {"../secret.bin",
                                         "..%2Fsecret.bin",
                                         "sub/../../secret.bin",
                                         "link.bin",
                                         "/dev/zero",
                                         "/etc/passwd",
                                         "",
                                         ".",
                                         "sub",
                                         "http://example.com/a.bin",
                                         "file:///etc/passwd",
                                         "missing.bin",
                                         "data:text/plain,hello",
                                         "data:application/octet-stream;base64,!!!!",
                                         "a%00b"};
    bad_uris.push_back(folder.file("secret.bin"));
    for (const std::string& uri : bad_uris) {
        folder.write("model/a.gltf", gltf(mesh, uri));
        const ProgramResult result = render(folder, "model/a.gltf");  // names either of the two files
        EXPECT_EQ(result.status, 1) << uri;
        EXPECT_TRUE(is_one_line(result.err)) << uri << ": " << result.err;
        EXPECT_EQ(folder.names(), (std::vector<std::string>{"model", "secret.bin"})) << uri;
    }
}

TEST(BadInput, NodesThatGoInCircles) {
    const TemporaryFolder folder;
    folder.write("tri.bin", bytes_of(0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f));
    for (const char* nodes :
         {R"([{"mesh":0,"children":[0]}])", R"([{"mesh":0,"children":[1]},{"children":[0]}])",
          R"([{"mesh":0,"children":[1]},{"children":[2]},{"children":[1]}])", R"([{"mesh":0,"children":[7]}])",
          R"([{"mesh":1}])", R"([{"mesh":-1}])", R"([{"mesh":"0"}])", R"([{"mesh":0,"matrix":[1,2,3]}])",
          R"([{"mesh":0,"scale":[1e999,1,1]}])", R"([{"mesh":0,"camera":3}])", R"([{}])", R"([])", R"({})"}) {
        folder.write("a.gltf", gltf(nodes));
        expect_refused(folder, "a.gltf");
    }
    // Each node twice the children of the next: 2^40 objects if nobody counts.
    std::string nodes = "[";
    for (int i = 0; i < 40; ++i) {
        const std::string next = std::to_string(i + 1);
        nodes += R"({"children":[)" + next + "," + next + "]},";
    }
    folder.write("a.gltf", gltf(nodes + R"({"mesh":0}])"));
    expect_refused(folder, "a.gltf");
    // A long chain must not overflow the stack, whatever becomes of it.
    nodes = "[";
    for (int i = 0; i < 20000; ++i) nodes += R"({"children":[)" + std::to_string(i + 1) + "]},";
    folder.write("a.gltf", gltf(nodes + R"({"mesh":0}])"));
    EXPECT_LE(render(folder, "a.gltf").status, 1);
    fs::remove(folder.file("out.exr"));
    folder.write("a.gltf", R"({"asset":)" + std::string(200000, '[') + std::string(200000, ']') + "}");
    expect_refused(folder, "a.gltf");
}

TEST(BadInput, ModelsWithoutSurfaces) {
    const TemporaryFolder folder;
    folder.write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    folder.write("dots.obj", "v 0 0 0\nv 1 0 0\nv 0 0 0\nl 1\nl 1 3\n");
    folder.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    folder.write("same.obj", "v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n");
    for (const char* name : {"points.obj", "dots.obj", "flat.obj", "same.obj"}) expect_refused(folder, name);
}

TEST(BadInput, ScenesWithBrokenParts) {
    const TemporaryFolder folder;
    folder.write("bad.obj", "v 0 0 0\nf 1 2 3\n");
    folder.write("a.toml", "[[object]]\nfile='bad.obj'\n");
    expect_refused(folder, "a.toml", "", "a.toml:2:6: bad.obj:2: ");
    folder.write("a.toml", "[[object]]\nfile='missing.obj'\n");
    expect_refused(folder, "a.toml", "cannot open", "a.toml:2:6: missing.obj: ");
    folder.write("a.toml", "[[object]]\nshape='teapot'\nsubdivide=8\n");
    expect_refused(folder, "a.toml", "object 'teapot'", "a.toml:1:1: ");
    folder.write("a.toml", "[[object]]\nfile='a.toml'\n");
    expect_refused(folder, "a.toml");
    folder.write("a.toml", "[[object]]\nshape='box'\n[lines]\nwidht=1\n");
    expect_refused(folder, "a.toml", "did you mean 'width'?", "a.toml:4:1: ");
    folder.write("a.toml", "[[object]]\nshape='box'\n[[camera]]\neye=[1,2,3]\ntarget=[1,2,3]\n");
    expect_refused(folder, "a.toml", "same place", "a.toml:3:1: ");
    folder.write("a.toml", "[[object]]\nshape='box'\n\"a\\nb\\u001b[31m\"=1\n");
    expect_refused(folder, "a.toml", "a?b?[31m");
    folder.write("a.toml", "[[object]]\nshape='box'\nmatrix=[1e200,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]\n");
    expect_refused(folder, "a.toml", "far too large");
    folder.write("a.toml", "[[object]]\nshape='box'\nmatrix=[1e50,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]\n");
    expect_refused(folder, "a.toml", "1e30");
}

TEST(BadInput, AnImageThatNoMemoryHolds) {
    const TemporaryFolder folder;
    folder.write("cube.obj", kCubeObj);
    // An EXR of visible lines is never in memory as a whole.
    using Arguments = std::vector<std::string>;
    for (const Arguments& kind :
         {Arguments{"out.png"}, Arguments{"out.exr", "--hidden", "solid"}, Arguments{"out.exr", "--method", "patel"}}) {
        Arguments arguments{"render", "cube.obj", "-r", "65535x65535", "-o"};
        arguments.insert(arguments.end(), kind.begin(), kind.end());
        const ProgramResult result = run_burin(folder.path(), arguments);
        EXPECT_EQ(result.status, 1);
        EXPECT_TRUE(is_one_line(result.err)) << result.err;
        EXPECT_NE(result.err.find("make it smaller, ask for fewer layers"), std::string::npos) << result.err;
        EXPECT_EQ(folder.names(), std::vector<std::string>{"cube.obj"});
    }
}

}  // namespace
}  // namespace burin::test::bad_input_test
