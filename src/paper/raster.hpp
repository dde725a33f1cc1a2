// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "gpu/drawing.hpp"
#include "paper/backend.hpp"

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

/// The paper's image space (section 3.4): the batch's tests are the texels of an image, edges lie in a texture, a
/// triangle is a quad over the texels of the edges that it is tested against, and fragments are the tests. Every call
/// may throw a gpu::Failure; after one it is of no more use.
class RasterBackend final : public Backend {
 public:
  explicit RasterBackend(const gpu::Drawing& drawing);

  /// From now on an occlusion query tells first whether anything is left of an image; where nothing is, no verdict is
  /// read. The verdicts are the same.
  void ask_first(bool does) { asks_first_ = does; }

  void submit(const Batch& batch) override;
  std::span<const Verdict> wait() override;

 private:
  void start_image();
  std::uint32_t lay_out(std::size_t begin, std::size_t end);
  void collect_image();
  void read_back(VkCommandBuffer commands);

  const gpu::Drawing& drawing_;
  gpu::Image edges_;
  gpu::Buffer edge_upload_, run_upload_, runs_, found_, readback_;
  OcclusionQuery query_;
  gpu::DrawingBindings bindings_;
  gpu::Commands commands_;  // the last, so that it ends before the others go
  bool asks_first_ = false;
  const Batch* batch_ = nullptr;
  std::uint32_t places_ = 0;  ///< taken in the image at work
  std::vector<Verdict> verdicts_;
};

/// The tests' shader.
std::unique_ptr<gpu::Drawing> make_raster_drawing(gpu::Device& device);

/// What is wrong with the device's fragments, as a sentence without its full stop; empty if their arithmetic is as
/// `probe` asks for, each texel of an image gets the fragment of its own quad, and an occlusion query sees what is
/// left.
std::string probe_fragments(const gpu::Drawing& drawing);

}  // namespace impinge::paper
