// Material files of OBJ models: opacities, and which files are read.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "mesh/read_mtl.h"
#include "mesh/readers.h"
#include "tests/support/temporary_folder.h"

namespace burin {
namespace {

class ReadMtl : public testing::Test {
  protected:
    float opacity(const std::string& statements) {
        folder_.write("a.mtl",
                      "newmtl before\nd 0.125\nTr 0.5\nnewmtl m\n" + statements + "\nnewmtl behind\nd 0.25\nTr 0.5\n");
        const auto library = read_material_files(folder_.file("a.obj"), {"a.mtl"});
        EXPECT_EQ(library.at("before").opacity, 0.125f) << statements;
        EXPECT_EQ(library.at("behind").opacity, 0.25f) << statements;
        return library.at("m").opacity;
    }
    test::TemporaryFolder folder_;
};

TEST_F(ReadMtl, TrAloneIsTheTransparencyBut1IsOpaque) {
    EXPECT_EQ(opacity("Tr 0"), 1);
    EXPECT_EQ(opacity("Tr 0.25"), 0.75f);
    EXPECT_EQ(opacity("Tr 0.75 # rest"), 0.25f);
    for (const char* one : {"Tr 1", "Tr 1.0", "Tr 1.000000", "Tr 1e0", "Tr 2", "tr 1", "Tr inf"})
        EXPECT_EQ(opacity(one), 1) << one;
    EXPECT_EQ(opacity("Tr -1"), 1);
    EXPECT_EQ(opacity("Tr nan"), 1);
    EXPECT_EQ(opacity("Kd 1 1 1"), 1);
}

TEST_F(ReadMtl, WhereThereIsADItCounts) {
    for (const char* d : {"d 0.5", "D 0.5"}) {
        for (const char* tr : {"Tr 1.0", "Tr 0.25", "Tr 0", "TR 0.75"}) {
            EXPECT_EQ(opacity(std::string(d) + "\n" + tr), 0.5f) << d << ' ' << tr;
            EXPECT_EQ(opacity(std::string(tr) + "\nKd 0 0 0\n" + d), 0.5f) << d << ' ' << tr;
        }
    }
    EXPECT_EQ(opacity("d 1.0\nTr 1.0"), 1);
    EXPECT_EQ(opacity("Tr 1.0\nd 1.0"), 1);
    EXPECT_EQ(opacity("d 1\nTr 0"), 1);
    EXPECT_EQ(opacity("d 0\nTr 1"), 0) << "what both say";
}

TEST_F(ReadMtl, TexturesAreNamedOnceAndNotRead) {
    folder_.write("a.mtl",
                  "newmtl m\nmap_Kd wood bark.png\nMAP_Bump -bm 0.5 -s 1 1 1 sub\\rough.png\nmap_d wood bark.png\n"
                  "norm n.png\nmap_Ks\nmap_Ka -clamp\nrefl -type sphere ../sky.hdr\nKd 1 0 0\n");
    OtherFiles files;
    EXPECT_EQ(read_material_files(folder_.file("a.obj"), {"a.mtl"}, &files).at("m").color, glm::vec3(1, 0, 0));
    EXPECT_EQ(files.read, std::vector<std::string>{folder_.file("a.mtl")});
    std::vector<std::string> expected;
    for (const char* name : {"../sky.hdr", "n.png", "sub/rough.png", "wood bark.png"})
        expected.push_back(folder_.file(name));
    EXPECT_EQ(files.pictures, expected);
}

TEST_F(ReadMtl, WhatIsNoNumberBehindDIsNoOpacity) {
    EXPECT_EQ(opacity("d -halo 0.5"), 1);
    EXPECT_EQ(opacity("d -halo 0.5\nTr 0.25"), 0.75f);
    EXPECT_EQ(opacity("d nan\nTr 0.25"), 0.75f);
    EXPECT_EQ(opacity("map_d 0.5\nTr 0.25"), 0.75f);
    EXPECT_EQ(opacity("d \\\n0.5"), 0.5f) << "a line that goes on";
    EXPECT_EQ(opacity("map_d a.png\nd 0.5"), 0.5f);
}

TEST_F(ReadMtl, AMaterialThatIsDefinedAgainHasItsLastOpacity) {
    EXPECT_EQ(opacity("d 0.5\nnewmtl other\nnewmtl m\nTr 0.25"), 0.75f);
    EXPECT_EQ(opacity("d 0.5\nnewmtl m\nKd 1 0 0"), 0.5f);
}

TEST_F(ReadMtl, KeywordsMayBeInCapitals) {
    folder_.write("a.mtl", "NEWMTL Red Wax\nKD 1 0.5 0\nD 0.5\n");
    const auto library = read_material_files(folder_.file("a.obj"), {"a.mtl"});
    ASSERT_TRUE(library.contains("Red Wax"));
    EXPECT_EQ(library.at("Red Wax").color, glm::vec3(1, 0.5, 0));
    EXPECT_EQ(library.at("Red Wax").opacity, 0.5f);
}

/// A file that is read a second time would give its materials their colours back.
TEST_F(ReadMtl, EachFileIsReadOnceByWhateverName) {
    folder_.write("a.mtl", "newmtl m\nKd 1 0 0\n");
    folder_.write("b.mtl", "newmtl m\nKd 0 1 0\n");
    std::filesystem::create_symlink("a.mtl", folder_.file("link.mtl"));
    std::filesystem::create_directory(folder_.file("sub"));
    for (const char* again : {"a.mtl", "./a.mtl", "sub/../a.mtl", "link.mtl", "b.mtl a.mtl", "missing.mtl a.mtl"}) {
        const auto library = read_material_files(folder_.file("a.obj"), {"a.mtl", "b.mtl", again});
        EXPECT_EQ(library.at("m").color, glm::vec3(0, 1, 0)) << again;
    }
    EXPECT_EQ(read_material_files(folder_.file("a.obj"), {"b.mtl", "a.mtl"}).at("m").color, glm::vec3(1, 0, 0));
    EXPECT_EQ(read_material_files(folder_.file("a.obj"), {"a.mtl b.mtl a.mtl"}).at("m").color, glm::vec3(0, 1, 0));
}

TEST_F(ReadMtl, FilesAreFoundBehindVeryManyThatAreMissing) {
    std::vector<std::string> names;
    for (int i = 0; i < 1000; ++i)
        names.push_back("missing" + std::to_string(i) + ".mtl sub/missing" + std::to_string(i) + ".mtl");
    for (const char* name : {"a.mtl", "./a.mtl", "sub/a.mtl", "x a.mtl"}) {
        for (const char* place : {"a.mtl", "sub/a.mtl"}) folder_.write(place, "newmtl m\nKd 1 0 0\n");
        std::vector<std::string> with_name = names;
        with_name.push_back(name);
        const auto library = read_material_files(folder_.file("a.obj"), with_name);
        ASSERT_TRUE(library.contains("m")) << name;
        EXPECT_EQ(library.at("m").color, glm::vec3(1, 0, 0)) << name;
    }
}

TEST_F(ReadMtl, TheObjItselfIsNoMaterialFile) {
    const std::string text = "newmtl m\nKd 1 0 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n";
    for (const char* name : {"part.obj", "./part.obj", "link.obj", "x part.obj"}) {
        const std::string path = folder_.write("part.obj", "mtllib " + std::string(name) + "\n" + text);
        std::error_code ignored;
        std::filesystem::create_symlink("part.obj", folder_.file("link.obj"), ignored);
        EXPECT_EQ(read_obj(path).materials[1].color, Material{}.color) << name;
    }
}

}  // namespace
}  // namespace burin
