// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/named_tests/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "report/named_tests/ifc_classes.hpp"
#include "report/text.hpp"
#include "report/units.hpp"

namespace impinge::report {
namespace {

std::uint64_t count(const PartSet& set) { return static_cast<std::uint64_t>(std::count(set.begin(), set.end(), true)); }

/// Objects of one parent, a node of one file that is not its root, have a number in common; 0 has none. Names say
/// nothing: nodes share them, have none, and have a '/' in them.
std::vector<std::uint32_t> parents_of(const Assembly& assembly) {
  std::vector<std::uint32_t> parents;
  parents.reserve(assembly.objects.size());
  for (const io::Object& object : assembly.objects)
    parents.push_back(object.group && assembly.groups[*object.group].parent ? *object.group + 1 : 0);
  return parents;
}

}  // namespace

class Plan::Maker {
 public:
  Maker(const Configuration& configuration, const Assembly& assembly)
      : configuration_(configuration), assembly_(assembly), sets_(configuration, assembly) {
    plan_.files_ = assembly.file_of;
    plan_.parents_ = parents_of(assembly);
  }

  Result<Plan> make() {
    const Terms& all = configuration_.terms;
    if (auto added = add(all.ignore, plan_.ignored_); !added) return added.error();
    for (const NamedTest& test : configuration_.tests) {
      PlannedTest planned;
      planned.name = test.name.text;
      planned.mode = configuration_.mode_of(test);
      planned.tolerance = value_of(test.terms.tolerance.value_or(all.tolerance.value_or(std::nullopt)));
      planned.clearance = configuration_.clearance_of(test);
      if (auto added = add_groups(test, planned); !added) return added.error();
      if (auto added = add_rules(test.terms); !added) return added.error();
      plan_.tests_.push_back(std::move(planned));
    }
    if (auto checked = check_groups(); !checked) return checked.error();
    lay_out_rows();
    plan_.counters_ = std::make_unique<std::atomic<std::uint64_t>[]>(counters_);
    return std::move(plan_);
  }

 private:
  /// A group that nothing uses may be a word that was mistyped elsewhere; what is in it must be right all the same.
  Result<void> check_groups() {
    for (const auto& [name, group] : configuration_.groups) {
      Group all;
      all.named = {{name, group.place}};
      all.place = group.place;
      if (auto set = sets_.of(all); !set) return set.error();
    }
    return {};
  }

  Result<std::uint32_t> add(const Group& group) {
    Result<PartSet> set = sets_.of(group);
    if (!set) return set.error();
    columns_.push_back(*std::move(set));
    return static_cast<std::uint32_t>(columns_.size() - 1);
  }

  /// What is of none of these classes is in no part: a model without doors has no fillings.
  std::uint32_t add_classes(const std::vector<std::string_view>& classes) {
    PartSet set;
    for (const io::Object& object : assembly_.objects)
      set.push_back(std::ranges::any_of(
          classes, [&](std::string_view wanted) { return is_of_ifc_class(class_of(object), wanted); }));
    columns_.push_back(std::move(set));
    return static_cast<std::uint32_t>(columns_.size() - 1);
  }

  /// `b` may be null: the group against itself.
  Result<SetPair> add(const Group& a, const Group* b) {
    const Result<std::uint32_t> first = add(a);
    if (!first) return first.error();
    const Result<std::uint32_t> second = b == nullptr ? first : add(*b);
    if (!second) return second.error();
    if (count(columns_[*first]) == 1 && columns_[*first] == columns_[*second])
      return configuration_.error_at(a.place, "only one part is named here, and no part is tested against itself");
    return SetPair{*first, *second};
  }

  Result<void> add(const std::vector<GroupPair>& pairs, std::vector<SetPair>& to) {
    for (const auto& [a, b] : pairs) {
      const Result<SetPair> pair = add(a, &b);
      if (!pair) return pair.error();
      to.push_back(*pair);
    }
    return {};
  }

  Result<void> add(const IgnoreRules& rules, std::vector<SetPair>& to) {
    for (const Group& group : rules.within) {
      const Result<SetPair> pair = add(group, nullptr);
      if (!pair) return pair.error();
      to.push_back(*pair);
    }
    return add(rules.pairs, to);
  }

  Result<void> add_groups(const NamedTest& test, PlannedTest& planned) {
    const Result<SetPair> groups = add(test.a, test.b ? &*test.b : nullptr);
    if (!groups) return groups.error();
    plan_.groups_.push_back(*groups);
    planned.a = in_short(test.a);
    if (test.b) planned.b = in_short(*test.b);
    planned.parts_a = count(columns_[groups->a]);
    planned.parts_b = count(columns_[groups->b]);
    return {};
  }

  Result<void> add_rules(const Terms& terms) {
    const Terms& all = configuration_.terms;
    Rules& rules = plan_.rules_.emplace_back();
    rules.same_file = terms.ignore.same_file.value_or(all.ignore.same_file.value_or(false));
    rules.same_parent = terms.ignore.same_parent.value_or(all.ignore.same_parent.value_or(false));
    if (auto added = add(terms.ignore, rules.ignored); !added) return added;
    std::set<const DesignRule*> by_design(all.ignore.by_design.begin(), all.ignore.by_design.end());
    by_design.insert(terms.ignore.by_design.begin(), terms.ignore.by_design.end());
    for (const DesignRule* const rule : by_design)
      rules.by_design.push_back({rule->name, {add_classes(rule->a), add_classes(rule->b)}, counters_++});
    const std::optional<MayTouch>& touch = terms.may_touch ? terms.may_touch : all.may_touch;
    if (!touch) return {};
    rules.may_touch_all = touch->all;
    return add(touch->pairs, rules.may_touch);
  }

  void lay_out_rows() {
    plan_.row_words_ = columns_.size() / 64 + 1;
    plan_.rows_.resize(plan_.files_.size() * plan_.row_words_);
    for (std::size_t column = 0; column < columns_.size(); ++column)
      for (std::size_t object = 0; object < plan_.files_.size(); ++object)
        if (columns_[column][object])
          plan_.rows_[object * plan_.row_words_ + column / 64] |= std::uint64_t{1} << (column % 64);
  }

  const Configuration& configuration_;
  const Assembly& assembly_;
  PartSets sets_;
  std::vector<PartSet> columns_;
  std::size_t counters_ = 0;
  Plan plan_;
};

Result<Plan> Plan::make(const Configuration& configuration, const Assembly& assembly) {
  return Maker(configuration, assembly).make();
}

bool Plan::is_in_any(const std::vector<SetPair>& pairs, std::uint32_t a, std::uint32_t b) const {
  return std::any_of(pairs.begin(), pairs.end(), [&](const SetPair& pair) { return is_between(pair, a, b); });
}

void Plan::terms(std::uint32_t a, std::uint32_t b, std::vector<ClashTerms>& to) const {
  if (is_in_any(ignored_, a, b)) return;
  for (std::uint32_t i = 0; i < tests_.size(); ++i) {
    const Rules& rules = rules_[i];
    if (!is_between(groups_[i], a, b) || (rules.same_file && files_[a] == files_[b]) ||
        (rules.same_parent && parents_[a] != 0 && parents_[a] == parents_[b]) || is_in_any(rules.ignored, a, b))
      continue;
    const auto rule =
        std::ranges::find_if(rules.by_design, [&](const ByDesign& each) { return is_between(each.sets, a, b); });
    if (rule != rules.by_design.end()) {
      counters_[rule->counter].fetch_add(1, std::memory_order_relaxed);
      continue;
    }
    const Mode mode = tests_[i].mode;
    to.push_back({tests_[i].tolerance, tests_[i].clearance,
                  mode == Mode::penetration ? Verdict::crossing
                  : mode == Mode::contact   ? Verdict::touching
                                            : Verdict::apart,
                  i});
  }
}

std::vector<std::pair<std::string_view, std::uint64_t>> Plan::left_out(std::uint32_t test) const {
  std::vector<std::pair<std::string_view, std::uint64_t>> counts;
  for (const ByDesign& rule : rules_[test].by_design) counts.emplace_back(rule.name, counters_[rule.counter]);
  return counts;
}

double Plan::largest_distance() const {
  double most = 0;
  for (const PlannedTest& test : tests_) most = std::max({most, test.clearance, test.tolerance.value_or(0)});
  return most;
}

bool Plan::names(std::uint32_t a, std::uint32_t b, std::uint32_t test, Verdict verdict) const {
  if (verdict <= Verdict::crossing) return true;
  if (tests_[test].mode == Mode::penetration) return false;
  if (verdict == Verdict::apart && tests_[test].mode != Mode::clearance) return false;
  return !rules_[test].may_touch_all && !is_in_any(rules_[test].may_touch, a, b);
}

}  // namespace impinge::report
