// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "paper/raster.hpp"

#include <algorithm>
#include <cassert>
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

constexpr std::uint32_t kPlaces = kRasterWidth * kRasterHeight, kNoPlace = ~0u;
constexpr std::uint32_t kTexelsPerEdge = 2;
constexpr std::uint32_t kTestsPerFrame = kPlaces;
static_assert(3 * 256 <= kRasterWidth);  // a leaf has up to 256 triangles (TreeConfig), and lies in one row

double largest(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }
int exponent_of(double reach) {
  int exponent = 0;
  std::frexp(reach, &exponent);
  return std::max(exponent, -1000);
}

/// Writes an offset in another unit; returns a bound of each coordinate's error. The offset is a difference, rounded
/// once: by 2^-53 of itself, then to float by 2^-24, or it is taken for zero below 2^-126. The rest of the factor is
/// room for the rounding of the largest and of the bound.
float write_scaled(const Vec3& offset, double scale, float to[3]) {
  to[0] = static_cast<float>(offset.x * scale);
  to[1] = static_cast<float>(offset.y * scale);
  to[2] = static_cast<float>(offset.z * scale);
  return static_cast<float>(largest(offset) * scale) * 0x1.01p-24f + 0x1p-120f;
}

double seconds_since(std::chrono::steady_clock::time_point then) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - then).count();
}

/// Two texels of the edge texture: the ends, and how far off each is.
struct EdgeTexels {
  float from[3], from_error;
  float to[3], to_error;
};
static_assert(sizeof(EdgeTexels) == std::size_t{kTexelsPerEdge} * Image::kTexelBytes);

/// The origin of a leaf's edges: where the first of them begins.
const Vec3& origin_of(const Batch& batch, std::uint32_t first_edge) {
  return batch.vertices[batch.edges[first_edge][0]];
}

/// A leaf's edges, scaled so that no coordinate is above 1, by 2^-e; returns e. World coordinates are below 2^300
/// (contract 1.3), and e is at least -1000, so that the scale is finite. What is smaller is written as less than 1,
/// with the same error.
int write_edges(const Batch& batch, std::uint32_t first, std::size_t end, EdgeTexels* to) {
  const Vec3& origin = origin_of(batch, first);
  const auto end_of = [&](std::size_t edge, int side) { return batch.vertices[batch.edges[edge][side]] - origin; };
  double reach = 0;
  for (std::size_t edge = first; edge < end; ++edge)
    reach = std::max({reach, largest(end_of(edge, 0)), largest(end_of(edge, 1))});
  const int exponent = exponent_of(reach);
  const double scale = std::ldexp(1.0, -exponent);
  for (std::size_t edge = first; edge < end; ++edge, ++to) {
    EdgeTexels texels;  // written as a whole, for the memory may not be cached
    texels.from_error = write_scaled(end_of(edge, 0), scale, texels.from);
    texels.to_error = write_scaled(end_of(edge, 1), scale, texels.to);
    *to = texels;
  }
  return exponent;
}

/// Scaled so that no coordinate is above 1/2, nor one of the leaf's edges, whose scale was 2^-exponent: then none is
/// above 1 as seen from the triangle's corner.
RasterRun triangle_as_seen(const Batch& batch, std::uint32_t triangle, std::uint32_t first_edge, int exponent) {
  const Triangle t = batch.triangle(triangle);
  const Vec3 corner = t[0] - origin_of(batch, first_edge), a = t[1] - t[0], b = t[2] - t[0];
  const int common = std::max(exponent, exponent_of(std::max({largest(corner), largest(a), largest(b)}))) + 1;
  const double scale = std::ldexp(1.0, -common);
  RasterRun run{.scale = static_cast<float>(std::ldexp(1.0, exponent - common))};
  run.error =
      std::max({write_scaled(corner, scale, run.corner), write_scaled(a, scale, run.a), write_scaled(b, scale, run.b)});
  return run;
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

RasterBackend::Frame::Frame(const Drawing& drawing)
    : edges(drawing.device(), kTexelsPerEdge * kRasterWidth, kRasterHeight),
      edge_upload(drawing.device(), kPlaces * sizeof(EdgeTexels), Buffer::Use::upload),
      run_upload(drawing.device(), kTestsPerFrame * sizeof(RasterRun), Buffer::Use::upload),
      runs(drawing.device(), kTestsPerFrame * sizeof(RasterRun), Buffer::Use::device),
      found(drawing.device(), kTestsPerFrame * sizeof(uint), Buffer::Use::device),
      readback(drawing.device(), kTestsPerFrame * sizeof(uint), Buffer::Use::readback),
      query(drawing.device()),
      bindings(drawing, edges, runs, found),
      commands(drawing.device()) {}

RasterBackend::RasterBackend(const Drawing& drawing)
    : drawing_(drawing), frames_{Frame(drawing), Frame(drawing), Frame(drawing)} {}

void RasterBackend::submit(const Batch& batch) {
  UnderWay& work = under_way_[submitted_++ % under_way_.size()];
  work.batch = &batch, work.drawn = 0;
  work.verdicts.clear();
  while (work.drawn < batch.tests.size()) {
    if (started_ - collected_ == frames_.size()) collect_frame();
    start_frame(work);
  }
}

std::span<const Verdict> RasterBackend::wait() {
  const UnderWay& work = under_way_[returned_++ % under_way_.size()];
  while (work.verdicts.size() < work.batch->tests.size()) collect_frame();
  return work.verdicts;
}

void RasterBackend::start_frame(UnderWay& work) {
  Frame& frame = frames_[started_ % frames_.size()];
  const Extent used = lay_out(frame, work);
  if (started_ == collected_) busy_since_ = std::chrono::steady_clock::now();
  frame.commands.start([&](VkCommandBuffer commands) {
    frame.edges.fill(commands, frame.edge_upload, used.rows);
    copy(commands, frame.run_upload, 0, frame.runs, 0, used.runs * sizeof(RasterRun));
    vkCmdFillBuffer(commands, frame.found.handle(), 0, frame.tests * sizeof(uint), kTestUnsure);
    barrier(commands);
    drawing_.draw(commands, frame.bindings.set(), used.runs, frame.query.handle());
    barrier(commands);
    copy(commands, frame.found, 0, frame.readback, 0, frame.tests * sizeof(uint));
    hand_to_host(commands);
  });
  ++counts_.images_drawn;
  if (started_++ > collected_) ++counts_.images_overlapped;
}

/// Tests of one triangle with edges that follow one another become a run. A leaf lies in one row, so no run is cut.
RasterBackend::Extent RasterBackend::lay_out(Frame& frame, UnderWay& work) {
  const Batch& batch = *work.batch;
  leaf_places_.assign(batch.leaves.size(), {kNoPlace, 0});
  auto* const texels = frame.edge_upload.mapped<EdgeTexels>();
  auto* const runs = frame.run_upload.mapped<RasterRun>();
  const std::size_t begin = work.drawn, end = std::min<std::size_t>(begin + kTestsPerFrame, batch.tests.size());
  std::uint32_t free_place = 0, count = 0;
  while (work.drawn < end) {
    const ElementTest& first = batch.tests[work.drawn];
    const auto leaf = std::upper_bound(batch.leaves.begin(), batch.leaves.end(), first.edge) - 1;
    const std::size_t leaf_end = leaf + 1 == batch.leaves.end() ? batch.edges.size() : leaf[1];
    LeafPlace& place = leaf_places_[static_cast<std::size_t>(leaf - batch.leaves.begin())];
    if (place.first == kNoPlace) {
      const auto size = static_cast<std::uint32_t>(leaf_end - *leaf);
      assert(size <= kRasterWidth);
      if (free_place % kRasterWidth + size > kRasterWidth) free_place += kRasterWidth - free_place % kRasterWidth;
      if (free_place + size > kPlaces) break;
      place = {free_place, write_edges(batch, *leaf, leaf_end, texels + free_place)};
      free_place += size;
    }
    RasterRun run = triangle_as_seen(batch, first.triangle, *leaf, place.exponent);
    run.first = place.first + first.edge - *leaf;
    run.verdict = static_cast<uint>(work.drawn - begin);
    do {
      ++run.count, ++work.drawn;
    } while (work.drawn < end && batch.tests[work.drawn].triangle == first.triangle &&
             batch.tests[work.drawn].edge == first.edge + run.count && first.edge + run.count < leaf_end);
    runs[count++] = run;
  }
  frame.work = &work;
  frame.tests = static_cast<std::uint32_t>(work.drawn - begin);
  return {count, (free_place + kRasterWidth - 1) / kRasterWidth};
}

void RasterBackend::collect_frame() {
  Frame& frame = frames_[collected_ % frames_.size()];
  const auto before = std::chrono::steady_clock::now();
  frame.commands.wait();
  const bool is_any_left = frame.query.has_seen_any();
  counts_.wait_seconds += seconds_since(before);
  if (++collected_ == started_) counts_.device_seconds += seconds_since(busy_since_);
  std::vector<Verdict>& verdicts = frame.work->verdicts;
  if (!is_any_left) {
    verdicts.resize(verdicts.size() + frame.tests, Verdict::no);
    return;
  }
  ++counts_.images_read;
  const uint* const found = frame.readback.mapped<const uint>();
  for (std::uint32_t i = 0; i < frame.tests; ++i)
    verdicts.push_back(found[i] <= kTestCrossing ? static_cast<Verdict>(found[i]) : Verdict::unsure);
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
  constexpr std::uint32_t kTests = 3000, kLeafSize = 1000;
  Batch batch;
  batch.vertices = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}, {1, 1, 2}};
  batch.triangles = {{0, 1, 2}};
  for (std::uint32_t i = 0; i < kTests; ++i) batch.tests.push_back({.edge = i, .triangle = 0});
  for (std::uint32_t i = 0; i < kTests; i += kLeafSize) batch.leaves.push_back(i);
  RasterBackend backend(drawing);
  for (const std::uint32_t at : {0u, kTests / 2, kTests - 1, kTests}) {
    batch.edges.assign(kTests, {4, 5});
    if (at < kTests) batch.edges[at] = {3, 4};
    backend.submit(batch);
    const std::span<const Verdict> found = backend.wait();
    for (std::uint32_t i = 0; i < kTests; ++i)
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
