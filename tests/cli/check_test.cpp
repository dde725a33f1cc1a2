// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// What `impinge check` answers, on cubes whose answer follows from their corners.
#include <algorithm>
#include <array>
#include <set>
#include <tuple>
#include <vector>

#include "meshes.hpp"
#include "program.hpp"

namespace impinge::test {
namespace {

using Contact = std::tuple<int, int, std::string>;

/// Two cubes of edge 2 whose corners lie on even numbers and that do not overlap meet in a square, an edge or a corner
/// that they share, and every triangle meets it in the hull of its own corners there. The diagonals of a shared square
/// are the same, so two triangles share a point if and only if they share a corner; and they lie in one plane if and
/// only if all six corners have one coordinate in common, for all planes of a cube are such.
std::vector<Contact> expected_contacts(const Solid& a, const Solid& b) {
  std::vector<Contact> contacts;
  for (std::size_t i = 0; i < a.triangles.size(); ++i)
    for (std::size_t j = 0; j < b.triangles.size(); ++j) {
      std::vector<std::array<int, 3>> corners;
      for (const int v : a.triangles[i]) corners.push_back(a.vertices[static_cast<std::size_t>(v)]);
      for (const int v : b.triangles[j]) corners.push_back(b.vertices[static_cast<std::size_t>(v)]);
      bool share = false, coplanar = false;
      for (std::size_t m = 0; m < 3; ++m)
        for (std::size_t n = 3; n < 6; ++n) share = share || corners[m] == corners[n];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        bool same = true;
        for (const auto& corner : corners) same = same && corner[axis] == corners[0][axis];
        coplanar = coplanar || same;
      }
      if (share) contacts.emplace_back(i, j, coplanar ? "coplanar" : "touching");
    }
  return contacts;
}

std::vector<Contact> contacts_of(const json& pair) {
  std::vector<Contact> contacts;
  for (const json& entry : pair.at("triangles")) contacts.emplace_back(entry.at(0), entry.at(1), entry.at(2));
  return contacts;
}

class Check : public testing::Test {
 protected:
  /// The document of `check` on these files, every pair of triangles in it.
  [[nodiscard]] json check(const Words& words, int code = 1) const {
    return document(folder, joined({"check", "--triangles"}, words), code);
  }
  Folder folder;
};

TEST_F(Check, ListsCubesThatMeetTriangleByTriangle) {
  // A face, an edge, a corner and nothing. Counted on paper, over the corners, edges and triangles that are shared: 80
  // - 20 + 2 for a face (corner counts 4, 4, 4, 6 against 6, 4, 4, 4), 24 + 24 - 4 for an edge, 6 x 6 for a corner.
  for (const auto& [b, count] :
       {std::pair(cube(2, 0, 0), 62U), {cube(2, 2, 0), 44U}, {cube(2, 2, 2), 36U}, {cube(4, 0, 0), 0U}}) {
    SCOPED_TRACE(count);
    const Solid a = cube(0, 0, 0);
    const std::vector<Contact> expected = expected_contacts(a, b);
    ASSERT_EQ(expected.size(), count);
    write_off(folder, {{"a", a}, {"b", b}});
    std::array<int, 2> counts{};
    for (const auto& [i, j, kind] : expected) ++counts[kind == "coplanar" ? 1 : 0];
    json pairs = check({"a.off", "b.off"}, count > 0 ? 1 : 0).at("pairs");
    ASSERT_EQ(pairs.size(), count > 0 ? 1U : 0U);
    if (count == 0) continue;
    EXPECT_EQ(contacts_of(pairs[0]), expected);
    pairs[0].erase("triangles");
    EXPECT_EQ(pairs[0], (json{{"a", 0}, {"b", 1}, {"crossing", 0}, {"touching", counts[0]}, {"coplanar", counts[1]}}));
  }
}

TEST_F(Check, NamesACrossing) {
  // The second triangle passes through (1, 1, 0), inside the first.
  const Solid flat{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}};
  const Solid upright{{{1, 1, -1}, {1, 1, 1}, {2, 1, 1}}, {{0, 1, 2}}};
  folder.write("flat.obj", obj(flat));
  folder.write("upright.stl", stl(upright));
  const json pair = check({"flat.obj", "upright.stl"}).at("pairs").at(0);
  EXPECT_EQ(contacts_of(pair), (std::vector<Contact>{{0, 0, "crossing"}}));
}

TEST_F(Check, PrintsATableInCanonicalOrderAndASummary) {
  write_off(folder, {{"b", cube(2, 0, 0)}, {"a", cube(0, 0, 0)}, {"c", cube(2, 2, 0)}});
  const Ended run = impinge(folder, {"check", "b.off", "a.off", "c.off"});
  EXPECT_EQ(run.code, 1);
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(run.out, StartsWith("object  object  crossing  touching  coplanar\n"
                                  "b       a              0        46        16\n"
                                  "b       c              0        46        16\n"
                                  "a       c              0        30        14\n"
                                  "\n"
                                  "3 pairs of objects touch, in 168 pairs of triangles.\n"
                                  "3 objects, 36 triangles; read in "));
}

TEST_F(Check, SaysThatNothingTouches) {
  write_off(folder, {{"a", cube(0, 0, 0)}, {"b", cube(9, 0, 0)}});
  const Ended two = impinge(folder, {"check", "a.off", "b.off"});
  EXPECT_EQ(two.code, 0);
  EXPECT_THAT(two.out, StartsWith("Nothing touches.\n"));
  const Ended one = impinge(folder, {"check", "a.off"});
  EXPECT_EQ(one.code, 0);
  EXPECT_THAT(one.out, HasSubstr("only one object"));
}

TEST_F(Check, TestsObjectsOfOneFileAndShowsTheFileWhereNamesAreTheSame) {
  folder.write("pair.gltf", gltf({{"left", {0, 0, 0}}, {"right", {2, 0, 0}}}));
  const json answer = check({"pair.gltf"});
  ASSERT_EQ(answer.at("pairs").size(), 1U);
  EXPECT_EQ(answer.at("pairs").at(0).at("touching"), 46);
  EXPECT_EQ(answer.at("pairs").at(0).at("coplanar"), 16);
  EXPECT_EQ(answer.at("objects").at(1).at("name"), "right");

  folder.write("left.off", off(cube(0, 2, 0)));
  const Ended both = impinge(folder, {"check", "pair.gltf", "left.off"});
  EXPECT_THAT(both.out, HasSubstr("left (pair.gltf)  right "));
  EXPECT_THAT(both.out, HasSubstr("left (pair.gltf)  left (left.off) "));

  folder.write("far.off", "OFF\n3 1 0\n1e100 0 0\n0 1 0\n0 0 1\n3 0 1 2\n");
  EXPECT_THAT(impinge(folder, {"check", "pair.gltf", "far.off"}).err, StartsWith("impinge: 'far' is out of range"));
}

TEST_F(Check, LimitKeepsTheFirstInOrder) {
  const Solid a = cube(0, 0, 0), b = cube(2, 0, 0);
  write_off(folder, {{"a", a}, {"b", b}});
  std::vector<Contact> expected = expected_contacts(a, b);
  for (const std::size_t limit : {1U, 7U, 61U, 62U, 1000U}) {
    const json answer = check({"a.off", "b.off", "--limit", std::to_string(limit)});
    EXPECT_EQ(answer.at("truncated"), limit < 62) << limit;
    const std::vector<Contact> kept(expected.begin(),
                                    expected.begin() + static_cast<long>(std::min<std::size_t>(limit, 62)));
    EXPECT_EQ(contacts_of(answer.at("pairs").at(0)), kept) << limit;
  }
  const Ended none = impinge(folder, {"check", "a.off", "b.off", "--limit", "0", "--json", "out.json"});
  EXPECT_EQ(none.code, 1);
  EXPECT_THAT(none.out, HasSubstr("--limit 0 keeps nothing"));
  const json answer = json::parse(folder.read("out.json"));
  EXPECT_TRUE(answer.at("pairs").empty());
  EXPECT_EQ(answer.at("truncated"), true);
}

TEST_F(Check, FirstGivesOneTrueWitnessAndNoHash) {
  const Solid a = cube(0, 0, 0), b = cube(2, 0, 0);
  write_off(folder, {{"a", a}, {"b", b}, {"far", cube(40, 0, 0)}});
  const json answer = check({"a.off", "b.off", "far.off", "--first"});
  EXPECT_TRUE(answer.at("hash").is_null());
  ASSERT_EQ(answer.at("pairs").size(), 1U);
  const std::vector<Contact> witness = contacts_of(answer.at("pairs").at(0));
  ASSERT_EQ(witness.size(), 1U);
  const std::vector<Contact> all = expected_contacts(a, b);
  EXPECT_NE(std::find(all.begin(), all.end(), witness[0]), all.end());
  EXPECT_EQ(impinge(folder, {"check", "a.off", "far.off", "--first"}).code, 0);
}

/// Two cubes with a common square as one object: their triangles there are the same, and all else that meets is
/// neighbours.
TEST_F(Check, SelfTestsEachObjectAgainstItself) {
  const Solid one = cube(0, 0, 0), other = cube(2, 0, 0);
  std::vector<Contact> same;
  for (std::size_t i = 0; i < one.triangles.size(); ++i)
    for (std::size_t j = 0; j < other.triangles.size(); ++j) {
      std::set<std::array<int, 3>> corners;
      for (const int v : one.triangles[i]) corners.insert(one.vertices[static_cast<std::size_t>(v)]);
      for (const int v : other.triangles[j]) corners.insert(other.vertices[static_cast<std::size_t>(v)]);
      if (corners.size() == 3) same.emplace_back(i, one.triangles.size() + j, "coplanar");
    }
  folder.write("both.off", off(as_one({one, other})));
  EXPECT_EQ(impinge(folder, {"check", "both.off"}).code, 0);
  const json answer = check({"both.off", "--self"});
  ASSERT_EQ(answer.at("pairs").size(), 1U);
  EXPECT_EQ(same.size(), 2U);
  EXPECT_EQ(contacts_of(answer.at("pairs").at(0)), same);
}

TEST_F(Check, ScaleMovesOneFileOnly) {
  write_off(folder, {{"a", cube(0, 0, 0)}, {"b", cube(4, 0, 0)}});
  EXPECT_EQ(impinge(folder, {"check", "a.off", "b.off"}).code, 0);
  // 4 x 0.5 is the face of the other cube; a double's width more is not.
  EXPECT_EQ(impinge(folder, {"check", "a.off", "b.off", "--scale", "b.off=0.5"}).code, 1);
  EXPECT_EQ(impinge(folder, {"check", "a.off", "b.off", "--scale", "b.off=0.5000000000000001"}).code, 0);
  EXPECT_EQ(impinge(folder, {"check", "a.off", "b.off", "--scale", "a.off=2", "--scale", "b.off=1"}).code, 1);
}

TEST_F(Check, AnswerDoesNotDependOnThreadsOrBackend) {
  write_off(folder, {{"a", cube(0, 0, 0)}, {"b", cube(1, 1, 1)}, {"c", cube(2, 0, 0)}});
  const auto answer = [&](Words more) {
    json whole = check(joined({"a.off", "b.off", "c.off"}, more));
    whole.erase("stats");
    return whole;
  };
  const json expected = answer({"--threads", "1"});
  EXPECT_EQ(expected.at("pairs").size(), 3U);
  EXPECT_EQ(answer({"--threads", "4"}), expected);
  for (const char* backend : {"auto", "simd", "paper"}) EXPECT_EQ(answer({"--backend", backend}), expected);
  EXPECT_EQ(answer({"--stats"}), expected);
}

TEST_F(Check, StatsShowStagesAndTheCostFunction) {
  write_off(folder, {{"a", cube(0, 0, 0)}, {"b", cube(1, 1, 1)}});
  const Ended run = impinge(folder, {"check", "a.off", "b.off", "--stats"});
  EXPECT_EQ(run.code, 1);
  for (const char* word :
       {"broad", "hierarchy", "partition", "narrow", "exact", "results", "T predicted", "T measured"})
    EXPECT_THAT(run.out, HasSubstr(word)) << word;
}

}  // namespace
}  // namespace impinge::test
