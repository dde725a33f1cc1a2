// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "io/importer/ifc_name.hpp"

namespace impinge::importer {

bool parse_ifc_product(std::string_view node_name, IfcProduct& product) {
  constexpr std::size_t kIdLength = 22;
  constexpr std::string_view kIdLetters = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_$";
  const std::size_t type_end = node_name.find('_');
  if (!node_name.starts_with("Ifc") || type_end == node_name.npos) return false;
  if (node_name.size() < type_end + 1 + kIdLength + 1) return false;
  const std::size_t id = node_name.size() - kIdLength;
  if (node_name[id - 1] != '_' || node_name.substr(id).find_first_not_of(kIdLetters) != node_name.npos) return false;
  product.type = node_name.substr(0, type_end);
  product.name = id - 1 > type_end ? node_name.substr(type_end + 1, id - 2 - type_end) : std::string_view{};
  return true;
}

}  // namespace impinge::importer
