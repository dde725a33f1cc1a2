// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

/// What was measured of devices is kept from run to run in a file that may be deleted at any time:
/// $XDG_CACHE_HOME/impinge/calibration, or .cache/impinge/calibration in the home directory. Where it can be neither
/// read nor written, devices are measured again.
namespace impinge::cli {

class CalibrationCache {
 public:
  CalibrationCache();
  /// Writes what has been measured since.
  ~CalibrationCache();
  CalibrationCache(const CalibrationCache&) = delete;
  CalibrationCache& operator=(const CalibrationCache&) = delete;
};

}  // namespace impinge::cli
