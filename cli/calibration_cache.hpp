// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

namespace impinge::cli {

/// Keeps the measured speeds of devices from run to run in a file that may be deleted at any time:
/// $XDG_CACHE_HOME/impinge/calibration, or .cache/impinge/calibration in the home directory. Where the file can be
/// neither read nor written, the library measures its devices again.
class CalibrationCache {
 public:
  /// Reads the file and hands its measurements to the library.
  CalibrationCache();
  /// Writes what has been measured since.
  ~CalibrationCache();
  CalibrationCache(const CalibrationCache&) = delete;
  CalibrationCache& operator=(const CalibrationCache&) = delete;
};

}  // namespace impinge::cli
