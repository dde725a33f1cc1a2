// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "impinge/result.hpp"

namespace impinge {

/// A device that Vulkan knows of, on which the backends "gpu", "raster" and "hybrid" may run.
struct DeviceInfo {
  enum class Type : std::uint8_t { discrete, integrated, virtual_gpu, cpu, other };
  std::string name, driver;
  Type type;
  std::uint64_t memory_bytes;          ///< of its own; of the machine where it shares that
  std::uint64_t largest_buffer_bytes;  ///< a mesh that needs more is left to the CPU (61 bytes a triangle)
  std::uint32_t subgroup_size;         ///< invocations that run in step
  bool has_doubles, has_int64;         ///< in shaders; neither is needed, but doubles are used if they can be trusted
  bool is_certified;                   ///< its arithmetic was tried out, and every bound that answers rest on holds
  std::string complaint;               ///< why it is not, and is left out
};

/// All devices, each tried out, the likely fastest first: discrete, integrated, virtual, then the CPU.
/// `Options::device` takes a number in this list, or a part of a name. Error: `no_device`, with the reason and the
/// mend.
Result<std::vector<DeviceInfo>> devices();

/// What has been measured so far of this machine's CPU and devices, by which `Options::predict_cost` predicts and
/// "hybrid" splits its work: some lines of text that another run may
/// be given, so that it need not measure again. Empty: nothing yet.
std::string calibration();
/// Takes what another run has measured. Lines that are not understood are passed over.
void set_calibration(std::string_view text);

}  // namespace impinge
