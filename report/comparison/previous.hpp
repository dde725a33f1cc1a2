// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "impinge/clash.hpp"
#include "report/comparison/standing.hpp"

namespace impinge::report {

/// What comparing with an earlier run needs of its JSON (docs/cli.md, "The JSON of clash").
struct Previous {
  struct OldRegion {
    std::string id;
    Point centroid{};
    double reach = 0;  ///< half of its box's diagonal
  };
  struct Pair {
    std::string id;
    OldPart a, b;
    std::string test;  ///< empty: none
    Verdict verdict = Verdict::apart;
    std::optional<Point> middle;  ///< of its largest region, or of its nearest points
    bool has_regions = false;     ///< the earlier run looked for them
    std::vector<OldRegion> regions;
  };
  struct OldFile {
    std::string file;      ///< as the objects name it
    std::string name;      ///< as `names_of_files` of that run
    std::string known_as;  ///< the name that it had before it was renamed, or the same
  };
  std::vector<OldFile> files;
  std::vector<OldPart> parts;
  std::vector<Pair> pairs;
};

/// Errors: `bad_file`, with the line and the place.
Result<Previous> read_previous(const std::string& name, std::uint64_t most_bytes);
Result<Previous> parse_previous(const std::string& name, const std::string& text);

}  // namespace impinge::report
