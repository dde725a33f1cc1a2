// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "gpu/mesh_store.hpp"
#include "gpu/walk.hpp"
#include "paper/raster.hpp"

namespace impinge::gpu {

/// A device that is ready for work: its shaders, the meshes on it, and walks kept for the next query.
class ReadyDevice {
 public:
  ReadyDevice(const PhysicalDevice& physical, const Limits& limits);

  Device device;
  const bool with_doubles;  ///< it has some, and they can be trusted
  const WalkKernels kernels;
  MeshStore meshes;

  /// Makes one, or takes one that was given back.
  std::unique_ptr<DeviceWalk> take_walk();
  void give_back(std::unique_ptr<DeviceWalk> walk);

  /// The same of what draws the plain stages' tests. Throws a Failure if the device does not draw, or does so wrongly:
  /// that is tried once.
  std::unique_ptr<paper::RasterBackend> take_raster();
  void give_back(std::unique_ptr<paper::RasterBackend> raster);

 private:
  /// Makes it, however many meshes must make way for it: they may be uploaded again.
  template <class Make>
  auto with_room(const Make& make);
  const Drawing& raster_drawing();

  std::mutex mutex_, drawing_mutex_;
  std::unique_ptr<Drawing> drawing_;  ///< tried out; null: not yet, or in vain
  std::string drawing_complaint_;
  std::vector<std::unique_ptr<DeviceWalk>> walks_;
  std::vector<std::unique_ptr<paper::RasterBackend>> rasters_;
};

/// A device that was found, and the result of trying it out.
struct FoundDevice {
  PhysicalDevice physical;
  std::string complaint;  ///< why it is left out; empty if it is not
};

/// The process's devices. Vulkan is looked for when they are first asked for.
class Devices {
 public:
  static Devices& of_process();

  /// All devices, tried.
  std::vector<FoundDevice> list();
  /// Why the list is empty.
  std::string complaint();

  struct Choice {
    std::shared_ptr<ReadyDevice> opened;  ///< null: none
    std::string complaint;                ///< then why
    bool is_unknown = false;              ///< no device has that number or name
    bool is_software = false;  ///< it is a program on the CPU, which would take its time from the CPU's threads
  };
  /// By number in the list or part of the name, whatever the case of its letters; empty: IMPINGE_DEVICE, or else the
  /// first that can be used.
  Choice choose(std::string_view name);
  /// The same choice without opening anything; `opened` is set only if the device is open already.
  Choice look_up(std::string_view name);

  /// For tests: forgets what is open, and opens devices so from now on.
  void reopen(const Limits& limits, bool validate);

 private:
  struct Slot {
    FoundDevice known;
    std::shared_ptr<ReadyDevice> opened;
    bool is_tried = false;
  };
  void look();
  void try_out(Slot& slot);
  Choice choice_of(const Slot& slot) const;
  Choice choose(std::string_view name, bool may_open);

  std::mutex mutex_;
  std::unique_ptr<Instance> instance_;
  std::vector<Slot> slots_;
  Limits limits_;
  bool validate_ = false;
};

}  // namespace impinge::gpu
