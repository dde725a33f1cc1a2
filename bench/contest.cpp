// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "bench/contest.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>

namespace impinge::bench {
namespace {

bool precedes(const TrianglePair& p, const TrianglePair& q) { return std::tie(p.a, p.b) < std::tie(q.a, q.b); }

template <class Contact, class Order>
Disagreement differences(std::span<const Contact> exact, std::span<const Contact> found, Order order) {
  std::vector<Contact> missed, added;
  std::set_difference(exact.begin(), exact.end(), found.begin(), found.end(), std::back_inserter(missed), order);
  std::set_difference(found.begin(), found.end(), exact.begin(), exact.end(), std::back_inserter(added), order);
  return {missed.size(), added.size(), exact.empty() != found.empty() ? 1U : 0U};
}

double seconds_of_rounds(const Contestant& contestant, std::size_t questions, int rounds) {
  const auto work = [&] {
    for (int round = 0; round < rounds; ++round)
      for (std::size_t i = 0; i < questions; ++i) contestant.ask(i);
  };
  return (contestant.waits ? wall_seconds_of(work) : seconds_of(work)) / rounds;
}

std::vector<std::string> with_figures(std::vector<std::string> columns) {
  for (const char* figure : {"library", "questions", "exact_pairs", "ms", "ratio", "ratio_low", "ratio_high", "repeats",
                             "missed", "added", "wrong_answers"})
    columns.emplace_back(figure);
  return columns;
}

}  // namespace

std::vector<Times> contest(std::span<const Contestant> contestants, std::size_t questions, const Effort& effort) {
  constexpr double kLeastSeconds = 0.005;
  constexpr int kMostRounds = 1000;
  const std::size_t n = contestants.size();
  std::vector<int> rounds;
  for (const Contestant& contestant : contestants) {
    const double once = seconds_of_rounds(contestant, questions, 1);
    rounds.push_back(std::clamp(static_cast<int>(std::ceil(kLeastSeconds / once)), 1, kMostRounds));
  }
  std::vector<Times> times(n);
  const double start = thread_seconds();
  for (int repeat = 0; repeat < effort.most; ++repeat) {
    if (repeat >= effort.least && thread_seconds() - start > effort.seconds) break;
    for (std::size_t turn = 0; turn < n; ++turn) {
      const std::size_t c = (turn + static_cast<std::size_t>(repeat)) % n;
      times[c].seconds.push_back(seconds_of_rounds(contestants[c], questions, rounds[c]) /
                                 static_cast<double>(questions));
    }
    for (Times& t : times) t.ratio.push_back(t.seconds.back() / times.front().seconds.back());
  }
  return times;
}

Disagreement& Disagreement::operator+=(const Disagreement& other) {
  missed += other.missed;
  added += other.added;
  wrong_answers += other.wrong_answers;
  return *this;
}

Disagreement compare(std::span<const TrianglePair> exact, std::span<const TrianglePair> found) {
  return differences(exact, found, precedes);
}

Disagreement compare(std::span<const SceneContact> exact, std::span<const SceneContact> found) {
  return differences(exact, found, std::less<SceneContact>());
}

Disagreement compare(const Contestant& contestant, std::span<const std::vector<TrianglePair>> exact) {
  Disagreement sum;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    contestant.ask(i);
    sum += compare(exact[i], contestant.pairs());
  }
  if (contestant.name.starts_with("impinge") && sum.missed + sum.added > 0) fail(contestant.name + " is wrong");
  return sum;
}

ContestTable::ContestTable(std::vector<std::string> columns) : table_(with_figures(std::move(columns))) {}

void ContestTable::add(const std::vector<std::string>& cells, std::span<const Contestant> contestants,
                       std::span<const std::vector<TrianglePair>> exact, const Effort& effort) {
  std::vector<Disagreement> wrong;
  for (const Contestant& contestant : contestants) wrong.push_back(compare(contestant, exact));
  const std::vector<Times> times = contest(contestants, exact.size(), effort);
  std::size_t pairs = 0;
  for (const auto& answer : exact) pairs += answer.size();
  for (std::size_t c = 0; c < contestants.size(); ++c) {
    const Spread ratio = spread(times[c].ratio);
    std::vector<std::string> row = cells;
    for (std::string& figure : std::vector<std::string>{
             contestants[c].name, count(exact.size()), count(pairs), milliseconds(median(times[c].seconds)),
             digits(ratio.median), digits(ratio.low), digits(ratio.high), count(times[c].seconds.size()),
             count(wrong[c].missed), count(wrong[c].added), count(wrong[c].wrong_answers)})
      row.push_back(std::move(figure));
    table_.add(std::move(row));
  }
}

}  // namespace impinge::bench
