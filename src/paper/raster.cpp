// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "paper/raster.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/vec3.hpp"
#include "gpu/probe.hpp"
#include "shaders/raster.frag.h"
#include "shaders/raster_probe.frag.h"

namespace impinge::paper {
using namespace gpu;  // buffers, images, drawings and the layouts that are shared with shaders
namespace {

static_assert(static_cast<uint>(Verdict::no) == kTestApart && static_cast<uint>(Verdict::unsure) == kTestUnsure &&
              static_cast<uint>(Verdict::crossing) == kTestCrossing);

constexpr std::uint32_t kPlaces = kRasterWidth * kRasterHeight;
constexpr std::uint32_t kTexelsPerTest = 2;

/// Two texels of the edge texture: the ends, and how far off each is.
struct EdgeTexels {
  float from[3], from_error;
  float to[3], to_error;
};
static_assert(sizeof(EdgeTexels) == std::size_t{kTexelsPerTest} * Image::kTexelBytes);

double largest(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// Returns how far off the floats are. The offset is a difference, rounded once: by 2^-53 of itself, then to float by
/// 2^-24, or it is taken for zero below 2^-126. The rest of the factor is room for the rounding of the largest and of
/// the bound.
float write_scaled(const Vec3& offset, double scale, float to[3]) {
  to[0] = static_cast<float>(offset.x * scale);
  to[1] = static_cast<float>(offset.y * scale);
  to[2] = static_cast<float>(offset.z * scale);
  return static_cast<float>(largest(offset) * scale) * 0x1.01p-24f + 0x1p-120f;
}

}  // namespace

OcclusionQuery::OcclusionQuery(Device& device) : device_(device) {
  const VkQueryPoolCreateInfo info{
      .sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO, .queryType = VK_QUERY_TYPE_OCCLUSION, .queryCount = 1};
  check(vkCreateQueryPool(device.handle(), &info, nullptr, &pool_), "making an occlusion query");
}

OcclusionQuery::~OcclusionQuery() { vkDestroyQueryPool(device_.handle(), pool_, nullptr); }

bool OcclusionQuery::has_seen_any() const {
  std::uint64_t samples = 0;
  check(vkGetQueryPoolResults(device_.handle(), pool_, 0, 1, sizeof samples, &samples, sizeof samples,
                              VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
        "reading an occlusion query");
  return samples != 0;
}

RasterBackend::RasterBackend(const Drawing& drawing)
    : drawing_(drawing),
      edges_(drawing.device(), kTexelsPerTest * kRasterWidth, kRasterHeight),
      edge_upload_(drawing.device(), kPlaces * sizeof(EdgeTexels), Buffer::Use::upload),
      run_upload_(drawing.device(), kPlaces * sizeof(RasterRun), Buffer::Use::upload),
      runs_(drawing.device(), kPlaces * sizeof(RasterRun), Buffer::Use::device),
      found_(drawing.device(), kPlaces * sizeof(uint), Buffer::Use::device),
      readback_(drawing.device(), kPlaces * sizeof(uint), Buffer::Use::readback),
      query_(drawing.device()),
      bindings_(drawing, edges_, runs_, found_),
      commands_(drawing.device()) {}

void RasterBackend::submit(const Batch& batch) {
  batch_ = &batch;
  verdicts_.clear();
  if (!batch.tests.empty()) start_image();
}

std::span<const Verdict> RasterBackend::wait() {
  while (verdicts_.size() < batch_->tests.size()) {
    collect_image();
    if (verdicts_.size() < batch_->tests.size()) start_image();
  }
  return verdicts_;
}

void RasterBackend::start_image() {
  const std::size_t begin = verdicts_.size(), end = std::min<std::size_t>(begin + kPlaces, batch_->tests.size());
  places_ = static_cast<std::uint32_t>(end - begin);
  const std::uint32_t runs = lay_out(begin, end);
  commands_.start([&](VkCommandBuffer commands) {
    edges_.fill(commands, edge_upload_, (places_ + kRasterWidth - 1) / kRasterWidth);
    copy(commands, run_upload_, 0, runs_, 0, runs * sizeof(RasterRun));
    vkCmdFillBuffer(commands, found_.handle(), 0, places_ * sizeof(uint), kTestUnsure);
    barrier(commands);
    drawing_.draw(commands, bindings_.set(), runs, asks_first_ ? query_.handle() : VK_NULL_HANDLE);
    if (!asks_first_) read_back(commands);
  });
}

/// Tests in their order, a place each: a row's end and a change of triangle end a run. Each run is seen from its
/// triangle's first corner, scaled by a power of two so that no coordinate is above 1. World coordinates are below
/// 2^300 and multiples of 2^-358 (contract 1.3), so are their rounded differences but for a factor of 2, and no
/// scaling of those leaves the range of doubles.
std::uint32_t RasterBackend::lay_out(std::size_t begin, std::size_t end) {
  const Batch& batch = *batch_;
  auto* const texels = edge_upload_.mapped<EdgeTexels>();
  auto* const runs = run_upload_.mapped<RasterRun>();
  std::uint32_t count = 0;
  for (std::size_t i = begin, next = begin; i < end; i = next) {
    const std::size_t row_end = std::min(end, begin + ((i - begin) / kRasterWidth + 1) * kRasterWidth);
    const std::uint32_t triangle = batch.tests[i].triangle;
    const Triangle t = batch.triangle(triangle);
    const Vec3 a = t[1] - t[0], b = t[2] - t[0];
    const auto end_of = [&](std::size_t test, int side) {
      return batch.vertices[batch.edges[batch.tests[test].edge][side]] - t[0];
    };
    double reach = std::max(largest(a), largest(b));
    for (; next < row_end && batch.tests[next].triangle == triangle; ++next)
      reach = std::max({reach, largest(end_of(next, 0)), largest(end_of(next, 1))});
    int exponent = 0;
    std::frexp(reach, &exponent);
    const double scale = std::ldexp(1.0, -exponent);

    RasterRun run{.first = static_cast<uint>(i - begin), .count = static_cast<uint>(next - i)};
    const float error_a = write_scaled(a, scale, run.a), error_b = write_scaled(b, scale, run.b);
    run.error = std::max(error_a, error_b);
    runs[count++] = run;
    for (std::size_t test = i; test < next; ++test) {
      EdgeTexels edge;
      edge.from_error = write_scaled(end_of(test, 0), scale, edge.from);
      edge.to_error = write_scaled(end_of(test, 1), scale, edge.to);
      texels[test - begin] = edge;
    }
  }
  return count;
}

void RasterBackend::read_back(VkCommandBuffer commands) {
  barrier(commands);
  copy(commands, found_, 0, readback_, 0, places_ * sizeof(uint));
  hand_to_host(commands);
}

void RasterBackend::collect_image() {
  commands_.wait();
  if (asks_first_) {
    if (!query_.has_seen_any()) {
      verdicts_.resize(verdicts_.size() + places_, Verdict::no);
      return;
    }
    commands_.start([&](VkCommandBuffer commands) { read_back(commands); });
    commands_.wait();
  }
  const uint* const found = readback_.mapped<const uint>();
  for (std::uint32_t i = 0; i < places_; ++i)
    verdicts_.push_back(found[i] <= kTestCrossing ? static_cast<Verdict>(found[i]) : Verdict::unsure);
}

std::unique_ptr<Drawing> make_raster_drawing(Device& device) {
  return std::make_unique<Drawing>(device, shader_raster_frag, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE);
}

namespace {

/// The trials of `probe`, again and again until they fill an image, under quads of all lengths.
std::string probe_arithmetic(Device& device) {
  const std::vector<ProbeCase> trials = probe_cases();
  std::vector<ProbeCase> cases(kPlaces);
  for (std::size_t i = 0; i < cases.size(); ++i) cases[i] = trials[i % trials.size()];
  std::vector<RasterRun> runs;
  for (std::uint32_t place = 0, length = 1; place < kPlaces; place += runs.back().count, length = length % 67 + 1)
    runs.push_back({.first = place, .count = std::min(length, kRasterWidth - place % kRasterWidth)});

  const std::uint64_t case_bytes = cases.size() * sizeof(ProbeCase), run_bytes = runs.size() * sizeof(RasterRun);
  const std::uint64_t answer_bytes = cases.size() * sizeof(ProbeAnswer);
  const Buffer case_upload(device, case_bytes, Buffer::Use::upload), run_upload(device, run_bytes, Buffer::Use::upload);
  const Buffer input(device, case_bytes, Buffer::Use::device), quads(device, run_bytes, Buffer::Use::device);
  const Buffer answers(device, answer_bytes, Buffer::Use::device),
      readback(device, answer_bytes, Buffer::Use::readback);
  std::memcpy(case_upload.mapped<char>(), cases.data(), case_bytes);
  std::memcpy(run_upload.mapped<char>(), runs.data(), run_bytes);
  const Drawing drawing(device, shader_raster_probe_frag, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
  const DrawingBindings bindings(drawing, input, quads, answers);
  Commands commands(device);
  commands.start([&](VkCommandBuffer buffer) {
    copy(buffer, case_upload, 0, input, 0, case_bytes);
    copy(buffer, run_upload, 0, quads, 0, run_bytes);
    vkCmdFillBuffer(buffer, answers.handle(), 0, answer_bytes, 0xFFFFFFFF);  // no number: a wrong answer
    barrier(buffer);
    drawing.draw(buffer, bindings.set(), static_cast<std::uint32_t>(runs.size()), VK_NULL_HANDLE);
    barrier(buffer);
    copy(buffer, answers, 0, readback, 0, answer_bytes);
    hand_to_host(buffer);
  });
  commands.wait();
  const std::string wrong = judge(cases, {readback.mapped<const ProbeAnswer>(), cases.size()});
  return wrong.empty() ? "" : "in fragments " + wrong;
}

/// One edge of many pierces the triangle, the first, one in the midst, the last, or none.
std::string probe_query(const Drawing& drawing) {
  constexpr std::size_t kTests = 3000;
  Batch batch;
  batch.vertices = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}, {1, 1, 2}};
  batch.triangles = {{0, 1, 2}};
  batch.edges = {{4, 5}, {3, 4}};
  RasterBackend backend(drawing);
  backend.ask_first(true);
  for (const std::size_t at : {std::size_t{0}, kTests / 2, kTests - 1, kTests}) {
    batch.tests.assign(kTests, {.edge = 0, .triangle = 0});
    if (at < kTests) batch.tests[at].edge = 1;
    backend.submit(batch);
    const std::span<const Verdict> found = backend.wait();
    for (std::size_t i = 0; i < kTests; ++i)
      if (found[i] != (i == at ? Verdict::crossing : Verdict::no)) return "it does not draw what it is told to";
  }
  return {};
}

}  // namespace

std::string probe_fragments(const Drawing& drawing) {
  std::string wrong = probe_arithmetic(drawing.device());
  if (wrong.empty()) wrong = probe_query(drawing);
  return wrong;
}

}  // namespace impinge::paper
