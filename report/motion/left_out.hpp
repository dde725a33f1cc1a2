// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "impinge/io.hpp"
#include "report/assembly.hpp"

namespace impinge::report {

/// What an animation does and `motion` does not, in sentences.
struct LeftOut {
  std::vector<std::string> shapes;    ///< of which parts the shape would change: the answer is not of all that moves
  std::vector<std::string> harmless;  ///< what cannot be followed, but moves no part
};

/// Errors: `bad_file`, where it is not known how a part moves, or nothing moves at all: nothing can be said of such a
/// motion. The assembly is of the model.
Result<LeftOut> left_out(const io::Model& model, const io::Animation& animation, const Assembly& assembly);

}  // namespace impinge::report
