// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "paper/batch.hpp"

namespace impinge::paper {

/// A way to run the streams. One thread uses it at a time.
class Backend {
 public:
  virtual ~Backend() = default;
  /// Starts on the batch's tests. The batch stays as it is until `wait` has returned.
  virtual void submit(const Batch& batch) = 0;
  /// A verdict a test. They stay until the next `submit`.
  virtual std::span<const Verdict> wait() = 0;
};

/// Plain C++: the reference that every other backend is held against.
std::unique_ptr<Backend> make_scalar_backend();

/// Folds the tests' verdicts into one a candidate pair. A pair is `crossing` only if both triangles are certainly
/// proper as well.
void fold(const Batch& batch, std::span<const Verdict> tests, std::vector<Verdict>& pairs);

}  // namespace impinge::paper
