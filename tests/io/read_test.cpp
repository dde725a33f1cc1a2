// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <limits>
#include <thread>

#include "io/import_stream.hpp"
#include "support.hpp"

namespace impinge::io {
namespace {

using testing::HasSubstr;
using namespace std::chrono_literals;

constexpr std::string_view kObj = "v 0 0 0\nv 1 0 0\nv 0 1 0.1\nf 1 2 3\n";

TEST(Read, TakesTheFormatFromTheEndingInAnyCase) {
  const TemporaryFolder folder;
  for (const char* name : {"part.obj", "part.OBJ", "part.Obj"}) {
    const Model model = model_of(read(folder.write(name, kObj)));
    EXPECT_EQ(names_of(model), std::vector<std::string>{"part"});
    EXPECT_EQ(model.objects[0].path, "part");
  }
  EXPECT_EQ(names_of(model_of(read(folder.write("a.STL",
                                                "solid\nfacet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 "
                                                "vertex 0 1 0 endloop endfacet endsolid")))),
            std::vector<std::string>{"a"});
  EXPECT_EQ(names_of(model_of(read(folder.write("b.Off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2")))),
            std::vector<std::string>{"b"});
}

TEST(Read, ErrorsNameTheFile) {
  const TemporaryFolder folder;
  const auto bad = folder.write("bad.obj", "v 0 0 x\n");
  EXPECT_THAT(error_of(read(bad)), HasSubstr(bad.string() + ", line 1: 'x' is not a number"));
}

TEST(Read, RefusesWhatIsNoReadableFile) {
  const TemporaryFolder folder;
  for (const char* ending : {"obj", "off", "ply", "stl", "gltf", "whatever"}) {
    SCOPED_TRACE(ending);
    const auto path = [&](const char* stem) { return folder.path() / (std::string(stem) + "." + ending); };
    EXPECT_THAT(error_of(read(path("missing"))), HasSubstr("No such file"));
    std::filesystem::create_directory(path("folder"));
    EXPECT_THAT(error_of(read(path("folder"))), HasSubstr("this is a directory"));
    folder.write("empty." + std::string(ending), "");
    EXPECT_THAT(error_of(read(path("empty"))), HasSubstr("the file is empty"));
    ASSERT_EQ(mkfifo(path("fifo").c_str(), 0600), 0);
    EXPECT_THAT(error_of(read(path("fifo"))), HasSubstr("no regular file"));
    std::filesystem::create_symlink("/dev/zero", path("device"));
    EXPECT_THAT(error_of(read(path("device"))), HasSubstr("no regular file"));
    std::filesystem::create_symlink(path("loop"), path("loop"));
    EXPECT_THAT(error_of(read(path("loop"))), HasSubstr("cannot be read"));
  }
}

TEST(Read, RefusesUnreadableFiles) {
  const TemporaryFolder folder;
  const auto file = folder.write("secret.obj", kObj);
  std::filesystem::permissions(file, std::filesystem::perms::none);
  const bool is_root = geteuid() == 0;  // root reads everything: be nobody for a moment
  if (is_root) {
    ASSERT_EQ(seteuid(65534), 0);
  }
  const Result<Model> model = read(file);
  if (is_root) {
    ASSERT_EQ(seteuid(0), 0);
  }
  EXPECT_THAT(error_of(model), HasSubstr("Permission denied"));
}

TEST(Read, RefusesLargeFilesUnread) {
  const TemporaryFolder folder;
  for (const char* name : {"sparse.stl", "sparse.obj", "sparse.ply", "sparse.off", "sparse.glb"}) {
    const auto file = folder.write(name, "solid");
    std::filesystem::resize_file(file, std::uintmax_t{4} << 30);
    const auto start = std::chrono::steady_clock::now();
    EXPECT_THAT(error_of(read(file)), HasSubstr("the file has 4294967296 bytes, more than the limit of 2000000000"));
    EXPECT_LT(std::chrono::steady_clock::now() - start, 1s);
    std::filesystem::remove(file);
  }
  ReadOptions options;
  options.max_file_bytes = kObj.size();
  EXPECT_TRUE(read(folder.write("a.obj", kObj), options).has_value());
  options.max_file_bytes = kObj.size() - 1;
  EXPECT_THAT(error_of(read(folder.write("a.obj", kObj), options)), HasSubstr("more than the limit"));
}

TEST(Read, ScalesEveryCoordinate) {
  const TemporaryFolder folder;
  ReadOptions options;
  options.scale = 0.1;
  const Model model = model_of(read(folder.write("a.obj", kObj), options));
  EXPECT_EQ(points_of(model.objects.at(0)), (Points{{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0.1 * 0.1}}));
  for (const double scale :
       {0.0, -1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    options.scale = scale;
    EXPECT_THAT(error_of(read(folder.write("a.obj", kObj), options), Code::bad_option), HasSubstr("scale"));
  }
  options.scale = 1e308;
  EXPECT_THAT(error_of(read(folder.write("b.obj", "v 0 0 0\nv 100 0 0\nv 0 1 0\nf 1 2 3\n"), options)),
              HasSubstr("scaled"));
}

TEST(Read, StopsWhenAsked) {
  const TemporaryFolder folder;
  std::stop_source source;
  source.request_stop();
  ReadOptions options;
  options.stop = source.get_token();
  EXPECT_THAT(error_of(read(folder.write("a.obj", kObj), options), Code::cancelled), HasSubstr("a.obj"));
}

/// Tests with a shell script where impinge-import should be.
class FakeImporter : public testing::Test {
 protected:
  Result<Model> read_with(const std::string& script, std::chrono::seconds time = 20s, std::uint64_t memory = 1 << 20) {
    options.importer = folder.write("importer", "#!/bin/sh\n" + script + "\n");
    std::filesystem::permissions(options.importer, std::filesystem::perms::owner_all);
    options.time_limit = time;
    options.memory_limit_bytes = memory;
    return read(folder.write("part.gltf", "{}"), options);
  }
  /// A script that sends a good stream, and then does something.
  std::string sending_a_triangle(const std::string& then = "") {
    const auto file = folder.path() / "stream";
    const int descriptor = open(file.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
    ImportWriter writer(descriptor);
    writer.mesh(std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0}, std::vector<std::uint32_t>{0, 1, 2});
    writer.object("bolt", "", "", 0, kNoNode, kNoNode, {0, -1, 0, 5, 1, 0, 0, 6, 0, 0, 1, 7, 0, 0, 0, 1});
    writer.object("nut", "", "", 0, kNoNode, kNoNode, {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1});
    writer.end();
    close(descriptor);
    return "cat '" + file.string() + "'; " + then;
  }
  TemporaryFolder folder;
  ReadOptions options;
};

TEST_F(FakeImporter, ItsStreamBecomesTheModel) {
  const Model model = model_of(read_with(sending_a_triangle()));
  EXPECT_EQ(names_of(model), (std::vector<std::string>{"bolt", "nut"}));
  EXPECT_EQ(model.objects[0].pose.t, (std::array<double, 3>{5, 6, 7}));
  EXPECT_EQ(points_of(model.objects[1]), (Points{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}));
}

TEST_F(FakeImporter, ScaleStretchesMeshesAndShiftsOfPoses) {
  options.scale = 10;
  const Model model = model_of(read_with(sending_a_triangle()));
  EXPECT_EQ(points_of(model.objects.at(0)), (Points{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}}));
  EXPECT_EQ(model.objects[0].pose.t, (std::array<double, 3>{50, 60, 70}));
  EXPECT_EQ(model.objects[0].pose.R, (std::array<double, 9>{0, -1, 0, 1, 0, 0, 0, 0, 1}));
}

TEST_F(FakeImporter, GetsTheFileAndItsLimits) {
  EXPECT_THAT(error_of(read_with("echo \"$# $2 $3 $(basename $1)\" >&2; exit 4", 20s, 12345)),
              HasSubstr("part.gltf: the importer ended with status 4, saying: 3 12345 20 part.gltf"));
}

TEST_F(FakeImporter, ItsDeathIsAnErrorThatSaysHow) {
  EXPECT_THAT(
      error_of(read_with("echo 'Assertion `x` failed' >&2; echo more >&2; kill -ABRT $$")),
      HasSubstr("part.gltf: the importer stopped (signal 6, Aborted) on this file, saying: Assertion `x` failed;"));
  EXPECT_THAT(error_of(read_with("kill -SEGV $$")), HasSubstr("(signal 11, Segmentation fault)"));
  EXPECT_THAT(error_of(read_with("kill -KILL $$")),
              HasSubstr("the importer was killed; the machine ran out of memory"));
  EXPECT_THAT(error_of(read_with(sending_a_triangle("kill -SEGV $$"))), HasSubstr("signal 11"));
  EXPECT_THAT(error_of(read_with("kill -XCPU $$")), HasSubstr("used up the time limit of 20 s"));
  EXPECT_THAT(error_of(read_with("exit 0")), HasSubstr("what it wrote is incomplete"));
  EXPECT_THAT(error_of(read_with("echo impinge1 and rubbish")), HasSubstr("what it wrote is incomplete"));
  EXPECT_THAT(error_of(read_with(sending_a_triangle("echo more"))), HasSubstr("incomplete"));
}

TEST_F(FakeImporter, HangsAndFloodsAreStopped) {
  const auto start = std::chrono::steady_clock::now();
  EXPECT_THAT(error_of(read_with("exec sleep 100", 1s)), HasSubstr("time limit of 1 s"));
  EXPECT_THAT(error_of(read_with("exec >&- 2>&-; exec sleep 100", 1s)), HasSubstr("time limit of 1 s"));
  EXPECT_THAT(error_of(read_with("exec yes", 20s)), HasSubstr("more than the memory limit of 1048576 bytes"));
  EXPECT_THAT(error_of(read_with("exec yes >&2", 1s)), HasSubstr("time limit of 1 s"));
  EXPECT_LT(std::chrono::steady_clock::now() - start, 15s);
}

TEST_F(FakeImporter, StopsWhenAsked) {
  std::stop_source source;
  options.stop = source.get_token();
  std::jthread later([&] {
    std::this_thread::sleep_for(200ms);
    source.request_stop();
  });
  const auto start = std::chrono::steady_clock::now();
  EXPECT_THAT(error_of(read_with("exec sleep 100"), Code::cancelled), HasSubstr("part.gltf"));
  EXPECT_LT(std::chrono::steady_clock::now() - start, 10s);
}

TEST_F(FakeImporter, LeavesNoChildBehind) {
  (void)read_with("exec sleep 100", 1s);
  (void)read_with("exit 1");
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

TEST_F(FakeImporter, InheritsNoDescriptors) {
  const int leak = open("/dev/null", O_RDONLY);
  ASSERT_GE(leak, 3);
  EXPECT_THAT(error_of(read_with("ls /proc/self/fd | tr '\\n' ' ' >&2; exit 1")), HasSubstr("saying: 0 1 2 3"));
  close(leak);
}

TEST(Importer, AMissingOneIsAnErrorWithTheMend) {
  const TemporaryFolder folder;
  const auto file = folder.write("part.gltf", "{}");
  ReadOptions options;
  options.importer = folder.path() / "not-there";
  EXPECT_THAT(error_of(read(file, options)),
              HasSubstr("not-there; install it there, or name its place in the environment variable IMPINGE_IMPORTER"));
  options.importer = folder.write("no-program", "text");
  EXPECT_THAT(error_of(read(file, options)), HasSubstr("no-program; install it"));
  std::filesystem::permissions(options.importer, std::filesystem::perms::owner_all);
  EXPECT_THAT(error_of(read(file, options)), HasSubstr("did not run"));
}

}  // namespace
}  // namespace impinge::io
