// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// Wrong command lines: always exit code 2, one sentence, nothing on standard output.
#include <gtest/gtest.h>

#include <algorithm>

#include "impinge/version.hpp"
#include "meshes.hpp"
#include "program.hpp"

namespace impinge::test {
namespace {

struct Wrong {
  std::vector<std::string> words;
  std::string part;  ///< of the sentence
};

class WrongUsage : public testing::TestWithParam<Wrong> {};

TEST_P(WrongUsage, IsOneSentence) {
  const Folder folder;
  folder.write("a.off", off(cube(0, 0, 0)));
  const Ended run = impinge(folder, GetParam().words);
  EXPECT_EQ(run.code, 2);
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err.rfind("impinge: ", 0), 0U) << run.err;
  EXPECT_NE(run.err.find(GetParam().part), std::string::npos) << run.err;
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
}

INSTANTIATE_TEST_SUITE_P(
    Usage, WrongUsage,
    testing::Values(Wrong{{}, "no command"}, Wrong{{"a.off"}, "no command 'a.off'"}, Wrong{{"check"}, "no file"},
                    Wrong{{"info"}, "no file"}, Wrong{{"check", "--threats", "2", "a.off"}, "did you mean --threads?"},
                    Wrong{{"--frobnicate"}, "--frobnicate"}, Wrong{{"check", "a.off", "-x"}, "-x"},
                    Wrong{{"info", "a.off", "--first"}, "--first"}, Wrong{{"check", "a.off", "--limit", "-1"}, "'-1'"},
                    Wrong{{"check", "a.off", "--limit", "1e3"}, "'1e3'"},
                    Wrong{{"check", "a.off", "--limit", "18446744073709551616"}, "--limit"},
                    Wrong{{"check", "a.off", "--limit"}, "--limit needs N"},
                    Wrong{{"check", "a.off", "--limit", "1", "--limit", "2"}, "more than once"},
                    Wrong{{"check", "a.off", "--limit="}, "no value"},
                    Wrong{{"check", "a.off", "--threads", "1025"}, "0 to 1024"},
                    Wrong{{"check", "a.off", "--threads", "two"}, "'two'"},
                    Wrong{{"check", "a.off", "--backend", "hybrid", "--device-share", "2"}, "'2'"},
                    Wrong{{"check", "a.off", "--device-share", "0.5"}, "for --backend hybrid"},
                    Wrong{{"devices", "--jsn"}, "'--jsn'"}, Wrong{{"devices", "a.off"}, "'a.off'"},
                    Wrong{{"check", "a.off", "--backend", "cuda"}, "auto, simd, scalar, gpu, raster or hybrid"},
                    Wrong{{"check", "a.off", "--triangles"}, "--json"},
                    Wrong{{"check", "a.off", "--first=maybe"}, "takes no value"},
                    Wrong{{"check", "a.off", "--ignore", "a"}, "--ignore needs A B"},
                    Wrong{{"check", "a.off", "--scale", "b.off=2"}, "none of the files"},
                    Wrong{{"check", "a.off", "--scale", "a.off"}, "FILE=S"},
                    Wrong{{"check", "a.off", "--scale", "a.off="}, "positive"},
                    Wrong{{"check", "a.off", "--scale", "a.off=0"}, "positive"},
                    Wrong{{"check", "a.off", "--scale", "a.off=-2"}, "positive"},
                    Wrong{{"check", "a.off", "--scale", "a.off=inf"}, "positive"},
                    Wrong{{"check", "a.off", "--scale", "a.off=nan"}, "positive"},
                    Wrong{{"check", "a.off", "--scale", "a.off=1e999"}, "positive"},
                    Wrong{{"check", "a.off", "--scale", "a.off=1,5"}, "positive"},
                    Wrong{{"check", "a.off", "--scale", "a.off=2", "--scale", "a.off=3"}, "twice"},
                    Wrong{{"check", "a.off", "--max-file", "2X"}, "'2X'"},
                    Wrong{{"info", "a.off", "--max-file", "-1"}, "'-1'"}));

TEST(Usage, VersionAndHelpEndWell) {
  const Folder folder;
  const Ended version = impinge(folder, {"--version"});
  EXPECT_EQ(version.code, 0);
  EXPECT_EQ(version.out, "impinge " IMPINGE_VERSION "\n");
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"--help"}, {"-h"}, {"check", "--help"}, {"info", "--help"}, {"check", "-h", "x"}})
    EXPECT_EQ(impinge(folder, words).code, 0);
}

TEST(Usage, WordsAfterTheMarkAreFiles) {
  const Folder folder;
  folder.write("--quiet.off", off(cube(0, 0, 0)));
  const Ended run = impinge(folder, {"check", "--", "--quiet.off"});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out, "");
}

}  // namespace
}  // namespace impinge::test
