// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "impinge/clash.hpp"
#include "report/motion/mover.hpp"
#include "report/review.hpp"

/// When parts that move clash.
namespace impinge::report {

/// A time between two at which the parts were looked at: before it they were on one side, after it on the other.
struct Moment {
  double lo = 0, hi = 0;  ///< seconds
};

/// How long two parts clash without a break that was seen.
struct ClashSpan {
  std::array<std::uint32_t, 2> objects{};
  std::optional<Moment> from, to;             ///< nothing: from the first frame, to the last
  Verdict worst = Verdict::apart;             ///< of the frames
  int inner = -1;                             ///< then, as `Clash::inner`
  double worst_at = 0;                        ///< seconds: of the first such frame; the deepest if depths are measured
  std::optional<OverlapDepth> overlap_depth;  ///< then
  Note note = Note::none;                     ///< then; but that the tolerance was not applied, of any frame
};

struct TimelineOptions {
  std::uint32_t frames = 120;  ///< steps of equal length from 0 to the animation's end; at least 1
  std::optional<double> tolerance;
  bool depth = false;
  FailOn fail_on;  ///< which verdicts are a clash; `clearance` is none of them
  int threads = 0;
  Progress* progress = nullptr;  ///< counts frames
  std::stop_token stop{};
};

struct Timeline {
  std::vector<double> times;     ///< of the frames
  std::vector<ClashSpan> spans;  ///< by (object, object, from)
};

/// Looks at every frame for pairs that clash, and halves the time between two frames of which one clashes and one does
/// not, down to a millionth of a frame's step. A clash that begins and ends between two frames is not seen. Errors:
/// as `Mover::at` and `find_clashes`.
/// `scene_of` makes a scene of the parts as they stand, with what is to be left out.
Result<Timeline> find_timeline(const Mover& mover,
                               const std::function<Result<Scene>(const std::vector<Posed>&)>& scene_of,
                               const TimelineOptions& options);

}  // namespace impinge::report
