// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "check_model.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  impinge::fuzz::check(impinge::io::read_ply(bytes, "fuzz.ply"), "fuzz.ply");
  return 0;
}
