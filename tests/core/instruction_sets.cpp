// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "tests/core/instruction_sets.hpp"

#include <hwy/highway.h>
#include <hwy/targets.h>

namespace impinge::test {

std::vector<std::int64_t> instruction_sets() { return hwy::SupportedAndGeneratedTargets(); }
std::string instruction_set_name(std::int64_t set) { return hwy::TargetName(set); }

OnInstructionSet::OnInstructionSet(std::int64_t set, const char* file, int line)
    : trace_(file, line, instruction_set_name(set)) {
  hwy::SetSupportedTargetsForTest(set);
}
OnInstructionSet::~OnInstructionSet() { hwy::SetSupportedTargetsForTest(0); }

}  // namespace impinge::test
