// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <stop_token>
#include <string_view>

namespace impinge {

/// How two closed triangles meet.
enum class Kind : std::uint8_t {
  crossing,  ///< both proper, planes differ, relative interiors meet
  touching,  ///< all that is neither `crossing` nor `coplanar`; degenerate triangles always touch
  coplanar,  ///< both proper, in one plane, sharing a point
};

/// Which vertices of one mesh are the same, for self-collision and for impacts of a mesh with itself.
enum class Adjacency : std::uint8_t {
  by_position,  ///< those of equal world coordinates, at both ends of a motion: as STL has them, whose triangles share
                ///< no index
  by_index,     ///< those of one index: seams whose sides lie on each other touch
};

/// Bits of `Options::kinds`.
inline constexpr std::uint8_t kCrossing = 1 << static_cast<int>(Kind::crossing);
inline constexpr std::uint8_t kTouching = 1 << static_cast<int>(Kind::touching);
inline constexpr std::uint8_t kCoplanar = 1 << static_cast<int>(Kind::coplanar);
inline constexpr std::uint8_t kAllKinds = kCrossing | kTouching | kCoplanar;

/// Work done so far, for a progress display: read it from another thread while a query runs.
struct Progress {
  std::atomic<std::uint64_t> done{0};   ///< object pairs finished
  std::atomic<std::uint64_t> total{0};  ///< object pairs in all; 0 until the broad phase has counted them
};

/// What a query looks for, and how. Nothing here but `find`, `limit`, `kinds` and `adjacency` changes the answer;
/// `stop` ends it with the error `cancelled`.
struct Options {
  enum class Find : std::uint8_t {
    all,    ///< every pair of triangles that touch
    first,  ///< for each pair of objects, whether they touch, and one witness of a wanted kind; no hash
  };
  Find find = Find::all;
  std::uint64_t limit = std::numeric_limits<std::uint64_t>::max();  ///< keep the first so many in canonical order
  std::uint8_t kinds = kAllKinds;                                   ///< the kinds wanted, or-ed
  int threads = 0;  ///< at most so many; 0: as many as oneTBB offers, a machine's all by default
  /// What does the work; the answer is the same.
  ///   "auto"    "simd"; "hybrid" for large queries, once a program has spent half a second on others (what one thread
  ///             begins of a lone pair does not count) or if one is huge, where a device is there that is no program on
  ///             the CPU and IMPINGE_DEVICE is not "none"
  ///   "simd"    the CPU, many at a time
  ///   "paper"   the CPU, one thing at a time: the paper's method from its sorted borders to its grid, and the
  ///             reference that the others are held against; "scalar" is another name of it
  ///   "gpu"     a device that Vulkan knows of (devices.hpp); what it cannot do is left to the CPU, with a warning
  ///   "raster"  the paper's image space: as "paper", with the tests of edges and triangles drawn by a device's
  ///             rasterizer
  ///   "hybrid"  the CPU, a device, or both so that they end at once: whichever took least in earlier queries alike
  std::string_view backend = "auto";
  /// Which device: its number in `devices()`, or part of its name. Empty: what the environment's IMPINGE_DEVICE says
  /// (the same, or "none"), or else the first that can be used. Error: `no_device` if there are devices, but none of
  /// that name.
  std::string_view device{};
  /// How much of a query "hybrid" gives to the device: 0 (nothing) to 1. Below 0 it sees for itself: small queries stay
  /// on the CPU, and nothing goes to a device that is a program on the CPU.
  double device_share = -1;
  Adjacency adjacency = Adjacency::by_position;
  bool statistics = false;    ///< read the clock for the times in `Statistics`; its counts are always there
  bool predict_cost = false;  ///< calibrate once, and fill the predicted time; includes `statistics`
  Progress* progress = nullptr;
  std::stop_token stop{};  ///< a device looks at it between submissions alone, one of which may be all of its work
};

}  // namespace impinge
