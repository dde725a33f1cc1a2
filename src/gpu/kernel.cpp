// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "gpu/kernel.hpp"

#include <algorithm>

namespace impinge::gpu {

Kernel::Kernel(Device& device, std::span<const std::uint32_t> spirv, std::vector<std::uint32_t> bindings,
               std::uint32_t push_bytes)
    : device_(device), bindings_(std::move(bindings)), push_bytes_(push_bytes) {
  if (bindings_.size() > device.physical().properties.limits.maxPerStageDescriptorStorageBuffers)
    throw Failure("its shaders may not use as many buffers as are needed");
  std::vector<VkDescriptorSetLayoutBinding> declared;
  for (const std::uint32_t binding : bindings_)
    declared.push_back({.binding = binding,
                        .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                        .descriptorCount = 1,
                        .stageFlags = VK_SHADER_STAGE_COMPUTE_BIT});
  const VkDescriptorSetLayoutCreateInfo set{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                            .bindingCount = static_cast<std::uint32_t>(declared.size()),
                                            .pBindings = declared.data()};
  const VkPushConstantRange push{.stageFlags = VK_SHADER_STAGE_COMPUTE_BIT, .size = push_bytes};
  VkShaderModule module = VK_NULL_HANDLE;
  try {
    check(vkCreateDescriptorSetLayout(device.handle(), &set, nullptr, &set_layout_), "laying out a shader's buffers");
    const VkPipelineLayoutCreateInfo layout{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                            .setLayoutCount = 1,
                                            .pSetLayouts = &set_layout_,
                                            .pushConstantRangeCount = push_bytes > 0 ? 1u : 0u,
                                            .pPushConstantRanges = &push};
    check(vkCreatePipelineLayout(device.handle(), &layout, nullptr, &pipeline_layout_), "laying out a shader");
    const VkShaderModuleCreateInfo code{
        .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, .codeSize = spirv.size_bytes(), .pCode = spirv.data()};
    check(vkCreateShaderModule(device.handle(), &code, nullptr, &module), "loading a shader");
    const VkComputePipelineCreateInfo pipeline{.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
                                               .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                                                         .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                                                         .module = module,
                                                         .pName = "main"},
                                               .layout = pipeline_layout_};
    check(vkCreateComputePipelines(device.handle(), VK_NULL_HANDLE, 1, &pipeline, nullptr, &pipeline_),
          "compiling a shader");
  } catch (...) {
    vkDestroyShaderModule(device.handle(), module, nullptr);
    release();
    throw;
  }
  vkDestroyShaderModule(device.handle(), module, nullptr);
}

Kernel::~Kernel() { release(); }

void Kernel::release() {
  vkDestroyPipeline(device_.handle(), pipeline_, nullptr);
  vkDestroyPipelineLayout(device_.handle(), pipeline_layout_, nullptr);
  vkDestroyDescriptorSetLayout(device_.handle(), set_layout_, nullptr);
}

void Kernel::bind(VkCommandBuffer commands, VkDescriptorSet set, const void* push_constants) const {
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
  vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_layout_, 0, 1, &set, 0, nullptr);
  if (push_bytes_ > 0)
    vkCmdPushConstants(commands, pipeline_layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, push_bytes_, push_constants);
}

Bindings::Bindings(Device& device, std::vector<const Kernel*> kernels) : device_(device), kernels_(std::move(kernels)) {
  std::vector<VkDescriptorSetLayout> layouts;
  std::uint32_t buffers = 0;
  for (const Kernel* kernel : kernels_) {
    layouts.push_back(kernel->layout());
    buffers += static_cast<std::uint32_t>(kernel->bindings().size());
  }
  const auto count = static_cast<std::uint32_t>(layouts.size());
  const VkDescriptorPoolSize size{.type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, .descriptorCount = buffers};
  const VkDescriptorPoolCreateInfo pool{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                        .maxSets = count,
                                        .poolSizeCount = 1,
                                        .pPoolSizes = &size};
  check(vkCreateDescriptorPool(device.handle(), &pool, nullptr, &pool_), "making room for a shader's buffers");
  const VkDescriptorSetAllocateInfo sets{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                         .descriptorPool = pool_,
                                         .descriptorSetCount = count,
                                         .pSetLayouts = layouts.data()};
  sets_.resize(count);
  if (const VkResult result = vkAllocateDescriptorSets(device.handle(), &sets, sets_.data()); result < 0) {
    vkDestroyDescriptorPool(device.handle(), pool_, nullptr);
    check(result, "making room for a shader's buffers");
  }
}

Bindings::~Bindings() { vkDestroyDescriptorPool(device_.handle(), pool_, nullptr); }

void Bindings::set(std::uint32_t binding, const Buffer& buffer) {
  const VkDescriptorBufferInfo info{.buffer = buffer.handle(), .offset = 0, .range = buffer.shown_bytes()};
  for (std::size_t i = 0; i < kernels_.size(); ++i) {
    const auto& declared = kernels_[i]->bindings();
    if (std::find(declared.begin(), declared.end(), binding) == declared.end()) continue;
    const VkWriteDescriptorSet write{.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                     .dstSet = sets_[i],
                                     .dstBinding = binding,
                                     .descriptorCount = 1,
                                     .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                     .pBufferInfo = &info};
    vkUpdateDescriptorSets(device_.handle(), 1, &write, 0, nullptr);
  }
}

VkDescriptorSet Bindings::of(const Kernel& kernel) const {
  const auto found = std::find(kernels_.begin(), kernels_.end(), &kernel);
  return sets_[static_cast<std::size_t>(found - kernels_.begin())];
}

}  // namespace impinge::gpu
