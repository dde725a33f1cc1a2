// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "tests/motion/rational_impact.hpp"

#include <algorithm>
#include <functional>
#include <vector>

namespace impinge::oracle {

namespace {

/// c[0] + c[1] t + ...; no leading zeros, so that zero is empty.
using Series = std::vector<mpq_class>;

Series trimmed(Series p) {
  while (!p.empty() && p.back() == 0) p.pop_back();
  return p;
}

Series add(const Series& a, const Series& b, int factor = 1) {
  Series sum(std::max(a.size(), b.size()));
  for (std::size_t i = 0; i < a.size(); ++i) sum[i] += a[i];
  for (std::size_t i = 0; i < b.size(); ++i) sum[i] += factor * b[i];
  return trimmed(sum);
}
Series subtract(const Series& a, const Series& b) { return add(a, b, -1); }

Series multiply(const Series& a, const Series& b) {
  if (a.empty() || b.empty()) return {};
  Series product(a.size() + b.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) product[i + j] += a[i] * b[j];
  return trimmed(product);
}

mpq_class value(const Series& p, const mpq_class& t) {
  mpq_class sum = 0;
  for (std::size_t i = p.size(); i-- > 0;) sum = sum * t + p[i];
  return sum;
}

struct Division {
  Series quotient, remainder;
};
Division divide(Series p, const Series& by) {
  Series quotient(p.size());
  while (p.size() >= by.size()) {
    const mpq_class factor = p.back() / by.back();
    const std::size_t shift = p.size() - by.size();
    quotient[shift] = factor;
    for (std::size_t i = 0; i < by.size(); ++i) p[shift + i] -= factor * by[i];
    p = trimmed(p);
  }
  return {trimmed(quotient), p};
}

Series common(Series a, Series b) {
  while (!b.empty()) {
    Series rest = divide(a, b).remainder;
    a = std::move(b);
    b = std::move(rest);
    if (const mpq_class leading = b.empty() ? 1 : b.back(); leading != 1)
      for (mpq_class& c : b) c /= leading;
  }
  return a;
}

Series slope(const Series& p);

/// With each of its roots once.
Series simple(const Series& p) { return p.empty() ? p : divide(p, common(p, slope(p))).quotient; }

Series slope(const Series& p) {
  Series result;
  for (std::size_t i = 1; i < p.size(); ++i) result.push_back(p[i] * static_cast<unsigned long>(i));
  return trimmed(result);
}

/// Different roots in (lo, hi], by Sturm's theorem.
int roots_in(const Series& p, const mpq_class& lo, const mpq_class& hi) {
  if (p.size() < 2) return 0;
  std::vector<Series> chain{simple(p)};  // the ends may be roots
  chain.push_back(slope(chain[0]));
  while (!chain.back().empty()) {
    Series rest = divide(chain[chain.size() - 2], chain.back()).remainder;
    if (!rest.empty()) {  // times a negative number, so that the numbers stay short
      const mpq_class factor = -1 / abs(rest.back());
      for (mpq_class& c : rest) c *= factor;
    }
    chain.push_back(std::move(rest));
  }
  const auto changes = [&](const mpq_class& t) {
    int count = 0, last = 0;
    for (const Series& q : chain) {
      const int sign = sgn(value(q, t));
      count += int{sign * last < 0};
      if (sign != 0) last = sign;
    }
    return count;
  };
  return changes(lo) - changes(hi);
}

/// The only root of `of` in (lo, hi], a simple one.
struct Root {
  Series of;
  mpq_class lo, hi;

  void halve() {
    const mpq_class middle = (lo + hi) / 2;
    const int at_middle = sgn(value(of, middle)), at_end = sgn(value(of, hi));
    (at_middle != 0 && at_middle != at_end ? lo : hi) = middle;
  }
  int sign(const Series& p) {
    if (p.empty() || roots_in(common(of, p), lo, hi) == 1) return 0;
    while (roots_in(p, lo, hi) > 0 || value(p, hi) == 0) halve();
    return sgn(value(p, hi));
  }
};

/// Those in [0, 1].
void find_roots(const Series& of, std::vector<Root>& roots) {
  const Series p = simple(of);
  const std::function<void(const mpq_class&, const mpq_class&)> search = [&](const mpq_class& lo, const mpq_class& hi) {
    const int count = roots_in(p, lo, hi);
    if (count == 1) roots.push_back({p, lo, hi});
    if (count < 2) return;
    const mpq_class middle = (lo + hi) / 2;
    search(lo, middle);
    search(middle, hi);
  };
  if (value(p, 0) == 0) {
    Root start{p, -1, 0};
    while (roots_in(p, start.lo, 0) > 1) start.lo /= 2;
    roots.push_back(start);
  }
  search(0, 1);
}

using Vector = std::array<Series, 3>;

Vector minus(const Vector& a, const Vector& b) {
  return {subtract(a[0], b[0]), subtract(a[1], b[1]), subtract(a[2], b[2])};
}
Series product(const Vector& a, const Vector& b) {
  return add(add(multiply(a[0], b[0]), multiply(a[1], b[1])), multiply(a[2], b[2]));
}
Vector across(const Vector& a, const Vector& b) {
  const auto part = [&](int i, int j) { return subtract(multiply(a[i], b[j]), multiply(a[j], b[i])); };
  return {part(1, 2), part(2, 0), part(0, 1)};
}

/// The signs that decide, asked of a root or of anything that moves on a segment of time.
struct Decision {
  Series volume;
  std::vector<Series> deciding;
  std::function<bool(Root&)> meet;
};

std::function<bool(Root&)> on_segment(const Vector& p, const Vector& a, const Vector& b,
                                      std::vector<Series>& deciding) {
  const Vector line = across(minus(p, a), minus(p, b));
  const Series between = product(minus(p, a), minus(p, b)), off = product(line, line);
  deciding.push_back(off);
  deciding.push_back(between);
  return [=](Root& root) { return root.sign(off) == 0 && root.sign(between) <= 0; };
}

Decision decision(Features features, const std::array<Vector, 4>& p) {
  Decision result;
  std::vector<std::function<bool(Root&)>> on;
  const auto on_edge = [&](int point, int a, int b) {
    on.push_back(on_segment(p[point], p[a], p[b], result.deciding));
  };
  if (features == Features::vertex_face) {
    const Vector normal = across(minus(p[2], p[1]), minus(p[3], p[1]));
    result.volume = product(normal, minus(p[0], p[1]));
    std::vector<Series> sides;
    for (int k = 1; k <= 3; ++k) {
      const int next = k % 3 + 1;
      sides.push_back(product(normal, across(minus(p[next], p[k]), minus(p[0], p[k]))));
      on_edge(0, k, next);
    }
    const Series flat = product(normal, normal);
    result.deciding.insert(result.deciding.end(), sides.begin(), sides.end());
    result.deciding.push_back(flat);
    result.meet = [=](Root& root) {
      if (root.sign(flat) == 0) return std::any_of(on.begin(), on.end(), [&](const auto& is) { return is(root); });
      return std::all_of(sides.begin(), sides.end(), [&](const Series& side) { return root.sign(side) >= 0; });
    };
    return result;
  }
  const Vector u = minus(p[1], p[0]), v = minus(p[3], p[2]), normal = across(u, v);
  result.volume = product(normal, minus(p[2], p[0]));
  const auto side = [&](const Vector& edge, const Vector& from, int point) {
    return product(normal, across(edge, minus(p[point], from)));
  };
  const Series c = side(u, p[0], 2), d = side(u, p[0], 3), a = side(v, p[2], 0), b = side(v, p[2], 1),
               flat = product(normal, normal);
  on_edge(2, 0, 1), on_edge(3, 0, 1), on_edge(0, 2, 3), on_edge(1, 2, 3);
  result.deciding.insert(result.deciding.end(), {a, b, c, d, flat});
  result.meet = [=](Root& root) {
    if (root.sign(flat) == 0) return std::any_of(on.begin(), on.end(), [&](const auto& is) { return is(root); });
    return root.sign(c) * root.sign(d) <= 0 && root.sign(a) * root.sign(b) <= 0;
  };
  return result;
}

using Place = std::array<mpq_class, 3>;

Place minus(const Place& a, const Place& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
mpq_class product(const Place& a, const Place& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Place between(const Place& a, const Place& b, const mpq_class& t) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}

mpq_class to_segment(const Place& p, const Place& a, const Place& b) {
  const mpq_class length = product(minus(b, a), minus(b, a));
  const mpq_class t = length == 0 ? mpq_class(0) : mpq_class(product(minus(p, a), minus(b, a)) / length);
  const Place way = minus(between(a, b, std::max(mpq_class(0), std::min(mpq_class(1), t))), p);
  return product(way, way);
}

/// Of r to the plane of u and v, where the nearest point s u + t v fulfils `is_inside(s, t)`.
template <class Inside>
void lower_to_plane(const Place& r, const Place& u, const Place& v, const Inside& is_inside, mpq_class& least) {
  const mpq_class uu = product(u, u), uv = product(u, v), vv = product(v, v), det = uu * vv - uv * uv;
  if (det == 0) return;
  const mpq_class ru = product(r, u), rv = product(r, v), s = (ru * vv - rv * uv) / det, t = (rv * uu - ru * uv) / det;
  if (is_inside(s, t)) least = std::min(least, mpq_class(product(r, r) - s * ru - t * rv));
}

}  // namespace

mpq_class squared_distance(Features features, const Points& from, const Points& to, const mpq_class& time) {
  std::array<Place, 4> p;
  for (std::size_t i = 0; i < 4; ++i)
    p[i] = between({from[i].x, from[i].y, from[i].z}, {to[i].x, to[i].y, to[i].z}, time);
  if (features == Features::vertex_face) {
    mpq_class least = to_segment(p[0], p[1], p[2]);
    least = std::min({least, to_segment(p[0], p[2], p[3]), to_segment(p[0], p[3], p[1])});
    const auto on_face = [](const mpq_class& s, const mpq_class& t) { return s >= 0 && t >= 0 && s + t <= 1; };
    lower_to_plane(minus(p[0], p[1]), minus(p[2], p[1]), minus(p[3], p[1]), on_face, least);
    return least;
  }
  mpq_class least = to_segment(p[0], p[2], p[3]);
  least = std::min({least, to_segment(p[1], p[2], p[3]), to_segment(p[2], p[0], p[1]), to_segment(p[3], p[0], p[1])});
  const auto on_both = [](const mpq_class& s, const mpq_class& t) { return s >= 0 && s <= 1 && t <= 0 && t >= -1; };
  lower_to_plane(minus(p[2], p[0]), minus(p[1], p[0]), minus(p[3], p[2]), on_both, least);
  return least;
}

std::optional<Time> first_impact(Features features, const Points& from, const Points& to) {
  std::array<Vector, 4> paths;
  for (int i = 0; i < 4; ++i) {
    const std::array<double, 3> start{from[i].x, from[i].y, from[i].z}, end{to[i].x, to[i].y, to[i].z};
    for (int k = 0; k < 3; ++k) paths[i][k] = trimmed({mpq_class(start[k]), mpq_class(end[k]) - mpq_class(start[k])});
  }
  Decision decision = oracle::decision(features, paths);
  std::vector<Root> roots;
  if (!decision.volume.empty()) {
    find_roots(decision.volume, roots);
  } else {
    find_roots({0, 1}, roots);
    for (const Series& p : decision.deciding) {
      std::vector<Root> more;
      if (!p.empty()) find_roots(p, more);
      roots.insert(roots.end(), more.begin(), more.end());
    }
  }
  std::optional<Time> first;
  mpq_class narrow = 1;
  narrow >>= 120;
  for (Root& root : roots) {
    if (!decision.meet(root)) continue;
    while (root.hi - root.lo > narrow) root.halve();
    if (value(root.of, root.hi) == 0) root.lo = root.hi;
    if (!first || root.hi < first->hi) first = {root.lo, root.hi};
  }
  return first;
}

}  // namespace impinge::oracle
