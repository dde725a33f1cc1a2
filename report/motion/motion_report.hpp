// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "report/assembly.hpp"
#include "report/drawn_scene.hpp"
#include "report/motion/left_out.hpp"
#include "report/motion/mover.hpp"
#include "report/sink.hpp"

namespace impinge::report {

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
Result<void> write_motion_json(Sink& sink, const MotionReport& report, const MotionOptions& options);

/// The part of a page that its timeline plays (page/README.md): the same spans, and where each part that moves is at
/// each frame. Errors: as `Mover::at`.
Result<void> write_motion_block(Sink& sink, const MotionReport& report, const DrawnScene& scene,
                                const MotionOptions& options);

}  // namespace impinge::report
