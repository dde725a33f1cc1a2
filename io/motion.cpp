// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// Where the nodes of an animated file are at a time.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "impinge/io.hpp"

namespace impinge::io {
namespace {

using Quaternion = std::array<double, 4>;

double dot(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// Along the shorter arc, as glTF asks for.
void slerp(std::span<const double> a, std::span<const double> b, double u, std::span<double> out) {
  const double cosine = dot(a, b), sign = cosine < 0 ? -1 : 1;
  const double angle = std::acos(std::min(std::fabs(cosine), 1.0));
  // The arc is as good as straight; normalizing makes up for the rest.
  const bool is_short = angle < 1e-6;
  const double from = is_short ? 1 - u : std::sin((1 - u) * angle) / std::sin(angle);
  const double to = is_short ? u : std::sin(u * angle) / std::sin(angle);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = from * a[i] + sign * to * b[i];
}

/// The cubic through both keys with their tangents, which are per second.
void spline(std::span<const double> a, std::span<const double> out_tangent, std::span<const double> b,
            std::span<const double> in_tangent, double u, double seconds, std::span<double> out) {
  const double u2 = u * u, u3 = u2 * u;
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = (2 * u3 - 3 * u2 + 1) * a[i] + seconds * (u3 - 2 * u2 + u) * out_tangent[i] + (3 * u2 - 2 * u3) * b[i] +
             seconds * (u3 - u2) * in_tangent[i];
}

/// The value of a track at a time.
void sample(const Track& track, double seconds, std::span<double> out) {
  const std::size_t n = out.size(), parts = track.between == Track::Between::cubic ? 3 : 1;
  // Of a cubic key's three parts its value is the middle one.
  const auto part = [&](std::size_t key, std::size_t which) {
    return std::span(track.values).subspan((key * parts + which) * n, n);
  };
  const auto value = [&](std::size_t key) { return part(key, parts / 2); };
  const auto after =
      static_cast<std::size_t>(std::upper_bound(track.times.begin(), track.times.end(), seconds) - track.times.begin());
  const bool is_outside = after == 0 || after == track.times.size();
  const std::size_t key = after == 0 ? 0 : after - 1;
  if (is_outside || track.between == Track::Between::step) {
    std::ranges::copy(value(key), out.begin());
    return;
  }
  // Between equal keys a part rests: it stands where it stood, to the bit.
  if (track.between == Track::Between::linear && std::ranges::equal(value(key), value(after))) {
    std::ranges::copy(value(key), out.begin());
    return;
  }
  const double length = track.times[after] - track.times[key], u = (seconds - track.times[key]) / length;
  if (track.between == Track::Between::cubic) {
    spline(value(key), part(key, 2), value(after), part(after, 0), u, length, out);
  } else if (track.property == Track::Property::rotation) {
    slerp(value(key), value(after), u, out);
  } else {
    for (std::size_t i = 0; i < n; ++i) out[i] = (1 - u) * value(key)[i] + u * value(after)[i];
  }
}

Affine affine_of(const Node& node) {
  const double length = std::sqrt(dot(node.rotation, node.rotation));
  Quaternion q = node.rotation;
  if (length == 0) return affine_of({node.parent, node.local, node.scale, {0, 0, 0, 1}, node.translation});
  for (double& c : q) c /= length;
  const auto [x, y, z, w] = q;
  const std::array<double, 9> turn{1 - 2 * (y * y + z * z), 2 * (x * y - z * w),     2 * (x * z + y * w),
                                   2 * (x * y + z * w),     1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
                                   2 * (x * z - y * w),     2 * (y * z + x * w),     1 - 2 * (x * x + y * y)};
  Affine map;
  for (std::size_t i = 0; i < 9; ++i) map.m[i] = turn[i] * node.scale[i % 3];
  map.t = node.translation;
  return map;
}

}  // namespace

Affine product(const Affine& a, const Affine& b) {
  Affine out;
  for (std::size_t row = 0; row < 3; ++row) {
    const double* const r = &a.m[3 * row];
    for (std::size_t column = 0; column < 3; ++column)
      out.m[3 * row + column] = (r[0] * b.m[column] + r[1] * b.m[3 + column]) + r[2] * b.m[6 + column];
    out.t[row] = ((r[0] * b.t[0] + r[1] * b.t[1]) + r[2] * b.t[2]) + a.t[row];
  }
  return out;
}

std::vector<Affine> nodes_at(const Model& model, const Animation& animation, double seconds) {
  std::vector<Node> nodes = model.nodes;
  std::vector<bool> moves(nodes.size(), false);
  for (const Track& track : animation.tracks) {
    Node& node = nodes[track.node];
    moves[track.node] = true;
    switch (track.property) {
      case Track::Property::translation:
        sample(track, seconds, node.translation);
        break;
      case Track::Property::rotation:
        sample(track, seconds, node.rotation);
        break;
      case Track::Property::scale:
        sample(track, seconds, node.scale);
        break;
    }
  }
  std::vector<Affine> worlds;
  worlds.reserve(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Affine local = moves[i] ? affine_of(nodes[i]) : nodes[i].local;
    worlds.push_back(nodes[i].parent ? product(worlds[*nodes[i].parent], local) : local);
  }
  return worlds;
}

}  // namespace impinge::io
