// Lines of an OBJ that begin with a word that the format does not have are named.

#include <gtest/gtest.h>

#include <string>

#include "mesh/readers.h"
#include "tests/support/temporary_folder.h"

namespace burin {
namespace {

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

class UnknownWords : public testing::Test {
  protected:
    std::vector<std::string> notes(const std::string& text, std::size_t piece_size = 1 << 20) {
        return read_obj_text(folder_.file("a.obj"), text, 2, piece_size).notes;
    }
    static std::vector<std::string> note(int count, int line, const std::string& word) {
        return {"lines left out that begin with a word that is not known: " + std::to_string(count) +
                "; the first one is line " + std::to_string(line) + ", '" + word + "'"};
    }
    test::TemporaryFolder folder_;
};

TEST_F(UnknownWords, AreNamedOnceWithCountAndFirstLine) {
    EXPECT_EQ(notes(kTriangle + "face 1 2 3\n"), note(1, 5, "face"));
    EXPECT_EQ(notes("\n  vertex 1 2 3\n" + kTriangle + "F1 2 3\nvertex 0 0 0\n"), note(3, 2, "vertex"));
    EXPECT_EQ(notes(kTriangle + "x \\\ny\nf 1 2 3\n"), note(1, 5, "x")) << "a statement is where it begins";
    EXPECT_EQ(notes(kTriangle + "12/3/4 5/6/7\n"), note(1, 5, "12/3/4"));
}

TEST_F(UnknownWords, AreTheSameInPieces) {
    const std::string text = kTriangle + kTriangle + "word\n" + kTriangle + "\r\n# x\r\nother\n" + kTriangle;
    for (const std::size_t size : {1u, 7u, 30u, 60u}) EXPECT_EQ(notes(text, size), note(2, 9, "word")) << size;
}

TEST_F(UnknownWords, AreNotThoseThatTheFormatHas) {
    EXPECT_TRUE(
        notes("# v\n#v\n" + kTriangle +
              "g a b\no c\ns 1\nS off\nvn 0 0 1\nVT 0 0\nvp 1\nmg 0\nlod 1\nbevel on\nc_interp on\nd_interp on\n"
              "usemap x\nmaplib y\nshadow_obj a\ntrace_obj b\nusemtl m\n")
            .empty());
    const std::string curve =
        "cstype bspline\ndeg 3\nstep 1\nbmat u 1\nctech cparm 1\nstech cparma 1 1\nparm u 0 1\ntrim 0 1 1\nhole 0 1 1\n"
        "scrv 0 1 1\nsp 1\nend\ncon 1 0 1 1 2 0 1 1\nres 1 1\n";
    EXPECT_TRUE(notes(kTriangle + curve).empty());
    for (const char* shape :
         {"curv 0 1 1 2 3", "curv2 1 2 3", "surf 0 1 0 1 1 2 3", "bzp 1 2 3", "BSP 1 2 3", "cdc 1 2 3", "cdp 1 2 3"}) {
        EXPECT_EQ(notes(kTriangle + shape),
                  std::vector<std::string>{"curves and surfaces of higher order left out: 1"});
    }
}

}  // namespace
}  // namespace burin
