// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "impinge/impacts.hpp"
#include "impinge/report.hpp"
#include "report/assembly.hpp"
#include "report/sink.hpp"

/// What meets between the states of parts that files hold one after the other (docs/motion.md).
namespace impinge::report {

struct ImpactOptions {
  std::vector<std::string> files;  ///< the states in order of time, two or more: all with the same parts and triangles
  bool self = false;               ///< test each part against itself, too
  bool earliest = false;           ///< only the first impact of all
  Length separation = 0;           ///< what comes within it meets: certified, not exact as at 0
  std::uint64_t limit = std::numeric_limits<std::uint64_t>::max();  ///< keep the first so many, in order
  std::optional<double> unit_in_metres{};                           ///< as `SceneOptions::unit_in_metres`
  std::uint64_t max_file_bytes = 2'000'000'000;                     ///< larger files are refused unread
  int threads = 0;                                                  ///< at most so many; 0: all there are
  Progress* progress = nullptr;                                     ///< counts steps from one state to the next
  std::stop_token stop{};
};

/// A time of a sequence: in the step from state `frame`, numbered from 0, to the next one.
struct SequenceTime {
  std::uint32_t frame = 0;
  Interval toi;  ///< of that step, which goes from 0 to 1
};

struct SequenceImpact {
  std::uint32_t frame = 0;
  std::array<std::uint32_t, 2> objects{};  ///< the lower one first; the same where a part meets itself
  Impact impact;
};

struct ImpactSequence {
  Assembly assembly;                    ///< of the first state
  double separation = 0;                ///< in its unit
  std::vector<SequenceImpact> impacts;  ///< by frame, objects, feature, a, b
  std::optional<SequenceTime> earliest;
  bool truncated = false;
};

/// Reads the states one after the other, and keeps two of them, and the first, in memory. Errors: those of reading and
/// of `Scene::find_impacts`; `bad_file` (a state with other parts or triangles than the one before: the sentence names
/// both files; or with another unit); `bad_option` (one part alone, which nothing but itself can meet, without `self`).
Result<ImpactSequence> find_impact_sequence(const ImpactOptions& options);

/// The JSON and the table of `impinge impacts` (docs/cli.md). Errors: `cancelled`. Write errors stay in the sink.
Result<void> write_impacts_json(Sink& sink, const ImpactSequence& sequence, const ImpactOptions& options);
Result<void> write_impacts_csv(Sink& sink, const ImpactSequence& sequence, const ImpactOptions& options);

}  // namespace impinge::report
