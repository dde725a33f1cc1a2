// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace impinge::report {

/// 3 bytes a pixel, red, green, blue, row by row from the top.
struct Picture {
  std::size_t width = 0, height = 0;
  std::vector<unsigned char> rgb;
};

/// As a PNG (ISO/IEC 15948), always the same for the same picture.
std::string png_of(const Picture& picture);

}  // namespace impinge::report
