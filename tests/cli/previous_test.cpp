// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// The reader of an earlier run's JSON on whatever a file may hold, and how regions are matched.
#include "report/comparison/previous.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "report/named_tests/configuration.hpp"
#include "report/named_tests/grouping.hpp"

namespace impinge::report {
namespace {

const std::string kReport =
    R"({"version":1,"settings":{"scale":[["a",1]]},"files":[{"file":"f","name":"f","known_as":"e"}],
 "objects":[{"id":0,"name":"a","path":"p/a","file":"f","placed":"u"},
 {"id":1,"name":"b","path":"b","file":"f"}],"pairs":[{"id":"p","a":0,"b":1,"verdict":"penetrating","test":"t","status":"s",
 "nearest":[[0,0,0],[1,1,1]],"regions":[{"id":"r","box":[[0,0,0],[2,2,2]],"centroid":[1,1,1]}]}],
 "resolved":[{"id":"q","region":null,"a":{"name":"a","path":"","file":""},"b":{"name":"b","path":"","file":""},
 "verdict":"touching","test":null,"centroid":null}]})";

TEST(PreviousReport, IsReadWhole) {
  const auto read = parse_previous("old.json", kReport);
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->pairs.size(), 1U);
  const Previous::Pair& pair = read->pairs.front();
  EXPECT_EQ(pair.id, "p");
  EXPECT_EQ(pair.a.path, "p/a");
  EXPECT_EQ(pair.a.placed, "u");
  EXPECT_EQ(pair.b.placed, "");
  ASSERT_EQ(read->files.size(), 1U);
  EXPECT_EQ(read->files[0].known_as, "e");
  EXPECT_EQ(pair.b.name, "b");
  EXPECT_EQ(pair.test, "t");
  EXPECT_EQ(pair.verdict, Verdict::penetrating);
  ASSERT_EQ(pair.regions.size(), 1U);
  EXPECT_DOUBLE_EQ(pair.regions[0].half_diagonal * pair.regions[0].half_diagonal, 3);
  EXPECT_EQ(pair.regions[0].id, "r");
}

TEST(PreviousReport, WithoutNamesOfFilesTakesThemFromItsParts) {
  const auto read = parse_previous("old.json", R"({"version":1,"objects":[{"id":0,"name":"a","path":"p/a","file":"f/g"},
 {"id":1,"name":"b","path":"b","file":""},{"id":2,"name":"c","path":"c"}],"pairs":[],"resolved":[]})");
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->files.size(), 1U);
  EXPECT_EQ(read->files[0].file, "f/g");
  EXPECT_EQ(read->files[0].name, "g");
  EXPECT_EQ(read->files[0].known_as, "g");
}

TEST(PreviousReport, SurvivesWhateverAFileHolds) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  const std::string letters = "{}[]\",:\\ue019-+.tfnal \x01\xC3";
  std::size_t good = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string text = kReport;
    for (auto edits = 1 + random() % 4; edits > 0; --edits) {
      const std::size_t at = random() % text.size();
      if (random() % 2 == 0)
        text.erase(at, 1 + random() % 40);
      else if (random() % 2 == 0)
        text.insert(at, text.substr(random() % text.size(), random() % 60));
      else
        text[at] = letters[random() % letters.size()];
      if (text.empty()) text = "{";
    }
    const auto read = parse_previous("old.json", text);
    good += read ? 1U : 0U;
    if (!read) {
      EXPECT_TRUE(read.error().message.starts_with("old.json:")) << read.error().message;
    }
    static_cast<void>(parse_configuration("c.json", text).has_value());
  }
  EXPECT_GT(good, 20U);
}

Region region_at(double x, double half) {
  Region region;
  region.centroid = {x, 0, 0};
  region.box = {Point{x - half, -half, -half}, Point{x + half, half, half}};
  return region;
}

/// What becomes of regions of half-size 1 at these places on a line, when the earlier ones are `before`: for each the
/// number of the earlier one, or -1.
std::vector<int> matched(const std::vector<double>& before, const std::vector<double>& now, double slack) {
  Clash pair;
  pair.objects = {0, 1};
  pair.verdict = Verdict::penetrating;
  for (const double x : now) pair.regions.push_back(region_at(x, 1));
  Previous previous;
  Previous::Pair& old = previous.pairs.emplace_back();
  old.id = "p", old.verdict = Verdict::penetrating, old.has_regions = true;
  for (std::size_t i = 0; i < before.size(); ++i)
    old.regions.push_back({"old" + std::to_string(i), {before[i], 0, 0}, std::sqrt(3.0)});
  const std::vector<Clash> pairs{pair};
  const std::vector<std::string> ids{"p"};
  std::vector<Resolved> resolved;
  const auto standings =
      compare({pairs, ids, [&](const Clash&) { return slack; }, [](const Clash&, Verdict) { return true; }}, &previous,
              resolved);
  std::vector<int> numbers;
  std::size_t kept = 0;
  for (const RegionStanding& region : standings.at(0).regions) {
    const bool is_old = region.id.starts_with("old");
    EXPECT_EQ(region.change, is_old ? Change::persisting : Change::fresh);
    numbers.push_back(is_old ? std::stoi(region.id.substr(3)) : -1);
    kept += is_old ? 1U : 0U;
  }
  EXPECT_EQ(resolved.size(), before.size() - kept);
  return numbers;
}

TEST(Matching, TakesTheNearestTwoFirst) {
  using Numbers = std::vector<int>;
  EXPECT_EQ(matched({0, 10}, {10.5, 0.5}, 0), (Numbers{1, 0}));
  EXPECT_EQ(matched({0, 2}, {1.75, 3}, 0), (Numbers{1, 0}));  // 3 is 1 from 2, which is taken, and 3 from 0
  EXPECT_EQ(matched({0}, {3.4, 3.5}, 0), (Numbers{0, -1}));   // 2 sqrt 3 = 3.464
  EXPECT_EQ(matched({0}, {3.5}, 0), (Numbers{-1}));
  EXPECT_EQ(matched({0}, {3.5}, 0.1), (Numbers{0}));
  EXPECT_EQ(matched({0, 0}, {0, 0, 0}, 0), (Numbers{0, 1, -1}));  // ties: in order
  EXPECT_EQ(matched({}, {0}, 0), (Numbers{-1}));
  EXPECT_EQ(matched({0}, {}, 0), (Numbers{}));
}

TEST(Matching, OfAHundredThousandRegionsEndsSoon) {
  std::vector<double> many(100'000, 0.0);
  const std::vector<int> numbers = matched(many, {0, 0}, 0);
  EXPECT_EQ(numbers, (std::vector<int>{0, 1}));
}

TEST(Matching, KnowsHoweverManyRegionsThatStayed) {
  std::vector<double> before, now;
  for (int i = 0; i < 5000; ++i) before.push_back(10 * i), now.push_back(10 * (4999 - i));
  now[4998] += 0.5;  // the first but one
  const std::vector<int> numbers = matched(before, now, 0);
  for (int i = 0; i < 5000; ++i) EXPECT_EQ(numbers[static_cast<std::size_t>(i)], 4999 - i);
}

TEST(Types, AreCalledWhatTheirNamesHaveInCommon) {
  EXPECT_EQ(common_name({"bolt M8_1", "bolt M8_12", "bolt M8_2"}), "bolt M8");
  EXPECT_EQ(common_name({"P-001 pipe", "P-002 pipe", "P-012 pipe"}), "P*pipe");
  EXPECT_EQ(common_name({"nut"}), "nut");
  EXPECT_EQ(common_name({"nut 1"}), "nut 1");
  EXPECT_EQ(common_name({"nut", "nut"}), "nut");
  EXPECT_EQ(common_name({"nut", "bolt"}), "*t");
  EXPECT_EQ(common_name({"ab", "cd"}), "ab");
  EXPECT_EQ(common_name({"aa", "aaa"}), "aa");
  EXPECT_EQ(common_name({"1", "2"}), "1");
  EXPECT_EQ(common_name({"", "2"}), "");
  EXPECT_EQ(common_name({}), "");
}

}  // namespace
}  // namespace impinge::report
