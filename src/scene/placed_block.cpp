// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "scene/placed_block.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/pose.hpp"
#include "scene/validate_pose.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "scene/placed_block.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace impinge::scene::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
// No product is fused with a sum: the numbers are the same on every machine, and a pose is valid on all or on none.
template <class Lanes>
HWY_INLINE void compute_by(Lanes d, PlacedLanes& s, std::size_t size) {
  using V = hn::Vec<Lanes>;
  const auto number = [&](double x) HWY_ATTR { return hn::Set(d, x); };
  const V zero = hn::Zero(d), infinite = number(kInfinity);
  for (std::size_t lane = 0; lane < size; lane += hn::Lanes(d)) {
    const auto load = [&](const PlacedLanes::Row& row) HWY_ATTR { return hn::Load(d, row + lane); };
    const auto store = [&](V v, PlacedLanes::Row& row) HWY_ATTR { hn::Store(v, d, row + lane); };
    V R[9], t[3], max_abs[3];
    for (int i = 0; i < 9; ++i) R[i] = load(s.R[i]);
    for (int i = 0; i < 3; ++i) t[i] = load(s.t[i]), max_abs[i] = load(s.max_abs[i]);
    const auto sum = [](V x, V y, V z) HWY_ATTR { return hn::Add(hn::Add(x, y), z); };

    // Contract 1.2. What is no number is not within a bound.
    auto valid = hn::Lt(sum(hn::Abs(t[0]), hn::Abs(t[1]), hn::Abs(t[2])), infinite);
    for (int i = 0; i < 3; ++i) {
      for (int j = i; j < 3; ++j) {
        const V product = sum(hn::Mul(R[i], R[j]), hn::Mul(R[3 + i], R[3 + j]), hn::Mul(R[6 + i], R[6 + j]));
        const V off = hn::Abs(i == j ? hn::Sub(product, number(1)) : product);
        valid = hn::And(valid, hn::Le(off, number(kMostDefect)));
      }
    }
    const auto minor = [&](int i, int j, int k, int l)
                           HWY_ATTR { return hn::Sub(hn::Mul(R[i], R[j]), hn::Mul(R[k], R[l])); };
    const V determinant =
        sum(hn::Mul(R[0], minor(4, 8, 5, 7)), hn::Mul(R[1], minor(5, 6, 3, 8)), hn::Mul(R[2], minor(3, 7, 4, 6)));
    valid = hn::And(valid, hn::Gt(determinant, zero));

    // Whether a glance shows that every world vertex is in the exact domain, as it nearly always does. No entry of a
    // valid R is above 1 + 1e-6, so no world coordinate is above 4 max|x| + |t|. Each product is a multiple of its
    // factors' last places, and so, for sums keep the lowest bit of their terms, is the coordinate. The smaller a
    // number, the lower its last place: that of 2^-306 is 2^-358.
    V most_t = zero;
    V most_x = hn::Max(max_abs[0], hn::Max(max_abs[1], max_abs[2]));
    auto clear = hn::Lt(hn::Mul(number(4), most_x), number(0x1p298));
    const auto is_coarse = [&](V x, V least) HWY_ATTR { return hn::Or(hn::Ge(hn::Abs(x), least), hn::Eq(x, zero)); };
    const V least_entry = load(s.least_entry);
    for (const V& r : R) clear = hn::And(clear, is_coarse(r, least_entry));
    for (const V& x : t) clear = hn::And(clear, is_coarse(x, number(0x1p-306))), most_t = hn::Max(most_t, hn::Abs(x));
    clear = hn::And(clear, hn::Lt(most_t, number(0x1p298)));

    // At least `rounding_radius` in every axis, as no |r| is above 1.001; it covers the world vertices' rounding and,
    // with 12 u S to spare, that of the lines below.
    const V size_of_terms = hn::Add(hn::Mul(number(1.001), sum(max_abs[0], max_abs[1], max_abs[2])), most_t);
    const V rounding = hn::Add(hn::Mul(number(0x1p-49), size_of_terms), number(0x1p-1000));
    // |R d|² = dᵀ RᵀR d <= (1 + 3 max|RᵀR - I|) |d|², sqrt(1 + x) <= 1 + x/2, and of a valid pose the defect is known.
    const V radius = hn::Add(hn::Mul(number(1 + 1.6 * kMostDefect), load(s.radius)), hn::Mul(number(3), rounding));
    store(radius, s.world_radius);
    V middle[3], half[3], center[3];
    for (int k = 0; k < 3; ++k) {
      const V lo = hn::Mul(number(0.5), load(s.lo[k])), hi = hn::Mul(number(0.5), load(s.hi[k]));
      middle[k] = hn::Add(lo, hi), half[k] = hn::Sub(hi, lo), center[k] = load(s.center[k]);
    }
    for (int i = 0; i < 3; ++i) {
      const V &x = R[3 * i], &y = R[3 * i + 1], &z = R[3 * i + 2];
      const auto posed = [&](const V(&v)[3]) HWY_ATTR {
        return hn::Add(sum(hn::Mul(x, v[0]), hn::Mul(y, v[1]), hn::Mul(z, v[2])), t[i]);
      };
      const V c = posed(center), m = posed(middle);
      const V reach = hn::Add(
          sum(hn::Mul(hn::Abs(x), half[0]), hn::Mul(hn::Abs(y), half[1]), hn::Mul(hn::Abs(z), half[2])), rounding);
      store(c, s.world_center[i]);
      store(hn::Max(hn::Sub(m, reach), hn::Sub(c, radius)), s.world_lo[i]);
      store(hn::Min(hn::Add(m, reach), hn::Add(c, radius)), s.world_hi[i]);
    }
    const hn::RebindToUnsigned<Lanes> du;
    hn::Store(hn::BitCast(du, hn::VecFromMask(d, valid)), du, s.is_valid + lane);
    hn::Store(hn::BitCast(du, hn::VecFromMask(d, clear)), du, s.is_clear + lane);
  }
}

/// Two meshes take two lanes.
void compute(PlacedLanes& s, std::size_t size) {
  size <= 2 ? compute_by(hn::CappedTag<double, 2>(), s, size) : compute_by(hn::CappedTag<double, 4>(), s, size);
}

}  // namespace impinge::scene::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace impinge::scene {

HWY_EXPORT(compute);

namespace {

/// 2^(-306 - min_bit), as far as there is such a double: a number's last place, at least that of a normal one, times
/// 2^min_bit is then at least 2^-358.
double least_entry(int min_bit) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(std::clamp(1023 - 306 - min_bit, 1, 2046)) << 52);
}

void set(PlacedLanes::Row (&rows)[3], std::size_t lane, const Vec3& v) {
  rows[0][lane] = v.x, rows[1][lane] = v.y, rows[2][lane] = v.z;
}

Vec3 get(const PlacedLanes::Row (&rows)[3], std::size_t lane) { return {rows[0][lane], rows[1][lane], rows[2][lane]}; }

}  // namespace

void PlacedBlock::set_mesh(std::size_t i, const MeshData& mesh) {
  meshes_[i] = &mesh;
  set(lanes_.center, i, mesh.sphere.center), set(lanes_.max_abs, i, mesh.max_abs);
  set(lanes_.lo, i, mesh.box.lo), set(lanes_.hi, i, mesh.box.hi);
  lanes_.radius[i] = mesh.sphere.radius;
  lanes_.least_entry[i] = least_entry(mesh.min_bit);
}

void PlacedBlock::set_pose(std::size_t i, const Pose& pose) {
  poses_[i] = &pose;
  for (std::size_t k = 0; k < 9; ++k) lanes_.R[k][i] = pose.R[k];
  for (std::size_t k = 0; k < 3; ++k) lanes_.t[k][i] = pose.t[k];
}

void PlacedBlock::compute() {
  const std::size_t vector = size_ <= 2 ? 2 : 4;
  // What fills the last vector is as good as any.
  for (std::size_t i = size_; i % vector != 0; ++i) set_mesh(i, *meshes_[0]), set_pose(i, *poses_[0]);
  HWY_DYNAMIC_DISPATCH(compute)(lanes_, size_);
}

bool PlacedBlock::are_clearly_apart() const {
  const auto box = [&](std::size_t i) { return Box{get(lanes_.world_lo, i), get(lanes_.world_hi, i)}; };
  return lanes_.is_clear[0] != 0 && lanes_.is_clear[1] != 0 && !overlap(box(0), box(1));
}

void PlacedBlock::write(std::size_t i, PlacedObject& object) const {
  const MeshData& mesh = *meshes_[i];
  object.pose = *poses_[i];
  object.mesh = mesh.triangles.empty() ? nullptr : &mesh;
  object.in_domain = true, object.is_fine = false;
  if (object.mesh != nullptr && lanes_.is_clear[i] == 0) {
    object.is_fine = !in_exact_domain(object.pose, mesh);
    object.in_domain = !object.is_fine || in_range(object.pose, mesh);
  }
  if (object.mesh == nullptr || !object.in_domain) {  // queries refuse it, and its bounds might not be numbers
    object.sphere = {}, object.box = {};
    return;
  }
  object.sphere = {get(lanes_.world_center, i), lanes_.world_radius[i]};
  object.box = {get(lanes_.world_lo, i), get(lanes_.world_hi, i)};
}

PlacedObject place(const MeshData& mesh, const Pose& pose, std::uint32_t group) {
  PlacedObject object;
  object.group = group;
  PlacedBlock block;
  block.add(mesh, pose), block.compute(), block.write(0, object);
  return object;
}

}  // namespace impinge::scene
#endif
