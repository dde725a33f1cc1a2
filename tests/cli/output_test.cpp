// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// Where the text goes, and what happens when it cannot go there; names that attack the terminal.
#include <fcntl.h>
#include <unistd.h>

#include <filesystem>
#include <sstream>

#include "meshes.hpp"
#include "program.hpp"
#include "report/text.hpp"

namespace impinge::test {
namespace {

class Output : public testing::Test {
 protected:
  void SetUp() override { write_off(folder, {{"a", cube(0, 0, 0)}, {"b", cube(2, 0, 0)}}); }
  Folder folder;
};

TEST_F(Output, AFullDeviceIsAnError) {
  const int full = ::open("/dev/full", O_WRONLY | O_CLOEXEC);
  ASSERT_GE(full, 0);
  Launch launch;
  launch.out = full;
  for (const Words& words : {Words{"check", "a.off", "b.off"},
                             {"check", "a.off", "b.off", "--json", "-"},
                             {"clash", "a.off", "b.off"},
                             {"info", "a.off"},
                             {"info", "a.off", "--json", "-"},
                             {"--help"},
                             {"--version"}})
    EXPECT_THAT(refusal(folder, words, launch), HasSubstr("cannot write to standard output: No space left"));
  ::close(full);
}

TEST_F(Output, AClosedStandardOutputIsAnErrorAndNoFileTakesItsPlace) {
  Launch launch;
  launch.close_out = true;
  EXPECT_THAT(refusal(folder, {"check", "a.off", "b.off"}, launch), HasSubstr("cannot write to standard output"));
  // With nothing to print there it is no error; and the table must not land in the JSON.
  EXPECT_EQ(impinge(folder, {"check", "a.off", "b.off", "--quiet"}, launch).code, 1);
  EXPECT_EQ(impinge(folder, {"check", "a.off", "b.off", "--json", "out.json"}, launch).code, 2);
  EXPECT_THAT(folder.read("out.json"), Not(HasSubstr("pairs of")));
  EXPECT_EQ(folder.read("a.off"), off(cube(0, 0, 0)));
}

TEST_F(Output, APipeThatNobodyReadsIsAnError) {
  int ends[2];
  ASSERT_EQ(::pipe2(ends, O_CLOEXEC), 0);
  ::close(ends[0]);
  Launch launch;
  launch.out = ends[1];
  EXPECT_THAT(refusal(folder, {"check", "a.off", "b.off"}, launch), HasSubstr("Broken pipe"));
  EXPECT_THAT(refusal(folder, {"check", "a.off", "b.off", "--json", "-"}, launch), HasSubstr("Broken pipe"));
  ::close(ends[1]);
}

TEST_F(Output, QuietSaysNothingButErrors) {
  for (const Words& asked :
       {Words{"check", "a.off", "--quiet", "--stats"}, {"clash", "a.off", "--quiet", "--fail-on", "contact"}}) {
    const Ended touching = impinge(folder, joined(asked, {"b.off"}));
    EXPECT_EQ(touching.code, 1);
    EXPECT_EQ(touching.out + touching.err, "");
    EXPECT_THAT(refusal(folder, joined(asked, {"missing.off"})), HasSubstr("missing.off"));
  }
}

TEST_F(Output, NamesCannotSteerTheTerminal) {
  // Escape sequences, a new line, a C1 control (CSI), a turn of the writing direction, and a byte that is no UTF-8.
  const std::string name = "\x1b]0;gone\x07\x1b[2J\n\r\x7f\xc2\x9b\xe2\x80\xae\xff";
  folder.write(name + ".off", off(cube(0, 2, 0)));
  const auto is_plain = [](const std::string& text) {
    for (std::size_t at = 0; at < text.size();) {
      const report::Character character = report::decode(text, at);
      const char32_t code = character.code;
      if (!character.valid || (code < 0x20 && code != '\n') || (code >= 0x7f && code < 0xa0) || code == 0x202e)
        return false;
      at += character.length;
    }
    return true;
  };
  for (const Words& words : {Words{"check", "a.off", name + ".off"},
                             {"clash", "a.off", name + ".off"},
                             {"info", name + ".off"},
                             {"check", name},
                             {"check", "a.off", "--ignore", name, name},
                             {"check", "a.off", "--scale", name},
                             {"check", "a.off", "--limit", name},
                             {"check", "a.off", "--" + name},
                             {name}}) {
    const Ended run = impinge(folder, words);
    EXPECT_TRUE(is_plain(run.out)) << run.out;
    EXPECT_TRUE(is_plain(run.err)) << run.err;
    EXPECT_FALSE((run.out + run.err).empty());
  }
  const Ended table = impinge(folder, {"check", "a.off", name + ".off"});
  EXPECT_THAT(table.out, HasSubstr("\\x1b]0;gone\\x07\\x1b[2J\\n\\r\\x7f\\u009b\\u202e\xEF\xBF\xBD"));
}

TEST_F(Output, LinesFitTheTerminalAndStayUtf8) {
  const std::string part = "\xe9\x83\xa8\xe5\x93\x81_\xc3\xa4\xcc\x88_";  // wide, plain and combining characters
  std::string name = "\x1b[2J1.off";
  for (int i = 0; i < 12; ++i) name = part + name;
  folder.write(name, off(cube(0, 2, 0)));
  for (const std::size_t width : {60U, 61U, 62U, 63U, 80U}) {
    Launch launch;
    launch.environment["COLUMNS"] = std::to_string(width);
    for (const Words& asked :
         {Words{"check"}, {"clash", "--depth", "0.01", "--clearance", "1", "--fail-on", "contact"}}) {
      const Ended run = impinge(folder, joined(asked, {"a.off", "b.off", name}), launch);
      EXPECT_EQ(run.code, 1) << run.err;
      EXPECT_EQ(run.out.find('\x1b'), std::string::npos);
      EXPECT_NO_THROW(std::ignore = nlohmann::json(run.out).dump()) << "it is no UTF-8";
      std::istringstream lines(run.out.substr(0, run.out.find("\n\n")));
      for (std::string line; std::getline(lines, line);) EXPECT_LE(report::columns(line), width) << line;
      EXPECT_THAT(run.out, HasSubstr("\xe2\x80\xa6")) << "nothing was cut";
    }
  }
  const Ended pipe = impinge(folder, {"check", "a.off", name});
  EXPECT_THAT(pipe.out, Not(HasSubstr("\xe2\x80\xa6"))) << "a pipe has no width";
}

TEST_F(Output, FilesThatCannotBeReadAreNamed) {
  folder.write("empty.off", "");
  folder.write("broken.off", "OFF\n3 1 0\n0 0 0\n");
  folder.write("notes.xyz", "no mesh at all");
  std::filesystem::create_directory(folder.path() / "folder.off");
  for (const char* name : {"missing.off", "empty.off", "broken.off", "notes.xyz", "folder.off", "a.off/b.off", "."}) {
    EXPECT_THAT(refusal(folder, {"check", "a.off", name}), HasSubstr(name));
    const Ended run = impinge(folder, {"info", name, "a.off"});
    EXPECT_THAT(sentence_of(run), HasSubstr(name));
    EXPECT_THAT(run.out, HasSubstr("a.off: 1 object")) << "the other file is listed";
  }
}

TEST_F(Output, LargeFilesAreRefusedUnread) {
  folder.write("large.off", "OFF\n");
  std::filesystem::resize_file(folder.path() / "large.off", 4'000'000'000);  // sparse
  EXPECT_THAT(refusal(folder, {"check", "large.off"}), HasSubstr("large.off"));
  EXPECT_THAT(refusal(folder, {"check", "a.off", "--max-file", "100"}), HasSubstr("a.off"));
  EXPECT_EQ(impinge(folder, {"check", "a.off", "--max-file", "1k"}).code, 0);
}

TEST_F(Output, AMissingImporterIsAnError) {
  folder.write("pair.gltf", gltf({{"left", {0, 0, 0}}, {"right", {2, 0, 0}}}));
  Launch launch;
  launch.environment["IMPINGE_IMPORTER"] = "/missing/impinge-import";
  EXPECT_THAT(refusal(folder, {"check", "pair.gltf"}, launch), HasSubstr("/missing/impinge-import"));
}

}  // namespace
}  // namespace impinge::test
