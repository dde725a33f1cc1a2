// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <unistd.h>

#include <cstring>
#include <limits>
#include <random>

#include "io/import_process.hpp"
#include "io/import_stream.hpp"
#include "io/model.hpp"
#include "support.hpp"

namespace impinge::io {
namespace {

using testing::HasSubstr;

constexpr std::array<double, 16> kIdentity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
const std::vector<double> kXyz{0, 0, 0, 1, 0, 0, 0, 1, 0.1};
const std::vector<std::uint32_t> kTriangle{0, 1, 2};

const ImportedNode kRoot{kNoNode, kIdentity, {1, 1, 1}, {0, 0, 0, 1}, {0, 0, 0}};
const ImportedNode kChild{0, {1, 0, 0, 4, 0, 1, 0, 5, 0, 0, 1, 6, 0, 0, 0, 1}, {1, 2, 3}, {0, 0, 1, 0}, {4, 5, 6}};
const Animation kOpening{"opening",
                         2,
                         {{1, Track::Property::rotation, Track::Between::linear, {0, 2}, {0, 0, 0, 1, 0, 0, 1, 0}},
                          {0, Track::Property::scale, Track::Between::cubic, {1}, {0, 0, 0, 1, 2, 3, 0, 0, 0}},
                          {1, Track::Property::translation, Track::Between::step, {0, 1}, {1, 2, 3, 4, 5, 6}}},
                         {{Unfollowed::What::place, 1, "broken"}, {Unfollowed::What::shape, std::nullopt, "bent"}}};

/// What a writer's calls put on the wire.
template <class Calls>
std::string written(const Calls& calls) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "stream";
  const int descriptor = open(file.c_str(), O_CREAT | O_WRONLY, 0600);
  ImportWriter writer(descriptor);
  calls(writer);
  close(descriptor);
  return bytes_of_file(file);
}

/// What every stream begins with.
std::string beginning() {
  return written([](ImportWriter& writer) { writer.end(); }).substr(0, 8);
}

std::string small_stream() {
  return written([](ImportWriter& writer) {
    writer.warning("careful");
    writer.missing("a leg");
    writer.node(kRoot);
    writer.node(kChild);
    writer.animation(kOpening);
    writer.mesh(kXyz, kTriangle);
    writer.group("a/b", kNoNode);
    writer.group("", 0);
    writer.object("bolt", "engine/bolt", "IfcBolt_bolt", 0, 1, 1, kIdentity);
    writer.property("class", "IfcBolt");
    writer.incomplete("a thread");
    writer.object("", "", "", 0, kNoNode, kNoNode, kIdentity);
    writer.grid({"axes", "Level 1", {{"B", 2, {{1, 2, 3}, {4, 5, 6}}}, {"", 0, {{7, 8, 9}, {0, 1, 2}, {3, 4, 5}}}}});
    writer.unit(0.3048);
    writer.exact_places();
    EXPECT_TRUE(writer.end());
  });
}

/// All that was read, in the order of small_stream().
std::string written_again(const Imported& imported) {
  return written([&](ImportWriter& writer) {
    for (const std::string& text : imported.warnings) writer.warning(text);
    for (const std::string& text : imported.missing) writer.missing(text);
    for (const ImportedNode& node : imported.nodes) writer.node(node);
    for (const Animation& animation : imported.animations) writer.animation(animation);
    for (const ImportedMesh& mesh : imported.meshes) writer.mesh(mesh.xyz, mesh.triangles);
    for (const ImportedGroup& group : imported.groups) writer.group(group.name, group.parent);
    for (const ImportedObject& it : imported.objects) {
      writer.object(it.name, it.path, it.product, it.mesh, it.node, it.group, it.world);
      for (const auto& [name, value] : it.properties) writer.property(name, value);
      if (!it.incomplete.empty()) writer.incomplete(it.incomplete);
    }
    for (const Grid& grid : imported.grids) writer.grid(grid);
    if (imported.unit_in_metres) writer.unit(*imported.unit_in_metres);
    if (imported.exact_places) writer.exact_places();
    EXPECT_TRUE(writer.end());
  });
}

TEST(ImportStream, GivesBackWhatWasWritten) {
  const Result<Imported> imported = decode_import(small_stream());
  ASSERT_TRUE(imported.has_value());
  EXPECT_EQ(written_again(*imported), small_stream());
  const Result<Imported> failed = decode_import(written([](ImportWriter& writer) { writer.error("why not"); }));
  ASSERT_TRUE(failed.has_value());
  EXPECT_EQ(failed->error, "why not");
}

TEST(ImportStream, EveryTruncationIsAnError) {
  const std::string stream = small_stream();
  for (std::size_t length = 0; length < stream.size(); ++length)
    EXPECT_FALSE(decode_import(std::string_view(stream).substr(0, length)).has_value()) << length;
}

/// Whatever is in a model's animations, where its nodes are can be asked.
void follow(const Result<Model>& model) {
  if (!model) return;
  for (const Animation& animation : model->animations)
    for (const double share : {-0.1, 0.0, 0.3, 1.0})
      EXPECT_EQ(nodes_at(*model, animation, share * animation.seconds).size(), model->nodes.size());
}

TEST(ImportStream, MutationsAreErrorsOrStreams) {
  const unsigned seed = 77;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  const std::string stream = small_stream();
  int refused = 0;
  for (int round = 0; round < 20'000; ++round) {
    std::string mutated = stream;
    for (int k = 0; k < 3; ++k) mutated[random() % mutated.size()] = static_cast<char>(random());
    Result<Imported> imported = decode_import(mutated);
    if (imported) follow(model_of(std::move(*imported), Source{"mutated", "mutated"}));
    refused += !imported;
  }
  EXPECT_GT(refused, 1000);
}

TEST(ImportStream, SizesBeyondTheStreamAreRefused) {
  std::string stream = beginning() + 'M';
  append_bytes(stream, std::uint64_t{1} << 61);
  append_bytes(stream, std::uint64_t{1});
  EXPECT_FALSE(decode_import(stream + std::string(100, 'x')).has_value());
}

/// A stream with one node, and an animation of one track that says so of itself.
std::string one_track(std::uint32_t node, std::uint32_t property, std::uint32_t between, std::uint64_t keys) {
  std::string stream = written([](ImportWriter& writer) {
    writer.node(kRoot);
    writer.animation({"", 1, {}});
    EXPECT_TRUE(writer.end());
  });
  stream.back() = 'T';
  append_bytes(stream, node);
  append_bytes(stream, property);
  append_bytes(stream, between);
  append_bytes(stream, keys);
  return stream + std::string(4 * sizeof(double), '\0') + "Z";
}

TEST(ImportStream, WhatIsUnfollowedPointsToANode) {
  const auto with = [](std::optional<std::uint32_t> node, std::uint8_t what) {
    return written([&](ImportWriter& writer) {
      writer.node(kRoot);
      writer.animation({"", 1, {}, {{static_cast<Unfollowed::What>(what), node, "why"}}});
      EXPECT_TRUE(writer.end());
    });
  };
  EXPECT_TRUE(decode_import(with(0, 1)).has_value());
  EXPECT_TRUE(decode_import(with(std::nullopt, 0)).has_value());
  EXPECT_FALSE(decode_import(with(1, 0)).has_value()) << "no such node";
  EXPECT_FALSE(decode_import(with(0, 2)).has_value()) << "neither place nor shape";
  EXPECT_FALSE(decode_import(beginning() + with(0, 0).substr(with(0, 0).find('U'))).has_value()) << "of no animation";
}

TEST(ImportStream, TracksThatPointNowhereAreRefused) {
  EXPECT_TRUE(decode_import(one_track(0, 0, 0, 1)).has_value());
  EXPECT_FALSE(decode_import(one_track(1, 0, 0, 1)).has_value()) << "no such node";
  EXPECT_FALSE(decode_import(one_track(0, 3, 0, 1)).has_value()) << "no such property";
  EXPECT_FALSE(decode_import(one_track(0, 0, 3, 1)).has_value()) << "no such way between";
  EXPECT_FALSE(decode_import(one_track(0, 0, 0, 0)).has_value()) << "no keys";
  EXPECT_FALSE(decode_import(one_track(0, 0, 2, 1)).has_value()) << "a cubic key is longer";
  EXPECT_FALSE(decode_import(one_track(0, 0, 0, std::uint64_t{1} << 59)).has_value());
  EXPECT_FALSE(decode_import(beginning() + one_track(0, 0, 0, 1).substr(one_track(0, 0, 0, 1).find('T'))).has_value())
      << "a track before any animation";
  const auto with_node = [](std::uint32_t parent) {
    return written([&](ImportWriter& writer) {
      ImportedNode node = kRoot;
      node.parent = parent;
      writer.node(node);
      EXPECT_TRUE(writer.end());
    });
  };
  EXPECT_TRUE(decode_import(with_node(kNoNode)).has_value());
  EXPECT_FALSE(decode_import(with_node(0)).has_value()) << "its own parent";
}

TEST(ImportStream, GridsAreWhole) {
  const auto decoded = [](std::uint32_t family, const std::vector<Point>& points, std::uint32_t axes = 1) {
    std::string stream = written([&](ImportWriter& writer) {
      writer.grid({"", "", {{"A", family, points}}});
      EXPECT_TRUE(writer.end());
    });
    const std::size_t at = beginning().size() + 1 + 4 + 4;  // behind the letter and two empty texts
    std::memcpy(stream.data() + at, &axes, sizeof axes);
    return decode_import(stream).has_value();
  };
  const std::vector<Point> line{{0, 0, 0}, {1, 0, 0}};
  EXPECT_TRUE(decoded(2, line));
  EXPECT_FALSE(decoded(3, line)) << "no such family";
  EXPECT_FALSE(decoded(0, {{0, 0, 0}})) << "a point is no axis";
  EXPECT_FALSE(decoded(0, line, 2)) << "there is one";
  EXPECT_FALSE(decoded(0, line, 0xFFFFFFFF));
}

TEST(ImportStream, GroupsComeBeforeWhatIsInThem) {
  const auto decoded = [](std::uint32_t parent, std::uint32_t group) {
    return decode_import(written([&](ImportWriter& writer) {
             writer.mesh(kXyz, kTriangle);
             writer.group("top", kNoNode);
             writer.group("inner", parent);
             writer.object("bolt", "", "", 0, kNoNode, group, kIdentity);
             writer.end();
           }))
        .has_value();
  };
  EXPECT_TRUE(decoded(0, 1));
  EXPECT_FALSE(decoded(1, 1)) << "its own parent";
  EXPECT_FALSE(decoded(0, 2)) << "there are two";
}

Imported one_object(const std::array<double, 16>& world) {
  return {{{kXyz, kTriangle}}, {{"bolt", "bolt", "", 0, kNoNode, kNoNode, world}}, {}, {}, {}, {}, {}, {}};
}

TEST(ImportedModel, ARotationBecomesThePoseAndAnythingElseIsBaked) {
  std::array<double, 16> world{0, -1, 0, 5, 1, 0, 0, 6, 0, 0, 1, 7, 0, 0, 0, 1};
  const Model posed = model_of(model_of(one_object(world), Source{"f", "f"}));
  EXPECT_EQ(points_of(posed.objects.at(0)), (Points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0.1}}));
  EXPECT_EQ(posed.objects[0].pose.R, (std::array<double, 9>{0, -1, 0, 1, 0, 0, 0, 0, 1}));
  EXPECT_EQ(posed.objects[0].pose.t, (std::array<double, 3>{5, 6, 7}));
  world[1] = -2;  // stretched
  const Model baked = model_of(model_of(one_object(world), Source{"f", "f"}));
  EXPECT_EQ(points_of(baked.objects.at(0)), (Points{{5, 6, 7}, {5, 7, 7}, {3, 6, 7 + 0.1}}));
  EXPECT_EQ(baked.objects[0].pose.R, Pose{}.R);
  EXPECT_EQ(baked.objects[0].pose.t, Pose{}.t);
  const Model mirrored =
      model_of(model_of(one_object({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1}), Source{"f", "f"}));
  EXPECT_EQ(points_of(mirrored.objects.at(0)), (Points{{0, 0, 0}, {1, 0, 0}, {0, 1, -0.1}}));
  EXPECT_EQ(triangles_of(mirrored.objects[0]), (Triangles{{0, 1, 2}})) << "mirroring keeps the order";
}

TEST(ImportedModel, PerspectiveAndBadMeshesAreErrors) {
  std::array<double, 16> world = kIdentity;
  world[12] = 1e-9;
  EXPECT_THAT(error_of(model_of(one_object(world), Source{"a.dae", "a"})),
              HasSubstr("a.dae: the transform of object 'bolt'"));
  Imported bad = one_object(kIdentity);
  bad.meshes[0].triangles[2] = 3;
  EXPECT_THAT(error_of(model_of(std::move(bad), Source{"a.dae", "a"})), HasSubstr("a.dae: mesh 0"));
  world = kIdentity;
  world[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(error_of(model_of(one_object(world), Source{"a.dae", "a"})), HasSubstr("object 'bolt'"));
  EXPECT_THAT(error_of(model_of(Imported{}, Source{"a.dae", "a"})), HasSubstr("no triangles"));
}

TEST(ImportedModel, WarnsOfFloatsFarFromTheOrigin) {
  std::array<double, 16> world = kIdentity;
  EXPECT_TRUE(model_of(model_of(one_object(world), Source{"f", "f"})).warnings.empty());
  world[3] = 1e6;  // floats there are 1/16 apart
  const Model far = model_of(model_of(one_object(world), Source{"f", "f"}));
  ASSERT_EQ(far.warnings.size(), 1u);
  EXPECT_THAT(far.warnings[0], HasSubstr("'bolt', of size 1 with a spacing of 0.0625 at coordinate 1e+06"));
}

TEST(Names, AreMadeUniqueWithNumbers) {
  const Result<Mesh> mesh = Mesh::create(kXyz, kTriangle);
  ASSERT_TRUE(mesh.has_value());
  std::vector<Object> objects;
  for (const char* name : {"bolt", "bolt", "bolt (2)", "nut", "bolt", "bolt (2)"})
    objects.push_back({name, name, "", *mesh, {}});
  make_names_unique(objects);
  std::vector<std::string> names;
  for (const Object& object : objects) names.push_back(object.name);
  EXPECT_EQ(names, (std::vector<std::string>{"bolt", "bolt (3)", "bolt (2)", "nut", "bolt (4)", "bolt (2) (2)"}));
}

}  // namespace
}  // namespace impinge::io
