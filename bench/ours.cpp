// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "bench/ours.hpp"

#include "scenes/shapes.hpp"

namespace impinge::bench {
namespace {

void check_same(const Contacts& plain, const Contacts& quick) {
  if (plain.objects != quick.objects || plain.triangles != quick.triangles || plain.kinds != quick.kinds ||
      plain.hash != quick.hash)
    fail("the paper's way and the fast one do not agree");
}

}  // namespace

std::string_view fast_backend() {
  static const std::string_view name = [] {
    const Mesh any = make_mesh(scenes::cube());
    return collide(any, {}, any, {}, {.threads = 1, .backend = "simd"}) ? "simd" : "auto";
  }();
  return name;
}

Options fast(int threads) { return {.threads = threads, .backend = fast_backend()}; }
Options timed() { return {.threads = 1, .backend = fast_backend(), .statistics = true}; }
Options paper_way(int threads) { return {.threads = threads, .backend = "paper", .statistics = true}; }

std::vector<TrianglePair> exact_answer(const Mesh& a, const Pose& pose_a, const Mesh& b, const Pose& pose_b) {
  Contacts plain = must(collide(a, pose_a, b, pose_b, paper_way()));
  check_same(plain, must(collide(a, pose_a, b, pose_b, fast())));
  return std::move(plain.triangles);
}

Contacts exact_answer(const Scene& scene) {
  Contacts plain = must(scene.collide(paper_way()));
  check_same(plain, must(scene.collide(fast())));
  return plain;
}

std::vector<std::vector<TrianglePair>> exact_answers(const Mesh& mesh, const std::vector<scenes::PosePair>& poses) {
  std::vector<std::vector<TrianglePair>> answers;
  for (const auto& [a, b] : poses) answers.push_back(exact_answer(mesh, a, mesh, b));
  return answers;
}

std::vector<std::array<std::uint32_t, 4>> flat(const Contacts& contacts) {
  std::vector<std::array<std::uint32_t, 4>> result;
  for (std::size_t row = 0; row < contacts.objects.size(); ++row)
    for (std::size_t i = contacts.offsets[row]; i < contacts.offsets[row + 1]; ++i)
      result.push_back(
          {contacts.objects[row][0], contacts.objects[row][1], contacts.triangles[i].a, contacts.triangles[i].b});
  return result;
}

}  // namespace impinge::bench
