// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "gpu/drawing.hpp"
#include "paper/batch.hpp"

namespace impinge::paper {

/// A pool of one occlusion query.
class OcclusionQuery {
 public:
  explicit OcclusionQuery(gpu::Device& device);
  ~OcclusionQuery();
  OcclusionQuery(const OcclusionQuery&) = delete;
  OcclusionQuery& operator=(const OcclusionQuery&) = delete;

  [[nodiscard]] VkQueryPool handle() const { return pool_; }
  /// Whether anything was seen. The commands that ask it must have been waited for.
  [[nodiscard]] bool has_seen_any() const;

 private:
  gpu::Device& device_;
  VkQueryPool pool_ = VK_NULL_HANDLE;
};

/// What a RasterBackend did since it was asked last.
struct RasterCounts {
  std::uint64_t images_drawn = 0;
  std::uint64_t images_overlapped = 0;  ///< of them, those begun before the caller had waited for an earlier one
  std::uint64_t images_read = 0;        ///< whose occlusion query had seen a test that is not certainly apart
  double device_seconds = 0;  ///< from the first image's start until the last one's end was noticed, by the clock
  double wait_seconds = 0;    ///< of these, while the caller waited for it
};

/// The paper's image space (section 3.4). Each edge of a batch lies once in a texture, leaf by leaf; a triangle is
/// drawn as quads over the edges that it is tested against, and the fragments are the tests. An occlusion query tells
/// whether any test is left, and only then are verdicts read. Each batch is an image, or several if it is large; the
/// device draws while the caller makes the next batches. Every call may throw a gpu::Failure; after one it is of no
/// more use.
class RasterBackend {
 public:
  static constexpr std::size_t kMostBatches = 3;  ///< that may be under way

  explicit RasterBackend(const gpu::Drawing& drawing);

  /// Starts on the batch's tests. The batch stays as it is until `wait` has returned its verdicts. Its leaves have at
  /// most kRasterWidth edges each.
  void submit(const Batch& batch);
  /// A verdict for each test of the batch that was submitted first of those under way. They stay until the next call.
  std::span<const Verdict> wait();
  RasterCounts take_counts() { return std::exchange(counts_, {}); }

 private:
  /// A batch, the verdicts that have arrived so far, and how many of its tests lie in frames.
  struct UnderWay {
    const Batch* batch = nullptr;
    std::vector<Verdict> verdicts;
    std::size_t drawn = 0;
  };
  /// An image and what drawing it needs.
  struct Frame {
    explicit Frame(const gpu::Drawing& drawing);
    gpu::Image edges;
    gpu::Buffer edge_upload, run_upload, runs, found, readback;
    OcclusionQuery query;
    gpu::DrawingBindings bindings;
    UnderWay* work = nullptr;
    std::uint32_t tests = 0;
    gpu::Commands commands;  // the last, so that it ends before the others go
  };
  /// Where a leaf's edges begin in the image that is laid out, and their unit, 2^exponent.
  struct LeafPlace {
    std::uint32_t first;
    int exponent;
  };
  /// What is used of a frame.
  struct Extent {
    std::uint32_t runs, rows;
  };

  void start_frame(UnderWay& work);
  Extent lay_out(Frame& frame, UnderWay& work);
  void collect_frame();

  const gpu::Drawing& drawing_;
  std::array<Frame, kMostBatches> frames_;
  std::uint64_t started_ = 0, collected_ = 0;  ///< frames
  std::array<UnderWay, kMostBatches> under_way_;
  std::uint64_t submitted_ = 0, returned_ = 0;  ///< batches
  std::vector<LeafPlace> leaf_places_;
  RasterCounts counts_;
  std::chrono::steady_clock::time_point busy_since_;
};

/// Compiles the shader of the tests.
std::unique_ptr<gpu::Drawing> make_raster_drawing(gpu::Device& device);

/// What is wrong with the device's fragments, as a sentence without its full stop; empty if their arithmetic is as
/// `probe` asks for, each texel of an image gets the fragment of its own quad, and an occlusion query sees what is
/// left.
std::string probe_fragments(const gpu::Drawing& drawing);

}  // namespace impinge::paper
