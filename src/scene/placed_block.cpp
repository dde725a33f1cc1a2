// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "scene/placed_block.hpp"

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

/// Four numbers side by side of each of as many structures as there are lanes: `out[k]` holds their k-th ones. Whole
/// vectors are loaded and turned in registers, since numbers that were written one by one into a vector's place could
/// not be loaded together without a wait.
template <class Part, class Lanes, class Structure>
HWY_INLINE void read_four(Lanes d, const Structure* const* from, std::size_t first, hn::Vec<Lanes>* out) {
  const auto load = [&](std::size_t lane, std::size_t at) HWY_ATTR {
    return hn::LoadU(d, reinterpret_cast<const double*>(static_cast<const Part*>(from[lane])) + first + at);
  };
#if HWY_TARGET == HWY_SCALAR
  for (std::size_t at = 0; at < 4; ++at) out[at] = load(0, at);
#else
  if constexpr (hn::MaxLanes(Lanes()) == 2) {
    for (std::size_t at = 0; at < 4; at += 2) {
      const auto a = load(0, at), b = load(1, at);
      out[at] = hn::InterleaveLower(d, a, b), out[at + 1] = hn::InterleaveUpper(d, a, b);
    }
  } else {
    const auto a = load(0, 0), b = load(1, 0), c = load(2, 0), e = load(3, 0);
    const auto even = hn::InterleaveLower(d, a, b), odd = hn::InterleaveUpper(d, a, b);
    const auto next_even = hn::InterleaveLower(d, c, e), next_odd = hn::InterleaveUpper(d, c, e);
    out[0] = hn::ConcatLowerLower(d, next_even, even), out[1] = hn::ConcatLowerLower(d, next_odd, odd);
    out[2] = hn::ConcatUpperUpper(d, next_even, even), out[3] = hn::ConcatUpperUpper(d, next_odd, odd);
  }
#endif
}

/// Whether the first two certainly are, by their spheres and within the exact domain. Centres and radii are certain;
/// the two sides of the comparison are off by less than 8 eps.
HWY_INLINE bool are_spheres_apart(const PlacedLanes& s) {
  double square = 0;
  for (const PlacedLanes::Row& center : s.world_center) square += (center[0] - center[1]) * (center[0] - center[1]);
  const double reach = s.world_radius[0] + s.world_radius[1];
  return square > reach * reach * (1 + 0x1p-49) && (s.is_clear[0] & s.is_clear[1]) != 0;
}

// No product is fused with a sum: the numbers are the same on every machine, and a pose is valid on all or on none.
template <class Lanes>
HWY_INLINE bool compute_by(Lanes d, const MeshData* const* meshes, const Pose* const* poses, std::size_t size,
                           bool ends_apart, PlacedLanes& s) {
  using V = hn::Vec<Lanes>;
  const auto number = [&](double x) HWY_ATTR { return hn::Set(d, x); };
  const V zero = hn::Zero(d), infinite = number(kInfinity);
  for (std::size_t lane = 0; lane < size; lane += hn::Lanes(d)) {
    const auto store = [&](V v, PlacedLanes::Row& row) HWY_ATTR { hn::Store(v, d, row + lane); };
    V pose[12], mesh[14];
    for (const std::size_t k : {0, 4, 8}) read_four<Pose>(d, poses + lane, k, pose + k);
    if (meshes != nullptr) {
      for (const std::size_t k : {0, 4, 8, 10}) read_four<MeshBounds>(d, meshes + lane, k, mesh + k);
      for (int k = 0; k < 14; ++k) store(mesh[k], s.mesh[k]);
    } else {
      for (int k = 0; k < 14; ++k) mesh[k] = hn::Load(d, s.mesh[k] + lane);
    }
    const V *const R = pose, *const t = pose + 9;
    const V *const box_lo = mesh, *const box_hi = mesh + 3, *const center = mesh + 6, *const max_abs = mesh + 10;
    const V &mesh_radius = mesh[9], &least_entry = mesh[13];
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
    for (int i = 0; i < 9; ++i) clear = hn::And(clear, is_coarse(R[i], least_entry));
    for (int i = 0; i < 3; ++i) {
      clear = hn::And(clear, is_coarse(t[i], number(0x1p-306)));
      most_t = hn::Max(most_t, hn::Abs(t[i]));
    }
    clear = hn::And(clear, hn::Lt(most_t, number(0x1p298)));

    // At least `rounding_radius` in every axis, as no |r| is above 1.001; it covers the world vertices' rounding and,
    // with 12 u S to spare, that of the lines below.
    const V size_of_terms = hn::Add(hn::Mul(number(1.001), sum(max_abs[0], max_abs[1], max_abs[2])), most_t);
    const V rounding = hn::Add(hn::Mul(number(0x1p-49), size_of_terms), number(0x1p-1000));
    // |R d|² = dᵀ RᵀR d <= (1 + 3 max|RᵀR - I|) |d|², sqrt(1 + x) <= 1 + x/2, and of a valid pose the defect is known.
    const V radius = hn::Add(hn::Mul(number(1 + 1.6 * kMostDefect), mesh_radius), hn::Mul(number(3), rounding));
    store(radius, s.world_radius);
    const hn::RebindToUnsigned<Lanes> du;
    hn::Store(hn::BitCast(du, hn::VecFromMask(d, valid)), du, s.is_valid + lane);
    hn::Store(hn::BitCast(du, hn::VecFromMask(d, clear)), du, s.is_clear + lane);
    const auto posed = [&](int i, const V* v) HWY_ATTR {
      return hn::Add(sum(hn::Mul(R[3 * i], v[0]), hn::Mul(R[3 * i + 1], v[1]), hn::Mul(R[3 * i + 2], v[2])), t[i]);
    };
    V c[3];
    for (int i = 0; i < 3; ++i) c[i] = posed(i, center), store(c[i], s.world_center[i]);
    if (ends_apart && hn::Lanes(d) >= size && are_spheres_apart(s)) return true;
    V middle[3], half[3];
    for (int k = 0; k < 3; ++k) {
      const V lo = hn::Mul(number(0.5), box_lo[k]), hi = hn::Mul(number(0.5), box_hi[k]);
      middle[k] = hn::Add(lo, hi), half[k] = hn::Sub(hi, lo);
    }
    for (int i = 0; i < 3; ++i) {
      const V &x = R[3 * i], &y = R[3 * i + 1], &z = R[3 * i + 2];
      const V m = posed(i, middle);
      const V reach = hn::Add(
          sum(hn::Mul(hn::Abs(x), half[0]), hn::Mul(hn::Abs(y), half[1]), hn::Mul(hn::Abs(z), half[2])), rounding);
      store(hn::Max(hn::Sub(m, reach), hn::Sub(c[i], radius)), s.world_lo[i]);
      store(hn::Min(hn::Add(m, reach), hn::Add(c[i], radius)), s.world_hi[i]);
    }
  }
  return false;
}

/// Two meshes take two lanes. Without `meshes`, their lanes are there.
bool compute(const MeshData* const* meshes, const Pose* const* poses, std::size_t size, bool ends_apart,
             PlacedLanes& s) {
  return size <= 2 ? compute_by(hn::CappedTag<double, 2>(), meshes, poses, size, ends_apart, s)
                   : compute_by(hn::CappedTag<double, 4>(), meshes, poses, size, false, s);
}

}  // namespace impinge::scene::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace impinge::scene {

HWY_EXPORT(compute);

namespace {

Vec3 get(const PlacedLanes::Row (&rows)[3], std::size_t lane) { return {rows[0][lane], rows[1][lane], rows[2][lane]}; }

}  // namespace

bool PlacedBlock::run(bool ends_apart) {
  const std::size_t vector = size_ <= 2 ? 2 : 4;
  // What fills the last vector is as good as any.
  for (std::size_t i = size_; i % vector != 0; ++i) meshes_[i] = meshes_[0], poses_[i] = poses_[0];
  const bool are_apart =
      HWY_DYNAMIC_DISPATCH(compute)(has_lanes_ ? nullptr : meshes_, poses_, size_, ends_apart, lanes_);
  has_lanes_ = true;
  return are_apart;
}

bool PlacedBlock::compute_apart() {
  if (run(true)) return true;
  const auto box = [&](std::size_t i) { return Box{get(lanes_.world_lo, i), get(lanes_.world_hi, i)}; };
  return lanes_.is_clear[0] != 0 && lanes_.is_clear[1] != 0 && !overlap(box(0), box(1));
}

void PlacedBlock::write(std::size_t i, PlacedObject& object) const {
  const MeshData& mesh = *meshes_[i];
  object.pose = *poses_[i];
  object.mesh = mesh.triangles.empty() ? nullptr : &mesh;
  object.in_domain = true, object.is_outside_exact_domain = false;
  if (object.mesh != nullptr && lanes_.is_clear[i] == 0) {
    object.is_outside_exact_domain = !in_exact_domain(object.pose, mesh);
    object.in_domain = !object.is_outside_exact_domain || in_range(object.pose, mesh);
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
