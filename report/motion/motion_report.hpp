// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "report/assembly.hpp"
#include "report/drawn_scene.hpp"
#include "report/motion/mover.hpp"
#include "report/sink.hpp"

namespace impinge::report {

/// What an animation does and `motion` does not, in sentences.
struct LeftOut {
  std::vector<std::string> shapes;    ///< of which parts the shape would change: the answer is not of all that moves
  std::vector<std::string> harmless;  ///< what cannot be followed, but moves no part
};

/// Errors: `bad_file`, where it is not known how a part moves, or nothing moves at all: nothing can be said of such a
/// motion. The assembly is of the model.
Result<LeftOut> left_out(const io::Model& model, const io::Animation& animation, const Assembly& assembly);

/// What `motion` found out.
struct MotionReport {
  Assembly assembly;  ///< where its parts stand at rest
  const io::Animation& animation;
  std::size_t animations = 0;  ///< in the file
  const Mover& mover;
  LeftOut left_out;
  Timeline timeline;
};

/// The JSON of `motion` (docs/cli.md).
Result<void> write_motion_json(Sink& sink, const MotionReport& report, const TimelineOptions& options);

/// The part of a page that its timeline plays (page/README.md): the same spans, and where each part that moves is at
/// each frame. Errors: as `Mover::at`.
Result<void> write_motion_block(Sink& sink, const MotionReport& report, const DrawnScene& scene);

}  // namespace impinge::report
