// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "impinge/result.hpp"

namespace impinge::cli {

/// `impinge devices`: lists what the backends gpu, raster and hybrid may run on. True if one of them can be used.
Result<bool> list_devices();

}  // namespace impinge::cli
