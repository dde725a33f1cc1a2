// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "calibration_cache.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

#include "impinge/devices.hpp"

namespace impinge::cli {
namespace {

namespace fs = std::filesystem;

/// No more than this is read; the files that this program writes are far smaller.
constexpr std::size_t kMostBytes = 1 << 16;

/// The path of the file; empty if no folder for it is known.
fs::path place() {
  const char* const cache = std::getenv("XDG_CACHE_HOME");
  if (cache != nullptr && *cache == '/') return fs::path(cache) / "impinge/calibration";
  const char* const home = std::getenv("HOME");
  if (home != nullptr && *home == '/') return fs::path(home) / ".cache/impinge/calibration";
  return {};
}

std::string contents() {
  std::error_code none;
  if (place().empty() || !fs::is_regular_file(place(), none)) return {};
  std::ifstream file(place(), std::ios::binary);
  std::string text(kMostBytes, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

}  // namespace

CalibrationCache::CalibrationCache() { set_calibration(contents()); }

CalibrationCache::~CalibrationCache() {
  const std::string text = calibration();
  if (text.empty() || place().empty() || text == contents()) return;
  std::error_code failed;
  fs::create_directories(place().parent_path(), failed);
  // Written beside it and renamed: another run never reads half of it.
  const fs::path beside = place().string() + "." + std::to_string(getpid());
  std::ofstream(beside, std::ios::binary) << text;
  fs::rename(beside, place(), failed);
  if (failed) fs::remove(beside, failed);
}

}  // namespace impinge::cli
