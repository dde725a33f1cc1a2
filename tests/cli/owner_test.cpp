// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// Whatever is done to parts and files from run to run, what was written about two parts stands with these two or with
// none, and is not lost. Who a part is only the test knows: the program sees names, shapes and places.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include "meshes.hpp"
#include "program.hpp"

namespace impinge::test {
namespace {

using nlohmann::json;

/// A cube of the model, at a height of its own, so that no two are ever alike.
struct Thing {
  int who;
  std::string name;
  std::size_t file;
  std::array<int, 3> lo;
  int size;
};

class Model {
 public:
  Model(std::mt19937& random, bool is_dated) : random_(random), is_dated_(is_dated) {
    for (int i = 0; i < 4; ++i) add();
  }

  /// One or two changes, after which no name is another part's than before: that such a part is taken for the same is
  /// by design.
  void change() {
    for (;;) {
      Model next(*this);
      for (auto changes = 1 + random_() % 2; changes > 0; --changes) next.change_once();
      std::shuffle(next.things_.begin(), next.things_.end(), random_);
      if (next.things_.size() < 2 || next.things_.size() > 6 || !keeps_names(*this, next)) continue;
      // A file that has a new name, and parts that go to another one: nobody could say which file is which.
      if (is_dated_ && next.files() == files() && next.file_of() == file_of())
        for (int& date : next.dates_) date += static_cast<int>(random_() % 2);
      things_ = std::move(next.things_), gone_ = std::move(next.gone_), people_ = next.people_, dates_ = next.dates_;
      return;
    }
  }

  /// Writes the files and says which they are.
  [[nodiscard]] std::vector<std::string> write(const Folder& folder) const {
    std::map<std::size_t, std::string> texts;
    std::map<std::size_t, std::size_t> corners;
    for (const Thing& thing : things_) {
      const auto& [x, y, z] = thing.lo;
      texts[thing.file] += "o " + thing.name + "\n";
      const Solid solid = box(thing.lo, {x + thing.size, y + thing.size, z + thing.size});
      for (const auto& [a, b, c] : solid.vertices)
        texts[thing.file] += "v " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
      for (const auto& [a, b, c] : solid.triangles) {
        const auto at = [&](int corner) {
          return " " + std::to_string(static_cast<int>(corners[thing.file]) + corner + 1);
        };
        texts[thing.file] += "f" + at(a) + at(b) + at(c) + "\n";
      }
      corners[thing.file] += solid.vertices.size();
    }
    std::vector<std::string> names;
    for (const auto& [file, text] : texts) folder.write(names.emplace_back(name_of(file)), text);
    return names;
  }

  /// Who a part of the report is: it has its name, and of its namesakes in the file it is as many as come before it.
  [[nodiscard]] std::vector<int> who_is(const json& objects) const {
    std::vector<int> people;
    std::map<std::pair<std::string, std::string>, std::size_t> seen;
    for (const json& object : objects) {
      const std::string file = object.at("file"), path = object.at("path");
      std::size_t before = seen[{file, path}]++;
      for (const Thing& thing : things_)
        if (name_of(thing.file) == file && thing.name == path && before-- == 0) people.push_back(thing.who);
    }
    EXPECT_EQ(people.size(), things_.size());
    return people;
  }

 private:
  /// Either their folders tell the two files apart, or they have names of their own with dates in them.
  [[nodiscard]] std::string name_of(std::size_t file) const {
    if (!is_dated_) return file == 0 ? "l/m.obj" : "r/m.obj";
    return (file == 0 ? "l_" : "r_") + std::to_string(dates_.at(file)) + ".obj";
  }

  void add() {
    const int who = people_++;
    things_.push_back({who, any_name(), random_() % 4 == 0 ? 1U : 0U, any_place(who), random_() % 2 == 0 ? 300 : 200});
  }
  std::string any_name() { return random_() % 3 == 0 ? "b" : "a"; }
  std::array<int, 3> any_place(int who) { return {static_cast<int>(random_() % 150), 0, who}; }
  Thing& any() { return things_[random_() % things_.size()]; }

  void change_once() {
    if (things_.empty()) return add();
    switch (random_() % 8) {
      case 0:
      case 1:
        return add();
      case 2:
      case 3:
        std::swap(any(), things_.back());
        gone_.push_back(things_.back());
        return things_.pop_back();
      case 4:
        if (gone_.empty()) return;
        things_.push_back(gone_.back());
        return gone_.pop_back();
      case 5: {
        Thing& thing = any();
        thing.lo = any_place(thing.who);
        return;
      }
      case 6:
        any().name = any_name();
        return;
      default:
        any().file = random_() % 2;
    }
  }

  [[nodiscard]] std::set<std::size_t> files() const {
    std::set<std::size_t> files;
    for (const Thing& thing : things_) files.insert(thing.file);
    return files;
  }
  [[nodiscard]] std::map<int, std::size_t> file_of() const {
    std::map<int, std::size_t> file_of;
    for (const Thing& thing : things_) file_of[thing.who] = thing.file;
    return file_of;
  }
  /// Those that are the only ones of their names.
  [[nodiscard]] std::map<std::pair<std::string, std::string>, int> owners() const {
    const std::size_t count = files().size();
    std::map<std::pair<std::string, std::string>, int> owners;
    for (const Thing& thing : things_) {
      // What is in the only file may be taken for what was in the only one then.
      for (const std::string file : {thing.file == 0 ? "left" : "right", "only"}) {
        if (file == "only" && count > 1) continue;
        const auto [known, fresh] = owners.try_emplace({file, thing.name}, thing.who);
        if (!fresh) known->second = -1;
      }
    }
    return owners;
  }
  static bool keeps_names(const Model& before, const Model& after) {
    const auto then = before.owners(), now = after.owners();
    return std::all_of(then.begin(), then.end(), [&](const auto& owner) {
      const auto same = now.find(owner.first);
      return owner.second < 0 || same == now.end() || same->second < 0 || same->second == owner.second;
    });
  }

  std::mt19937& random_;
  bool is_dated_;
  std::array<int, 2> dates_{};
  std::vector<Thing> things_, gone_;
  int people_ = 0;
};

/// All that is written in a report: of pairs, regions and what is resolved.
std::multiset<std::string> written(const json& value) {
  std::multiset<std::string> texts;
  if (value.is_object())
    for (const char* key : {"status", "comment"})
      if (value.contains(key) && value.at(key).is_string()) texts.insert(value.at(key).get<std::string>());
  if (value.is_structured())
    for (const json& item : value) texts.merge(written(item));
  return texts;
}

TEST(WhatWasWritten, StandsWithThosePartsThatItWasWrittenFor) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  std::size_t carried = 0;
  for (int trial = 0; trial < 12; ++trial) {
    const Folder folder;
    for (const char* side : {"l", "r"}) std::filesystem::create_directory(folder.path() / side);
    Model model(random, trial % 2 == 1);
    std::set<std::string> all;
    for (int run = 0; run < 6; ++run) {
      if (run > 0) model.change();
      std::vector<std::string> words{"clash", "--json", "new.json", "--regions", "--quiet"};
      if (run > 0) words.insert(words.end(), {"--previous", "old.json"});
      for (const std::string& file : model.write(folder)) words.push_back(file);
      const Ended ended = impinge(folder, words);
      ASSERT_LE(ended.code, 1) << ended.err;
      json report = json::parse(folder.read("new.json"));
      const std::vector<int> who = model.who_is(report.at("objects"));
      const std::multiset<std::string> there = written(report);
      for (const std::string& text : all) EXPECT_TRUE(there.contains(text)) << text << " is lost in run " << run;
      for (json& pair : report.at("pairs")) {
        EXPECT_EQ(pair.at("ambiguous"), false);
        const auto [a, b] = std::minmax(who[pair.at("a").get<std::size_t>()], who[pair.at("b").get<std::size_t>()]);
        const std::string text = std::to_string(a) + " and " + std::to_string(b);
        const auto look_at = [&](json& remark, const std::string& expected) {
          if (remark.is_string()) {
            EXPECT_EQ(remark, expected) << "in run " << run << " of trial " << trial;
            ++carried;
          } else if (random() % 4 != 0) {
            remark = expected;
            all.insert(expected);
          }
        };
        look_at(pair.at("status"), text);
        for (json& region : pair.at("regions")) look_at(region.at("comment"), text + ", here");
      }
      folder.write("old.json", report.dump());
      std::filesystem::remove(folder.path() / "new.json");
    }
  }
  EXPECT_GT(carried, 20U);
}

}  // namespace
}  // namespace impinge::test
