// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <iostream>

#include "impinge/report.hpp"

/// write_report FILE FILE JSON: writes which parts of two files clash, and prints how many pairs fail.
int main(int argc, char** argv) {
  if (argc < 4) return 2;
  impinge::report::ReportOptions options;
  options.files = {argv[1], argv[2]};
  const auto report = impinge::report::review(options);
  if (!report) return std::cerr << report.error().message << '\n', 2;
  if (const auto written = impinge::report::write_json(*report, argv[3]); !written)
    return std::cerr << written.error().message << '\n', 2;
  std::cout << report->failing() << " of " << report->pairs().size() << " pairs fail\n";
}
