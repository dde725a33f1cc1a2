// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace impinge::bench {

/// The device to be measured, or why there is none.
struct TargetDevice {
  std::string option;  ///< of `Options::device`; empty: none
  std::string line;    ///< what it is, for a table's head
};

/// `wanted` is a number among the devices or part of a name; empty: what IMPINGE_DEVICE says, or the first. Software
/// drivers are left out unless they are allowed: their times say nothing about a GPU.
TargetDevice choose_device(std::string wanted = "", bool allows_software = false);

}  // namespace impinge::bench
