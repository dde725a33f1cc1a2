// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "hierarchy/wide_tree.hpp"

/// How a range of triangles is to be split, found on a sample of them.
namespace impinge::hierarchy {

inline constexpr int kFewestBins = 8, kMostBins = 16;
/// Boxes are kept as eight floats: the lower corner, something, the upper corner negated, something. So the union of
/// two is their minimum, and this, everywhere, is the empty one.
inline constexpr float kEmpty = 1e30f;

/// A triangle's box, with the triangle's place in the sample as the fourth number.
struct alignas(32) SplitItem {
  float box[8];
  [[nodiscard]] std::uint32_t index() const { return static_cast<std::uint32_t>(box[3]); }
};

/// A triangle lies beyond if (key - low) * per_key >= bin, its key on an axis being the sum of its box's ends.
struct Cut {
  int axis = -1;  ///< none
  int slot = 0;   ///< of the axis, among those that cuts were tried on
  int bin = 0;
  float low = 0, per_key = 0;
};

struct alignas(32) SplitPart {
  float box[8];
  float area;
  std::uint32_t first, count;  ///< its items
  bool is_open = true;         ///< may be split
};

struct SplitPlan {
  SplitPart parts[kWidth];
  Cut cut[kWidth - 1];
  std::uint8_t cut_part[kWidth - 1];  ///< the part that the cut is made through; what lies beyond becomes a new one
  int size = 1, cuts = 0;
  std::uint32_t most_in_leaf;  ///< items that stand for one leaf at most

  [[nodiscard]] SplitPart* largest() {
    SplitPart* result = nullptr;
    for (int p = 0; p < size; ++p) {
      SplitPart& part = parts[p];
      if (part.is_open && part.count > most_in_leaf && (result == nullptr || part.area > result->area)) result = &part;
    }
    return result;
  }
};

/// How many triangles fall into each part, and their box.
struct alignas(32) SplitTally {
  float box[kWidth][8];
  std::uint32_t count[kWidth];
};

/// Triangles, in units of full leaves. Without leaves, where triangles are a sample, just their number.
class LeafCount {
 public:
  LeafCount() = default;
  explicit LeafCount(std::uint32_t leaf_size)
      : round_up_(leaf_size - 1), reciprocal_(((std::uint64_t{1} << 32) + leaf_size - 1) / leaf_size) {}
  /// Right up to 2^32 / leaf_size triangles.
  [[nodiscard]] float operator()(std::uint32_t count) const {
    return static_cast<float>(static_cast<std::int32_t>((count + round_up_) * reciprocal_ >> 32));
  }

 private:
  std::uint32_t round_up_ = 0;
  std::uint64_t reciprocal_ = std::uint64_t{1} << 32;
};

}  // namespace impinge::hierarchy
