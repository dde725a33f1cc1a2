// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace impinge::clash {

/// Divides a line at the ends of all stretches and calls `take` with the stretches over each piece and the ends of the
/// piece, until it returns false.
template <class Stretch, class Take>
void each_section(std::vector<Stretch> stretches, const Take& take) {
  std::sort(stretches.begin(), stretches.end(), [](const Stretch& p, const Stretch& q) { return p.lo < q.lo; });
  std::vector<decltype(Stretch::lo)> ends;
  for (const Stretch& stretch : stretches) ends.push_back(stretch.lo), ends.push_back(stretch.hi);
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  std::vector<const Stretch*> open;
  std::size_t next = 0;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    open.erase(std::remove_if(open.begin(), open.end(), [&](const Stretch* s) { return s->hi <= ends[i]; }),
               open.end());
    for (; next < stretches.size() && stretches[next].lo == ends[i]; ++next) open.push_back(&stretches[next]);
    if (!take(open, ends[i], ends[i + 1])) return;
  }
}

}  // namespace impinge::clash
