// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

// What the CPU and the shaders hand each other: read as C++ and as GLSL. Nothing here is wider than a word, or it
// stands at multiples of eight bytes, so that the layouts are the same in both (std430). Trees are WideTree's
// (hierarchy/wide_tree.hpp) in arrays: lengths in the tree's unit, origins from the root's.
#ifndef IMPINGE_GPU_LAYOUT_H
#define IMPINGE_GPU_LAYOUT_H

#ifdef __cplusplus
#include <cstdint>
namespace impinge::gpu {
using uint = std::uint32_t;
#define IMPINGE_CONSTANT(name, value) inline constexpr uint name = value
#else
#define IMPINGE_CONSTANT(name, value) const uint name = value
#endif

IMPINGE_CONSTANT(kDeviceWidth, 8);          // children of a node
IMPINGE_CONSTANT(kTileSize, 16);            // triangles of a leaf; a larger leaf is a node of leaves
IMPINGE_CONSTANT(kGroupSize, 64);           // invocations of a workgroup
IMPINGE_CONSTANT(kWalkedTogether, 16);      // pairs of nodes that a workgroup walks at a time
IMPINGE_CONSTANT(kSweptTogether, 4);        // pairs of leaves that a workgroup sweeps at a time
IMPINGE_CONSTANT(kLeafBit, 0x80000000u);    // in a reference: a leaf, not a node
IMPINGE_CONSTANT(kUnsureBit, 0x80000000u);  // in Hit::a: left to exact arithmetic
IMPINGE_CONSTANT(kNoHit, 0xFFFFFFFFu);      // Hit::pair of a place that nothing was written to
IMPINGE_CONSTANT(kRasterWidth, 2048);       // edges in a row of an image; its edge texture has two texels an edge
IMPINGE_CONSTANT(kRasterHeight, 16);
IMPINGE_CONSTANT(kTestApart, 0);  // as paper::Verdict
IMPINGE_CONSTANT(kTestUnsure, 1);
IMPINGE_CONSTANT(kTestCrossing, 2);

// The buffers of a walk, by binding.
IMPINGE_CONSTANT(kNodesA, 0);
IMPINGE_CONSTANT(kNodesB, 1);
IMPINGE_CONSTANT(kLeavesA, 2);
IMPINGE_CONSTANT(kLeavesB, 3);
IMPINGE_CONSTANT(kRelations, 4);
IMPINGE_CONSTANT(kSettled, 5);
IMPINGE_CONSTANT(kControl, 6);
IMPINGE_CONSTANT(kStack, 7);
IMPINGE_CONSTANT(kLeafPairs, 8);
IMPINGE_CONSTANT(kAgain, 9);
IMPINGE_CONSTANT(kHits, 10);
IMPINGE_CONSTANT(kVerticesA, 11);
IMPINGE_CONSTANT(kVerticesB, 12);
IMPINGE_CONSTANT(kTrianglesA, 13);
IMPINGE_CONSTANT(kTrianglesB, 14);
IMPINGE_CONSTANT(kPoses, 15);

/// x = axes (v - origin): see hierarchy/frame.hpp.
struct DeviceFrame {
  float origin_hi[3], origin_lo[3];  // their sum
  float axes[9];                     // axes[3 l + i] is component l of axis i
  float radius;
};

struct DeviceNode {
  float center[24], extent[24];  // x of all children, then y, then z
  uint child[8];                 // references within the page
  DeviceFrame frame;
  uint size;
  uint unused[7];
};

struct DeviceLeaf {
  DeviceFrame frame;
  float extent[3];
  float error, inverse_error;  // as in hierarchy/wide_leaf.hpp
  uint count;
  uint unused[2];
  float rows[144];  // nine rows of kTileSize
  uint ids[16];
};

/// How tree B lies in tree A's space: hierarchy/tree_relation.hpp, with t from root to root.
struct DeviceRelation {
  float m_hi[9], m_lo[9];  // by rows
  float t_hi[3], t_lo[3];
  float scale, error, defect;
};

/// Two nodes or leaves that are to be held against each other, of the relation numbered `pair`.
struct WorkItem {
  uint a, b, pair;
};

/// Triangle a (with kUnsureBit or without) and triangle b of a pair.
struct Hit {
  uint a, b, pair;
};

/// A step of the walk.
struct WalkStep {
  uint stack_size;                                       // with those that are taken
  uint first, take;                                      // which items it takes
  uint walk_groups[3], plan_groups[3], sweep_groups[3];  // for indirect dispatch
};

/// What the kernels know of the work, and what the host reads back.
struct Control {
  WalkStep steps[2];  // the one at hand, and the one that is planned
  uint leaf_pairs;    // in the list
  uint swept;         // of them, those that the sweep came to the end of
  uint again;         // leaf pairs whose hits found no room
  uint hits;          // asked for, which may be more than there is room for
  uint box_tests, box_tests_high, triangle_pairs, triangle_pairs_high;
};

/// Sizes, in items; see `plan.comp`.
struct WalkConfig {
  uint stack_capacity, stack_reserve, leaf_capacity, hit_capacity;
  uint most_groups;  // that one dispatch may have
  uint first_only;   // a pair of objects with a crossing needs no more tests
  uint step;         // which of Control::steps is at hand
};

/// In one image of backend "raster": a triangle, and edges of one leaf that follow one another in a row. Its first
/// corner is seen from the leaf's origin, the other two from the first; each coordinate is within `error`, and
/// multiplied by `scale` those of the edges have the same unit.
struct RasterRun {
  float corner[3], a[3], b[3];
  float scale, error;
  uint first, count;  // places in the image
  uint verdict;       // where the first one's verdict goes
};

/// A trial of the device's arithmetic: four numbers, and what it makes of them (shaders/probe.comp).
struct ProbeCase {
  float x[4];
};
struct ProbeAnswer {
  float x[10];
  uint above;
  int sign;
};

#if defined(__cplusplus) || defined(WITH_DOUBLES)
/// Where a mesh stands, in a world that is scaled, and where its numbers begin in its page.
struct DevicePose {
  double R[9], t[3];
  uint first_vertex, first_triangle;
};
/// Of the two meshes of a relation.
struct DevicePoses {
  DevicePose a, b;
  uint is_usable;
  uint unused;
};

struct DoubleCase {
  double x[3];
};
struct DoubleAnswer {
  double x[7];
  uint above;
  int sign;
};
#endif

#ifdef __cplusplus
static_assert(sizeof(DevicePose) == 104 && sizeof(DevicePoses) == 216 && sizeof(DoubleAnswer) == 64);
static_assert(sizeof(DeviceFrame) == 16 * 4 && sizeof(DeviceNode) == 80 * 4 && sizeof(DeviceLeaf) == 184 * 4);
static_assert(sizeof(DeviceRelation) == 27 * 4 && sizeof(WorkItem) == 12 && sizeof(Hit) == 12);
}  // namespace impinge::gpu
#endif
#undef IMPINGE_CONSTANT

#endif  // IMPINGE_GPU_LAYOUT_H
