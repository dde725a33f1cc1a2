// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/named_tests/part_sets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "report/scene.hpp"
#include "report/text.hpp"

namespace impinge::report {
namespace {

// Each is held against each part, and these against each pair that is near.
constexpr std::size_t kMostWords = 10'000;
// Groups of groups of groups: far more than a person writes, and no more than a stack holds.
constexpr std::size_t kDeepest = 32;

void intersect(PartSet& set, const PartSet& other) {
  for (std::size_t i = 0; i < set.size(); ++i) set[i] = set[i] && other[i];
}
void unite(PartSet& set, const PartSet& other) {
  for (std::size_t i = 0; i < set.size(); ++i) set[i] = set[i] || other[i];
}
bool is_empty(const PartSet& set) { return std::find(set.begin(), set.end(), true) == set.end(); }

/// The objects of which the text is the word, or else agrees with it as a pattern.
PartSet where(const std::vector<io::Object>& objects, const std::string io::Object::*text, std::string_view word) {
  PartSet set(objects.size());
  const auto mark = [&](auto says) {
    for (std::size_t i = 0; i < objects.size(); ++i) set[i] = says(objects[i].*text);
  };
  mark([&](std::string_view name) { return name == word; });
  if (is_empty(set) && word.find_first_of("*?") != std::string_view::npos)
    mark([&](std::string_view name) { return !name.empty() && matches_pattern(word, name); });
  return set;
}

}  // namespace

Error PartSets::nothing_named(const Word& word, std::string_view what, const std::string& nearest) const {
  return configuration_.error_at(
      word.place, fmt::format("no {} is '{}'{}", what, fit(printable(word.shown()), 80),
                              nearest.empty() ? "" : fmt::format("; the nearest is '{}'", printable(nearest))));
}

Result<void> PartSets::count_word(const Word& word) {
  if (++words_ <= kMostWords) return {};
  return configuration_.error_at(word.place, fmt::format("there are more than {} words in all groups together; "
                                                         "patterns such as 'pipe*' need fewer",
                                                         grouped(kMostWords)));
}

Result<PartSet> PartSets::of_word(const Word& word, const std::vector<Word> Group::*list) {
  if (auto counted = count_word(word); !counted) return counted.error();
  if (list == &Group::named) return of_named(word);
  PartSet set(assembly_.objects.size());
  if (list == &Group::names) {
    const auto found = objects_named(assembly_, word.text);
    if (!found) return configuration_.error_at(word.place, found.error().message);
    for (const std::uint32_t object : *found) set[object] = true;
    return set;
  }
  if (list == &Group::files) {
    const std::vector<std::uint32_t> files = files_named(configuration_, word.text, assembly_.files);
    if (files.empty()) return nothing_named(word, "file that is read", "");
    for (std::size_t i = 0; i < set.size(); ++i)
      set[i] = std::find(files.begin(), files.end(), assembly_.file_of[i]) != files.end();
    return set;
  }
  if (list == &Group::classes) {
    Result<PartSet> found = of_class(assembly_, word.text);
    return found ? found : configuration_.error_at(word.place, found.error().message);
  }
  if (list == &Group::selects) {
    const Result<Selector> selector = parse_selector(word.text);
    const Result<PartSet> found = selector ? select(*selector, assembly_) : Result<PartSet>(selector.error());
    return found ? found : configuration_.error_at(word.place, "the selector: " + found.error().message);
  }
  const auto text = list == &Group::paths ? &io::Object::path : &io::Object::product;
  set = where(assembly_.objects, text, word.text);
  if (is_empty(set))
    return nothing_named(word, list == &Group::paths ? "part's path" : "part's IFC product",
                         nearest_text(word.text, assembly_.objects, text));
  return set;
}

Result<PartSet> PartSets::of_named(const Word& word) {
  const auto group = configuration_.groups.find(word.text);
  if (group == configuration_.groups.end())
    return nothing_named(word, "group of this configuration",
                         nearest_text(word.text, configuration_.groups,
                                      [](const auto& known) -> std::string_view { return known.first; }));
  if (const auto known = known_.find(word.text); known != known_.end()) return known->second;
  if (std::find(open_.begin(), open_.end(), word.text) != open_.end())
    return configuration_.error_at(word.place, fmt::format("the group '{}' is made of itself", printable(word.text)));
  if (open_.size() >= kDeepest)
    return configuration_.error_at(word.place, fmt::format("groups of groups go {} levels deep at most", kDeepest));
  open_.push_back(word.text);
  Result<PartSet> set = of(group->second);
  open_.pop_back();
  if (set) known_.emplace(word.text, *set);
  return set;
}

Result<PartSet> PartSets::with_property(const PropertyWords& property, const std::string& place) {
  const std::vector<io::Object>& objects = assembly_.objects;
  std::set<std::string> names;
  std::vector<std::vector<std::string_view>> values(objects.size());
  for (std::size_t i = 0; i < objects.size(); ++i)
    for (const auto& [name, value] : objects[i].properties) {
      names.insert(name);
      if (name == property.name) values[i].push_back(value);
    }
  if (!names.contains(property.name))
    return nothing_named({property.name, place + "/property"}, "part's property", nearest_text(property.name, names));
  PartSet all(objects.size());
  for (const Word& word : property.words) {
    if (auto counted = count_word(word); !counted) return counted.error();
    const auto some = [&](auto says) {
      PartSet set(objects.size());
      for (std::size_t i = 0; i < set.size(); ++i) set[i] = std::ranges::any_of(values[i], says);
      return set;
    };
    PartSet set = some([&](std::string_view value) { return value == word.text; });
    if (is_empty(set)) set = some([&](std::string_view value) { return matches_pattern(word.text, value); });
    if (is_empty(set)) {
      std::set<std::string_view> known;
      for (const auto& of_object : values) known.insert(of_object.begin(), of_object.end());
      return nothing_named(word, "part's " + printable(property.name), nearest_text(word.text, known));
    }
    unite(all, set);
  }
  return all;
}

Result<PartSet> PartSets::any_of(const std::vector<Group>& groups) {
  PartSet all(assembly_.objects.size());
  for (const Group& group : groups) {
    const Result<PartSet> set = of(group);
    if (!set) return set.error();
    unite(all, *set);
  }
  return all;
}

Result<PartSet> PartSets::of(const Group& group) {
  PartSet all(assembly_.objects.size(), true);
  for (const auto list : {&Group::names, &Group::paths, &Group::products, &Group::classes, &Group::selects,
                          &Group::files, &Group::named}) {
    if ((group.*list).empty()) continue;
    PartSet some(all.size());
    for (const Word& word : group.*list) {
      const Result<PartSet> set = of_word(word, list);
      if (!set) return set.error();
      unite(some, *set);
    }
    intersect(all, some);
  }
  for (const PropertyWords& property : group.properties) {
    const Result<PartSet> some = with_property(property, group.place);
    if (!some) return some.error();
    intersect(all, *some);
  }
  if (!group.any.empty()) {
    const Result<PartSet> some = any_of(group.any);
    if (!some) return some.error();
    intersect(all, *some);
  }
  if (!group.except.empty()) {
    Result<PartSet> none = any_of(group.except);
    if (!none) return none;
    none->flip();
    intersect(all, *none);
  }
  if (is_empty(all)) return configuration_.error_at(group.place, "no part is in this group");
  return all;
}

std::string in_short(const Group& group) {
  std::string text;
  const auto add = [&](const std::string& more) { text += (text.empty() ? "" : ", ") + more; };
  const auto add_words = [&](const std::vector<Word>& words, const char* what) {
    for (const Word& word : words) add(what + word.shown());
  };
  add_words(group.names, "");
  add_words(group.paths, "path ");
  add_words(group.products, "product ");
  add_words(group.classes, "class ");
  add_words(group.selects, "");
  for (const PropertyWords& property : group.properties) add_words(property.words, (property.name + " ").c_str());
  add_words(group.files, "file ");
  add_words(group.named, "");
  for (const Group& inner : group.any) add(in_short(inner));
  for (const Group& inner : group.except) add("not " + in_short(inner));
  constexpr std::size_t kLongest = 200;
  return fit(printable(text), kLongest);
}

}  // namespace impinge::report
