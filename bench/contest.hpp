// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bench/support.hpp"
#include "impinge/contacts.hpp"

/// Libraries that are asked the same questions, in turns.
namespace impinge::bench {

struct Contestant {
  std::string name;
  std::function<void(std::size_t)> ask;                ///< answers a question, counted from 0: what is timed
  std::function<std::vector<TrianglePair>()> pairs{};  ///< the answer to the last question, sorted
  bool waits = false;                                  ///< for a device: timed by wall clock
};

/// How often everything is repeated: until the time is used up, but within these bounds.
struct Effort {
  int least, most;
  double seconds;
};

/// A contestant's figures, a repeat each: the mean time of a question, and how many times the first contestant's it is.
struct Times {
  std::vector<double> seconds, ratio;
};

/// Each contestant answers all questions in a row, then the next one does; who begins changes with each repeat. What is
/// quick answers them several times in a repeat, so that the clock's own time does not show. A first round is not
/// counted. Processor time of the calling thread; wall clock for a contestant that waits.
std::vector<Times> contest(std::span<const Contestant> contestants, std::size_t questions, const Effort& effort);

/// How far an answer is from the exact one.
struct Disagreement {
  std::uint64_t missed = 0, added = 0;
  std::uint64_t wrong_answers = 0;  ///< questions where something touches and nothing was found, or the other way round

  Disagreement& operator+=(const Disagreement& other);
};
Disagreement compare(std::span<const TrianglePair> exact, std::span<const TrianglePair> found);
/// (object, object, triangle, triangle), for scenes; both sorted.
using SceneContact = std::array<std::uint32_t, 4>;
Disagreement compare(std::span<const SceneContact> exact, std::span<const SceneContact> found);
/// Each question once, not timed. Ends the program if it is impinge that is wrong.
Disagreement compare(const Contestant& contestant, std::span<const std::vector<TrianglePair>> exact);

/// Tables of libraries, a row each: what the table is about, then the figures.
class ContestTable {
 public:
  explicit ContestTable(std::vector<std::string> columns);
  /// Holds the contest and adds its rows. `exact` has the answer to each question.
  void add(const std::vector<std::string>& cells, std::span<const Contestant> contestants,
           std::span<const std::vector<TrianglePair>> exact, const Effort& effort);
  void write(const std::filesystem::path& folder, const std::string& name) const { table_.write(folder, name); }

 private:
  Table table_;
};

}  // namespace impinge::bench
