// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "impinge/contacts.hpp"
#include "impinge/options.hpp"
#include "impinge/workspace.hpp"

/// What impinge-gpu-figures measures: every case on the CPU, on a device and on both at once.
namespace impinge::bench {

/// What a backend said and took, added up where a question is a series of queries.
struct Answer {
  double seconds = 0;  ///< wall clock
  std::uint64_t contacts = 0;
  std::uint64_t fingerprint = 0;  ///< of all that must not depend on the backend
  std::vector<Statistics> statistics;
  std::vector<std::string> warnings;

  /// Takes in a query's answer: its hash, or with `Find::first`, whose witnesses may differ, what touches.
  void add(const Contacts& contacts, Options::Find find);
};

struct Question {
  std::string triangles;
  int queries = 1;  ///< figures are given for one of so many
  std::function<Answer(Options, Workspace&)> ask;
};

struct Case {
  std::string name;
  std::function<Question()> make;  ///< when its turn has come: large meshes do not wait in memory
  bool is_papers = false;          ///< of the paper's experiment: asked in image space too
  bool is_rated = false;           ///< pairs of triangles tested a second are given as well
  double gigabytes = 0;            ///< of memory that it takes, if many
};

/// In the order of the table. `is_quick`: smaller ones in place of those that take long.
std::vector<Case> figure_cases(bool is_quick);

/// 1234567 as 1,234,567.
std::string grouped(std::uint64_t value);

}  // namespace impinge::bench
