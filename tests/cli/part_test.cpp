// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

#include "program.hpp"
#include "report/json_writer.hpp"
#include "tables.hpp"

namespace impinge::cli {
namespace {

using nlohmann::json;

Mesh two_triangles() {
  const std::vector<double> xyz{0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, -1, 1, 1, 1, 2, 1, 1};
  const std::vector<std::uint32_t> triangles{0, 1, 2, 3, 4, 5};
  return Mesh::create(std::span<const double>(xyz), triangles).value();
}

TEST(Part, FactsAreNamedWithPlaces) {
  Part part;
  part.size = 1;
  EXPECT_EQ(facts_text(part), "it encloses nothing");
  part.facts.open_edges = 1;
  part.facts.open_edge = Segment{Point{0, -0.0, 0.25}, Point{100, 0, 1.0 / 3}};
  EXPECT_EQ(facts_text(part), "1 open edge, first at (0 0 0.25)-(100 0 0.333)");
  part.facts.self_crossings = 1200;
  part.crossing_near = Point{-1, 2, 1e6};
  EXPECT_EQ(facts_text(part),
            "1 open edge, first at (0 0 0.25)-(100 0 0.333); 1,200 self-crossings, first near (-1 2 1000000)");
  part.facts.unclear_edges = 1;
  part.facts.unclear_edge = Segment{Point{0, 0, 0}, Point{0, 0, 1}};
  part.facts.turned = 2;
  EXPECT_EQ(facts_text(part),
            "1 open edge, first at (0 0 0.25)-(100 0 0.333); at none of them can inside be told from outside; 1,200 "
            "self-crossings, first near (-1 2 1000000); 2 triangles turned");
  part.facts.open_edges = 3;
  EXPECT_EQ(
      facts_text(part, "mm"),
      "3 open edges, first at (0 0 0.25)-(100 0 0.333) mm; at 1 of them inside cannot be told from outside, first "
      "at (0 0 0)-(0 0 1) mm; 1,200 self-crossings, first near (-1 2 1000000) mm; 2 triangles turned");
}

TEST(Part, ACrossingIsNearBothTriangles) {
  PartFacts facts;
  facts.self_crossings = 1;
  facts.self_crossing = TrianglePair{0, 1};
  Pose pose;
  pose.t = {1e6, 0, -5};
  const Part part = describe(facts, two_triangles(), pose);
  // The boxes share x from 1 to 2, y = 1 and z = 0.
  EXPECT_EQ(part.crossing_near, (Point{1e6 + 1.5, 1, -5}));
  EXPECT_FALSE(describe(PartFacts{}, two_triangles(), pose).crossing_near.has_value());
}

TEST(Part, JsonIsNullWhereNothingIsKnown) {
  Part part;
  part.facts.volume = 8, part.facts.area = 24, part.facts.radius = 0.5;
  const auto parse = [](const std::optional<Part>& of) { return json::parse(json_text(json_facts(of))); };
  part.facts.part_class = PartClass::solid;
  part.facts.pieces = {2, 0, 1};
  EXPECT_EQ(parse(part), json::parse(R"({"class":"solid","pieces":{"solid":2,"cracked":0,"surface":1},"turned":0,
    "unclear_edges":0,"first_unclear_edge":null,"first_open_edge":null,"self_crossings":0,"first_self_crossing":null,
    "volume":8,"area":24,"inner_radius":0.5})"));
  part.facts.open_edges = 1;
  part.facts.open_edge = Segment{Point{0, 0, 1}, Point{0, 0, 1e300}};
  part.facts.self_crossings = 2;
  part.facts.self_crossing = TrianglePair{3, 7};
  part.crossing_near = Point{0.1, 0, 0};
  part.facts.part_class = PartClass::cracked;
  part.facts.turned = 5;
  part.facts.unclear_edges = 1;
  part.facts.unclear_edge = Segment{Point{0, 0, 1}, Point{0, 0, 2}};
  EXPECT_EQ(parse(part), json::parse(R"({"class":"cracked","pieces":{"solid":2,"cracked":0,"surface":1},"turned":5,
    "unclear_edges":1,"first_unclear_edge":[[0,0,1],[0,0,2]],"first_open_edge":[[0,0,1],[0,0,1e300]],
    "self_crossings":2,"first_self_crossing":{"triangles":[3,7],"near":[0.1,0,0]},
    "volume":null,"area":24,"inner_radius":0.5})"));
  part.facts.part_class = PartClass::surface;
  EXPECT_TRUE(parse(part).at("inner_radius").is_null());
  const json unknown = parse(std::nullopt);
  for (const auto& item : unknown.items()) EXPECT_TRUE(item.value().is_null()) << item.key();
  EXPECT_EQ(unknown.size(), parse(part).size());
}

TEST(Part, TheListOfSurfacesAndCrackedPartsIsCut) {
  std::vector<Part> parts(13);
  parts[0].facts.part_class = PartClass::solid;
  std::vector<std::string> labels;
  for (std::size_t i = 0; i < parts.size(); ++i) labels.push_back("a_rather_long_name_" + std::to_string(i));
  const auto printed = [&](std::size_t count, std::optional<std::size_t> width) {
    std::vector<NamedPart> named;
    for (std::size_t i = 0; i < count; ++i) named.push_back({labels[i], "", &parts[i]});
    return test::written([&](Sink& sink) { EXPECT_EQ(print_parts(named, 0.001, sink, width), count > 1); });
  };
  EXPECT_EQ(printed(1, {}), "");
  const std::string hidden = "Surfaces have no inside: what lies wholly within one is not found.\n";
  EXPECT_EQ(printed(2, {}), "a_rather_long_name_1 is a surface: it encloses nothing\n" + hidden);
  parts[1].facts.part_class = PartClass::cracked;
  parts[1].facts.open_edges = 2;
  EXPECT_EQ(printed(3, {}),
            "a_rather_long_name_2 is a surface: it encloses nothing\n"
            "a_rather_long_name_1 is cracked: 2 open edges\n" +
                hidden);
  parts[1].facts.open_edges = 0;
  parts[1].facts.part_class = PartClass::surface;
  EXPECT_EQ(printed(2, 36), "a_rathe…me_1 is a surface: it encloses nothing\n" + hidden);
  EXPECT_EQ(printed(11, {}).find("more"), std::string::npos);
  EXPECT_TRUE(
      printed(13, {}).ends_with("name_10 is a surface: it encloses nothing\n"
                                "(2 more are no solids; --json lists them.)\n" +
                                hidden))
      << printed(13, {});
}

}  // namespace
}  // namespace impinge::cli
