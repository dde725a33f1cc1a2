// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <span>
#include <vector>

#include "gpu/kernel.hpp"
#include "tests/gpu/environment.hpp"

namespace impinge::test {

/// What a shader with 64 invocations a workgroup makes of cases, one an invocation: it reads them at binding 0 and
/// writes its answers at binding 1.
template <class Answer, class Case>
std::vector<Answer> ask(std::span<const std::uint32_t> shader, const std::vector<Case>& cases) {
  const auto opened = gpu::Devices::of_process().choose("").opened;
  EXPECT_TRUE(opened);
  gpu::Device& device = opened->device;
  const std::size_t bytes = cases.size() * sizeof(Case);
  const gpu::Buffer upload(device, bytes, gpu::Buffer::Use::upload), input(device, bytes, gpu::Buffer::Use::device);
  const gpu::Buffer output(device, cases.size() * sizeof(Answer), gpu::Buffer::Use::readback);
  const gpu::Kernel kernel(device, shader, {0, 1}, 0);
  gpu::Bindings bindings(device, {&kernel});
  bindings.set(0, input), bindings.set(1, output);
  std::memcpy(upload.mapped<char>(), cases.data(), bytes);
  gpu::Commands commands(device);
  commands.start([&](VkCommandBuffer buffer) {
    gpu::copy(buffer, upload, 0, input, 0, bytes);
    gpu::barrier(buffer);
    kernel.bind(buffer, bindings.of(kernel), nullptr);
    vkCmdDispatch(buffer, static_cast<std::uint32_t>((cases.size() + 63) / 64), 1, 1);
    gpu::hand_to_host(buffer);
  });
  commands.wait();
  const auto* const answers = output.mapped<const Answer>();
  return {answers, answers + cases.size()};
}

}  // namespace impinge::test
