// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bench/contest.hpp"
#include "impinge/io.hpp"

namespace impinge::bench {

/// Every library on a whole assembly. The peers are handed the pairs of parts whose bounding spheres meet, in poses and
/// with trees made beforehand, so that only their narrow part is timed; impinge finds the pairs itself.
class AssemblyContest {
 public:
  void add(const std::string& name, const io::Model& model, const Effort& effort);
  void write(const std::filesystem::path& folder) const { table_.write(folder, "assemblies"); }

 private:
  Table table_{{"assembly", "library", "exact_pairs", "exact_object_pairs", "ms", "ratio", "ratio_low", "ratio_high",
                "missed", "added", "wrong_object_pairs"}};
};

}  // namespace impinge::bench
