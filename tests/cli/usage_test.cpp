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
    testing::Values(Wrong{{}, "subcommand is required"}, Wrong{{"a.off"}, "'a.off' is no command of impinge"},
                    Wrong{{"check"}, "FILE is required; see impinge check --help"}, Wrong{{"info"}, "FILE is required"},
                    Wrong{{"--frobnicate"}, "--frobnicate"}, Wrong{{"check", "a.off", "-x"}, "-x"},
                    Wrong{{"check", "a.off", "--limit", "-1"}, "'-1'"},
                    Wrong{{"check", "a.off", "--limit", "1e3"}, "'1e3'"},
                    Wrong{{"check", "a.off", "--limit", "18446744073709551616"}, "--limit"},
                    Wrong{{"check", "a.off", "--limit"}, "--limit: 1 required N missing"},
                    Wrong{{"check", "a.off", "--limit", "1", "--limit", "2"}, "--limit: At Most 1 required"},
                    Wrong{{"check", "a.off", "--limit="}, "'--limit=' is empty"},
                    Wrong{{"check", "a.off", "--threads", "1025"}, "0 to 1024"},
                    Wrong{{"check", "a.off", "--threads", "two"}, "'two'"},
                    Wrong{{"check", "a.off", "--backend", "hybrid", "--device-share", "2"}, "'2'"},
                    Wrong{{"check", "a.off", "--device-share", "0.5"}, "for --backend hybrid"},
                    Wrong{{"devices", "--jsn"}, "'--jsn'"}, Wrong{{"devices", "a.off"}, "'a.off'"},
                    Wrong{{"check", "a.off", "--backend", "cuda"},
                          "cuda not in {auto,simd,paper,scalar,gpu,raster,hybrid}"},
                    Wrong{{"check", "a.off", "--triangles"}, "--triangles requires --json"},
                    Wrong{{"check", "a.off", "--first=maybe"}, "--first"},
                    Wrong{{"check", "a.off", "--ignore", "a"}, "--ignore: 2 required A B missing"},
                    Wrong{{"check", "a.off", "--scale", "b.off=2"}, "none of the files"},
                    Wrong{{"check", "a.off", "--scale", "a.off"}, "FILE=S"},
                    Wrong{{"check", "a.off", "--scale", "a.off="}, "positive"},
                    Wrong{{"check", "a.off", "--scale", "a.off=0"}, "positive"},
                    Wrong{{"check", "a.off", "--scale", "a.off=inf"}, "positive"},
                    Wrong{{"check", "a.off", "--scale", "a.off=nan"}, "positive"},
                    Wrong{{"check", "a.off", "--scale", "a.off=1,5"}, "positive"},
                    Wrong{{"check", "a.off", "--scale", "a.off=2", "--scale", "a.off=3"}, "twice"},
                    Wrong{{"check", "a.off", "--max-file", "2X"}, "--max-file: x unit not recognized"},
                    Wrong{{"info", "a.off", "--max-file", "-1"}, "--max-file: Value -1"},
                    Wrong{{"info", "a.off", "--max-file", "1.5G"}, "--max-file: Value 1.5"},
                    Wrong{{"info", "a.off", "--max-file", "18446745T"}, "overflow"}));

INSTANTIATE_TEST_SUITE_P(
    Clash, WrongUsage,
    testing::Values(Wrong{{"clash", "a.off", "--stats"}, "see impinge clash --help"},
                    Wrong{{"clash", "a.off", "--tolerance", "-1"},
                          "--tolerance takes auto or a length from 0 up, such as 10 or 10mm, not '-1'"},
                    Wrong{{"clash", "a.off", "--tolerance", "nan"}, "--tolerance takes auto"},
                    Wrong{{"clash", "a.off", "--tolerance", "inf"}, "'inf'"},
                    Wrong{{"clash", "a.off", "--tolerance", "1 mile"}, "'1 mile'; the units are m, cm, mm, in and ft"},
                    Wrong{{"clash", "a.off", "--tolerance", "0,5"}, "'0,5'"},
                    Wrong{{"clash", "a.off", "--tolerance", "Auto"}, "'Auto'"},
                    Wrong{{"clash", "a.off", "--tolerance"}, "--tolerance: 1 required auto|0|D missing"},
                    Wrong{{"clash", "a.off", "--tolerance", "0", "--tolerance", "1"}, "--tolerance: At Most 1"},
                    Wrong{{"clash", "a.off", "--clearance", "-1"}, "--clearance takes a length from 0 up"},
                    Wrong{{"clash", "a.off", "--clearance", "auto"}, "'auto'"},
                    Wrong{{"clash", "a.off", "--fail-on", "penetrating"},
                          "--fail-on: penetrating not in {contact,penetration,inside,clearance,new}"},
                    Wrong{{"clash", "a.off", "--fail-on", "new"}, "add --previous FILE"},
                    Wrong{{"clash", "a.off", "--group-by", "colour"}, "part|type|test|none, not 'colour'"},
                    Wrong{{"clash", "a.off", "--group-by", "test"}, "--config FILE"},
                    Wrong{{"clash"}, "no file to read is named"},
                    Wrong{{"clash", "a.off", "--fail-on", "inside, contact"}, " contact not in {"},
                    Wrong{{"clash", "a.off", "--fail-on", ""}, "'--fail-on' is empty"},
                    Wrong{{"clash", "a.off", "--fail-on"}, "--fail-on: 1 required LIST missing"},
                    Wrong{{"clash", "a.off", "--fail-on", "clearance"}, "add --clearance C"},
                    Wrong{{"clash", "a.off", "--fail-on", "clearance", "--clearance", "0"}, "add --clearance C"},
                    Wrong{{"clash", "a.off", "--depth=maybe"}, "none or a share"},
                    Wrong{{"clash", "a.off", "--depth", "0"}, "none or a share"},
                    Wrong{{"clash", "a.off", "--depth", "1.5"}, "none or a share"},
                    Wrong{{"clash", "a.off", "--ignore", "a", "b"}, "nothing is named 'b'"},
                    Wrong{{"clash", "a.off", "--json", "a.off"}, "one of the files to read"}));

TEST(Usage, VersionAndHelpEndWell) {
  const Folder folder;
  const Ended version = impinge(folder, {"--version"});
  EXPECT_EQ(version.code, 0);
  EXPECT_EQ(version.out, "impinge " IMPINGE_VERSION "\n");
  for (const std::vector<std::string>& words : {std::vector<std::string>{"--help"},
                                                {"-h"},
                                                {"check", "--help"},
                                                {"clash", "--help"},
                                                {"info", "--help"},
                                                {"check", "-h", "x"}})
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
