// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <random>

#include "support.hpp"

namespace impinge::io {
namespace {

struct Sample {
  std::string name;
  Result<Model> (*read)(std::string_view, std::string_view);
  enum class Kind : std::uint8_t { text, loose_text, binary } kind;  ///< loose: a NUL is a blank like others
  std::string bytes;
};

std::string binary_stl() {
  std::string bytes(80, ' ');
  append_bytes(bytes, std::uint32_t{2});
  for (int i = 0; i < 2; ++i) {
    for (int k = 0; k < 12; ++k) append_bytes(bytes, static_cast<float>(k * k + i));
    append_bytes(bytes, std::uint16_t{0});
  }
  return bytes;
}

std::string binary_ply(bool big) {
  std::string bytes = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                      "_endian 1.0\nelement vertex 4\nproperty float x\nproperty double y\nproperty short z\n"
                      "element face 2\nproperty list uchar uint vertex_indices\nend_header\n";
  for (int i = 0; i < 4; ++i) {
    append_bytes(bytes, static_cast<float>(i), big);
    append_bytes(bytes, 0.5 * i * i, big);
    append_bytes(bytes, static_cast<std::int16_t>(-i), big);
  }
  for (const std::vector<std::uint32_t>& face :
       {std::vector<std::uint32_t>{0, 1, 2, 3}, std::vector<std::uint32_t>{2, 1, 0}}) {
    append_bytes(bytes, static_cast<std::uint8_t>(face.size()), big);
    for (const std::uint32_t corner : face) append_bytes(bytes, corner, big);
  }
  return bytes;
}

std::vector<Sample> samples() {
  using Kind = Sample::Kind;
  return {
      {"obj", read_obj, Kind::text,
       "o first\nv 0 0 0\nv 1 0 0 \\\n 0.5\nv 1.5e0 1 0 # c\nv 0 1 -1\nvn 0 0 1\nf 1//1 2//1 3//1 4//1\ng x\nf -1 -2/1 "
       "-3\r\no b\nf 1 2 4\n"},
      {"off", read_off, Kind::text,
       "COFF # c\n5 3 0\n0 0 0 1 1 1\n4 0 0\n1 1 0\n0 4 0\n1 0.5 1e2\n4 0 1 2 3 1 1 1\n3 0 1 4\n5 4 3 2 1 0\n"},
      {"ply", read_ply, Kind::text,
       "ply\nformat ascii 1.0\ncomment x\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
       "element face 1\nproperty list uchar int vertex_indices\nelement tristrips 1\nproperty list int int "
       "vertex_indices\n"
       "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n5 0 1 2 -1 3\n"},
      {"ply little endian", read_ply, Kind::binary, binary_ply(false)},
      {"ply big endian", read_ply, Kind::binary, binary_ply(true)},
      {"stl", read_stl, Kind::loose_text,
       "solid a b\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
       "0\nendloop\nendfacet\nendsolid\n"
       "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
       "0\nendloop\nendfacet\nendsolid\n"},
      {"stl binary", read_stl, Kind::binary, binary_stl()},
  };
}

/// A result, or an error that names the file and says something; whether it is a result.
bool expect_answer(const Sample& sample, std::string_view bytes) {
  const Result<Model> model = sample.read(bytes, "hostile.file");
  if (!model) {
    EXPECT_GT(model.error().message.size(), 25u) << model.error().message;
  }
  return expect_sound_or_error(model, "hostile.file");
}

TEST(Hostile, TheSamplesThemselvesAreGood) {
  for (const Sample& sample : samples()) {
    SCOPED_TRACE(sample.name);
    expect_sound(model_of(sample.read(sample.bytes, sample.name)));
  }
}

TEST(Hostile, EveryTruncationHasAnAnswer) {
  for (const Sample& sample : samples())
    for (std::size_t length = 0; length < sample.bytes.size(); ++length) {
      SCOPED_TRACE(sample.name + " cut to " + std::to_string(length));
      const bool is_read = expect_answer(sample, std::string_view(sample.bytes).substr(0, length));
      EXPECT_FALSE(is_read && sample.kind == Sample::Kind::binary);
    }
}

TEST(Hostile, MutationsHaveAnAnswer) {
  const unsigned seed = 4711;
  std::mt19937 random(seed);
  constexpr std::string_view kNasty = "-09.e+/\\# \n\r\t\xFF\x80in";
  for (const Sample& sample : samples())
    for (int round = 0; round < 3000; ++round) {
      SCOPED_TRACE(sample.name + " seed " + std::to_string(seed) + " round " + std::to_string(round));
      std::string bytes = sample.bytes;
      for (std::size_t edits = 1 + random() % 4; edits > 0 && !bytes.empty(); --edits) {
        const std::size_t at = random() % bytes.size(), length = random() % 8;
        switch (random() % 5) {
          case 0:
            bytes[at] = static_cast<char>(random());
            break;
          case 1:
            bytes[at] = kNasty[random() % kNasty.size()];
            break;
          case 2:
            bytes.erase(at, length);
            break;
          case 3:
            bytes.insert(at, bytes.substr(random() % bytes.size(), length));
            break;
          default:
            bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
            break;
        }
      }
      expect_answer(sample, bytes);
    }
}

TEST(Hostile, TextWithAZeroByteIsRefused) {
  for (const Sample& sample : samples()) {
    if (sample.kind != Sample::Kind::text) continue;
    SCOPED_TRACE(sample.name);
    std::string bytes = sample.bytes;
    bytes.insert(bytes.size() - 1, 1, '\0');
    EXPECT_NE(error_of(sample.read(bytes, "hostile.file"))
                  .find("byte " + std::to_string(bytes.size() - 2) + ": a zero byte stands where text should"),
              std::string::npos);
  }
}

TEST(Hostile, GarbageHasAnAnswer) {
  const unsigned seed = 12;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  for (const Sample& sample : samples())
    for (int round = 0; round < 200; ++round) {
      std::string bytes(random() % 2000, ' ');
      for (char& c : bytes) c = static_cast<char>(random());
      expect_answer(sample, bytes);
    }
}

}  // namespace
}  // namespace impinge::io
