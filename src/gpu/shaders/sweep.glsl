// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

// Pairs of leaves to pairs of triangles whose boxes meet (partition/sweep.cpp), and those to verdicts
// (narrow/pair_filter.cpp), in workgroup memory. Only what is not certainly apart leaves it. WITH_DOUBLES: what single
// precision is unsure of is tested once more.

#include "frames.glsl"
#include "triangle_pair.glsl"
#include "work.glsl"
#ifdef WITH_DOUBLES
#include "triangle_pair_doubles.glsl"
#endif

layout(local_size_x = 64) in;

layout(set = 0, binding = kLeavesA, std430) readonly buffer LeavesA { DeviceLeaf leaves_a[]; };
layout(set = 0, binding = kLeavesB, std430) readonly buffer LeavesB { DeviceLeaf leaves_b[]; };
layout(set = 0, binding = kRelations, std430) readonly buffer Relations { DeviceRelation relations[]; };
layout(set = 0, binding = kSettled, std430) buffer Settled { uint settled[]; };
layout(set = 0, binding = kLeafPairs, std430) readonly buffer LeafPairs { WorkItem leaf_pairs[]; };
layout(set = 0, binding = kAgain, std430) writeonly buffer Again { WorkItem again[]; };
layout(set = 0, binding = kHits, std430) writeonly buffer Hits { Hit hits[]; };
#ifdef WITH_DOUBLES
layout(set = 0, binding = kVerticesA, std430) readonly buffer VerticesA { double vertices_a[]; };
layout(set = 0, binding = kVerticesB, std430) readonly buffer VerticesB { double vertices_b[]; };
layout(set = 0, binding = kTrianglesA, std430) readonly buffer TrianglesA { uint triangles_a[]; };
layout(set = 0, binding = kTrianglesB, std430) readonly buffer TrianglesB { uint triangles_b[]; };
layout(set = 0, binding = kPoses, std430) readonly buffer Poses { DevicePoses poses[]; };
#endif

shared FrameRelation relation[kGroupSize];
shared float error[kGroupSize];
shared uint is_open[kGroupSize];
/// Of the leaf pairs at hand, both leaves' triangles in A's frame, an array a coordinate, and the boxes of A's: least and
/// greatest x, y, z.
shared float triangles[2][9][kGroupSize];
shared float boxes[6][kGroupSize];
const uint kMostCandidates = kSweptTogether * kTileSize * kTileSize;
shared uint candidates[kMostCandidates];  // leaf pair, A's triangle, B's triangle: 8 bits each; later the verdict, from bit 24
shared uint candidate_count, hit_count, first_hit, tests;

// The bound of partition/sweep.cpp with this device's roundings, u = 2^-23: 30 u r_b for C's entries, 9 u for c, three
// products and sums 9 u r_b and u |c|, and the sum that makes a box larger u (|c| + 2 r_b).
float error_of(uint a, uint b, FrameRelation f, DeviceRelation trees) {
  precise float far = max(abs(f.c[0]), max(abs(f.c[1]), abs(f.c[2])));
  precise float error_a = leaves_a[a].error + trees.error;
  precise float radius_b = trees.scale * leaves_b[b].frame.radius;
  precise float error_b = (trees.scale * (1.8 * leaves_b[b].error + leaves_b[b].inverse_error) +
                           kTwoToMinus23 * (12.0 * far + 44.0 * radius_b)) + 2.0 * trees.error;
  precise float larger = 1.001 * max(error_a, error_b) + kTwoToMinus110;
  return larger;
}

void prepare(uint place) {
  const WorkItem item = leaf_pairs[place];
  const uint a = item.a & ~kLeafBit, b = item.b & ~kLeafBit;
  const DeviceRelation trees = relations[item.pair];
  const DeviceFrame frame_a = leaves_a[a].frame, frame_b = leaves_b[b].frame;
  const FrameRelation f = relate_frames(frame_a, frame_b, trees);
  relation[gl_LocalInvocationID.x] = f;
  error[gl_LocalInvocationID.x] = error_of(a, b, f, trees);
  is_open[gl_LocalInvocationID.x] = config.first_only != 0 && settled[item.pair] != 0 ? 0 : 1;
}

// Triangle `corner` of leaf pair `k`: A's as it is, B's brought into A's frame. Returns B's box.
void load(uint k, WorkItem item, uint triangle, out float least[3], out float greatest[3]) {
  const uint lane = gl_LocalInvocationID.x, a = item.a & ~kLeafBit, b = item.b & ~kLeafBit;
  const float scale = relations[item.pair].scale;
  const float margin = 2.0 * error[k];  // a shared point is within the error of both triangles
  for (int i = 0; i < 3; ++i) {
    float p[3], q[3];
    for (int vertex = 0; vertex < 3; ++vertex) {
      p[vertex] = leaves_a[a].rows[16 * (3 * vertex + i) + triangle];
      precise float x = scale * leaves_b[b].rows[16 * (3 * vertex) + triangle];
      precise float y = scale * leaves_b[b].rows[16 * (3 * vertex + 1) + triangle];
      precise float z = scale * leaves_b[b].rows[16 * (3 * vertex + 2) + triangle];
      precise float posed = ((relation[k].C[3 * i] * x + relation[k].C[3 * i + 1] * y) + relation[k].C[3 * i + 2] * z) +
                            relation[k].c[i];
      q[vertex] = posed;
      triangles[0][3 * vertex + i][lane] = p[vertex];
      triangles[1][3 * vertex + i][lane] = posed;
    }
    boxes[2 * i][lane] = min(p[0], min(p[1], p[2]));
    boxes[2 * i + 1][lane] = max(p[0], max(p[1], p[2]));
    precise float low = min(q[0], min(q[1], q[2])) - margin;
    precise float high = max(q[0], max(q[1], q[2])) + margin;
    least[i] = low;
    greatest[i] = high;
  }
}

vec3 corner(uint side, uint vertex, uint place) {
  return vec3(triangles[side][3 * vertex][place], triangles[side][3 * vertex + 1][place],
              triangles[side][3 * vertex + 2][place]);
}

#ifdef WITH_DOUBLES
// The verdict on two triangles of the meshes, by their own vertices.
uint test_in_doubles(uint id_a, uint id_b, uint pair) {
  if (poses[pair].is_usable == 0) return kUnsure;
  const DevicePose pose_a = poses[pair].a, pose_b = poses[pair].b;
  dvec3 a[3], b[3];
  for (uint v = 0; v < 3; ++v) {
    const uint from_a = 3 * (pose_a.first_vertex + triangles_a[3 * (pose_a.first_triangle + id_a) + v]);
    const uint from_b = 3 * (pose_b.first_vertex + triangles_b[3 * (pose_b.first_triangle + id_b) + v]);
    a[v] = posed(pose_a, dvec3(vertices_a[from_a], vertices_a[from_a + 1], vertices_a[from_a + 2]));
    b[v] = posed(pose_b, dvec3(vertices_b[from_b], vertices_b[from_b + 1], vertices_b[from_b + 2]));
  }
  return test_pair(a, b, kTwoToMinus49);
}
#endif

// Sweeps leaf pairs `first` to `first` + kSweptTogether - 1 of the workgroup's `count`, whose places in the list begin at
// `begin`.
void sweep(uint begin, uint first, uint count) {
  const uint lane = gl_LocalInvocationID.x, k = first + lane / kTileSize, own = lane % kTileSize;
  if (lane == 0) {
    candidate_count = 0;
    hit_count = 0;
  }
  const bool is_there = k < count && is_open[k] != 0;
  WorkItem item = WorkItem(0, 0, 0);
  uint count_a = 0;
  float least[3], greatest[3];
  if (is_there) {
    item = leaf_pairs[begin + k];
    count_a = own < leaves_b[item.b & ~kLeafBit].count ? leaves_a[item.a & ~kLeafBit].count : 0;
    load(k, item, own, least, greatest);
  }
  barrier();
  uint met = 0;
  for (uint t = 0; t < count_a; ++t) {
    const uint place = lane - own + t;
    bool meet = true;
    for (int i = 0; i < 3; ++i)
      meet = meet && boxes[2 * i][place] <= greatest[i] && boxes[2 * i + 1][place] >= least[i];
    met |= meet ? 1u << t : 0;
  }
  uint to = atomicAdd(candidate_count, bitCount(met));
  for (; met != 0; met &= met - 1) candidates[to++] = k << 16 | uint(findLSB(met)) << 8 | own;
  barrier();
  const uint candidates_here = candidate_count;
  for (uint n = lane; n < candidates_here; n += kGroupSize) {
    const uint candidate = candidates[n], pair = candidate >> 16;
    const uint place_a = (pair - first) * kTileSize + (candidate >> 8 & 0xFF);
    const uint place_b = (pair - first) * kTileSize + (candidate & 0xFF);
    uint verdict = test_pair(vec3[3](corner(0, 0, place_a), corner(0, 1, place_a), corner(0, 2, place_a)),
                             vec3[3](corner(1, 0, place_b), corner(1, 1, place_b), corner(1, 2, place_b)),
                             error[pair]);
#ifdef WITH_DOUBLES
    if (verdict == kUnsure) {
      const WorkItem of = leaf_pairs[begin + pair];
      verdict = test_in_doubles(leaves_a[of.a & ~kLeafBit].ids[candidate >> 8 & 0xFF],
                                leaves_b[of.b & ~kLeafBit].ids[candidate & 0xFF], of.pair);
    }
#endif
    candidates[n] = candidate | verdict << 24;
    if (verdict != kApart) atomicAdd(hit_count, 1);
  }
  barrier();
  if (lane == 0) first_hit = hit_count > 0 ? atomicAdd(control.hits, hit_count) : 0;
  barrier();
  const uint hits_here = hit_count, begin_hit = first_hit;
  const bool has_room = begin_hit <= config.hit_capacity && hits_here <= config.hit_capacity - begin_hit;
  if (lane == 0 && (has_room || hits_here == 0)) tests += candidates_here;
  if (hits_here == 0) return;
  if (!has_room) {
    // No room: what would have been a part of it stays empty, and these leaf pairs come once more.
    for (uint n = begin_hit + lane; n < config.hit_capacity; n += kGroupSize) hits[n].pair = kNoHit;
    if (is_there && own == 0) again[atomicAdd(control.again, 1)] = item;
    return;
  }
  barrier();  // all have read hit_count, which now counts down
  for (uint n = lane; n < candidates_here; n += kGroupSize) {
    const uint candidate = candidates[n], verdict = candidate >> 24;
    if (verdict == kApart) continue;
    const WorkItem of = leaf_pairs[begin + (candidate >> 16 & 0xFF)];
    const uint id_a = leaves_a[of.a & ~kLeafBit].ids[candidate >> 8 & 0xFF];
    const uint id_b = leaves_b[of.b & ~kLeafBit].ids[candidate & 0xFF];
    const uint place = begin_hit + atomicAdd(hit_count, uint(-1)) - 1;
    hits[place] = Hit(verdict == kUnsure ? id_a | kUnsureBit : id_a, id_b, of.pair);
    if (config.first_only != 0 && verdict == kCrossing) settled[of.pair] = 1;
  }
}

void main() {
  const uint lane = gl_LocalInvocationID.x;
  const uint all = control.leaf_pairs, stride = gl_NumWorkGroups.x * kGroupSize;
  uint swept = 0;
  if (lane == 0) tests = 0;
  for (uint begin = gl_WorkGroupID.x * kGroupSize; begin < all; begin += stride) {
    const uint count = min(all - begin, kGroupSize);
    if (lane < count) prepare(begin + lane);
    barrier();
    for (uint first = 0; first < count; first += kSweptTogether) {
      sweep(begin, first, count);
      swept += min(count - first, kSweptTogether);
      barrier();  // before shared memory is written again
    }
  }
  if (lane == 0) {
    atomicAdd(control.swept, swept);
    const uint before = atomicAdd(control.triangle_pairs, tests);
    if (before + tests < before) atomicAdd(control.triangle_pairs_high, 1);
  }
}
